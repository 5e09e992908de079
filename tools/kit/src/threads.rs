//! How many threads a tool may use.

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
    std::thread::available_parallelism().map_or(1, |n| n.get().min(MOST))
}
