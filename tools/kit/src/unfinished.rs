//! Files that are being written, and what becomes of them when a signal ends the process: they are
//! removed, as they are when the tool fails.

use std::io;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tempfile::{NamedTempFile, TempPath};

/// Temporary files that do not have their final name yet. The lock is held while one is made, renamed or removed.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a temporary file that is removed when a signal ends the process.
pub fn create(make: impl FnOnce() -> io::Result<NamedTempFile>) -> io::Result<NamedTempFile> {
    let mut list = unfinished();
    let file = make()?;
    list.push(file.path().to_owned());
    Ok(file)
}

/// Gives a file its name.
pub fn persist(file: TempPath, path: PathBuf) -> io::Result<()> {
    let mut list = unfinished();
    list.retain(|p| *p != *file);
    file.persist(path).map_err(|e| e.error)
}

/// Sees to it that signals that ask the process to end remove its unfinished files first, and that
/// a write past the limit on file sizes fails like one to a full disk.
///
/// Signals that the process was started to ignore stay ignored. Where the system grants no thread or
/// pipe, signals end the process as if this had not been called, and its temporary files stay.
#[cfg(unix)]
pub fn remove_on_signals() {
    use signal_hook::consts::signal::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    let ignored = ignored();
    let ends = [SIGHUP, SIGINT, SIGTERM];
    let Ok(mut signals) = Signals::new(ends.into_iter().filter(|s| ignored & (1 << (s - 1)) == 0))
    else {
        return;
    };
    let wait = move || {
        if let Some(signal) = signals.forever().next() {
            // The lock is held until the process ends, so that no file gets its final name after this.
            let list = unfinished();
            for path in list.iter() {
                let _ = std::fs::remove_file(path);
            }
            let _ = emulate_default_handler(signal);
        }
    };
    let _ = std::thread::Builder::new()
        .name("signals".to_owned())
        .spawn(wait);
}

/// Signals that are ignored, a bit each from signal 1 on; none where the system does not say.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    mask.and_then(|m| u64::from_str_radix(m.trim(), 16).ok())
        .unwrap_or(0)
}
