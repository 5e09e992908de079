//! Templates of few elements are filled several times, and the best is taken.

use crate::template::Done;
use geom::tet::TetMeasures;
use mesher::{Asks, Attempt, Climb, Description, EASING, Log, Order, Params, Room};
use rayon::prelude::*;
use std::cmp::Ordering;

/// Up to so many elements the first percentile of the angles is the smallest one, which is that of a single element and a matter of
/// luck; and another mesh takes a few milliseconds.
const FEW: usize = 100;

/// How often such a template is filled anew: equivalent descriptions of its surface, with usual and stricter bounds and angles to reach in
/// turn. Measured on 68 small bodies, ten of which TetGen alone gives a larger first percentile without draws: 3 have it after
/// sixteen draws, 5 after eight at the usual angles, and the smallest angles are 16 % and 5 % larger, with 9 % and 5 % more elements.
const DRAWS: u64 = 16;

/// Factors of the bounds asked for, those of the radius-edge ratio and of the smallest dihedral angle, instead of [`EASING`].
const STRICTER: [f64; 2] = [0.9, 2.0];

/// The largest dihedral angle that optimization leaves alone in every other draw, degrees, unless a smaller one was asked for: the smallest
/// one to reach is 40 degrees. A choice: all of 70.5 are those of a regular tetrahedron, which fill no body; few bodies have 40 throughout.
const LARGEST: f64 = 100.0;

/// Of a template that was filled and others, the one that is best, and whether that is another; `again` fills it once more. What is not
/// to be improved stays as it is, as does what the user's own switches say how to mesh, and what cannot be as asked: there it is not luck.
pub fn best_of_draws(
    climb: &Climb<'_>,
    first: Done,
    again: impl Fn(&Climb<'_>, Attempt) -> Option<Done> + Sync,
) -> (Done, bool) {
    let filled = &first.filled;
    let is_as_asked =
        filled.improved.is_some() && first.advice.is_none() && climb.params.switches.is_empty();
    if !is_as_asked || filled.template.tets.len() > FEW {
        return (first, false);
    }
    let room = Room::beside(filled.template.vertices.len());
    let strict = Params {
        optimize: climb.params.optimize.map(|largest| largest.min(LARGEST)),
        ..climb.params.clone()
    };
    let goals = [climb.params, &strict];
    let quiet = |draw: u64| Climb {
        params: goals[(draw / 2 % 2) as usize],
        rungs: &[],
        log: Log::new(&|_| ()),
        ..*climb
    };
    let draws = (0..DRAWS).into_par_iter();
    let others: Vec<Option<Done>> = draws
        .map(|draw| again(&quiet(draw), attempt(draw, room)))
        .collect();
    let failed = first.failed;
    let mut best = first;
    let mut is_another = false;
    for other in others.into_iter().flatten() {
        if is_better(&other, &best) {
            best = other;
            is_another = true;
        }
    }
    if is_another {
        climb.log.detail(&format!(
            "template {}: the best of {} meshes has {} tetrahedra, none with an angle below {:.1} degrees",
            climb.piece.index,
            DRAWS + 1,
            best.filled.template.tets.len(),
            worst(&best),
        ));
    }
    (Done { failed, ..best }, is_another)
}

/// The attempt of a draw. Refinement to stricter bounds may not come to an end.
fn attempt(draw: u64, room: Room) -> Attempt {
    let factors = match draw % 2 {
        0 => EASING,
        _ => STRICTER,
    };
    Attempt {
        description: Description {
            order: Order::Shuffled(draw),
            // In the order given: that of few points would depend on their places alone.
            rounds_from: Some(0),
            ..Description::PLAIN
        },
        room: Some(room),
        ..Attempt::new(Asks::Eased(factors))
    }
}

/// Whether one has fewer elements that fail what is asked for, or as many and fewer elements for what its smallest angle is worth: its
/// cube, as edges that are shorter by a part make as many more elements. Whole degrees count.
fn is_better(one: &Done, other: &Done) -> bool {
    let failing = |done: &Done| done.filled.improved.map_or(0, |i| i.past + i.low);
    let elements = |done: &Done| done.filled.template.tets.len() as f64;
    let worth = |done: &Done| worst(done).floor().powi(3);
    match failing(one).cmp(&failing(other)) {
        Ordering::Equal => elements(one) * worth(other) < elements(other) * worth(one),
        differ => differ.is_lt(),
    }
}

/// The smallest dihedral angle of all elements, degrees.
fn worst(done: &Done) -> f64 {
    let template = &done.filled.template;
    let angles = template.tets.iter().map(|tet| {
        let corners = tet.vertices.map(|v| template.vertices[v as usize]);
        TetMeasures::of(corners).min_dihedral().to_degrees()
    });
    angles.fold(f64::INFINITY, f64::min)
}
