//! How many threads a tool may use, and work shared between them.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Threads that pay at most.
const MOST: usize = 16;

/// The option of tools that use threads.
#[derive(clap::Args, Clone, Debug)]
pub struct ThreadArgs {
    /// Threads used at most, which makes no difference to the result [default: as many as the machine runs at
    /// once, up to 16]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=256))]
    threads: Option<u32>,
}

impl ThreadArgs {
    /// How many.
    pub fn count(&self) -> usize {
        self.threads.map_or_else(available_threads, |n| n as usize)
    }
}

/// Threads that the machine runs at once, up to 16.
pub fn available_threads() -> usize {
    thread::available_parallelism().map_or(1, |n| n.get().min(MOST))
}

/// What `work` makes of each item, in their order, of up to `threads` items at the same time. Where no thread is to
/// be had, it goes without.
pub fn in_parallel<A: Sync, T: Send>(
    items: &[A],
    threads: usize,
    work: impl Fn(&A) -> T + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let share = || {
        let mut done = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            match items.get(place) {
                Some(item) => done.push((place, work(item))),
                None => return done,
            }
        }
    };
    let mut done = thread::scope(|scope| {
        let others: Vec<_> = (1..threads.min(items.len()))
            .map_while(|_| thread::Builder::new().spawn_scoped(scope, share).ok())
            .collect();
        let mut done = share();
        for other in others {
            done.extend(other.join().unwrap_or_else(|e| resume_unwind(e)));
        }
        done
    });
    done.sort_unstable_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, made)| made).collect()
}

/// What two pieces of work make, at the same time if there may be more threads than one and another one is to be had.
pub fn both<A: Send, B>(
    threads: usize,
    first: impl Fn() -> A + Sync,
    second: impl FnOnce() -> B,
) -> (A, B) {
    thread::scope(|scope| {
        let other = (threads > 1)
            .then(|| thread::Builder::new().spawn_scoped(scope, &first).ok())
            .flatten();
        match other {
            Some(other) => {
                let b = second();
                (other.join().unwrap_or_else(|e| resume_unwind(e)), b)
            }
            None => (first(), second()),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_keep_their_order() {
        let items: Vec<u32> = (0..370).collect();
        let squares: Vec<u32> = items.iter().map(|i| i * i).collect();
        for threads in [0, 1, 2, 3, 50] {
            assert_eq!(in_parallel(&items, threads, |i| i * i), squares);
        }
        assert!(in_parallel(&items[..0], 4, |i| *i).is_empty());
    }

    #[test]
    fn both_are_done() {
        for threads in [0, 1, 2] {
            assert_eq!(both(threads, || 2 * 21, || "other"), (42, "other"));
        }
    }

    #[test]
    #[should_panic(expected = "item 3")]
    fn a_panic_is_passed_on() {
        in_parallel(&[1, 2, 3], 2, |i| assert!(*i != 3, "item {i}"));
    }
}
