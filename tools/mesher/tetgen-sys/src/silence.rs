//! A process that works and says nothing.

use std::time::{Duration, Instant};

/// How TetGen announces refinement, from which on it may take long: the points that it may add bound that, not those of the surface.
const REFINEMENT: &[u8] = b"Refining mesh";

/// How often the clock of a silent process is read.
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// Where TetGen is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    /// Before refinement: what it does is in proportion to the surface.
    Early,
    /// Refining: it checks tetrahedra, and takes memory for new ones.
    Refinement,
    /// After refinement: what it does is in proportion to a mesh that we do not know.
    Late,
}

/// What changes while TetGen refines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Life {
    /// Tetrahedra checked so far.
    checked: u64,
    /// Pages of memory.
    pages: u64,
}

/// Watches for steps that come to no end. Time is the processor's, so that a machine that is busy or stopped makes no difference.
#[derive(Debug)]
pub(crate) struct Silence {
    pid: libc::pid_t,
    most: Duration,
    /// The process's clock when it was last heard; `None` before, and for all time where its switches make it quiet.
    heard: Option<Duration>,
    /// The line that it is printing.
    line: Vec<u8>,
    step: Step,
    /// Last signs of life in refinement.
    life: Option<Life>,
}

impl Silence {
    /// Watches a process that may take a time from one thing that it prints to the next, or from one sign of life to the
    /// next.
    pub fn new(pid: libc::pid_t, most: Duration) -> Self {
        Self {
            pid,
            most,
            heard: None,
            line: Vec::new(),
            step: Step::Early,
            life: None,
        }
    }

    /// Takes what it printed.
    pub fn heard(&mut self, bytes: &[u8]) {
        self.heard = self.clock();
        for &byte in bytes {
            if byte == b'\n' {
                self.step = match self.step {
                    Step::Early if !self.line.starts_with(REFINEMENT) => Step::Early,
                    Step::Early => Step::Refinement,
                    Step::Refinement | Step::Late => Step::Late,
                };
                self.line.clear();
            } else if self.line.len() < REFINEMENT.len() {
                self.line.push(byte);
            }
        }
    }

    /// When to look again.
    pub fn next_look(&self) -> Option<Instant> {
        Instant::now().checked_add(LOOK_EVERY)
    }

    /// The time that it may take, if it has taken more without a word or, in refinement, a sign of life. TetGen's walk from
    /// tetrahedron to tetrahedron can go in circles there: it then neither checks tetrahedra nor makes any. `checked`:
    /// those it has checked.
    pub fn broken(&mut self, checked: u64) -> Option<Duration> {
        if self.step == Step::Refinement {
            // Where the system does not tell, nothing is known.
            let life = self.pages().map(|pages| Life { checked, pages });
            if life.is_none() || life != self.life {
                self.life = life;
                self.heard = self.clock();
            }
        }
        let silent = self.clock()?.checked_sub(self.heard?)?;
        (self.step != Step::Late && silent > self.most).then_some(self.most)
    }

    /// Pages that the process has for data; `None` where the system does not tell.
    fn pages(&self) -> Option<u64> {
        let sizes = std::fs::read_to_string(format!("/proc/{}/statm", self.pid)).ok()?;
        sizes.split_ascii_whitespace().nth(5)?.parse().ok()
    }

    /// Processor time of the process so far; `None` where the system does not tell.
    fn clock(&self) -> Option<Duration> {
        let mut clock = 0;
        let mut now = libc::timespec {
            tv_sec: 0,
            tv_nsec: 0,
        };
        // SAFETY: both calls write into valid variables of our own.
        let known = unsafe {
            libc::clock_getcpuclockid(self.pid, &raw mut clock) == 0
                && libc::clock_gettime(clock, &raw mut now) == 0
        };
        let (seconds, nanos) = (now.tv_sec.try_into().ok()?, now.tv_nsec.try_into().ok()?);
        known.then(|| Duration::new(seconds, nanos))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_before_refinement_may_not_take_long() {
        let mut silence = watch();
        // One that never says anything is quiet, not stuck.
        assert_eq!(silence.broken(0), None);
        silence.heard(b"Delaunizing vertices...\n");
        silence.heard = Some(Duration::ZERO);
        assert_eq!(silence.broken(0), Some(Duration::ZERO));
        silence.heard(b"Constrained Delaunay...\nRefining m");
        silence.heard = Some(Duration::ZERO);
        assert!(silence.broken(0).is_some());
    }

    #[test]
    fn refinement_gives_signs_of_life() {
        let mut silence = watch();
        silence.heard(b"Refining mesh...\n");
        silence.most = Duration::from_secs(3600);
        assert_eq!(silence.broken(1), None);
        assert_eq!(silence.life.map(|life| life.checked), Some(1));
        silence.heard = Some(Duration::ZERO);
        assert_eq!(silence.broken(2), None);
        assert_ne!(silence.heard, Some(Duration::ZERO));
        silence.heard(b"Optimizing mesh...\n");
        silence.heard = Some(Duration::ZERO);
        silence.most = Duration::ZERO;
        assert_eq!(silence.broken(2), None);
    }

    /// A watch over this process, which has taken some time.
    fn watch() -> Silence {
        let own = std::process::id() as libc::pid_t;
        while Silence::new(own, Duration::ZERO).clock() == Some(Duration::ZERO) {}
        Silence::new(own, Duration::ZERO)
    }
}
