//! Independent pieces of work, several at a time.

use std::ops::Range;
use std::panic::resume_unwind;
use std::thread;

/// Splits a range into `parts` consecutive ones, does the `work` on them at the same time, and returns what comes
/// of it in their order.
pub fn in_parts<T: Send>(
    range: Range<usize>,
    parts: usize,
    work: impl Fn(Range<usize>) -> T + Sync,
) -> Vec<T> {
    if parts < 2 {
        return vec![work(range)];
    }
    let step = range.len().div_ceil(parts);
    let part = |p: usize| {
        let [first, end] = [p, p + 1].map(|p| (range.start + p * step).min(range.end));
        first..end
    };
    thread::scope(|scope| {
        let work = &work;
        let others: Vec<_> = (1..parts)
            .map(|p| {
                let part = part(p);
                thread::Builder::new().spawn_scoped(scope, move || work(part))
            })
            .collect();
        let mut all = vec![work(part(0))];
        for (p, other) in (1..parts).zip(others) {
            all.push(match other {
                Ok(other) => other.join().unwrap_or_else(|e| resume_unwind(e)),
                // Where no thread is to be had, it goes without.
                Err(_) => work(part(p)),
            });
        }
        all
    })
}

/// What `work` makes of each item, in their order.
pub fn map<A: Sync, T: Send>(items: &[A], threads: usize, work: impl Fn(&A) -> T + Sync) -> Vec<T> {
    let parts = threads.min(items.len());
    let of_part = |part: Range<usize>| items[part].iter().map(&work).collect::<Vec<T>>();
    let parts = in_parts(0..items.len(), parts, of_part);
    parts.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_a_range_in_order() {
        for (range, parts) in [(3..20, 1), (3..20, 4), (5..7, 4), (0..0, 3), (0..64, 64)] {
            let found = in_parts(range.clone(), parts, |part| part.collect::<Vec<usize>>());
            assert_eq!(found.len(), parts);
            assert_eq!(found.concat(), range.collect::<Vec<usize>>());
        }
    }

    #[test]
    fn items_keep_their_order() {
        let items: Vec<u32> = (0..37).collect();
        let squares: Vec<u32> = items.iter().map(|i| i * i).collect();
        for threads in [1, 2, 3, 50] {
            assert_eq!(map(&items, threads, |i| i * i), squares);
        }
        assert!(map(&items[..0], 4, |i| *i).is_empty());
    }
}
