//! Templates of few elements are filled several times, and the best is taken.

use crate::done::Done;
use crate::kept::to_keep;
use crate::score::Judge;
use improve::Leaves;
use mesher::{Asks, Attempt, Climb, Description, EASING, Kept, Log, Order, Params, Piece};
use rayon::prelude::*;
use surface::Footing;

/// Up to so many elements the first percentile of the angles is the smallest one, which is that of a single element and a matter of
/// luck; and another mesh takes a few milliseconds.
const FEW: usize = 100;

/// Where edges get the lengths that are wanted, how near a mesh comes to them is luck, too: the draws of a template have about so many elements
/// together then, which mostly takes less than half a second. Where lengths are asked for, 43 parts from CAD kernels have 4 % fewer elements with edges of
/// a tenth and of a twentieth of the diagonal, in 1.2 to 1.3 times the time of the whole pipe; with a quarter of it, 1 %; with a hundred draws of two and
/// a half times as many, 6 % in twice the time. Where the shape alone says how long edges are to be, 136 parts and assemblies have 7 % fewer, and smallest
/// angles that are 3 % larger, in 1.2 times the time; with four times as many, 1 % fewer and 3 % in 1.4 times that. Where surfaces stay as they are drawn, 1 %,
/// and none on prisms, rings and vias, which take a fifth longer.
const DRAWN: usize = 6400;

/// How often a template is filled anew at most: equivalent descriptions of its surface, with usual and stricter bounds, usual and stricter angles to
/// reach, and coarsened to what can be mended or to good elements only, in turn. Measured on 68 small bodies, before there were both ways to
/// coarsen, ten of which TetGen alone gives a larger first percentile without draws: 3 have it after sixteen draws, 5 after eight at the usual angles, and the smallest angles are 16 % and 5 % larger, with 9 % and 5 % more elements.
const DRAWS: usize = 16;

/// Factors of the bounds asked for, those of the radius-edge ratio and of the smallest dihedral angle, instead of [`EASING`].
const STRICTER: [f64; 2] = [0.9, 2.0];

/// The largest dihedral angle that optimization leaves alone in every other draw, degrees, unless a smaller one was asked for: the smallest
/// one to reach is 40 degrees. A choice: all of 70.5 are those of a regular tetrahedron, which fill no body; few bodies have 40 throughout.
const LARGEST: f64 = 100.0;

