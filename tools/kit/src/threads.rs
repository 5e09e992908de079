//! How many threads a tool may use, and work shared between them.

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Most threads that a tool takes unasked. The stages that share work between threads (checking orders, meshing
/// templates, improving elements) have from a few to some hundred pieces of it: with more threads than this the
/// longest piece decides, and each thread costs a stack. `--threads` goes beyond.
const MOST_UNASKED: usize = 16;

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
    std::thread::available_parallelism().map_or(1, |n| n.get().min(MOST_UNASKED))
}

/// What `work` makes of each item, in the order of the items, up to `threads` of them at the same time.
///
/// Work that itself calls [`in_parallel`] or [`both`] shares the threads of the outermost call, so that its
/// `threads` bounds all of them. Where the system grants no threads, the items are worked on one after another.
pub fn in_parallel<A: Sync, T: Send>(
    items: &[A],
    threads: usize,
    work: impl Fn(&A) -> T + Sync,
) -> Vec<T> {
    // Items are few and take long: each may go to another thread.
    let shared = || items.par_iter().with_max_len(1).map(&work).collect();
    match Threads::for_pieces(items.len(), threads) {
        Threads::Current => items.iter().map(&work).collect(),
        Threads::Shared => shared(),
        Threads::New(pool) => pool.install(shared),
    }
}

/// What two pieces of work make, at the same time where `threads` allows; see [`in_parallel`].
pub fn both<A: Send, B: Send>(
    threads: usize,
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    match Threads::for_pieces(2, threads) {
        Threads::Current => (first(), second()),
        Threads::Shared => rayon::join(first, second),
        Threads::New(pool) => pool.install(|| rayon::join(first, second)),
    }
}

/// Where pieces of work are done.
enum Threads {
    /// One after another in the calling thread.
    Current,
    /// By the threads of the pool that the calling thread belongs to.
    Shared,
    /// By a pool of its own, which ends with the work.
    New(ThreadPool),
}

impl Threads {
    fn for_pieces(pieces: usize, most: usize) -> Self {
        let count = most.min(pieces);
        if count <= 1 {
            return Self::Current;
        }
        if rayon::current_thread_index().is_some() {
            return Self::Shared;
        }
        let pool = ThreadPoolBuilder::new().num_threads(count).build();
        pool.map_or(Self::Current, Self::New)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::sync::Mutex;
    use std::thread;

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
    fn work_within_work_takes_no_further_threads() {
        let seen = Mutex::new(BTreeSet::new());
        let note = |_: &u32| {
            let id = format!("{:?}", thread::current().id());
            seen.lock().unwrap().insert(id);
        };
        let items: Vec<u32> = (0..40).collect();
        in_parallel(&items, 2, |_| {
            both(8, || note(&0), || note(&1));
            in_parallel(&items, 8, note);
        });
        assert!(seen.into_inner().unwrap().len() <= 2);
    }

    #[test]
    #[should_panic(expected = "item 3")]
    fn a_panic_is_passed_on() {
        in_parallel(&[1, 2, 3], 2, |i| assert!(*i != 3, "item {i}"));
    }
}
