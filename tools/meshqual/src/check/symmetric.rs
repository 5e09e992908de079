//! Exact symmetry of a plain mesh: the generators of its group map it onto itself.

use super::RADIUS_SLACK;
use super::findings::{Findings, Kind, at};
use crate::faces::sorted;
use geom::grid::Grid;
use glam::{DMat3, DVec3};
use kit::number;
use rustc_hash::FxHashMap;
use tmesh::{Document, Frame, Group, Isometry, Promise, Tet};

/// How well a vertex has to fall on its image, relative to the size.
const RESIDUAL: f64 = 1e-12;
/// World coordinates far from the origin hold less: so many roundings of the largest one are allowed
/// on top.
const ROUNDINGS: f64 = 8.0;
/// How far from an image its vertex is looked for, relative to the size.
const REACH: f64 = 1e-6;

const NONE: u32 = u32::MAX;

/// What the check found out.
pub struct Symmetry {
    /// Largest distance between an image and the vertex nearest to it, relative to the size; at least
    /// [`REACH`] if a vertex has no image.
    pub residual: f64,
    /// Whether vertices, tetrahedra, regions and triangles are mapped onto such.
    pub connectivity: bool,
}

/// Checks a plain mesh against the symmetry it promises.
///
/// Per generator: each vertex's image is matched with the vertex nearest to it, then tetrahedra and
/// triangles are mapped by vertex ids alone. A map of a finite set into itself that maps no two
/// elements onto one is onto, so all images are covered too. What is promised outside of a radius is
/// checked in the same way on the elements that reach beyond it. Linear.
pub fn check(
    document: &Document,
    promise: &Promise,
    size: f64,
    findings: &mut Findings,
) -> Symmetry {
    let mut found = Symmetry {
        residual: 0.0,
        connectivity: true,
    };
    let Some(frame) = frame(promise) else {
        findings.add(Kind::BadPromise, || {
            format!(
                "{}, a frame that is not a rotation and a finite shift, or a group outside of a radius \
                 that does not fit",
                promise.group
            )
        });
        found.connectivity = false;
        return found;
    };
    let template = &document.templates[0];
    let same = document.frame == frame;
    let points: Vec<DVec3> = template
        .vertices
        .iter()
        .map(|&p| match same {
            true => p,
            false => frame.to_canonical(document.frame.to_world(p)),
        })
        .collect();
    let largest = template
        .vertices
        .iter()
        .fold(frame.origin.abs().max_element(), |m, p| {
            m.max(document.frame.to_world(*p).abs().max_element())
        });
    let mut matcher = Matcher {
        points: &points,
        size,
        limit: RESIDUAL * size + ROUNDINGS * f64::EPSILON * largest,
        near: None,
        far: None,
    };
    let tets = TetIndex::new(&template.tets, points.len());
    let triangles: FxHashMap<[u32; 3], u32> = template
        .triangles
        .iter()
        .enumerate()
        .map(|(i, t)| (sorted(t.vertices).0, i as u32))
        .collect();
    let mut outer = None;
    for generator in generators(promise) {
        let part = match generator.beyond {
            None => &Part::default(),
            Some(radius) => outer.get_or_insert_with(|| {
                let margin = RADIUS_SLACK * radius + matcher.limit;
                Part::beyond(radius + margin, &template.tets, &points)
            }),
        };
        let (residual, images) = matcher.images(document, &generator, part, findings);
        found.residual = found.residual.max(residual);
        check_permutation(document, &generator.name, &images, findings);
        let regions = map_tets(document, &generator.name, part, &images, &tets, findings);
        map_triangles(
            document, &generator, part, &images, &regions, &triangles, findings,
        );
    }
    found.connectivity = !findings.has(&CONNECTIVITY);
    found
}

const CONNECTIVITY: [Kind; 5] = [
    Kind::NoImage,
    Kind::NoPermutation,
    Kind::TetImage,
    Kind::RegionImage,
    Kind::TriangleImage,
];

fn frame(promise: &Promise) -> Option<Frame> {
    let [a, b, c] = promise.rotation.map(DVec3::from_array);
    let rotation = DMat3::from_cols(a, b, c).transpose();
    let origin = DVec3::from_array(promise.origin);
    let off = rotation.transpose() * rotation - DMat3::IDENTITY;
    let off = off
        .to_cols_array()
        .iter()
        .fold(0.0_f64, |m, x| m.max(x.abs()));
    let proper = off <= 1e-12 && rotation.determinant() > 0.0 && origin.is_finite();
    let turns = |group: Group| (1..=group.kind.max_order()).contains(&group.order);
    let fits = turns(promise.group)
        && promise.outside.is_none_or(|o| {
            turns(o.group)
                && o.group.order.is_multiple_of(promise.group.order)
                && (0.0..f64::INFINITY).contains(&o.radius)
        });
    (proper && fits).then_some(Frame { rotation, origin })
}

