//! Documents that are well formed and may be wrong in every way: a sound one, altered.

use arbitrary::Arbitrary;
use glam::DVec3;
use tmesh::{
    Axis, Document, Gluing, Group, Instance, Isometry, Kind, MAX_TURN_DENOMINATOR, Marker, OUTSIDE,
    Outside, Promise, Region, RegionMap, Symmetry, Template, Tet, Triangle,
};

const BASES: [&[u8]; 3] = [
    include_bytes!("../../../formats/tmesh/tests/golden/column.tmesh"),
    include_bytes!("../../../formats/tmesh/tests/golden/pyramid.tmesh"),
    include_bytes!("../../../formats/tmesh/tests/golden/sized.tmesh"),
];

/// A sound document and what is altered in it.
#[derive(Arbitrary, Debug)]
pub struct Plan {
    base: u8,
    /// Which of the outputs is tried.
    pub turn: u8,
    edits: Vec<Edit>,
}

/// One alteration. Places count round: every number names something.
#[derive(Arbitrary, Debug)]
struct Edit {
    kind: u8,
    template: u8,
    place: u8,
    part: u8,
    value: Value,
}

/// A number put in.
#[derive(Arbitrary, Debug)]
enum Value {
    /// A small one, which often names something.
    Small(u8),
    /// One of those that mean trouble.
    Special(u8),
    /// Any.
    Any(u64),
}

impl Value {
    fn integer(&self) -> u32 {
        match *self {
            Self::Small(x) => u32::from(x),
            Self::Special(x) => {
                const ALL: [u32; 8] = [0, 1, 65_535, 65_536, 65_537, 1 << 31, OUTSIDE - 1, OUTSIDE];
                ALL[usize::from(x) % ALL.len()]
            }
            Self::Any(x) => x as u32,
        }
    }

    fn number(&self) -> f64 {
        match *self {
            Self::Small(x) => f64::from(x as i8) / 4.0,
            Self::Special(x) => {
                const ALL: [f64; 12] = [
                    0.0,
                    -0.0,
                    f64::NAN,
                    f64::INFINITY,
                    f64::NEG_INFINITY,
                    f64::MAX,
                    f64::MIN_POSITIVE,
                    5e-324,
                    1e-15,
                    1e160,
                    -1e300,
                    1e-200,
                ];
                ALL[usize::from(x) % ALL.len()]
            }
            Self::Any(x) => f64::from_bits(x),
        }
    }

    /// An isometry: numerator and denominator of the turn, and flags.
    fn isometry(&self, k: u8) -> Isometry {
        let n = self.integer() % MAX_TURN_DENOMINATOR + 1;
        Isometry::new(i64::from(k / 4), n, k & 1 != 0, k & 2 != 0)
    }
}

impl Plan {
    /// The altered document.
    pub fn document(&self) -> Document {
        let base = BASES[usize::from(self.base) % BASES.len()];
        let mut document = tmesh::read(base).expect("it is sound");
        // Two more to start from: the mesh assembled, and a sector.
        match self.base / 2 % 4 {
            1 => document = assembled(&document),
            2 => document = rotassemble::sector(document),
            _ => {}
        }
        for edit in self.edits.iter().take(16) {
            edit.apply(&mut document);
        }
        document
    }
}

fn assembled(document: &Document) -> Document {
    let mut bytes = Vec::new();
    let mesh = rotassemble::Assembled::new(document).expect("it is sound");
    rotassemble::write_expanded(&mesh, document, &mut bytes).expect("a vector takes all bytes");
    tmesh::read(bytes.as_slice()).expect("it is sound")
}

/// An element of a list, counted round.
fn nth<T>(list: &mut [T], at: u8) -> Option<&mut T> {
    let count = list.len().max(1);
    list.get_mut(usize::from(at) % count)
}

impl Edit {
    fn apply(&self, document: &mut Document) {
        // The first half of the kinds alters the document, the other one a template.
        if self.kind.is_multiple_of(2) {
            self.apply_to_document(document);
        } else if let Some(template) = nth(&mut document.templates, self.template) {
            self.apply_to_template(template);
        }
    }

