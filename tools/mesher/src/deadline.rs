//! The time limit that all attempts at one template share.

use std::time::{Duration, Instant};

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deadline {
    end: Option<Instant>,
    whole: Option<Duration>,
}

impl Deadline {
    /// A limit that begins now; none without a duration, or if that ends after the clock does.
    pub fn start(limit: Option<Duration>) -> Self {
        Self {
            end: limit.and_then(|limit| Instant::now().checked_add(limit)),
            whole: limit,
        }
    }

    /// What is left; `None` without a limit.
    pub fn left(&self) -> Option<Duration> {
        let end = self.end?;
        Some(end.saturating_duration_since(Instant::now()))
    }

    /// Whether nothing is left.
    pub fn is_over(&self) -> bool {
        self.left().is_some_and(|left| left.is_zero())
    }

    /// The whole limit, as the user gave it.
    pub fn whole(&self) -> Option<Duration> {
        self.whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attempts_share_the_time_limit() {
        let none = Deadline::start(None);
        assert!(!none.is_over() && none.left().is_none());
        let hour = Duration::from_secs(3600);
        let long = Deadline::start(Some(hour));
        let short = Deadline::start(Some(Duration::from_millis(1)));
        std::thread::sleep(Duration::from_millis(2));
        assert!(long.left().is_some_and(|left| left < hour) && !long.is_over());
        assert!(short.is_over());
        assert_eq!(long.whole(), Some(hour));
        // Longer than the clock runs is as good as none.
        assert!(!Deadline::start(Some(Duration::MAX)).is_over());
    }
}
