//! One template: filled, improved, checked, and those that follow it.

use crate::fill::{Filled, fill, finish};
use crate::judge::{EASING, Verdict, improves};
use mesher::{Answer, Asks, Climb, Deadline, Error, Judged, Log, Params, Rung, Sizes, TetGen};
use tmesh::Document;

/// What all templates have in common.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// The document as it was given.
    pub document: &'a Document,
    /// What is asked for.
    pub params: &'a Params,
    /// Sizes by region.
    pub sizes: &'a Sizes,
    /// Receives details.
    pub log: Log<'a>,
}

impl<'a> Job<'a> {
    /// Attempts at a template, by the given rungs.
    pub fn climb(&self, template: usize, rungs: &'a [Rung], deadline: Deadline) -> Climb<'a> {
        Climb {
            document: self.document,
            template,
            params: self.params,
            sizes: self.sizes,
            preserve: true,
            rungs,
            deadline,
            mesher: &TetGen,
            log: self.log,
        }
    }
}

/// A filled template, and what there is to say about it.
pub struct Done {
    /// The template.
    pub filled: Filled,
    /// TetGen's switches.
    pub switches: String,
    /// What the user should know or do otherwise.
    pub advice: Option<String>,
    /// Whether faces were preserved.
    pub preserved: bool,
    /// Descriptions that failed before.
    pub failed: usize,
    /// How far the elements are from what was asked for.
    pub verdict: Verdict,
}

/// Meshes a template, at first with the bounds eased if improvement can mend that. What it shares with others is settled
/// before it is improved: where there are threads, `beside` works on that at the same time, and what it makes of
/// the first attempt that is taken is returned.
///
/// # Errors
/// See [`Error`].
pub fn template<B: Send>(
    climb: &Climb<'_>,
    beside: Option<&(dyn Fn(&Filled) -> B + Sync)>,
) -> Result<(Done, Option<B>), Error> {
    let asks = match improves(climb.params) {
        true => Asks::Eased(EASING),
        false => Asks::AsWished,
    };
    let take = |answer: Answer| {
        let beside = beside.filter(|_| !answer.again && rayon::current_num_threads() > 1);
        let (done, made) = done(climb, answer, beside)?;
        let short = match done.advice {
            Some(_) => None,
            None => done.verdict.short_of(climb.params),
        };
        Ok(Judged {
            made: (done, made),
            short,
        })
    };
    climb.climb(asks, take, |(eased, _), (tight, _)| {
        tight.verdict.is_worth_it(&eased.verdict)
    })
}

/// Makes a filled template of the mesher's answer.
fn done<B: Send>(
    climb: &Climb<'_>,
    answer: Answer,
    beside: Option<&(dyn Fn(&Filled) -> B + Sync)>,
) -> Result<(Done, Option<B>), Error> {
    let say = |text: &str| (climb.log)(&format!("template {}: {text}", climb.template));
    let (mut filled, origin) = fill(climb.document, climb.template, &answer)?;
    let made = match beside {
        Some(beside) => {
            let surface = filled.shared_surface();
            let (made, finished) = rayon::join(
                || beside(&surface),
                || finish(climb, &answer.plc, &mut filled, &origin),
            );
            finished?;
            Some(made)
        }
        None => {
            finish(climb, &answer.plc, &mut filled, &origin)?;
            None
        }
    };
    if let Some(done) = filled.improved {
        say(&format!(
            "{} tetrahedra to be improved, {} remain; {} vertices moved, {} added, {} edges and faces replaced",
            done.bad, done.left, done.moved, done.inserted, done.flipped,
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
    let done = Done {
        verdict: Verdict::new(filled.improved, filled.template.tets.len(), &answer),
        filled,
        switches: answer.mesh.told().to_owned(),
        preserved: answer.plc.faces.preserve(),
        failed: answer.failed,
        advice: answer.advice,
    };
    Ok((done, made))
}
