//! Collects what is wrong: a count and the first place of each kind.

use glam::DVec3;
use kit::number;
use serde::Serialize;
use std::collections::BTreeMap;
use tmesh::Document;

/// A broken promise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Broken {
    /// Which promise: `conforming`, `orientation`, `coincidence`, `symmetry`, `volume` or `document`.
    pub promise: &'static str,
    /// How often.
    pub count: u64,
    /// A sentence with the count, the first case, its numbers and its place.
    pub text: String,
}

macro_rules! kinds {
    ($($name:ident, $promise:literal, $text:literal;)*) => {
        /// Ways of breaking a promise, in the order of reports.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Kind { $(#[doc = $text] $name,)* }

        impl Kind {
            /// The promise, and what is counted.
            fn texts(self) -> (&'static str, &'static str) {
                match self { $(Self::$name => ($promise, $text),)* }
            }
        }
    };
}

kinds! {
    Document, "document", "inconsistencies of the document";
    Unplaced, "document", "templates that are placed nowhere, so that nothing of them is in the mesh";
    Sector, "document", "pieces that were taken for the whole body";
    OverfullFace, "conforming", "faces with more than two tetrahedra";
    SameSide, "conforming", "faces with two tetrahedra on the same side";
    MissingTriangle, "conforming", "open faces inside (one tetrahedron, and no surface triangle): cracks";
    MissingInterface, "conforming", "faces between regions without a surface triangle";
    StrayTriangle, "conforming", "surface triangles that are no face of a tetrahedron";
    RepeatedTriangle, "conforming", "surface triangles that occur more than once";
    WrongRegion, "conforming", "surface triangles whose regions are not those of the tetrahedra beside them";
    OpenEdge, "conforming", "edges at which the surface does not close";
    WallInside, "conforming", "wall triangles without exactly one tetrahedron, or with material beyond";
    BeyondWall, "conforming", "vertices beyond a mirror wall";
    UnlistedWallFace, "conforming", "faces that lie on a wall and are not listed on it";
    HubCoverage, "conforming", "hub wall triangles that do not meet each instance exactly once";
    UngluedFace, "conforming", "pairs of boundary faces of copies that lie on each other without being glued";
    Crossing, "conforming", "pairs of boundary faces of copies that cross or touch";
    Inverted, "orientation", "tetrahedra that are not positively oriented";
    Coincident, "coincidence", "vertices that coincide with another";
    NearWall, "coincidence", "vertices that nearly lie on a mirror wall, so that they coincide with their image";
    UnpairedVertex, "coincidence", "vertices that coincide with one of the neighbour across a wall, unpaired";
    Unglued, "coincidence", "vertices of copies that coincide without being glued";
    Instances, "symmetry", "symmetries of the instances that fall short of the promise";
    NoImage, "symmetry", "vertices whose image is no vertex";
    Deviation, "symmetry", "vertices that miss their image";
    NoPermutation, "symmetry", "vertices on which the images of two vertices fall";
    TetImage, "symmetry", "tetrahedra whose image is no tetrahedron";
    RegionImage, "symmetry", "tetrahedra whose image has a region at odds with the others";
    TriangleImage, "symmetry", "surface triangles whose image is no surface triangle with the same sides";
    BadPromise, "symmetry", "promises that make no sense";
    Volume, "volume", "total volume that differs from the input's";
    RegionVolume, "volume", "volumes of regions that differ from the input's";
    BoundaryArea, "volume", "boundary area that differs from the input's";
}

/// Findings of a run.
pub struct Findings {
    items: BTreeMap<Kind, (u64, String)>,
}

impl Findings {
    /// None yet.
    pub fn new() -> Self {
        Self {
            items: BTreeMap::new(),
        }
    }

    /// Counts one; `text` describes it if it is the first of its kind.
    pub fn add(&mut self, kind: Kind, text: impl FnOnce() -> String) {
        self.items.entry(kind).or_insert_with(|| (0, text())).0 += 1;
    }

    /// Whether one of the kinds was found.
    pub fn has(&self, kinds: &[Kind]) -> bool {
        kinds.iter().any(|k| self.items.contains_key(k))
    }

    /// Everything found.
    pub fn broken(&self) -> Vec<Broken> {
        let broken = |(kind, (count, first)): (&Kind, &(u64, String))| {
            let (promise, what) = kind.texts();
            let text = format!("{count} {what}; first: {first}");
            Broken {
                promise,
                count: *count,
                text,
            }
        };
        self.items.iter().map(broken).collect()
    }
}

/// "near (x, y, z)": where an element is, in world coordinates, and of which template.
pub fn at(document: &Document, template: usize, vertices: &[u32]) -> String {
    let points = &document.templates[template].vertices;
    let sum: DVec3 = vertices.iter().map(|&v| points[v as usize]).sum();
    let place = place(document, sum / vertices.len().max(1) as f64);
    let of = if document.templates.len() > 1 {
        format!(" of template {template}")
    } else {
        String::new()
    };
    format!("{place}{of}")
}

/// "near (x, y, z)" in world coordinates, of a point in the frame of the document.
pub fn place(document: &Document, point: DVec3) -> String {
    let [x, y, z] = document.frame.to_world(point).to_array().map(number);
    format!("near ({x}, {y}, {z})")
}
