//! The surface of a template, remeshed within the deviation.

use glam::DVec3;
use mesher::{Faces, Piece};
use remesh::{Link, Remeshed, Rules, Sizes, Surface, Told, remesh};
use rustc_hash::FxHashMap;
use tmesh::{Document, FixedSet, Gluing, Template, Triangle};

/// The bit of the axis; mirror walls have those below.
const AXIS: u32 = u32::BITS - 1;

/// What a template became.
pub struct Smoothed {
    /// The template.
    pub template: Template,
    /// New vertex of each vertex, `u32::MAX` for those that are gone.
    pub vertices: Vec<u32>,
    /// New triangle of each triangle that stayed, `u32::MAX` for others.
    pub triangles: Vec<u32>,
    /// What was done.
    pub told: Told,
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
    /// Whether all facets stay, unless some are far finer than the edges asked for.
    pub exact: bool,
    /// How long edges are to be.
    pub sizes: &'a mesher::Sizes,
}

/// Remeshes the surface of a template; vertices stay on mirror walls, faces glued to each other stay images of each other, and
/// those glued to another template stay as they are.
/// `None` where there is nothing to do.
pub fn remeshed(document: &Document, index: usize, remeshing: &Remeshing<'_>) -> Option<Smoothed> {
    let template = &document.templates[index];
    let faces = Faces::new(Piece::of(document, index));
    let mut labels: FxHashMap<(u32, u32, u32, u32), u32> = FxHashMap::default();
    let mut kinds: Vec<Triangle> = Vec::new();
    let mut keys: Vec<u32> = Vec::new();
    let triangles = template.triangles.iter().zip(&faces.of_triangle);
    let label = |(t, &face): (&Triangle, &u32)| {
        *labels
            .entry((t.marker, t.front, t.back, face))
            .or_insert_with(|| {
                kinds.push(*t);
                keys.push(face);
                kinds.len() as u32 - 1
            })
    };
    let surface = Surface {
        labels: triangles.map(label).collect(),
        points: template.vertices.clone(),
        triangles: template.triangles.iter().map(|t| t.vertices).collect(),
    };
    let bound = bound(template, index)?;
    let held = held(document, index);
    let links = links(template, index, &keys);
    let sets: Vec<FixedSet> = template
        .gluings
        .iter()
        .map(|g| FixedSet::of(g.step))
        .collect();
    let onto = |bit: u32, p: DVec3| match bit {
        AXIS => FixedSet::Axis.nearest(p),
        bit => sets[bit as usize].nearest(p),
    };
    let lengths: Vec<f64> = kinds
        .iter()
        .map(|t| length(document, remeshing.sizes, t))
        .collect();
    let graded = remeshing.sizes.local[index]
        .as_ref()
        .map(|local| &local.graded);
    let local = graded.map(|graded| |p: DVec3| graded.at(p));
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
        held: &held,
        bound: &bound,
        links: &links,
        onto: &onto,
        deviation: remeshing.deviation,
        nearer: remeshing.nearer,
        noise: remeshing.noise,
        flat: remeshing.flat,
        folds: document.unevenness(),
        feature: libm::cos(document.wishes.feature_angle().to_radians()),
        sharp: document.wishes.min_dihedral().to_radians(),
        exact: remeshing.exact,
        sizes,
    };
    let done = remesh(&surface, &rules)?;
    let triangle = |(corners, label): (&[u32; 3], &u32)| Triangle {
        vertices: *corners,
        ..kinds[*label as usize]
    };
    let made = &done.surface;
    Some(Smoothed {
        template: Template {
            vertices: made.points.clone(),
            triangles: made
                .triangles
                .iter()
                .zip(&made.labels)
                .map(triangle)
                .collect(),
            tets: Vec::new(),
            gluings: glued(template, index, &done, &keys)?,
            axis: bound_to(&done, AXIS).collect(),
        },
        vertices: done.vertices,
        triangles: done.triangles,
        told: done.told,
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

/// The faces of a template that are glued to each other; `keys` has the face of each label.
fn links(template: &Template, index: usize, keys: &[u32]) -> Vec<Link> {
    let seams = template.gluings.iter().enumerate();
    let seams = seams.filter(|(_, gluing)| gluing.is_seam(index));
    seams
        .map(|(i, gluing)| {
            let step = gluing.step;
            let faces = [false, true].map(|second| mesher::face_key(i, second));
            let is_there = |key: &u32| faces.contains(key);
            Link {
                pairs: gluing.vertex_pairs.iter().map(|&[a, b]| [b, a]).collect(),
                labels: (0..)
                    .zip(keys)
                    .filter(|(_, key)| is_there(key))
                    .map(|(l, _)| l)
                    .collect(),
                image: Box::new(move |p| step.apply(p)),
            }
        })
        .collect()
}

/// The gluings of a remeshed template; `keys` has the face of each label. `None` if two faces are not divided alike.
fn glued(template: &Template, index: usize, done: &Remeshed, keys: &[u32]) -> Option<Vec<Gluing>> {
    let new = |v: u32| done.vertices[v as usize];
    let made = &done.surface;
    let mut linked = done.links.iter();
    let mut gluings = template.gluings.clone();
    for (i, gluing) in gluings.iter_mut().enumerate() {
        if gluing.is_mirror(index) {
            let key = mesher::face_key(i, false);
            let of_wall = (0..)
                .zip(&made.labels)
                .filter(|(_, l)| keys[**l as usize] == key);
            gluing.vertex_pairs = bound_to(done, i as u32).map(|v: u32| [v, v]).collect();
            gluing.triangle_pairs = of_wall.map(|(t, _): (u32, _)| [t, t]).collect();
            continue;
        }
        if gluing.is_seam(index) {
            let pairs = linked.next()?;
            let faces = [false, true].map(|second| {
                let key = mesher::face_key(i, second);
                let all = (0..).zip(&made.labels);
                let of_face = all.filter(move |(_, l)| keys[**l as usize] == key);
                of_face.map(|(t, _): (u32, _)| t).collect::<Vec<u32>>()
            });
            let triangles = alike(&made.triangles, pairs, faces)?;
            *gluing = Gluing::seam(
                &gluing.name,
                gluing.other,
                gluing.step,
                pairs.clone(),
                triangles,
            );
            continue;
        }
        for pair in &mut gluing.vertex_pairs {
            pair[0] = new(pair[0]);
        }
        for pair in &mut gluing.triangle_pairs {
            pair[0] = done.triangles[pair[0] as usize];
        }
        gluing.sort();
    }
    Some(gluings)
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

/// Vertices on the plane or line of a bit.
fn bound_to(done: &Remeshed, bit: u32) -> impl Iterator<Item = u32> + '_ {
    let all = (0..).zip(&done.bound);
    all.filter(move |(_, bound)| *bound & 1 << bit != 0)
        .map(|(v, _)| v)
}

/// Mirror walls of each vertex, and the axis. `None` where there are more walls than bits.
fn bound(template: &Template, index: usize) -> Option<Vec<u32>> {
    let mut bound = vec![0; template.vertices.len()];
    for (i, gluing) in (0..).zip(&template.gluings) {
        if gluing.is_mirror(index) {
            if i >= AXIS {
                return None;
            }
            gluing
                .vertices_here()
                .for_each(|v| bound[v as usize] |= 1 << i);
        }
    }
    template
        .axis
        .iter()
        .for_each(|&v| bound[v as usize] |= 1 << AXIS);
    Some(bound)
}

/// Vertices of faces that are glued to other templates, whoever lists them.
fn held(document: &Document, index: usize) -> Vec<bool> {
    let template = &document.templates[index];
    let mut held = vec![false; template.vertices.len()];
    for gluing in &template.gluings {
        if gluing.other_than(index).is_some() {
            gluing.vertices_here().for_each(|v| held[v as usize] = true);
        }
    }
    for (o, other) in document.templates.iter().enumerate() {
        for gluing in &other.gluings {
            if gluing.other_than(o) == Some(index) {
                gluing
                    .vertices_there()
                    .for_each(|v| held[v as usize] = true);
            }
        }
    }
    held
}
