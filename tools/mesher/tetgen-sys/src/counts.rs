//! How far refinement is: counts in memory that the child shares with us.

use crate::Error;
use crate::ffi::SharedCounts;
use std::ptr::NonNull;
use std::sync::atomic::{AtomicU64, Ordering};

/// How far refinement is. Both numbers only grow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Tetrahedra within the bounds on volumes that were checked so far, among them those that were replaced later.
    pub checked: u64,
    /// Points that these have, estimated from a share of them.
    pub points: u64,
}

/// Memory of our own and of children forked later, zeros at first.
#[derive(Debug)]
pub(crate) struct Counters(NonNull<SharedCounts>);

// SAFETY: it is only read, by atomic operations.
unsafe impl Send for Counters {}

impl Counters {
    pub(crate) fn new() -> Result<Self, Error> {
        // SAFETY: a fresh mapping chosen by the kernel; failure is checked below.
        let begin = unsafe {
            libc::mmap(
                std::ptr::null_mut(),
                size_of::<SharedCounts>(),
                libc::PROT_READ | libc::PROT_WRITE,
                libc::MAP_SHARED | libc::MAP_ANONYMOUS,
                -1,
                0,
            )
        };
        match NonNull::new(begin.cast()) {
            Some(counts) if begin != libc::MAP_FAILED => Ok(Self(counts)),
            _ => Err(Error::system("sharing memory")),
        }
    }

    pub(crate) fn as_ptr(&self) -> *const SharedCounts {
        self.0.as_ptr()
    }

    pub(crate) fn read(&self) -> Counts {
        // SAFETY: the mapping is page-aligned, as long as the structure, never zero-sized, and lives as long as `self`.
        let shared = unsafe { self.0.as_ref() };
        let now = |count: &AtomicU64| count.load(Ordering::Relaxed);
        Counts {
            checked: now(&shared.tetrahedra),
            points: now(&shared.points),
        }
    }
}

impl Drop for Counters {
    fn drop(&mut self) {
        // SAFETY: unmaps exactly what `new` mapped; no reference outlives `read`.
        unsafe {
            libc::munmap(self.0.as_ptr().cast(), size_of::<SharedCounts>());
        }
    }
}
