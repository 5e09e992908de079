//! Where a document is short of what was asked of its elements: how far, how many, at which wall or surface most of
//! them are, where the worst one is, and what would help.

use super::bound::{Bound, Measure};
use super::place::{Place, Places};
use super::sharp::{Sharp, sharp_edges};
use crate::{number, point, tolerance};
use geom::measure::corners;
use geom::tet::TetMeasures;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;
use tmesh::{Document, Instance, OUTSIDE, Template};

/// Something beyond a bound: an element, or an edge of the surface.
struct Failing<'a> {
    /// Number of the bound.
    bound: usize,
    value: f64,
    place: Place,
    /// Where it is in the template.
    middle: DVec3,
    /// The first of the copies that it is in, and how often it counts.
    first: &'a Instance,
    count: u64,
}

/// What the elements of a document do not meet of what it says was asked of them, a sentence for each bound; of a
/// document without elements, what they cannot meet for the angles of its surface. Linear.
pub fn shortfalls(document: &Document) -> Vec<String> {
    let bounds = Bound::of(document);
    let filled = document.templates.iter().any(|t| !t.tets.is_empty());
    let failing = if filled {
        elements(document, &bounds)
    } else {
        edges(document, &bounds)
    };
    let mut of_bound: Vec<Vec<&Failing<'_>>> = bounds.iter().map(|_| Vec::new()).collect();
    for f in &failing {
        of_bound[f.bound].push(f);
    }
    let each = bounds.iter().zip(&of_bound);
    each.filter_map(|(bound, failing)| {
        let (said, worst) = said(document, bound, failing, filled)?;
        let what_helps = match filled {
            true => remedy(document, bound),
            false => remedy_before(worst.place),
        };
        Some(format!("{said}; {what_helps}"))
    })
    .collect()
}

/// Copies of a template whose regions are the same.
struct Placed<'a> {
    template: usize,
    first: &'a Instance,
    count: u64,
}

/// The copies of each template, by template.
fn placed(document: &Document) -> Vec<Placed<'_>> {
    let mut placed: Vec<Placed<'_>> = Vec::new();
    for instance in &document.instances {
        let template = instance.template as usize;
        let same = |p: &&mut Placed<'_>| {
            p.template == template && p.first.region_map == instance.region_map
        };
        match placed.iter_mut().find(same) {
            Some(known) => known.count += 1,
            None => placed.push(Placed {
                template,
                first: instance,
                count: 1,
            }),
        }
    }
    placed.sort_by_key(|p| p.template);
    placed
}

/// Edges of the surface of templates that are placed, at which it has angles below `asked`.
fn sharp(document: &Document, asked: f64) -> impl Iterator<Item = (Placed<'_>, Vec<Sharp>)> {
    let mut placed = placed(document);
    placed.dedup_by_key(|p| p.template);
    placed.into_iter().map(move |p| {
        let sharp = sharp_edges((p.template, &document.templates[p.template]), asked);
        (p, sharp)
    })
}

/// The elements beyond their bounds.
fn elements<'a>(document: &'a Document, bounds: &[Bound]) -> Vec<Failing<'a>> {
    let mut failing = Vec::new();
    for Placed {
        template: index,
        first,
        count,
    } in placed(document)
    {
        let template = &document.templates[index];
        let beyond = template.tets.par_iter().flat_map_iter(|tet| {
            let measures = TetMeasures::of(corners(&template.vertices, tet.vertices));
            let region = document.placed_region(first, tet.region);
            let failing = bounds.iter().enumerate().filter_map(move |(i, bound)| {
                let value = bound.beyond(&measures)?;
                bound.holds_for(region).then_some((i, value))
            });
            failing.map(move |(i, value)| (i, value, tet))
        });
        let beyond: Vec<_> = beyond.collect();
        if beyond.is_empty() {
            continue;
        }
        let places = Places::new((index, template));
        failing.extend(beyond.into_iter().map(|(bound, value, tet)| {
            Failing {
                bound,
                value,
                place: places.of(tet.vertices),
                middle: corners(&template.vertices, tet.vertices)
                    .iter()
                    .sum::<DVec3>()
                    / 4.0,
                first,
                count,
            }
        }));
    }
    failing
}

