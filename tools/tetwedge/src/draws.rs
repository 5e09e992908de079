//! Templates of few elements are filled several times, and the best is taken.

use crate::done::Done;
use crate::score::Score;
use mesher::{Asks, Attempt, Climb, Description, EASING, Log, Order, Params};
use rayon::prelude::*;

/// Up to so many elements the first percentile of the angles is the smallest one, which is that of a single element and a matter of
/// luck; and another mesh takes a few milliseconds.
const FEW: usize = 100;

/// Where a length of edges is asked for, how near a mesh comes to it is luck, too: the draws of a template have about so many elements
/// together then, which mostly takes less than a tenth of a second. 43 parts from CAD kernels have 4 % fewer elements with edges of a tenth of the diagonal.
/// Without lengths it is 1 %, and none on prisms, rings and vias, which take a fifth longer.
const DRAWN: usize = 1600;

/// How often a template is filled anew at most: equivalent descriptions of its surface, with usual and stricter bounds and angles to reach in
/// turn. Measured on 68 small bodies, ten of which TetGen alone gives a larger first percentile without draws: 3 have it after
/// sixteen draws, 5 after eight at the usual angles, and the smallest angles are 16 % and 5 % larger, with 9 % and 5 % more elements.
const DRAWS: usize = 16;

/// Factors of the bounds asked for, those of the radius-edge ratio and of the smallest dihedral angle, instead of [`EASING`].
const STRICTER: [f64; 2] = [0.9, 2.0];

/// The largest dihedral angle that optimization leaves alone in every other draw, degrees, unless a smaller one was asked for: the smallest
/// one to reach is 40 degrees. A choice: all of 70.5 are those of a regular tetrahedron, which fill no body; few bodies have 40 throughout.
const LARGEST: f64 = 100.0;

/// How often a template of so many elements is filled anew.
pub fn draws(climb: &Climb<'_>, elements: usize) -> usize {
    match has_lengths(climb) {
        true => DRAWS.min(DRAWN / elements.max(1)),
        false if elements <= FEW => DRAWS,
        false => 0,
    }
}

/// Whether lengths of edges are asked for.
pub fn has_lengths(climb: &Climb<'_>) -> bool {
    climb.sizes.lengths.iter().any(Option::is_some)
}

/// Of a template that was filled and others, the one that is best, and whether that is another; `again` fills it once more. What is not
/// to be improved stays as it is, as does what the user's own switches say how to mesh, and what cannot be as asked: there it is not luck.
///
/// Where edges have a length that was asked for, angles beyond those of good elements are no reason for shorter ones, and all draws
/// have the usual bounds.
pub fn best_of_draws(
    climb: &Climb<'_>,
    first: Done,
    again: impl Fn(&Climb<'_>, Attempt) -> Option<Done> + Sync,
) -> (Done, bool) {
    let filled = &first.filled;
    let count = draws(climb, filled.template.tets.len());
    let is_as_asked =
        filled.improved.is_some() && first.advice.is_none() && climb.params.switches.is_empty();
    let angle = climb.params.angle().filter(|_| is_as_asked && count > 0);
    let Some(angle) = angle else {
        return (first, false);
    };
    let strict = Params {
        optimize: climb.params.optimize.map(|largest| largest.min(LARGEST)),
        ..climb.params.clone()
    };
    let all = [
        (EASING, climb.params),
        (STRICTER, climb.params),
        (EASING, &strict),
        (STRICTER, &strict),
    ];
    let (ways, enough) = match has_lengths(climb) {
        true => (&all[..1], angle),
        false => (&all[..], strict.angle().unwrap_or(angle)),
    };
    let score = |done: &Done| Score::new(done, enough);
    let room = score(&first).room(filled.template.vertices.len(), enough);
    let others: Vec<Option<Done>> = (0..count)
        .into_par_iter()
        .map(|draw| {
            let (factors, params) = ways[draw % ways.len()];
            let quiet = Climb {
                params,
                rungs: &[],
                log: Log::new(&|_| ()),
                ..*climb
            };
            // Refinement to stricter bounds may not come to an end.
            let attempt = Attempt {
                room: Some(room),
                ..drawn(draw as u64, Asks::Eased(factors))
            };
            again(&quiet, attempt)
        })
        .collect();
    let failed = first.failed;
    let mut best = first;
    let mut is_another = false;
    for other in others.into_iter().flatten() {
        if score(&other).is_better_than(&score(&best)) {
            best = other;
            is_another = true;
        }
    }
    if is_another {
        climb.log.detail(&format!(
            "template {}: the best of {} meshes has {} tetrahedra, none with an angle below {:.1} degrees",
            climb.piece.index,
            count + 1,
            best.filled.template.tets.len(),
            score(&best).angle,
        ));
    }
    (Done { failed, ..best }, is_another)
}

/// The attempt of a draw, without a limit.
pub fn drawn(draw: u64, asks: Asks) -> Attempt {
    Attempt {
        description: Description {
            order: Order::Shuffled(draw),
            // In the order given: that of few points would depend on their places alone.
            rounds_from: Some(0),
            ..Description::PLAIN
        },
        ..Attempt::new(asks)
    }
}
