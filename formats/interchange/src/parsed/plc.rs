//! A piecewise linear complex as its file lists it.

use glam::DVec3;

/// A piecewise linear complex.
#[derive(Clone, Debug, Default)]
pub struct Plc {
    /// Nodes. All finite.
    pub points: Vec<DVec3>,
    /// Facets.
    pub facets: Vec<Facet>,
    /// A point in each hole.
    pub holes: Vec<DVec3>,
    /// A point in each region.
    pub regions: Vec<Seed>,
    /// Largest error of a coordinate relative to the largest one.
    pub relative_precision: f64,
}

/// A planar facet.
#[derive(Clone, Debug, Default)]
pub struct Facet {
    /// Closed polygons, single segments (two nodes) and single nodes.
    pub polygons: Vec<Vec<u32>>,
    /// A point in each hole of the facet.
    pub holes: Vec<DVec3>,
    /// Boundary marker.
    pub marker: i64,
}

/// A point that says which region it lies in.
#[derive(Clone, Debug)]
pub struct Seed {
    /// Where.
    pub point: DVec3,
    /// The region's attribute, as printed.
    pub attribute: String,
    /// Largest tetrahedron volume wanted in the region.
    pub max_volume: Option<f64>,
}
