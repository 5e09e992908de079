//! Small valid documents.

use glam::DVec3;
use tmesh::{
    Axis, Document, Frame, Gluing, Group, HistoryEntry, Instance, Isometry, Kind, Marker, OUTSIDE,
    OtherAxis, Outside, Promise, Region, RegionMap, RejectedOrder, Search, Size, SizeField,
    SizePoint, Source, Symmetry, Template, Tet, Triangle, Wishes,
};

fn triangle(vertices: [u32; 3], marker: u32) -> Triangle {
    Triangle {
        vertices,
        marker,
        front: OUTSIDE,
        back: 1,
    }
}

fn instance(template: u32, isometry: Isometry, region_map: u32) -> Instance {
    Instance {
        template,
        isometry,
        region_map,
    }
}

fn region(id: u32, name: &str) -> Region {
    Region {
        id,
        name: name.to_owned(),
        size: None,
        volume: None,
    }
}

/// A square pyramid as four images of one tetrahedron between two mirror walls. `SPEC.md`,
/// section 11, is its hex dump.
pub fn pyramid() -> Document {
    let mirror = |name: &str, reflection, vertices: [u32; 3], triangle| {
        Gluing::mirror(name, 0, reflection, vertices, [triangle])
    };
    let mut document = Document::single(Template {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: vec![
            triangle([0, 2, 1], 0),
            triangle([0, 1, 3], 0),
            triangle([0, 3, 2], 0),
            triangle([1, 2, 3], 0),
        ],
        tets: vec![Tet {
            vertices: [0, 1, 2, 3],
            region: 1,
        }],
        gluings: vec![
            mirror("a", Isometry::reflection(0, 1), [0, 1, 3], 1),
            mirror("b", Isometry::reflection(1, 2), [0, 2, 3], 2),
        ],
        axis: vec![0, 3],
    });
    document.instances = [(0, false), (0, true), (1, false), (1, true)]
        .map(|(k, mirrored)| instance(0, Isometry::new(k, 2, mirrored, false), 0))
        .to_vec();
    document.regions = vec![region(1, "Cu")];
    document
}

/// The pyramid with lengths of edges that change from place to place: in a tetrahedron, and on a triangle beside it.
pub fn sized() -> Document {
    let point = |position: DVec3, size: f64| SizePoint { position, size };
    Document {
        size_field: Some(SizeField {
            points: vec![
                point(DVec3::new(-1.0, -1.0, 0.0), 0.5),
                point(DVec3::new(3.0, -1.0, 0.0), 0.25),
                point(DVec3::new(-1.0, 3.0, 0.0), 0.125),
                point(DVec3::new(-1.0, -1.0, 4.0), 1e-3),
                point(DVec3::new(-1.0, -2.0, 0.0), 1.0),
            ],
            tets: vec![[0, 1, 2, 3]],
            triangles: vec![[0, 4, 1]],
        }),
        ..pyramid()
    }
}

/// Corners of an upright prism: corner i of the outline at the bottom is vertex 2 i, at the top
/// 2 i + 1.
fn upright(outline: &[(f64, f64)]) -> Vec<DVec3> {
    let at = |&(x, y): &(f64, f64)| [0.0, 0.5].map(|z| DVec3::new(x, y, z));
    outline.iter().flat_map(at).collect()
}

/// Pairs of the high face with the low one.
fn seam(own: u32, vertex_pairs: [[u32; 2]; 4]) -> Gluing {
    Gluing {
        name: "seam".to_owned(),
        other: own,
        step: Isometry::rotation(1, 4),
        vertex_pairs: vertex_pairs.to_vec(),
        triangle_pairs: vec![[4, 0], [5, 1]],
    }
}

