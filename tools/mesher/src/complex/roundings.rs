//! How far what the mesher is given and gives back is from where it belongs.

/// How far walls are moved to be exactly coplanar at most (see [`super::flat`]), relative to the size; and what may be lost
/// by it: the unevenness of facets, the part of a volume or an area, the place of a point along an edge. A smaller
/// value would leave walls of some orders not exactly coplanar; a larger one reaches details of thin layers.
pub const FLATNESS: f64 = 1e-9;

/// Facets may be uneven by so many times the input's precision where that is more than [`FLATNESS`]: two roundings for each
/// of a plane's point and of the vertex off it.
pub const PRECISIONS: f64 = 4.0;

/// Points that the mesher puts on a plane or on the axis may be this far from it, relative to the largest coordinate: some
/// ten thousand roundings, which is what the coordinates of circumcentres of nearly flat triangles lose.
pub const ROUNDING: f64 = 1e-11;

/// How often points are put back onto planes that meet: a single projection meets a single plane, and leaves
/// others that it crosses by less each time. Planes at an angle of 45 degrees and more, as nearly all are, have
/// what is left halved by each round.
pub const PROJECTIONS: usize = 4;
