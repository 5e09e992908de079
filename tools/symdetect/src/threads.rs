//! Work shared between threads. No result depends on how many there are.

use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

/// Does the work with up to so many threads for [`map`] and [`both`] inside of it. Where none can be started, the
/// calling thread does it alone; inside of other such work, that one's threads do it.
pub fn with<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let inside = rayon::current_thread_index().is_some();
    let pool =
        (threads > 1 && !inside).then(|| ThreadPoolBuilder::new().num_threads(threads).build());
    match pool {
        Some(Ok(pool)) => pool.install(work),
        _ => work(),
    }
}

/// What `work` makes of each item, in their order.
pub fn map<A: Sync, T: Send>(items: &[A], work: impl Fn(&A) -> T + Sync + Send) -> Vec<T> {
    match rayon::current_thread_index() {
        Some(_) => items.par_iter().map(work).collect(),
        None => items.iter().map(work).collect(),
    }
}

/// What two pieces of work make.
pub fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    match rayon::current_thread_index() {
        Some(_) => rayon::join(first, second),
        None => (first(), second()),
    }
}
