//! The rule by which attempts follow each other.

use super::attempt::{Answer, Asks, Attempt};
use super::room::Room;
use super::rungs::{Change, Ending, Rung};
use crate::error::{ADVICE, Place};
use crate::{Deadline, Error, Failure, FailureKind, Limits, Log, Mesher, Params, Plc, Sizes};
use geom::measure::volume_of_region;
use std::time::{Duration, Instant};
use tmesh::Document;

/// Most tetrahedra that may be asked for in a template: TetGen counts their corners in 32 bits.
const MOST: f64 = i32::MAX as f64 / 4.0;

/// How long finding the place of a failure may take at most. It is for the message only, and is worth about as much
/// patience as reading it.
const DIAGNOSIS: Duration = Duration::from_secs(10);

/// Everything that attempts at one template have in common.
///
/// Attempts follow each other by one rule. A mesh as asked for ends them. Otherwise the first rung that answers how the
/// attempt ended and was not taken before says what is done differently. When there is none, or no time is left, the
/// best mesh so far is taken, or the last failure reported; and so it is when there is a mesh already and the attempt at a
/// better one fails.
#[derive(Clone, Copy)]
pub struct Climb<'a> {
    /// The document with the template.
    pub document: &'a Document,
    /// The template's number.
    pub template: usize,
    /// What is asked for.
    pub params: &'a Params,
    /// Sizes by region.
    pub sizes: &'a Sizes,
    /// Whether faces that walls want to be preserved are.
    pub preserve: bool,
    /// What is done when an attempt does not end as it should.
    pub rungs: &'a [Rung],
    /// When to stop.
    pub deadline: Deadline,
    /// What makes the meshes.
    pub mesher: &'a dyn Mesher,
    /// Receives details.
    pub log: Log<'a>,
}

/// What was made of an attempt's mesh.
#[derive(Clone, Debug)]
pub struct Judged<T> {
    /// What was made of it.
    pub made: T,
    /// Why another attempt may be worth it, if too many elements are not as asked for.
    pub short: Option<String>,
}

/// An attempt that gave no mesh: why, and the surface as it was described if it came that far.
type Broken = (Error, Option<Box<Plc>>);

/// The rungs that were not taken yet.
struct Left<'a> {
    rungs: Vec<Rung>,
    deadline: &'a Deadline,
}

impl Left<'_> {
    /// Takes the first rung that answers an ending, if there is time for it.
    fn next(&mut self, ending: Ending) -> Option<Change> {
        let place = self.rungs.iter().position(|rung| rung.after == ending)?;
        (!self.deadline.is_over()).then(|| self.rungs.remove(place).change)
    }
}