    fn apply_to_document(&self, document: &mut Document) {
        let (place, value) = (self.place, &self.value);
        match self.kind / 2 % 24 {
            0 => set(nth(&mut document.instances, place), |i| {
                i.template = value.integer();
            }),
            1 => set(nth(&mut document.instances, place), |i| {
                i.isometry = value.isometry(self.part);
            }),
            2 => set(nth(&mut document.instances, place), |i| {
                i.region_map = value.integer();
            }),
            3 => document.instances.push(Instance {
                template: u32::from(self.template),
                isometry: value.isometry(self.part),
                region_map: 0,
            }),
            4 => remove(&mut document.instances, place),
            5 => document.instances.clear(),
            6 => set(nth(&mut document.regions, place), |r| {
                r.id = value.integer()
            }),
            7 => document.regions.push(Region {
                id: value.integer(),
                name: "region".repeat(usize::from(self.part % 3)),
                size: Some(tmesh::Size::MaxVolume(value.number())),
                volume: None,
            }),
            8 => remove(&mut document.regions, place),
            9 => set(nth(&mut document.regions, place), |r| {
                r.volume = Some(value.number());
            }),
            10 => document.markers.push(Marker {
                id: value.integer(),
                name: "\u{fffd}<\"&\n".to_owned(),
                area: None,
            }),
            11 => document.region_maps.push(RegionMap {
                pairs: vec![[u32::from(place), value.integer()]],
            }),
            12 => set(nth(&mut document.region_maps, place), |m| {
                m.pairs.push([u32::from(self.part), value.integer()]);
            }),
            13 => {
                let entry = usize::from(place) % 9;
                let mut rows = document.frame.rotation.to_cols_array();
                rows[entry] = value.number();
                document.frame.rotation = glam::DMat3::from_cols_array(&rows);
            }
            14 => document.frame.origin[usize::from(place) % 3] = value.number(),
            15 => document.templates.push(Template::default()),
            16 => {
                if let Some(template) = nth(&mut document.templates, place).cloned() {
                    document.templates.push(template);
                }
            }
            17 => remove(&mut document.templates, place),
            18 => document.templates.reverse(),
            19 => {
                let symmetry = document.symmetry.get_or_insert_with(symmetry);
                match place % 8 {
                    0 => symmetry.group = group(self.part, value.integer()),
                    1 => symmetry.axis.direction[usize::from(self.part) % 3] = value.number(),
                    2 => symmetry.axis.point[usize::from(self.part) % 3] = value.number(),
                    3 => symmetry.reference[usize::from(self.part) % 3] = value.number(),
                    4 => symmetry.residual = value.number(),
                    5 => symmetry.radius = value.number(),
                    6 => symmetry.tolerance = value.number(),
                    _ => symmetry.regions.push(RegionMap {
                        pairs: vec![[u32::from(self.part), value.integer()]],
                    }),
                }
            }
            20 => {
                let promise = document.promise.get_or_insert(Promise {
                    group: Group::TRIVIAL,
                    rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                    origin: [0.0; 3],
                    outside: None,
                });
                match place % 4 {
                    0 => promise.group = group(self.part, value.integer()),
                    1 => promise.rotation[usize::from(self.part) % 3][0] = value.number(),
                    2 => promise.origin[usize::from(self.part) % 3] = value.number(),
                    _ => {
                        promise.outside = Some(Outside {
                            group: group(place / 4, u32::from(self.part)),
                            radius: value.number(),
                        });
                    }
                }
            }
            21 => {
                if let Some(source) = &mut document.source {
                    source.volume = value.number();
                }
            }
            22 => document.source = None,
            _ => document.symmetry = None,
        }
    }

