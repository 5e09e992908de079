//! The document model.

use crate::{
    Deviation, Frame, Gluing, Group, Isometry, Promise, RegionMap, Search, Size, SizeField,
    Symmetry, Wishes,
};
use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Region id that means "no material": outside of the body, in a void, or beyond a wall.
pub const OUTSIDE: u32 = u32::MAX;

/// A surface triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Triangle {
    /// Three vertex ids, counter-clockwise seen from the front region.
    pub vertices: [u32; 3],
    /// Id of the boundary piece the triangle belongs to; see [`Marker`].
    pub marker: u32,
    /// Region on the side the normal points to, or [`OUTSIDE`].
    pub front: u32,
    /// Region on the other side, or [`OUTSIDE`].
    pub back: u32,
}

/// A linear tetrahedron, positively oriented: `(b - a) x (c - a) . (d - a) > 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Tet {
    /// Four vertex ids.
    pub vertices: [u32; 4],
    /// Region id.
    pub region: u32,
}

/// A piece of mesh that is stored once and placed by instances. Coordinates are canonical.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Template {
    /// Vertex positions in the canonical frame, model units. All finite.
    pub vertices: Vec<DVec3>,
    /// Surface: outer boundary, region interfaces and glued faces.
    pub triangles: Vec<Triangle>,
    /// Volume; empty before the mesher ran.
    pub tets: Vec<Tet>,
    /// Where the template meets its images and other templates.
    pub gluings: Vec<Gluing>,
    /// Vertices on the symmetry axis (x = y = 0 exactly), increasing.
    pub axis: Vec<u32>,
}

impl Template {
    /// Largest distance of a vertex from the axis, model units; 0 without vertices.
    pub fn reach(&self) -> f64 {
        let squares = self.vertices.iter().map(|p| p.truncate().length_squared());
        squares.fold(0.0, f64::max).sqrt()
    }
}

/// A placed copy of a template.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instance {
    /// Index of the template.
    pub template: u32,
    /// Placement in the canonical frame.
    pub isometry: Isometry,
    /// Index into [`Document::region_maps`] plus one; 0 leaves region ids as they are.
    pub region_map: u32,
}

/// A material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Any id but [`OUTSIDE`].
    pub id: u32,
    /// Name, as the input gives it.
    pub name: String,
    /// Size of its elements wanted, in place of that of the wishes.
    #[serde(default, flatten, skip_serializing_if = "Option::is_none")]
    pub size: Option<Size>,
    /// Volume in the input body, model units cubed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub volume: Option<f64>,
}

/// A named piece of boundary or interface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Marker {
    /// Id used by [`Triangle::marker`].
    pub id: u32,
    /// Name, as the input gives it.
    pub name: String,
    /// Area in the input body, model units squared.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area: Option<f64>,
}

/// What the document was read from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Name of the foreign format, such as `stl`; of several files all of theirs, such as `obj, stl`.
    pub format: String,
    /// Triangles in the input, after welding.
    pub triangles: u64,
    /// Volume of the body, all regions, model units cubed.
    pub volume: f64,
    /// Area of the outer boundary (one side outside), model units squared, less that of sheets without thickness that were taken out.
    pub boundary_area: f64,
    /// Absolute error of a coordinate, model units: what the input's number format can hold at the
    /// size of its largest coordinate.
    pub precision: f64,
    /// How many instances the whole has, where the input is one sector of a mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sector_of: Option<u32>,
}

/// One step in the making of the document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HistoryEntry {
    /// Tool name.
    pub tool: String,
    /// Tool version.
    pub version: String,
    /// Arguments, without the tool's name.
    pub arguments: Vec<String>,
    /// What the tool chose and found, a sentence each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// The document that travels through the pipe.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// Pieces of mesh.
    pub templates: Vec<Template>,
    /// Placed copies.
    pub instances: Vec<Instance>,
    /// Renamings of regions used by instances.
    pub region_maps: Vec<RegionMap>,
    /// From canonical to world coordinates.
    pub frame: Frame,
    /// The symmetry found in the body, once it was searched.
    pub symmetry: Option<Symmetry>,
    /// The symmetry that an assembled mesh has exactly.
    pub promise: Option<Promise>,
    /// How the search for symmetry went.
    pub search: Option<Search>,
    /// What is asked of the elements.
    pub wishes: Wishes,
    /// Lengths of edges wanted that change from place to place, world coordinates; they hold beside the size of the wishes.
    pub size_field: Option<SizeField>,
    /// Materials, increasing in id.
    pub regions: Vec<Region>,
    /// Boundary pieces, increasing in id.
    pub markers: Vec<Marker>,
    /// What the document was read from.
    pub source: Option<Source>,
    /// How the document was made, oldest first.
    pub history: Vec<HistoryEntry>,
}