impl Climb<'_> {
    /// Makes attempts, the first with these bounds, until the rule ends them: at most one more than there are rungs. `take`
    /// makes something of a mesh, and `better` says whether its second argument is to be preferred to the first, which
    /// was made before.
    ///
    /// # Errors
    /// The last attempt's, if none gave a mesh.
    pub fn climb<T>(
        &self,
        asks: Asks,
        mut take: impl FnMut(Answer) -> Result<Judged<T>, Error>,
        better: impl Fn(&T, &T) -> bool,
    ) -> Result<T, Error> {
        self.check_count()?;
        let mut left = Left {
            rungs: self.rungs.to_vec(),
            deadline: &self.deadline,
        };
        let mut attempt = Attempt::new(asks);
        let mut in_hand: Option<T> = None;
        let mut failed = 0;
        loop {
            let answer = self.run(&mut attempt, failed, in_hand.is_some());
            if let Ok(Answer { plc, mesh, .. }) = &answer
                && let Some(ending) = attempt.room.and_then(|room| room.ending(plc, &**mesh))
                && let Some(change) = left.next(ending)
            {
                attempt = attempt.changed(change);
                continue;
            }
            let (judged, plc) = match answer {
                Ok(answer) => (take(answer), None),
                Err((error, plc)) => (Err(error), plc),
            };
            match judged {
                Ok(Judged { made, short }) => {
                    let is_eased = matches!(attempt.asks, Asks::Eased(_));
                    if let Some(why) = short.filter(|_| is_eased)
                        && let Some(change) = left.next(Ending::Short)
                    {
                        self.say(&format!("{why}; once more without the bounds eased"));
                        attempt = attempt.changed(change);
                        in_hand = Some(made);
                        continue;
                    }
                    return Ok(match in_hand {
                        Some(before) if !better(&before, &made) => before,
                        _ => made,
                    });
                }
                Err(error) => {
                    let again = error.is_chance() && in_hand.is_none();
                    match again.then(|| left.next(Ending::Chance)).flatten() {
                        Some(change) => {
                            let next = "trying an equivalent description of the surface";
                            self.say(&format!("{error}; {next}"));
                            failed += 1;
                            attempt = attempt.changed(change);
                        }
                        None => return self.settle(in_hand, error, plc.as_deref()),
                    }
                }
            }
        }
    }

    /// What there is after an attempt without a mesh and without a rung for it.
    fn settle<T>(&self, in_hand: Option<T>, error: Error, plc: Option<&Plc>) -> Result<T, Error> {
        match (in_hand, plc) {
            (Some(before), _) if !error.is_from_outside() => Ok(before),
            (_, Some(plc)) => Err(self.located(error, plc)),
            _ => Err(error),
        }
    }

    /// Has the surface meshed once.
    fn run(&self, attempt: &mut Attempt, failed: usize, again: bool) -> Result<Answer, Broken> {
        let begun = Instant::now();
        let plc = Plc::new(
            self.document,
            self.template,
            self.sizes,
            attempt.description,
        )
        .map_err(|error| (error, None))?;
        let prepared = Instant::now();
        if self.params.quality && !self.params.switches.contains('S') {
            // The user's own limit counts.
            attempt.limit(|| Room::new(self.document, self.sizes, &plc), &plc);
        }
        let preserve = self.preserve && plc.faces.preserve();
        let task = attempt.task(self.params, preserve);
        let limits = Limits {
            timeout: self.deadline.left(),
            memory: self.params.max_memory,
        };
        let mesh = match self.mesher.mesh(&plc, &task, limits, self.log) {
            Ok(mesh) => mesh,
            Err(failure) => return Err((self.explained(failure), Some(Box::new(plc)))),
        };
        let meshed = Instant::now();
        self.say(&format!(
            "{} tetrahedra; prepared in {:.3} s, meshed in {:.3} s",
            mesh.tetrahedra().len(),
            (prepared - begun).as_secs_f64(),
            (meshed - prepared).as_secs_f64(),
        ));
        Ok(Answer {
            plc,
            mesh,
            bounds: attempt.bounds(self.params),
            advice: attempt.advice(self.params),
            meshed,
            failed,
            again,
        })
    }

    fn say(&self, text: &str) {
        (self.log)(&format!("template {}: {text}", self.template));
    }

    /// The error to report for a failure, with advice.
    fn explained(&self, mut failure: Failure) -> Error {
        let advice = match failure.kind {
            FailureKind::TimedOut => {
                if let Some(whole) = self.deadline.whole() {
                    // The attempt had what was left of the time; the user gave the whole.
                    failure.what = format!(
                        "TetGen was stopped after {} s, the time limit",
                        whole.as_secs_f64()
                    );
                }
                "raise --timeout, or ask for larger elements (--max-volume, --edge-length) or fewer (--radius-edge, --min-dihedral)"
            }
            FailureKind::MemoryLimit => {
                "raise --max-memory, or ask for larger elements (--max-volume, --edge-length)"
            }
            FailureKind::Killed | FailureKind::NoMemory => {
                "ask for larger elements (--max-volume, --edge-length)"
            }
            FailureKind::Switches => "see --switches",
            FailureKind::Outside => "this is not a matter of the input",
            FailureKind::Chance | FailureKind::Final => ADVICE,
        };
        Error::Mesher {
            failure,
            place: String::new(),
            advice,
        }
    }

    /// The error with the place where the surface intersects itself, if that is why the mesher failed.
    fn located(&self, error: Error, plc: &Plc) -> Error {
        let Error::Mesher {
            failure,
            mut advice,
            mut place,
        } = error
        else {
            return error;
        };
        if matches!(failure.kind, FailureKind::Chance | FailureKind::Final) {
            let timeout = self.params.timeout.map_or(DIAGNOSIS, |t| t.min(DIAGNOSIS));
            let limits = Limits {
                timeout: Some(timeout),
                memory: None,
            };
            let pairs = self.mesher.intersections(plc, limits);
            if let Some(first) = pairs.first() {
                let [a, b] = first.map(|t| Place(plc.middle(t)));
                place = format!(
                    "; {} pair(s) of surface triangles intersect, the first near {a} and {b}",
                    pairs.len()
                );
                advice = "repair the surface there";
            }
        }
        Error::Mesher {
            failure,
            place,
            advice,
        }
    }

    /// Refuses sizes that could only end in running out of memory.
    fn check_count(&self) -> Result<(), Error> {
        let template = &self.document.templates[self.template];
        let sizes = self.document.regions.iter().zip(&self.sizes.of_region);
        for (region, limit) in sizes {
            if let Some(max_volume) = *limit {
                let count =
                    volume_of_region(&template.vertices, template.faces(), region.id) / max_volume;
                if count > MOST {
                    return Err(Error::TooMany {
                        template: self.template,
                        max_volume,
                        count,
                        limit: MOST,
                    });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
