//! The rule by which attempts follow each other.

use super::attempt::{Answer, Attempt};
use super::layers::Layers;
use super::room::Room;
use super::rungs::{Change, Ending, Rung};
use crate::error::{ADVICE, Place};
use crate::{
    Deadline, Error, Failure, FailureKind, Limits, Log, Mesher, Params, Piece, Plc, Sizes,
};
use geom::measure::volume_of_region;
use std::time::{Duration, Instant};
/// How long finding the place of a failure may take at most. It is for the message only, and is worth about as much
/// patience as reading it.
const DIAGNOSIS: Duration = Duration::from_secs(10);

/// Everything that attempts at one template have in common.
///
/// Attempts follow each other by one rule. A mesh that can be used ends them. Otherwise the first rung that answers how the
/// attempt ended and was not taken before says what is done differently. When there is none, or no time is left, the
/// last mesh is taken, or the last failure reported.
#[derive(Clone, Copy)]
pub struct Climb<'a> {
    /// What is meshed.
    pub piece: Piece<'a>,
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

/// How an attempt ended that gave no mesh, what is answered first before what is.
fn endings(error: &Error) -> &'static [Ending] {
    match error {
        Error::Doubled { .. } => &[Ending::Doubled, Ending::Chance],
        _ if error.is_chance() && error.is_of_recovery() => &[Ending::Chance, Ending::Recovery],
        _ if error.is_chance() => &[Ending::Chance],
        _ => &[],
    }
}

impl Climb<'_> {
    /// Makes attempts, this one first, until the rule ends them: at most one more than there are rungs. `take`
    /// makes something of a mesh, or says why it cannot be used.
    ///
    /// # Errors
    /// The last attempt's, if none gave a mesh.
    pub fn climb<T>(
        &self,
        mut attempt: Attempt,
        mut take: impl FnMut(Answer) -> Result<T, Error>,
    ) -> Result<T, Error> {
        self.check_count()?;
        let mut left = Left {
            rungs: self.rungs.to_vec(),
            deadline: &self.deadline,
        };
        let mut failed = 0;
        loop {
            let answer = self.run(&mut attempt, failed);
            if let Ok(Answer { plc, mesh, .. }) = &answer
                && let Some(room) = attempt.room.filter(|_| !attempt.stop)
                && let Some(ending) = room.ending(plc, &**mesh, !self.params.quality)
                && let Some(change) = left.next(ending)
            {
                attempt = attempt.changed(change);
                continue;
            }
            let (error, plc) = match answer {
                Ok(answer) => match take(answer) {
                    Ok(made) => return Ok(made),
                    Err(error) => (error, None),
                },
                Err(broken) => broken,
            };
            let change = endings(&error).iter().find_map(|&e| left.next(e));
            let Some(change) = change else {
                return Err(match plc {
                    Some(plc) => self.located(error, &plc),
                    None => error,
                });
            };
            let next = "trying an equivalent description of the surface";
            self.say(&format!("{error}; {next}"));
            failed += 1;
            attempt = attempt.changed(change);
        }
    }

    /// Has the surface meshed once.
    fn run(&self, attempt: &mut Attempt, failed: usize) -> Result<Answer, Broken> {
        let begun = Instant::now();
        let plc =
            Plc::new(self.piece, self.sizes, attempt.description).map_err(|error| (error, None))?;
        let prepared = Instant::now();
        let preserve = self.preserve && plc.faces.preserve();
        // What is divided as volumes are too large need not come to an end either.
        let refines = self.params.quality || !plc.sizes.is_empty();
        if refines && !self.params.switches.contains('S') {
            // The user's own limit counts, and the user's own bounds do, as do elements across walls. Faces that are preserved get
            // no points, however thin layers are.
            let asks = self.params.quality && self.params.default_bounds;
            let yields = asks && !preserve && plc.graded.is_none();
            let layers = || yields.then(|| Layers::of(&plc)).flatten();
            attempt.limit(|| Room::new(self.piece, self.sizes, &plc), layers, &plc);
        }
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
            advice: attempt.advice(self.params),
            meshed,
            failed,
        })
    }

    fn say(&self, text: &str) {
        self.log
            .detail(&format!("template {}: {text}", self.piece.index));
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
        let Piece {
            document,
            index,
            template,
            ..
        } = self.piece;
        // TetGen counts corners in 32 bits.
        let most = f64::from(i32::MAX) / 4.0;
        let sizes = document.regions.iter().zip(&self.sizes.of_region);
        for (region, limit) in sizes {
            if let Some(max_volume) = *limit {
                let count =
                    volume_of_region(&template.vertices, template.faces(), region.id) / max_volume;
                if count > most {
                    return Err(Error::TooMany {
                        template: index,
                        max_volume,
                        count,
                        limit: most,
                    });
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
