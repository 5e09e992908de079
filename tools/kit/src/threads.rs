//! How many threads to use where nobody says.

/// Threads that pay at most.
const MOST: usize = 16;

/// Threads that the machine runs at once, up to 16.
pub fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, |n| n.get().min(MOST))
}
