//! Bounds that a mesh does not meet: how far it is from them, where, and what would help.

use geom::tet::TetMeasures;
use glam::DVec3;
use mesher::Params;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use tmesh::{Document, Template, Tet};

/// A bound on elements, and how an element is measured against it.
struct Bound {
    /// Name of the measure.
    name: &'static str,
    asked: f64,
    /// How much an element is on the wrong side, as a part of what was asked; not above 0 within the bound.
    excess: fn(f64, f64) -> f64,
    value: fn(&TetMeasures) -> f64,
    side: &'static str,
}

/// An element that fails: its template, its number there, and its measure.
#[derive(Clone, Copy)]
struct Failing {
    template: usize,
    tet: usize,
    value: f64,
}

/// What the elements of a filled document are short of: a sentence for each bound that is not met. Linear.
pub fn shortfalls(document: &Document, params: &Params) -> Vec<String> {
    if !params.quality {
        return Vec::new();
    }
    let bounds = [
        Bound {
            name: "dihedral",
            asked: params.min_dihedral,
            excess: |value, asked| asked - value,
            value: |m| m.min_dihedral.to_degrees(),
            side: "below",
        },
        Bound {
            name: "radius-edge ratio",
            asked: params.radius_edge,
            excess: |value, asked| value - asked,
            value: |m| m.radius_edge_ratio,
            side: "above",
        },
    ];
    let each = bounds.iter();
    each.filter_map(|bound| shortfall(document, bound))
        .collect()
}

/// The sentence for one bound, if it is not met.
fn shortfall(document: &Document, bound: &Bound) -> Option<String> {
    let mut failing = Vec::new();
    for (index, template) in document.templates.iter().enumerate() {
        failing.par_extend((0..template.tets.len()).into_par_iter().filter_map(|tet| {
            let value = (bound.value)(&TetMeasures::of(corners(template, &template.tets[tet])));
            let fails = (bound.excess)(value, bound.asked) > 0.0;
            fails.then_some(Failing {
                template: index,
                tet,
                value,
            })
        }));
    }
    let excess = |f: &&Failing| (bound.excess)(f.value, bound.asked);
    let worst = failing
        .iter()
        .max_by(|a, b| excess(a).total_cmp(&excess(b)))?;
    let copies = |f: &Failing| {
        let of_it = document.instances.iter();
        of_it.filter(|i| i.template as usize == f.template).count()
    };
    let places = Places::new(document);
    let mut kinds: FxHashMap<String, usize> = FxHashMap::default();
    let mut count = 0;
    for f in &failing {
        let copies = copies(f);
        *kinds.entry(places.of(document, f)).or_default() += copies;
        count += copies;
    }
    let most = kinds
        .iter()
        .max_by(|a, b| a.1.cmp(b.1).then(b.0.cmp(a.0)))?;
    let template = &document.templates[worst.template];
    let p: DVec3 = corners(template, &template.tets[worst.tet])
        .iter()
        .sum::<DVec3>()
        * 0.25;
    let p = document.frame.to_world(p);
    Some(format!(
        "{} {:.3} of {} asked for: {count} element(s) {}, most {} ({}), the worst {} near ({:.6}, {:.6}, {:.6}); a smaller \
         --edge-length gives them room, but not where the surface itself has such angles or narrow places",
        bound.name,
        worst.value,
        bound.asked,
        bound.side,
        most.0,
        most.1,
        places.of(document, worst),
        p.x,
        p.y,
        p.z,
    ))
}

fn corners(template: &Template, tet: &Tet) -> [DVec3; 4] {
    tet.vertices.map(|v| template.vertices[v as usize])
}

/// What the vertices of each template are on.
struct Places {
    of_vertex: Vec<FxHashMap<u32, Place>>,
}

/// What a vertex is on; what comes first says more.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Axis,
    /// Number of the gluing.
    Wall(usize),
    /// A marker.
    Surface(u32),
}

impl Places {
    fn new(document: &Document) -> Self {
        let places = |template: &Template| {
            let mut of_vertex: FxHashMap<u32, Place> = FxHashMap::default();
            let mut put = |v: u32, place: Place| {
                let known = of_vertex.entry(v).or_insert(place);
                *known = (*known).min(place);
            };
            for t in &template.triangles {
                let place = Place::Surface(t.marker);
                t.vertices.into_iter().for_each(|v| put(v, place));
            }
            for (i, gluing) in template.gluings.iter().enumerate() {
                gluing.vertices_here().for_each(|v| put(v, Place::Wall(i)));
            }
            template.axis.iter().for_each(|&v| put(v, Place::Axis));
            of_vertex
        };
        Self {
            of_vertex: document.templates.iter().map(places).collect(),
        }
    }

    /// Words for what an element is at.
    fn of(&self, document: &Document, failing: &Failing) -> String {
        let template = &document.templates[failing.template];
        let known = &self.of_vertex[failing.template];
        let vertices = template.tets[failing.tet].vertices;
        match vertices.iter().filter_map(|v| known.get(v)).min() {
            None => "inside".to_owned(),
            Some(Place::Axis) => "at the axis".to_owned(),
            Some(&Place::Wall(i)) => format!("at '{}'", template.gluings[i].name),
            Some(&Place::Surface(marker)) => {
                let named = document.markers.iter().find(|m| m.id == marker);
                match named.map(|m| m.name.as_str()) {
                    Some(name) if !name.is_empty() => format!("at surface '{name}'"),
                    _ => "at the surface".to_owned(),
                }
            }
        }
    }
}
