//! One template: how it is meshed.

use crate::done::{Beside, Done, done};
use crate::draws::{best_of_draws, draws};
use crate::fill::Filled;
use improve::Leaves;
use mesher::{
    Asks, Attempt, Climb, Deadline, EASING, Error, LADDER, Log, Params, Piece, Sizes, TetGen,
};
use surface::{Footing, Guide};

/// What all templates have in common.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// What is asked for.
    pub params: &'a Params,
    /// Sizes by region.
    pub sizes: &'a Sizes,
    /// What the surfaces of followers are divided by.
    pub guide: Guide,
    /// Receives details.
    pub log: Log<'a>,
}

impl<'a> Job<'a> {
    /// Attempts at a template.
    pub fn climb<'p>(&self, piece: Piece<'p>, deadline: Deadline) -> Climb<'p>
    where
        'a: 'p,
    {
        Climb {
            piece,
            params: self.params,
            sizes: self.sizes,
            preserve: true,
            rungs: &LADDER,
            deadline,
            mesher: &TetGen,
            log: self.log,
        }
    }
}

/// Meshes a template, with the bounds eased if elements are improved afterwards. What it shares with others is settled
/// before; its surface may stand on a shape. Where there are threads and only one mesh is made, `beside` works on that at the same time, and what it makes of it is returned.
///
/// # Errors
/// See [`Error`].
pub fn template<B: Send>(
    climb: &Climb<'_>,
    footing: Option<&Footing>,
    beside: Option<&(dyn Fn(&Filled) -> B + Sync)>,
) -> Result<(Done, Option<B>), Error> {
    let asks = match climb.params.angle().is_some() {
        true => Asks::Eased(EASING),
        false => Asks::AsWished,
    };
    let beside = beside.filter(|_| rayon::current_num_threads() > 1);
    let unless_drawn = beside.map(|beside| {
        move |filled: &Filled| {
            (draws((climb, footing), filled.template.tets.len()) == 0).then(|| beside(filled))
        }
    });
    let beside = unless_drawn.as_ref().map(|made| made as Beside<'_, B>);
    let (first, made) = climb.climb(Attempt::new(asks), |answer| {
        done((climb, footing), (answer, Leaves::Mendable), beside)
    })?;
    let again = |climb: &Climb<'_>, footing: Option<&Footing>, (attempt, leaves)| {
        let done = climb.climb(attempt, |answer| {
            done::<()>((climb, footing), (answer, leaves), None)
        });
        Some(done.ok()?.0)
    };
    let (best, is_another) = best_of_draws((climb, footing), first, again);
    Ok((best, made.filter(|_| !is_another)))
}
