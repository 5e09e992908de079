//! One template: filled, improved, checked, and those that follow it.

use crate::fill::{Filled, fill, finish};
use crate::follow::{Followed, follower};
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
    /// Templates that share faces with this one, if they were meshed while it was finished.
    pub followed: Vec<Followed>,
}

/// Meshes a template, at first with the bounds eased if improvement can mend that; followers, too, if it is done at the
/// first attempt and there are threads for it.
///
/// # Errors
/// See [`Error`].
pub fn template(climb: &Climb<'_>, followers: &[usize]) -> Result<Done, Error> {
    let asks = match improves(climb.params) {
        true => Asks::Eased(EASING),
        false => Asks::AsWished,
    };
    let take = |answer| {
        let done = done(climb, followers, answer)?;
        let short = match done.advice {
            Some(_) => None,
            None => done.verdict.short_of(climb.params),
        };
        Ok(Judged { made: done, short })
    };
    let better = |eased: &Done, tight: &Done| tight.verdict.is_worth_it(&eased.verdict);
    climb.climb(asks, take, better)
}

/// Makes a filled template of the mesher's answer. What it shares with followers is settled before it is improved:
/// where there are threads, they are meshed at the same time.
fn done(climb: &Climb<'_>, followers: &[usize], answer: Answer) -> Result<Done, Error> {
    let say = |text: &str| (climb.log)(&format!("template {}: {text}", climb.template));
    let (mut filled, origin) = fill(climb.document, climb.template, &answer)?;
    let parallel = rayon::current_num_threads() > 1 && !followers.is_empty() && !answer.again;
    let followed = if parallel {
        let surface = filled.shared_surface();
        let job = Job {
            document: climb.document,
            params: climb.params,
            sizes: climb.sizes,
            log: climb.log,
        };
        let follow = || {
            let each = followers.iter();
            each.map(|&i| (i, follower(&job, i, &surface))).collect()
        };
        let (followed, finished) =
            rayon::join(follow, || finish(climb, &answer.plc, &mut filled, &origin));
        finished?;
        followed
    } else {
        finish(climb, &answer.plc, &mut filled, &origin)?;
        Vec::new()
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
    Ok(Done {
        verdict: Verdict::new(filled.improved, filled.template.tets.len(), &answer),
        filled,
        switches: answer.mesh.told().to_owned(),
        preserved: answer.plc.faces.preserve(),
        failed: answer.failed,
        advice: answer.advice,
        followed,
    })
}