impl Document {
    /// A document with one template in world coordinates and the identity instance.
    pub fn single(template: Template) -> Self {
        Self {
            templates: vec![template],
            instances: vec![Instance {
                template: 0,
                isometry: Isometry::IDENTITY,
                region_map: 0,
            }],
            ..Self::default()
        }
    }

    /// Whether the document is a plain mesh: one template, placed once by the identity.
    pub fn is_plain(&self) -> bool {
        self.templates.len() == 1
            && self.instances.len() == 1
            && self.instances[0].isometry == Isometry::IDENTITY
            && self.instances[0].region_map == 0
    }

    /// Region that `instance` gives to a region id of its template.
    pub fn placed_region(&self, instance: &Instance, region: u32) -> u32 {
        match instance.region_map {
            0 => region,
            i => self.region_maps[i as usize - 1].get(region),
        }
    }

    /// How far surfaces may move, relative to the radius about the axis. A body within `equal`, relative as well, of its
    /// symmetry has no facets that stand for another shape: it is exact, and none of them moves unless that is asked for. A body without
    /// symmetry says nothing of the kind.
    pub fn deviation(&self, equal: f64) -> f64 {
        match (self.wishes.deviation(), &self.symmetry) {
            (Deviation::Within(relative), _) => relative,
            (Deviation::Auto, None) => 0.0,
            (Deviation::Auto, Some(found))
                if found.residual <= equal && found.group != Group::TRIVIAL =>
            {
                found.residual
            }
            (Deviation::Auto, Some(found)) => found.residual.max(found.tolerance),
        }
    }

    /// Whether edges of some length are asked for, anywhere, and it is left open how far surfaces may move for that.
    pub fn moves_for_lengths(&self) -> bool {
        let regions = self.regions.iter().filter_map(|region| region.size);
        let mut sizes = regions.chain(self.wishes.size);
        let asks = self.size_field.is_some() || sizes.any(|size| size.edge_length().is_some());
        asks && self.wishes.deviation() == Deviation::Auto
    }

    /// How far off its plane a flat face may be drawn, model units: as far as the body may be off its symmetry, of which that is
    /// noise alike, or as far as surfaces may move if that was said. What faces are off by is kept, unlike what
    /// [`Self::deviation`] allows: it only decides which triangles are one face.
    pub fn unevenness(&self) -> f64 {
        let Some(found) = &self.symmetry else {
            return 0.0;
        };
        found.radius
            * match self.wishes.deviation() {
                Deviation::Within(relative) => relative,
                Deviation::Auto => found.tolerance,
            }
    }

    /// How far the surface may be from the input's by now, model units: as far as the input is off its symmetry, its coordinates are off, and
    /// the surface was moved beyond that. What [`Self::deviation`] allows is not in it.
    pub fn displacement(&self) -> f64 {
        let precision = self.source.as_ref().map_or(0.0, |source| source.precision);
        let moved = self.wishes.moved.unwrap_or(0.0);
        let of_radius = |found: &Symmetry| (found.residual + moved) * found.radius;
        precision + self.symmetry.as_ref().map_or(0.0, of_radius)
    }

    /// Notes that the surface is farther from the input's by this, model units, than [`Self::displacement`] says.
    pub fn add_displacement(&mut self, by: f64) {
        if let Some(found) = &self.symmetry
            && by > 0.0
        {
            let earlier = self.wishes.moved.unwrap_or(0.0);
            self.wishes.moved = Some(earlier + by / found.radius);
        }
    }

    /// Diagonal of the bounding box over all templates, in the canonical frame; 0 when empty.
    pub fn diagonal(&self) -> f64 {
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for p in self.templates.iter().flat_map(|t| &t.vertices) {
            low = low.min(*p);
            high = high.max(*p);
        }
        if low.x <= high.x {
            (high - low).length()
        } else {
            0.0
        }
    }
}
