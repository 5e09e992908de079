//! The surfaces of templates, remeshed within the deviation.

use crate::footing::{Footing, point};
use crate::joined::{AXIS, Joined, Part};
use glam::DVec3;
use remesh::{Drawn, Remeshed, Rules, Sizes, Told, remesh};
use rustc_hash::FxHashMap;
use std::sync::Arc;
use tmesh::{Document, Gluing, Template, Triangle};

/// What a template became.
pub struct Smoothed {
    /// Its index in the document.
    pub index: usize,
    /// The template.
    pub template: Template,
    /// New vertex of each vertex, `u32::MAX` for those that are gone.
    pub vertices: Vec<u32>,
    /// New triangle of each triangle that stayed, `u32::MAX` for others.
    pub triangles: Vec<u32>,
    /// What its surface stands on.
    pub footing: Option<Footing>,
}

/// How far a surface may move, and what is asked of it.
pub struct Remeshing<'a> {
    /// At most so far, model units.
    pub deviation: f64,
    /// Of each vertex, how far it may move there if that is less; empty for no less anywhere.
    pub nearer: &'a [f64],
    /// What is less off a plane may be noise, model units.
    pub noise: f64,
    /// Within this of a plane, triangles are in one plane, model units.
    pub flat: f64,
    /// What the triangles of curved faces stand for.
    pub drawn: Drawn,
    /// How long edges are to be.
    pub sizes: &'a mesher::Sizes,
}

/// Remeshes the surfaces of templates that are glued to each other, and tells what was done; vertices stay on mirror walls, faces
/// glued to each other stay images of each other, and those glued to other templates stay as they are.
/// `None` where there is nothing to do.
pub fn remeshed(
    document: &Document,
    group: &[usize],
    remeshing: &Remeshing<'_>,
) -> Option<(Vec<Smoothed>, Told)> {
    let joined = Joined::new(document, group)?;
    let links = joined.links();
    let kinds = joined.kinds.iter();
    let lengths: Vec<f64> = kinds
        .map(|kind| length(document, remeshing.sizes, &kind.like))
        .collect();
    let spaces: Vec<u32> = joined.kinds.iter().map(|kind| kind.part).collect();
    let graded = group.iter().find_map(|&i| {
        let local = remeshing.sizes.local[i].as_ref();
        local.map(|local| &local.graded)
    });
    let local = graded.map(|graded| |p: DVec3| graded.at(p));
    let onto = |bit: u32, p: DVec3| joined.onto(bit, p);
    let segments = document.wishes.segments_per_turn;
    let sizes = Sizes {
        turn: document.wishes.turn(),
        turn_is_asked: segments.is_some(),
        lengths: &lengths,
        local: local
            .as_ref()
            .map(|local| local as &(dyn Fn(DVec3) -> f64 + Sync)),
        growth: document.wishes.gradation() - 1.0,
    };
    let rules = Rules {
        held: &joined.held,
        bound: &joined.bound,
        links: &links,
        spaces: &spaces,
        onto: &onto,
        deviation: remeshing.deviation,
        nearer: remeshing.nearer,
        noise: remeshing.noise,
        flat: remeshing.flat,
        folds: document.unevenness(),
        feature: libm::cos(document.wishes.feature_angle().to_radians()),
        sharp: document.wishes.min_dihedral().to_radians(),
        drawn: remeshing.drawn,
        sizes,
    };
    let done = remesh(&joined.surface, &rules)?;
    let numbers = Numbers::new(&joined, &done);
    let all = joined.parts.iter().enumerate();
    let smoothed: Option<Vec<Smoothed>> = all
        .map(|(p, part)| smoothed(&joined, (p, part), (&done, &numbers)))
        .collect();
    Some((smoothed?, done.told))
}

/// Numbers of the vertices and triangles of a remeshed surface in their templates.
struct Numbers {
    /// Of each vertex.
    vertices: Vec<u32>,
    /// Of each triangle.
    triangles: Vec<u32>,
    /// The part of each vertex.
    part: Vec<u32>,
}

impl Numbers {
    fn new(joined: &Joined<'_>, done: &Remeshed) -> Self {
        let made = &done.surface;
        let part_of = |label: &u32| joined.kinds[*label as usize].part;
        let mut part = vec![0; made.points.len()];
        for (corners, label) in made.triangles.iter().zip(&made.labels) {
            let of = part_of(label);
            corners.iter().for_each(|&v| part[v as usize] = of);
        }
        let count = |parts: &mut dyn Iterator<Item = u32>| -> Vec<u32> {
            let mut next = vec![0; joined.parts.len()];
            let numbers = parts.map(|p| {
                next[p as usize] += 1;
                next[p as usize] - 1
            });
            numbers.collect()
        };
        Self {
            vertices: count(&mut part.iter().copied()),
            triangles: count(&mut made.labels.iter().map(part_of)),
            part,
        }
    }

    /// The numbers in their templates of two vertices.
    fn pair(&self, pair: [u32; 2]) -> [u32; 2] {
        pair.map(|v| self.vertices[v as usize])
    }
}

