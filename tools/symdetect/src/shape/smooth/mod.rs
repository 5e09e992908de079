//! The smooth shape that facets stand for, and how far it may be from them, place by place.
//!
//! Corners of a drawn surface lie on the shape that was drawn. Between them the shape bends as the facets on either
//! side do: a facet stands for the quadratic patch through its corners whose normal, in the middle of each side, is
//! halfway between its own and that of the facet beyond (the triangle of Morley, Aeronautical Quarterly 19, 1968; as
//! a discrete shape operator, Grinspun, Gingold, Reisman and Zorin, Computer Graphics Forum 25, 2006).
//!
//! Edges up to half a radian are smooth. Steeper ones, up to a sixth of a turn, may be sharp or not where both facets bend
//! into others and are about as wide: inside of faces that are curved in two directions CAD kernels draw coarser than they are told. They are read
//! both ways, and the shape may be anywhere between the two readings.
//!
//! Where all that leaves a symmetry that the drawing does not have unexplained, the vertices around a facet are asked, too: they are on the
//! shape, and tell how it bends along a facet between two sharp edges, and whatever diagonals were drawn. The shape may be as either
//! tells it.
//!
//! Flat faces, sharp edges between them and straight edges so hide nothing; arcs hide their sagitta. A place may be
//! anywhere between the facet and the patch, since facets of flat and of curved faces look alike where they meet, and
//! between the two ways of dividing a quadrilateral into triangles. How well the patch is known is told by the patches
//! next to it; near the corners of a facet, which are on the shape, it is known the better the nearer they are. Where sharp
//! edges meet, the shape itself has a corner, which any drawing of it has.

mod corners;
mod curvature;
mod curves;
mod facets;
mod fit;
mod heights;
mod reading;
mod sharp;
mod slack;
mod surface;

pub use facets::BENT;
pub use fit::Told;
pub use surface::SmoothSurface;
