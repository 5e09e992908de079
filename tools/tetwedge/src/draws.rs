//! Templates of few elements are filled several times, and the best is taken.

use crate::template::Done;
use geom::tet::TetMeasures;
use mesher::{Asks, Attempt, Climb, Description, EASING, Log, Order, Room};
use rayon::prelude::*;

/// Up to so many elements the first percentile of the angles is the smallest one, which is that of a single element and a matter of
/// luck; and another mesh takes a few milliseconds.
const FEW: usize = 100;

/// How often such a template is filled anew: equivalent descriptions of its surface, every other time with stricter bounds. Of 12 small
/// bodies for which TetGen alone has a larger first percentile, 6 have the larger one after eight draws; 3 after sixteen at the usual
/// bounds.
const DRAWS: u64 = 8;

/// Factors of the bounds asked for, those of the radius-edge ratio and of the smallest dihedral angle, instead of [`EASING`].
const STRICTER: [f64; 2] = [0.9, 2.0];

/// Of a template that was filled and others, the one that is best; `again` fills it once more. What other templates share with it is
/// settled, so that such a template stays as it is, as does what is not to be improved, what the user's own switches say how to mesh, and
/// what cannot be as asked: there it is not luck.
pub fn best_of_draws(
    climb: &Climb<'_>,
    first: Done,
    again: impl Fn(&Climb<'_>, Attempt) -> Option<Done> + Sync,
) -> Done {
    let filled = &first.filled;
    let is_as_asked =
        filled.improved.is_some() && first.advice.is_none() && climb.params.switches.is_empty();
    if !is_as_asked || !filled.shared.is_empty() || filled.template.tets.len() > FEW {
        return first;
    }
    let room = Room::beside(filled.template.vertices.len());
    let quiet = Climb {
        rungs: &[],
        log: Log::new(&|_| ()),
        ..*climb
    };
    let draws = (0..DRAWS).into_par_iter();
    let others: Vec<Option<Done>> = draws
        .map(|draw| again(&quiet, attempt(draw, room)))
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
    Done { failed, ..best }
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

/// Whether one has fewer elements that fail what is asked for, or as many and a larger smallest angle. Whole degrees count, and
/// between equals the number of elements.
fn is_better(one: &Done, other: &Done) -> bool {
    let rank = |done: &Done| {
        let failing = done.filled.improved.map_or(0, |i| i.past + i.low);
        (
            failing,
            -worst(done).floor(),
            done.filled.template.tets.len(),
        )
    };
    rank(one) < rank(other)
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
