//! A process that works and says nothing.

use std::time::{Duration, Instant};

/// How TetGen announces refinement, from which on it may take long: the points that it may add bound that, not those of the surface.
const LONG: &[u8] = b"Refining mesh";

/// How often the clock of a silent process is read.
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// Watches for steps that come to no end. Time is the processor's, so that a machine that is busy or stopped makes no difference.
#[derive(Debug)]
pub(crate) struct Silence {
    pid: libc::pid_t,
    most: Duration,
    /// The process's clock when it was last heard; `None` before, and for all time where its switches make it quiet.
    heard: Option<Duration>,
    /// The line that it is printing.
    line: Vec<u8>,
    is_long: bool,
}

impl Silence {
    /// Watches a process that may take a time from one thing that it prints to the next.
    pub fn new(pid: libc::pid_t, most: Duration) -> Self {
        Self {
            pid,
            most,
            heard: None,
            line: Vec::new(),
            is_long: false,
        }
    }

    /// Takes what it printed.
    pub fn heard(&mut self, bytes: &[u8]) {
        self.heard = self.clock();
        for &byte in bytes {
            if byte == b'\n' {
                self.is_long |= self.line.starts_with(LONG);
                self.line.clear();
            } else if self.line.len() < LONG.len() {
                self.line.push(byte);
            }
        }
    }

    /// When to look again.
    pub fn next_look(&self) -> Option<Instant> {
        Instant::now().checked_add(LOOK_EVERY)
    }

    /// The time that it may take, if it has taken more without a word.
    pub fn broken(&self) -> Option<Duration> {
        let silent = self.clock()?.checked_sub(self.heard?)?;
        (!self.is_long && silent > self.most).then_some(self.most)
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
        // This process has taken some time.
        let own = std::process::id() as libc::pid_t;
        while Silence::new(own, Duration::ZERO).clock() == Some(Duration::ZERO) {}
        let mut silence = Silence::new(own, Duration::ZERO);
        // One that never says anything is quiet, not stuck.
        assert_eq!(silence.broken(), None);
        silence.heard(b"Delaunizing vertices...\n");
        silence.heard = Some(Duration::ZERO);
        assert_eq!(silence.broken(), Some(Duration::ZERO));
        silence.heard(b"Constrained Delaunay...\nRefining m");
        silence.heard = Some(Duration::ZERO);
        assert!(silence.broken().is_some());
        silence.heard(b"esh...\n");
        silence.heard = Some(Duration::ZERO);
        assert_eq!(silence.broken(), None);
    }
}