/// A square column as four quarters, each an outer piece and a hub piece with seams, materials
/// that alternate, and every optional part of a document.
pub fn column() -> Document {
    let outer = Template {
        vertices: upright(&[(1.0, 0.0), (2.0, 0.0), (0.0, 2.0), (0.0, 1.0)]),
        triangles: vec![
            triangle([0, 2, 3], 0),
            triangle([0, 3, 1], 0),
            triangle([2, 4, 5], 7),
            triangle([2, 5, 3], 7),
            triangle([6, 5, 4], 0),
            triangle([6, 7, 5], 0),
            triangle([6, 0, 1], 0),
            triangle([6, 1, 7], 0),
            triangle([0, 4, 2], 8),
            triangle([0, 6, 4], 8),
            triangle([1, 3, 5], 9),
            triangle([1, 5, 7], 9),
        ],
        tets: Vec::new(),
        gluings: vec![
            seam(0, [[4, 2], [5, 3], [6, 0], [7, 1]]),
            Gluing {
                name: "hub".to_owned(),
                other: 1,
                step: Isometry::IDENTITY,
                vertex_pairs: vec![[0, 2], [1, 3], [6, 4], [7, 5]],
                triangle_pairs: vec![[6, 2], [7, 3]],
            },
        ],
        axis: Vec::new(),
    };
    let hub = Template {
        vertices: upright(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]),
        triangles: vec![
            triangle([0, 2, 3], 0),
            triangle([0, 3, 1], 0),
            triangle([4, 3, 2], 0),
            triangle([4, 5, 3], 0),
            triangle([0, 5, 4], 0),
            triangle([0, 1, 5], 0),
            triangle([0, 4, 2], 8),
            triangle([1, 3, 5], 9),
        ],
        tets: Vec::new(),
        gluings: vec![seam(1, [[0, 0], [1, 1], [4, 2], [5, 3]])],
        axis: vec![0, 1],
    };
    let instances = (0..4).flat_map(|k| {
        let turn = Isometry::rotation(k, 4);
        [instance(0, turn, (k % 2) as u32), instance(1, turn, 0)]
    });
    let marker = |id, name: &str, area| Marker {
        id,
        name: name.to_owned(),
        area,
    };
    Document {
        templates: vec![outer, hub],
        instances: instances.collect(),
        region_maps: vec![RegionMap {
            pairs: vec![[1, 2]],
        }],
        // Canonical x, y, z are world y, z, x.
        frame: Frame {
            rotation: glam::DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X),
            origin: DVec3::new(0.25, -3.0, 1e-3),
        },
        symmetry: Some(symmetry()),
        promise: Some(Promise {
            group: Group::new(Kind::C, 4),
            rotation: [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            origin: [0.25, -3.0, 1e-3],
            outside: Some(Outside {
                group: Group::new(Kind::Cv, 8),
                radius: 1.5,
            }),
        }),
        search: Some(Search {
            other_axes: vec![OtherAxis {
                direction: [0.0, 1.0, 0.0],
                order: 2,
                residual: 3e-8,
            }],
            rejected: vec![RejectedOrder {
                order: 8,
                residual: 0.07,
            }],
        }),
        wishes: Wishes {
            radius_edge: Some(1.25),
            size: Some(Size::EdgeLength(0.5)),
            keep_surface: Some(true),
            ..Wishes::default()
        },
        size_field: None,
        regions: vec![
            Region {
                size: Some(Size::MaxVolume(0.125)),
                ..region(1, "copper")
            },
            Region {
                volume: Some(2.0),
                ..region(2, "Silizium \u{3b1}")
            },
        ],
        markers: vec![
            marker(7, "side", Some(4.0)),
            marker(8, "bottom", None),
            marker(9, "top", None),
        ],
        source: Some(Source {
            sector_of: None,
            format: "stl".to_owned(),
            triangles: 28,
            volume: 4.0,
            boundary_area: 21.5,
            precision: 6e-8,
        }),
        history: vec![HistoryEntry {
            tool: "symdetect".to_owned(),
            version: "0.1.0".to_owned(),
            arguments: vec!["--order".to_owned(), "4".to_owned()],
            notes: vec!["order 4".to_owned()],
        }],
    }
}

fn symmetry() -> Symmetry {
    Symmetry {
        group: Group::new(Kind::Ch, 4),
        axis: Axis {
            point: [0.5, -3.0, 1e-3],
            direction: [1.0, 0.0, 0.0],
        },
        reference: [0.0, 1.0, 0.0],
        residual: 1.2e-7,
        tolerance: 1e-3,
        axisymmetric: false,
        radius: 2.0,
        regions: vec![
            RegionMap {
                pairs: vec![[1, 2], [2, 1]],
            },
            RegionMap::default(),
        ],
    }
}

/// The bytes of a document.
pub fn bytes(document: &Document) -> Vec<u8> {
    let mut bytes = Vec::new();
    tmesh::write(document, &mut bytes).expect("a vector takes all bytes");
    bytes
}