struct Generator {
    name: String,
    isometry: Isometry,
    /// Holds only for what reaches farther from the axis than this.
    beyond: Option<f64>,
}

/// The generators of what is promised: a mesh that each maps onto itself is mapped onto itself by
/// their products, so no other element has to be looked at.
fn generators(promise: &Promise) -> Vec<Generator> {
    let of = |group: Group| {
        group
            .generators()
            .into_iter()
            .map(move |g| (named(group, g), g))
    };
    let whole = of(promise.group).map(|(name, isometry)| Generator {
        name,
        isometry,
        beyond: None,
    });
    let outside = promise.outside.iter().flat_map(|outside| {
        let new = of(outside.group).filter(|(_, g)| !promise.group.contains(*g));
        new.map(|(name, isometry)| Generator {
            name: format!("{name} outside of the radius {}", number(outside.radius)),
            isometry,
            beyond: Some(outside.radius),
        })
    });
    whole.chain(outside).collect()
}

fn named(group: Group, generator: Isometry) -> String {
    match (generator.mirrored(), generator.flipped()) {
        (false, false) => format!("the rotation of order {}", group.order),
        (true, false) => "the mirror".to_owned(),
        (true, true) => "the half turn across the axis".to_owned(),
        (false, true) if generator == Isometry::FLIP => "the horizontal mirror".to_owned(),
        (false, true) => format!("the rotary reflection of order {}", 2 * group.order),
    }
}

/// The part of the mesh that a generator has to map onto itself; the default is all of it.
#[derive(Default)]
struct Part {
    /// Per vertex, whether it is a corner of a tetrahedron that reaches beyond the radius, and whether
    /// it lies beyond itself.
    vertices: Option<Vec<(bool, bool)>>,
}

impl Part {
    /// The tetrahedra with a corner farther from the axis than `radius`.
    fn beyond(radius: f64, tets: &[Tet], points: &[DVec3]) -> Self {
        let far = |p: &DVec3| p.truncate().length() > radius;
        let mut vertices: Vec<(bool, bool)> = points.iter().map(|p| (far(p), far(p))).collect();
        for tet in tets {
            if tet.vertices.iter().any(|&v| vertices[v as usize].1) {
                tet.vertices
                    .iter()
                    .for_each(|&v| vertices[v as usize].0 = true);
            }
        }
        Self {
            vertices: Some(vertices),
        }
    }

    fn has_vertex(&self, v: usize) -> bool {
        self.vertices.as_ref().is_none_or(|all| all[v].0)
    }

    fn has_element(&self, corners: &[u32]) -> bool {
        let far = |all: &Vec<(bool, bool)>| corners.iter().any(|&v| all[v as usize].1);
        self.vertices.as_ref().is_none_or(far)
    }
}

/// Finds the vertices that images fall on.
struct Matcher<'a> {
    points: &'a [DVec3],
    size: f64,
    /// Largest distance allowed, model units.
    limit: f64,
    near: Option<Grid<3>>,
    far: Option<Grid<3>>,
}

impl Matcher<'_> {
    /// The largest distance relative to the size, and the image of each vertex of the part, [`NONE`]
    /// where there is none within reach.
    fn images(
        &mut self,
        document: &Document,
        generator: &Generator,
        part: &Part,
        findings: &mut Findings,
    ) -> (f64, Vec<u32>) {
        let name = &generator.name;
        let placed = generator.isometry.placed();
        let near = self
            .near
            .get_or_insert_with(|| Grid::of(self.points.iter().copied(), self.limit));
        // A cell of the fine grid holds few vertices; of the coarse one possibly many, where a mesh is
        // extremely graded, so that searching it is limited.
        let mut budget = 1000 * self.points.len() as u64;
        let mut residual = 0.0_f64;
        let mut images = Vec::with_capacity(self.points.len());
        for (v, &p) in self.points.iter().enumerate() {
            if !part.has_vertex(v) {
                images.push(NONE);
                continue;
            }
            let image = placed.apply(p);
            let mut found = near.nearest(image, self.limit);
            if found.is_none() {
                let reach = REACH * self.size;
                let far = self
                    .far
                    .get_or_insert_with(|| Grid::of(self.points.iter().copied(), reach));
                found = far.nearest_of(image, reach, &mut budget);
                let kind = if found.is_some() {
                    Kind::Deviation
                } else {
                    Kind::NoImage
                };
                findings.add(kind, || {
                    let place = at(document, 0, &[v as u32]);
                    match found {
                        Some((w, d)) => format!(
                            "the image of vertex {v} under {name} misses vertex {w} by {d:.3e} ({:.3e} of the size, where {:.1e} is allowed) {place}",
                            d / self.size,
                            self.limit / self.size
                        ),
                        None => format!(
                            "the image of vertex {v} under {name} has no vertex within {reach:.3e} {place}"
                        ),
                    }
                });
            }
            let (image, distance) = found.unwrap_or((NONE, REACH * self.size));
            residual = residual.max(distance);
            images.push(image);
        }
        (
            if self.size > 0.0 {
                residual / self.size
            } else {
                0.0
            },
            images,
        )
    }
}

