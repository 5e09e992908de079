//! Surfaces that follow the shape behind the triangles of the input.

use crate::remeshed::{Remeshing, Smoothed, remeshed};
use crate::surface::{same_body, same_size};
use kit::tolerance;
use mesher::{Log, Params, Progress};
use remesh::Sizes;
use std::f64::consts::TAU;
use tmesh::{Deviation, Document, Wishes};

/// What a deviation is multiplied by where it changes volumes by too much. A choice: what a deviation changes of them is at most
/// proportional to it, so that a few steps of this size are enough, and none gives up much more than needed.
const NARROWER: f64 = 0.25;

/// Remeshes the surfaces of all templates within the deviation that the wishes allow; returns a sentence for each that
/// changed. Nothing changes where the input is as symmetric as its coordinates can be, unless a deviation is asked for.
pub fn follow_shape(document: &mut Document, params: &Params, log: Log<'_>) -> Vec<String> {
    let tolerance = tolerance(document);
    let mut facts = Vec::new();
    let radius = tolerance.extent().radius;
    let deviation = radius * document.deviation(tolerance.equal() / radius);
    if !params.quality || deviation <= tolerance.equal() {
        return facts;
    }
    // Nobody asked for more than the tolerance: then volume and area stay what they are within what the body is off its
    // symmetry, or it is remeshed within that.
    let attempts = match document.wishes.deviation() {
        Deviation::Auto if deviation > tolerance.drift() => {
            let drift = tolerance.drift();
            let wider = std::iter::successors(Some(deviation), |d| Some(d * NARROWER));
            let wider = wider.take_while(|d| *d > drift);
            wider
                .map(|d| (d, Some(drift)))
                .chain([(drift, None)])
                .collect()
        }
        _ => vec![(deviation, None)],
    };
    for index in 0..document.templates.len() {
        log.progress(&Progress {
            template: index,
            step: "remeshing the surface",
            points: 0.0,
            tetrahedra: 0.0,
        });
        for &(deviation, drift) in &attempts {
            let remeshing = Remeshing {
                deviation,
                flat: tolerance.flat(),
                feature_angle: document.wishes.feature_angle(),
                sizes: sizes(&document.wishes),
            };
            let Some(smoothed) = remeshed(document, index, &remeshing) else {
                continue;
            };
            let before = &document.templates[index];
            let kept = same_body(before, &smoothed.template, (deviation, 0.0)).and_then(|()| {
                drift.map_or(Ok(()), |d| {
                    same_size((before, index), &smoothed.template, d)
                })
            });
            if let Err(what) = kept {
                log.detail(&format!(
                    "template {index}: not remeshed within {deviation:.1e}, {what}"
                ));
                continue;
            }
            facts.push(fact(index, &smoothed, before.triangles.len(), deviation));
            take(document, index, smoothed);
            break;
        }
    }
    if !facts.is_empty() {
        document.wishes.keep_surface = Some(true);
    }
    facts
}

/// How long the edges of surfaces are to be.
fn sizes(wishes: &Wishes) -> Sizes {
    let segments = wishes.segments_per_turn;
    Sizes {
        turn: TAU / segments.unwrap_or(Wishes::SEGMENTS_PER_TURN),
        turn_is_asked: segments.is_some(),
        length: wishes.edge_length(),
        growth: wishes.gradation() - 1.0,
    }
}

fn fact(index: usize, smoothed: &Smoothed, before: usize, deviation: f64) -> String {
    let told = smoothed.told;
    format!(
        "template {index}: surface remeshed within {deviation:.1e}, {} triangles for {before} ({} edges collapsed, {} split, \
         {} flipped, {} vertices moved)",
        smoothed.template.triangles.len(),
        told.collapsed,
        told.split,
        told.flipped,
        told.moved,
    )
}

/// Puts a template in its place, and renumbers what other templates have of it.
fn take(document: &mut Document, index: usize, smoothed: Smoothed) {
    document.templates[index] = smoothed.template;
    for (other, template) in document.templates.iter_mut().enumerate() {
        for gluing in &mut template.gluings {
            if gluing.other_than(other) == Some(index) {
                for pair in &mut gluing.vertex_pairs {
                    pair[1] = smoothed.vertices[pair[1] as usize];
                }
                for pair in &mut gluing.triangle_pairs {
                    pair[1] = smoothed.triangles[pair[1] as usize];
                }
                gluing.sort();
            }
        }
    }
}
