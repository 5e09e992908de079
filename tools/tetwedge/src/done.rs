//! A filled template: coarsened, improved, checked, with what there is to say about it.

use crate::failing::{FAILING, is_hopeless};
use crate::fill::{Filled, fill, finish};
use improve::Leaves;
use mesher::{Answer, Climb, EASING, Error, Progress};
use surface::Footing;

/// A filled template, and what there is to say about it.
pub struct Done {
    /// The template.
    pub filled: Filled,
    /// TetGen's switches.
    pub switches: String,
    /// What the user should know or do otherwise.
    pub advice: Option<String>,
    /// Descriptions that failed before.
    pub failed: usize,
    /// Whether the surface is off the one that was given: faces are uneven, or vertices were moved along the shape.
    pub is_off: bool,
}

/// What is made of a filled template while it is improved, of what it shares with others, unless that may change.
pub type Beside<'a, B> = &'a (dyn Fn(&Filled) -> Option<B> + Sync);

/// The mesher's answer coarsened within the bound that it was given, where coarser elements could not all be mended and this is better. Improvement is
/// chaotic where shapes leave it little room, and the better one of two has fewer bad outcomes: of 12 placements of an impeller, 1.70 % of
/// the elements are past the radius-edge bound in the mean, and 1.90 % at most; 1.78 and 2.06 % without. Faces that other templates
/// share are settled before anything is mended, so that templates with such faces have one way only.
fn bounded(
    (climb, footing): (&Climb<'_>, Option<&Footing>),
    answer: &Answer,
    filled: &Filled,
) -> Option<Filled> {
    let weight = |filled: &Filled| {
        let failing = filled.improved.map_or(0, |done| done.past + done.low);
        (failing, filled.template.tets.len() + FAILING * failing)
    };
    let (failing, most) = weight(filled);
    let is_hopeless = is_hopeless(failing, filled.template.tets.len());
    if failing == 0
        || is_hopeless
        || climb.deadline.is_over()
        || filled.removed == 0
        || !filled.shared.is_empty()
    {
        return None;
    }
    let [ratio, _] = EASING;
    let (mut other, origin) = fill(climb, answer, Leaves::Within(ratio)).ok()?;
    finish((climb, footing), &answer.plc, &mut other, origin).ok()?;
    (weight(&other).1 < most).then_some(other)
}

/// That there was no time to improve all elements.
fn cut_short(climb: &Climb<'_>, filled: &Filled) -> Option<String> {
    let whole = climb.deadline.whole()?.as_secs_f64();
    let done = filled.improved.filter(|done| done.stopped)?;
    Some(format!(
        "template {}: improvement was stopped after {whole} s, the time limit; of {} tetrahedra to be improved, {} remain; raise --timeout",
        climb.piece.index, done.bad, done.left,
    ))
}

/// Makes a filled template of the mesher's answer, and what there is to be made beside it.
///
/// # Errors
/// See [`Error`].
pub fn done<B: Send>(
    (climb, footing): (&Climb<'_>, Option<&Footing>),
    (answer, leaves): (Answer, Leaves),
    beside: Option<Beside<'_, B>>,
) -> Result<(Done, Option<B>), Error> {
    let say = |text: &str| {
        climb
            .log
            .detail(&format!("template {}: {text}", climb.piece.index))
    };
    let (mut filled, origin) = fill(climb, &answer, leaves)?;
    climb.log.progress(&Progress {
        template: climb.piece.index,
        step: "improving elements",
        points: filled.template.vertices.len() as f64,
        tetrahedra: filled.template.tets.len() as f64,
    });
    let made = match beside {
        Some(beside) => {
            let surface = filled.shared_surface();
            let (made, finished) = rayon::join(
                || beside(&surface),
                || finish((climb, footing), &answer.plc, &mut filled, origin),
            );
            finished?;
            made
        }
        None => {
            finish((climb, footing), &answer.plc, &mut filled, origin)?;
            None
        }
    };
    if let Some(better) = bounded((climb, footing), &answer, &filled) {
        say("coarser elements could not be mended, so that fewer vertices were taken out");
        filled = better;
    }
    if let Some(done) = filled.improved {
        say(&format!(
            "{} tetrahedra to be improved, {} remain; {} vertices moved, {} added, {} edges and faces replaced",
            done.bad, done.left, done.moved, done.inserted, done.flipped,
        ));
    }
    if filled.removed > 0 {
        say(&format!(
            "{} vertices of the mesher's were taken out that the elements do not need",
            filled.removed
        ));
    }
    say(&format!(
        "{} tetrahedra, {} vertices; checked in {:.3} s",
        filled.template.tets.len(),
        filled.template.vertices.len(),
        answer.meshed.elapsed().as_secs_f64(),
    ));
    if filled.dropped > 0 {
        say(&format!(
            "{} tetrahedra in voids were left out",
            filled.dropped
        ));
    }
    let notes = [answer.advice, cut_short(climb, &filled)];
    let notes: Vec<String> = notes.into_iter().flatten().collect();
    let is_off = answer.plc.relief.is_there() || filled.has_slid;
    let done = Done {
        filled,
        switches: answer.mesh.told().to_owned(),
        failed: answer.failed,
        is_off,
        advice: (!notes.is_empty()).then(|| notes.join("; ")),
    };
    Ok((done, made))
}
