//! A limit on the memory that reading an input may take.

use cap::Cap;
use std::alloc::System;
use std::panic;
use std::sync::Once;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// What reading may take whatever the input: first buffers, tables of the libraries used.
const FIXED: usize = 8 << 20;
/// And per byte of the input: far above what any reader needs, far below what a count that is
/// believed would take.
const PER_BYTE: usize = 2000;

/// Runs `work` on an input of `length` bytes, within the memory allowed; the process aborts at the
/// allocation that exceeds it.
pub fn limited<T>(length: usize, work: impl FnOnce() -> T) -> T {
    static HOOK: Once = Once::new();
    // What a panic prints takes memory that the input is not to blame for.
    HOOK.call_once(|| {
        let print_and_abort = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            lift();
            print_and_abort(info);
        }));
    });
    let allowed = ALLOCATOR.allocated() + FIXED + PER_BYTE * length;
    ALLOCATOR
        .set_limit(allowed)
        .expect("it is above what is allocated");
    let result = work();
    lift();
    result
}

fn lift() {
    ALLOCATOR.set_limit(usize::MAX).expect("it is no limit");
}
