//! Several workers at the same time.

use std::io;

/// Runs as many workers as there are jobs, one at least, to their ends; the first one that fails says why.
///
/// # Errors
/// What a worker could not read or write.
pub fn run(jobs: usize, worker: impl Fn() -> io::Result<()> + Sync) -> io::Result<()> {
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs.max(1)).map(|_| scope.spawn(&worker)).collect();
        let mut ends = workers
            .into_iter()
            .map(|w| w.join().expect("workers do not panic"));
        ends.try_for_each(|end| end)
    })
}
