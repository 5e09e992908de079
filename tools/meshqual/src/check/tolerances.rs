//! What counts as equal, in one place.

/// Distance below which two vertices coincide, relative to the mesh's size (the diagonal of its
/// bounding box): the promise of assembled meshes. Copies of a vertex that were not welded are some
/// 1e-16 of the size apart, and edges this short would have no direction left to compute with.
pub const COINCIDENCE: f64 = 1e-12;

/// How well a vertex has to fall on its image, relative to the size: the promise of assembled meshes.
pub const IMAGE: f64 = 1e-12;

/// Roundings of the largest world coordinate that are allowed on top of [`IMAGE`], in epsilons. A stored
/// world coordinate is off by half an epsilon of itself, a vertex by the square root of three halves, and
/// its image misses another vertex by twice that, 1.7 epsilons. The next powers of two above are 2 and
/// 4; 8 leaves room for files that hold a digit less.
pub const ROUNDINGS: f64 = 8.0;

/// How far from an image its vertex is looked for where none is near enough, relative to the size: the
/// distance is only reported, and beyond this a vertex is said to have no image.
pub const REACH: f64 = 1e-6;

/// How well a distance from the axis is known, relative to it: radii are promised with six digits or
/// more, and computed with some 1e-16. Anything between serves.
pub const RADIUS: f64 = 1e-9;

/// Deviation from orthonormality up to which the frame of a promise counts as a rotation: that of a
/// normalized frame is some 1e-16, and what it adds to images stays within [`IMAGE`].
pub const FRAME: f64 = 1e-12;

/// Relative difference of volumes and areas that is allowed where the input is exact and exactly
/// symmetric: a choice. The volume of a layer a millionth as thick as wide, of coordinates with 16
/// digits, is good to 1e-10; the smallest part of a body that could be lost unnoticed is a millionth.
pub const VOLUME: f64 = 1e-6;

/// How many times the residual and the precision of the input a boundary may have moved: a mesh is one
/// sector's copies, so that a place can be off by the residual of the sector and by that of the copy;
/// and points near the cuts are moved onto them by as much again.
pub const SHIFTS: f64 = 4.0;