/// The edges of the surface that keep elements from meeting the bound of the angle.
fn edges<'a>(document: &'a Document, bounds: &[Bound]) -> Vec<Failing<'a>> {
    let angle = bounds.iter().position(|b| b.measure == Measure::Dihedral);
    let Some(bound) = angle else {
        return Vec::new();
    };
    let sharp = sharp(document, bounds[bound].asked);
    let failing = sharp.flat_map(|(placed, edges)| {
        edges.into_iter().map(move |edge| Failing {
            bound,
            value: edge.angle,
            place: edge.place,
            middle: edge.middle,
            first: placed.first,
            // Edges on walls belong to several copies.
            count: 1,
        })
    });
    failing.collect()
}

/// How far, how many and where, and the worst.
fn said<'a>(
    document: &Document,
    bound: &Bound,
    failing: &[&'a Failing<'a>],
    filled: bool,
) -> Option<(String, &'a Failing<'a>)> {
    let badness = |f: &Failing<'_>| bound.measure.badness(f.value);
    let mut worst = *failing.first()?;
    let mut places: BTreeMap<Place, u64> = BTreeMap::new();
    for &f in failing {
        if badness(f) > badness(worst) {
            worst = f;
        }
        *places.entry(f.place).or_default() += f.count;
    }
    let count: u64 = places.values().sum();
    // The first among equals.
    let most = places.iter().rev().max_by_key(|p| p.1)?;
    let [of_most, of_worst] = [*most.0, worst.place].map(|place| place.words(document));
    let what = if filled {
        "element(s)"
    } else {
        "edge(s) of the surface"
    };
    let said = format!(
        "{} {} of {}: {count} {what} {}, most {of_most} ({}), the worst {of_worst} near {}",
        bound.measure.name(),
        number(worst.value),
        bound.words,
        bound.measure.side(),
        most.1,
        point(
            document
                .frame
                .to_world(worst.first.isometry.apply(worst.middle))
                .to_array()
        ),
    );
    Some((said, worst))
}

/// What would help elements that were made.
fn remedy(document: &Document, bound: &Bound) -> String {
    let shape = follow_shape(document, bound);
    match bound.measure {
        Measure::Volume => {
            "a smaller --edge-length or --max-volume gives smaller ones, but not at faces kept by --keep-surface".to_owned()
        }
        Measure::RadiusEdge => format!("a smaller --edge-length gives them room{shape}"),
        Measure::Dihedral => {
            let all: Vec<Sharp> = sharp(document, bound.asked).flat_map(|s| s.1).collect();
            let least = all.iter().map(|s| s.angle).fold(f64::INFINITY, f64::min);
            match all.len() {
                0 => format!("a smaller --edge-length gives them room{shape}"),
                count => format!(
                    "a smaller --edge-length gives them room, but not at {count} edge(s) where the surface itself has \
                     such angles, down to {}{shape}",
                    number(least)
                ),
            }
        }
    }
}

/// That the surface may follow its shape, where it keeps triangles with corners sharper than elements should be.
fn follow_shape(document: &Document, bound: &Bound) -> String {
    let Some(symmetry) = &document.symmetry else {
        return String::new();
    };
    let tolerance = tolerance(document);
    let equal = tolerance.equal() / tolerance.extent().radius;
    let asked = document.wishes.min_dihedral();
    let is_sharp = |template: &Template| {
        let surface = template.triangles.par_iter();
        surface
            .filter(|t| t.front == OUTSIDE || t.back == OUTSIDE)
            .any(|t| sharpest(corners(&template.vertices, t)) < asked)
    };
    let is_kept = document.deviation(equal) <= equal;
    match is_kept && bound.measure != Measure::Volume && document.templates.iter().any(is_sharp) {
        true => format!(
            "; --deviation {} from wedgecut on remeshes needles of curved surfaces",
            number(symmetry.tolerance)
        ),
        false => String::new(),
    }
}

/// The sharpest corner of a triangle, degrees.
fn sharpest(points: [DVec3; 3]) -> f64 {
    let corner = |i: usize| {
        let [p, q, r] = [0, 1, 2].map(|k| points[(i + k) % 3]);
        (q - p).angle_between(r - p)
    };
    [0, 1, 2]
        .map(corner)
        .into_iter()
        .fold(f64::INFINITY, f64::min)
        .to_degrees()
}

/// What would help before elements are made, by where the smallest angle is.
fn remedy_before(place: Place) -> String {
    let advice = match place {
        Place::Axis => "wedgecut has larger ones with a lower --order or with a --hub",
        Place::Wall(..) => {
            "wedgecut may have larger ones with another --seam, --start-angle or --order"
        }
        Place::Surface(_) | Place::Inside => "the body itself has them",
    };
    format!("elements there have no larger angles; {advice}")
}