/// What a part became. `None` if two faces are not divided alike.
fn smoothed(
    joined: &Joined<'_>,
    (p, part): (usize, &Part<'_>),
    (done, numbers): (&Remeshed, &Numbers),
) -> Option<Smoothed> {
    let made = &done.surface;
    let is_here = |v: &u32| numbers.part[*v as usize] as usize == p;
    let points = (0..made.points.len() as u32).filter(is_here);
    let triangles = made.triangles.iter().zip(&made.labels);
    let kinds = triangles.map(|(corners, label)| (corners, &joined.kinds[*label as usize]));
    let triangles = kinds.filter(|(_, kind)| kind.part as usize == p);
    let triangle = |(corners, kind): (&[u32; 3], &crate::joined::Kind)| Triangle {
        vertices: corners.map(|v| numbers.vertices[v as usize]),
        ..kind.like
    };
    let is_of_part = |label: &u32| joined.kinds[*label as usize].part as usize == p;
    let patches = made.labels.iter().zip(&done.patches);
    let patches = patches.filter(|(label, _)| is_of_part(label));
    let samples = made.labels.iter().zip(&done.samples);
    let samples = samples.filter(|(label, _)| is_of_part(label));
    let footing = done.ground.clone().map(|ground| Footing {
        ground,
        patches: patches.map(|(_, &patch)| patch).collect(),
        apart: Vec::new(),
        points: samples
            .map(|(_, samples)| samples.iter().map(point).collect())
            .collect(),
        given: Arc::new(part.template.clone()),
        drift: None,
        deviation: None,
    });
    let new = |old: &[u32], number: &[u32]| -> Vec<u32> {
        let new = old.iter().map(|&n| number.get(n as usize));
        new.map(|n| n.copied().unwrap_or(u32::MAX)).collect()
    };
    let [vertices, faces] = joined.range(part);
    let vertices = new(&done.vertices[vertices], &numbers.vertices);
    let faces = new(&done.triangles[faces], &numbers.triangles);
    let bound_to = |bit: u32| {
        let bound = move |v: &u32| done.bound[*v as usize] & 1 << bit != 0;
        let all = (0..made.points.len() as u32).filter(is_here).filter(bound);
        all.map(|v| numbers.vertices[v as usize])
    };
    let mut gluings = part.template.gluings.clone();
    for (i, gluing) in gluings.iter_mut().enumerate() {
        if gluing.is_mirror(part.index) {
            let all = (0..).zip(&made.labels);
            let of_wall = all.filter(|(_, label)| joined.is_on(**label, p, i));
            let bit = joined.mirror(part, i);
            gluing.vertex_pairs = bound_to(bit).map(|v: u32| [v, v]).collect();
            gluing.triangle_pairs = of_wall
                .map(|(t, _): (usize, _)| [numbers.triangles[t]; 2])
                .collect();
            continue;
        }
        let known = joined.glued.iter();
        let known = known.zip(&done.links);
        let mut known = known.filter(|(glued, _)| glued.parts[0] == p && glued.gluing == i);
        match known.next() {
            Some((glued, pairs)) => {
                let faces = glued.labels.each_ref().map(|labels| {
                    let all = (0..).zip(&made.labels);
                    let of_face = all.filter(|(_, label)| labels.contains(label));
                    of_face.map(|(t, _): (u32, _)| t).collect::<Vec<u32>>()
                });
                let triangles = alike(&made.triangles, pairs, faces)?;
                let triangles = triangles
                    .iter()
                    .map(|pair| pair.map(|t| numbers.triangles[t as usize]));
                // The first of each pair is the one there.
                *gluing = Gluing::seam(
                    &gluing.name,
                    gluing.other,
                    gluing.step,
                    pairs.iter().map(|&pair| numbers.pair(pair)),
                    triangles,
                );
            }
            None => {
                for pair in &mut gluing.vertex_pairs {
                    pair[0] = vertices[pair[0] as usize];
                }
                for pair in &mut gluing.triangle_pairs {
                    pair[0] = faces[pair[0] as usize];
                }
                gluing.sort();
            }
        }
    }
    Some(Smoothed {
        index: part.index,
        template: Template {
            vertices: points.map(|v| made.points[v as usize]).collect(),
            triangles: triangles.map(triangle).collect(),
            tets: Vec::new(),
            gluings,
            axis: bound_to(AXIS).collect(),
        },
        vertices,
        triangles: faces,
        footing,
    })
}

/// The length of edges at a triangle, model units: the shorter one of both sides; infinite where none is asked for.
fn length(document: &Document, sizes: &mesher::Sizes, t: &Triangle) -> f64 {
    let of = |id: u32| {
        let at = document.regions.binary_search_by_key(&id, |r| r.id).ok()?;
        sizes.lengths[at]
    };
    let lengths = [t.front, t.back].into_iter().filter_map(of);
    lengths.fold(f64::INFINITY, f64::min)
}

/// Triangles of a face with those of the other one whose corners are the images of theirs, if all have one.
fn alike(
    triangles: &[[u32; 3]],
    pairs: &[[u32; 2]],
    [low, high]: [Vec<u32>; 2],
) -> Option<Vec<[u32; 2]>> {
    let image: FxHashMap<u32, u32> = pairs.iter().map(|&[v, w]| (v, w)).collect();
    let sorted = |mut corners: [u32; 3]| {
        corners.sort_unstable();
        corners
    };
    let count = high.len();
    let high = high.into_iter();
    let at: FxHashMap<[u32; 3], u32> = high.map(|t| (sorted(triangles[t as usize]), t)).collect();
    let found: Option<Vec<[u32; 2]>> = (low.into_iter())
        .map(|t| {
            let [a, b, c] = triangles[t as usize].map(|v| image.get(&v).copied());
            Some([t, *at.get(&sorted([a?, b?, c?]))?])
        })
        .collect();
    found.filter(|found| found.len() == count)
}