fn check_permutation(document: &Document, name: &str, images: &[u32], findings: &mut Findings) {
    let mut taken = vec![false; images.len()];
    for (v, &image) in images.iter().enumerate().filter(|i| *i.1 != NONE) {
        if std::mem::replace(&mut taken[image as usize], true) {
            findings.add(Kind::NoPermutation, || {
                let place = at(document, 0, &[image]);
                format!("{name} maps vertex {v} and an earlier one to vertex {image} {place}")
            });
        }
    }
}

/// Tetrahedra by their vertices.
struct TetIndex {
    start: Vec<u32>,
    /// The three higher vertices, and the tetrahedron; grouped by the lowest vertex.
    entries: Vec<([u32; 3], u32)>,
}

impl TetIndex {
    fn new(tets: &[Tet], vertices: usize) -> Self {
        let mut start = vec![0_u32; vertices + 1];
        for t in tets {
            start[increasing(t.vertices)[0] as usize + 1] += 1;
        }
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let mut next = start.clone();
        let mut entries = vec![([0; 3], 0); tets.len()];
        for (i, t) in tets.iter().enumerate() {
            let [a, b, c, d] = increasing(t.vertices);
            entries[next[a as usize] as usize] = ([b, c, d], i as u32);
            next[a as usize] += 1;
        }
        for v in 0..vertices {
            entries[start[v] as usize..start[v + 1] as usize].sort_unstable();
        }
        Self { start, entries }
    }

    fn find(&self, vertices: [u32; 4]) -> Option<u32> {
        let [a, b, c, d] = increasing(vertices);
        let bucket =
            &self.entries[self.start[a as usize] as usize..self.start[a as usize + 1] as usize];
        let found = bucket.binary_search_by_key(&[b, c, d], |e| e.0);
        found.ok().map(|i| bucket[i].1)
    }
}

fn increasing(mut v: [u32; 4]) -> [u32; 4] {
    v.sort_unstable();
    v
}

/// Checks that tetrahedra are mapped onto tetrahedra and returns the permutation of regions seen.
fn map_tets(
    document: &Document,
    name: &str,
    part: &Part,
    images: &[u32],
    index: &TetIndex,
    findings: &mut Findings,
) -> FxHashMap<u32, u32> {
    let template = &document.templates[0];
    let mut forward: FxHashMap<u32, u32> = FxHashMap::default();
    let mut backward: FxHashMap<u32, u32> = FxHashMap::default();
    // Regions run in blocks: most lookups repeat the last one.
    let mut last = None;
    for (i, tet) in template.tets.iter().enumerate() {
        let image = tet.vertices.map(|v| images[v as usize]);
        // A vertex without image is reported already.
        if image.contains(&NONE) || !part.has_element(&tet.vertices) {
            continue;
        }
        let Some(other) = index.find(image) else {
            findings.add(Kind::TetImage, || {
                let place = at(document, 0, &tet.vertices);
                format!("that of tetrahedron {i} under {name} {place}")
            });
            continue;
        };
        let (from, to) = (tet.region, template.tets[other as usize].region);
        if last == Some((from, to)) {
            continue;
        }
        let consistent =
            *forward.entry(from).or_insert(to) == to && *backward.entry(to).or_insert(from) == from;
        if consistent {
            last = Some((from, to));
        } else {
            findings.add(Kind::RegionImage, || {
                let place = at(document, 0, &tet.vertices);
                format!(
                    "{name} maps tetrahedron {i} of region {from} onto tetrahedron {other} of region {to} {place}"
                )
            });
        }
    }
    forward
}

fn map_triangles(
    document: &Document,
    generator: &Generator,
    part: &Part,
    images: &[u32],
    regions: &FxHashMap<u32, u32>,
    index: &FxHashMap<[u32; 3], u32>,
    findings: &mut Findings,
) {
    let name = &generator.name;
    let turns_over = generator.isometry.reverses_orientation();
    let triangles = &document.templates[0].triangles;
    // OUTSIDE is in no region map and stays itself.
    let mapped = |region: u32| regions.get(&region).copied().unwrap_or(region);
    for (i, t) in triangles.iter().enumerate() {
        let image = t.vertices.map(|v| images[v as usize]);
        if image.contains(&NONE) || !part.has_element(&t.vertices) {
            continue;
        }
        let (key, odd) = sorted(image);
        let found = index.get(&key).map(|&j| &triangles[j as usize]);
        let same = found.is_some_and(|other| {
            let reversed = (sorted(other.vertices).1 != odd) != turns_over;
            let sides = if reversed {
                [other.back, other.front]
            } else {
                [other.front, other.back]
            };
            sides == [mapped(t.front), mapped(t.back)]
        });
        if !same {
            findings.add(Kind::TriangleImage, || {
                let place = at(document, 0, &t.vertices);
                format!("that of triangle {i} under {name} {place}")
            });
        }
    }
}