/// How often a template of so many elements is filled anew.
pub fn draws(of: (&Climb<'_>, Option<&Footing>), elements: usize) -> usize {
    match gets_lengths(of, elements) {
        true => DRAWS.min(DRAWN / elements.max(1)),
        false if elements <= FEW => DRAWS,
        false => 0,
    }
}

/// Whether the edges of a template of so many elements get the lengths that are wanted: those that are asked for, or where its surface was remeshed and
/// angles are no matter of luck, those of the shape.
fn gets_lengths((climb, footing): (&Climb<'_>, Option<&Footing>), elements: usize) -> bool {
    let are_asked = climb.sizes.lengths.iter().any(Option::is_some);
    are_asked || footing.is_some() && elements > FEW
}

/// Of a template that was filled and others, the one that is best, and whether that is another; `again` fills it once more. What is not
/// to be improved stays as it is, as does what the user's own switches say how to mesh, and what cannot be as asked: there it is not luck.
///
/// Where edges get the lengths that are wanted, angles beyond those of good elements are no reason for shorter ones, and all draws
/// have the usual bounds; some have no vertices added to their surface where that may bring longer edges.
pub fn best_of_draws(
    (climb, footing): (&Climb<'_>, Option<&Footing>),
    first: Done,
    again: impl Fn(&Climb<'_>, Option<&Footing>, (Attempt, Leaves)) -> Option<Done> + Sync,
) -> (Done, bool) {
    let filled = &first.filled;
    let is_as_asked =
        filled.improved.is_some() && first.advice.is_none() && climb.params.switches.is_empty();
    let Some(angle) = climb.params.angle().filter(|_| is_as_asked) else {
        return (first, false);
    };
    let strict = Params {
        optimize: climb.params.optimize.map(|largest| largest.min(LARGEST)),
        ..climb.params.clone()
    };
    let elements = filled.template.tets.len();
    let sized = gets_lengths((climb, footing), elements);
    let count = draws((climb, footing), elements);
    let to_keep = to_keep(climb, &filled.template);
    if count == 0 && to_keep.is_none() {
        return (first, false);
    }
    let enough = match sized {
        true => angle,
        false => strict.angle().unwrap_or(angle),
    };
    let Piece {
        document, index, ..
    } = climb.piece;
    let judge = Judge::new(document, (climb.sizes, index), climb.params, enough);
    let score = |done: &Done| judge.score(done);
    let footing_kept = footing
        .zip(to_keep.as_ref())
        .map(|(footing, kept)| footing.with_parts(&kept.parents));
    let fill = |(params, attempt, leaves): (&Params, Attempt, Leaves)| {
        let kept = (to_keep.as_ref()).filter(|_| attempt.keeps_surface.is_some());
        let (template, footing) = match kept {
            Some(kept) => (&kept.template, footing_kept.as_ref()),
            None => (climb.piece.template, footing),
        };
        let quiet = Climb {
            piece: Piece {
                template,
                apart: footing.map_or(&[], |footing| &footing.apart),
                ..climb.piece
            },
            params,
            rungs: &[],
            log: Log::new(&|_| ()),
            ..*climb
        };
        again(&quiet, footing, (attempt, leaves))
    };
    // Refinement to stricter bounds may not come to an end.
    let room = score(&first).room(filled.template.vertices.len(), enough);
    let mut ways: Vec<(&Params, Attempt, Leaves)> = (0..count)
        .map(|draw| {
            let (params, asks) = match sized {
                true => (climb.params, Asks::Eased(EASING)),
                false => (
                    [climb.params, &strict][draw / 2 % 2],
                    Asks::Eased([EASING, STRICTER][draw % 2]),
                ),
            };
            let attempt = Attempt {
                room: Some(room),
                ..drawn(draw, asks)
            };
            let leaves = match draw / 4 % 2 {
                1 if !sized => Leaves::Good,
                _ => Leaves::Mendable,
            };
            (params, attempt, leaves)
        })
        .collect();
    let keeping = |attempt| {
        let keeps_surface = Some(Kept::Enough);
        let attempt = Attempt {
            keeps_surface,
            ..attempt
        };
        (climb.params, attempt, Leaves::Mendable)
    };
    let usual = Asks::Eased(EASING);
    let kept = (to_keep.as_ref())
        .and_then(|_| fill(keeping(Attempt::new(usual))))
        .filter(|kept| !score(kept).is_hopeless());
    if let Some(kept) = &kept {
        let draws = 0..draws((climb, footing), kept.filled.template.tets.len());
        ways.extend(draws.map(|draw| keeping(drawn(draw, usual))));
    }
    let others: Vec<Option<Done>> = ways.into_par_iter().map(fill).collect();
    let others = kept.into_iter().chain(others.into_iter().flatten());
    let failed = first.failed;
    let (mut best, mut made) = (first, 1);
    let mut is_another = false;
    for other in others {
        let is_better = match sized {
            true => score(&other).is_cheaper_than(&score(&best)),
            false => score(&other).is_better_than(&score(&best)),
        };
        made += 1;
        if is_better {
            best = other;
            is_another = true;
        }
    }
    if is_another {
        climb.log.detail(&format!(
            "template {}: the best of {made} meshes has {} tetrahedra, none with an angle below {:.1} degrees",
            climb.piece.index,
            best.filled.template.tets.len(),
            score(&best).angle,
        ));
    }
    (Done { failed, ..best }, is_another)
}

/// The attempt of a draw, without a limit.
fn drawn(draw: usize, asks: Asks) -> Attempt {
    Attempt {
        description: Description {
            order: Order::Shuffled(draw as u64),
            // In the order given: that of few points would depend on their places alone.
            rounds_from: Some(0),
            ..Description::PLAIN
        },
        ..Attempt::new(asks)
    }
}