    fn apply_to_template(&self, template: &mut Template) {
        let (place, part, value) = (self.place, usize::from(self.part), &self.value);
        match self.kind / 2 % 20 {
            0 => set(nth(&mut template.vertices, place), |p| {
                p[part % 3] = value.number();
            }),
            1 => template.vertices.push(DVec3::splat(value.number())),
            2 => {
                template.vertices.pop();
            }
            3 => set(nth(&mut template.triangles, place), |t| {
                t.vertices[part % 3] = value.integer();
            }),
            4 => set(nth(&mut template.triangles, place), |t| match part % 3 {
                0 => t.front = value.integer(),
                1 => t.back = value.integer(),
                _ => t.marker = value.integer(),
            }),
            5 => set(nth(&mut template.triangles, place), |t| {
                t.vertices.reverse()
            }),
            6 => template.triangles.push(Triangle {
                vertices: [u32::from(place), value.integer(), u32::from(self.part)],
                marker: 0,
                front: OUTSIDE,
                back: 1,
            }),
            7 => {
                template.triangles.pop();
            }
            8 => set(nth(&mut template.tets, place), |t| {
                t.vertices[part % 4] = value.integer();
            }),
            9 => set(nth(&mut template.tets, place), |t| {
                t.region = value.integer()
            }),
            10 => template.tets.push(Tet {
                vertices: [u32::from(place), u32::from(self.part), value.integer(), 0],
                region: 1,
            }),
            11 => template.tets.clear(),
            12 => template.axis.push(value.integer()),
            13 => template.axis.clear(),
            14 => remove(&mut template.gluings, place),
            15 => {
                if let Some(gluing) = nth(&mut template.gluings, place).cloned() {
                    template.gluings.push(gluing);
                }
            }
            16 => template.gluings.push(new_gluing(place, self.part, value)),
            17 => template.triangles.reverse(),
            _ => set(nth(&mut template.gluings, place), |gluing| {
                alter_gluing(gluing, self.template, self.part, value);
            }),
        }
    }
}

fn set<T>(entry: Option<&mut T>, change: impl FnOnce(&mut T)) {
    if let Some(entry) = entry {
        change(entry);
    }
}

fn remove<T>(list: &mut Vec<T>, at: u8) {
    if !list.is_empty() {
        list.remove(usize::from(at) % list.len());
    }
}

/// A group as a document can name one.
fn group(kind: u8, order: u32) -> Group {
    let kind = Kind::ALL[usize::from(kind) % Kind::ALL.len()];
    Group::new(kind, 1 + order % kind.max_order())
}

fn new_gluing(place: u8, part: u8, value: &Value) -> Gluing {
    let pair = [u32::from(part); 2];
    match place % 3 {
        0 => Gluing::mirror("", 0, Isometry::FLIP, [u32::from(part)], []),
        1 => Gluing::seam("seam", 0, value.isometry(part), [pair], []),
        _ => Gluing {
            name: "hub".to_owned(),
            other: u32::from(part) % 3,
            step: value.isometry(part),
            vertex_pairs: vec![pair],
            triangle_pairs: Vec::new(),
        },
    }
}

fn alter_gluing(gluing: &mut Gluing, at: u8, part: u8, value: &Value) {
    let id = value.integer();
    match part % 7 {
        0 => set(nth(gluing.vertex_pairs.as_flattened_mut(), at), |v| *v = id),
        1 => set(nth(gluing.triangle_pairs.as_flattened_mut(), at), |t| {
            *t = id
        }),
        2 => gluing.step = value.isometry(at),
        3 => gluing.other = id,
        4 => gluing.vertex_pairs.push([id, u32::from(at)]),
        5 => gluing.triangle_pairs.push([id, u32::from(at)]),
        _ => remove(&mut gluing.triangle_pairs, at),
    }
}

fn symmetry() -> Symmetry {
    Symmetry {
        group: Group::new(Kind::C, 2),
        axis: Axis {
            point: [0.0; 3],
            direction: [0.0, 0.0, 1.0],
        },
        reference: [1.0, 0.0, 0.0],
        residual: 0.0,
        tolerance: 1e-3,
        axisymmetric: false,
        radius: 1.0,
        regions: Vec::new(),
    }
}
