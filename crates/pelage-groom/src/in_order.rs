//! Chunks made by several threads and taken in order.
//!
//! Memory is a fixed number of chunks and each thread's scratch, whatever the number of
//! chunks. The threads draw chunk numbers in order and only when they hold an empty
//! chunk, so the one that is waited for always has one and nothing can lock up.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, mpsc};

/// Hairs cut into chunks whose ends are multiples of one number, but for the first start
/// and the last end: roots are drawn fastest in aligned blocks.
#[derive(Clone, Debug)]
pub(crate) struct Chunks {
    hairs: Range<u64>,
    each: u64,
}

impl Chunks {
    /// Cuts `hairs` into chunks of `each`, at least 1.
    pub(crate) fn new(hairs: Range<u64>, each: u64) -> Self {
        Self { hairs, each }
    }

    pub(crate) fn count(&self) -> u64 {
        match self.hairs.is_empty() {
            true => 0,
            false => (self.hairs.end - 1) / self.each - self.hairs.start / self.each + 1,
        }
    }

    /// The hairs of chunk `number`, which is less than [`count`](Self::count).
    pub(crate) fn get(&self, number: u64) -> Range<u64> {
        let start = (self.hairs.start / self.each + number) * self.each;
        start.max(self.hairs.start)..start.saturating_add(self.each).min(self.hairs.end)
    }
}

/// Makes chunks 0 to `chunks` - 1 on `threads` threads, or as many as the system gives, each
/// with a worker of its own, and hands them to `take` on this thread, in order, until it fails.
pub(crate) fn in_order<W: Default, C: Default + Send, E>(
    chunks: u64,
    threads: usize,
    make: impl Fn(&mut W, u64, &mut C) + Sync,
    mut take: impl FnMut(u64, &C) -> Result<(), E>,
) -> Result<(), E> {
    // More would have nothing to do.
    let threads = (threads as u64).min(chunks) as usize;
    if threads > 1
        && let Some(taken) = together(chunks, threads, &make, &mut take)
    {
        return taken;
    }
    let (mut worker, mut chunk) = (W::default(), C::default());
    for number in 0..chunks {
        make(&mut worker, number, &mut chunk);
        take(number, &chunk)?;
    }
    Ok(())
}

/// The same on two threads and more; `None` where the system gives none.
fn together<W: Default, C: Default + Send, E>(
    chunks: u64,
    threads: usize,
    make: &(impl Fn(&mut W, u64, &mut C) + Sync),
    take: &mut impl FnMut(u64, &C) -> Result<(), E>,
) -> Option<Result<(), E>> {
    let next = AtomicU64::new(0);
    let (give_empty, take_empty) = mpsc::channel::<C>();
    let (give_full, take_full) = mpsc::channel::<(u64, C)>();
    let take_empty = Mutex::new(take_empty);
    std::thread::scope(|scope| {
        let spawn = |_: &usize| {
            let give_full = give_full.clone();
            let (next, take_empty) = (&next, &take_empty);
            let work = move || {
                let mut worker = W::default();
                loop {
                    // A poisoned lock means that another thread panicked; stop too.
                    let Ok(waiting) = take_empty.lock() else {
                        return;
                    };
                    let Ok(mut chunk) = waiting.recv() else {
                        return;
                    };
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    drop(waiting);
                    if number >= chunks {
                        return;
                    }
                    make(&mut worker, number, &mut chunk);
                    if give_full.send((number, chunk)).is_err() {
                        return;
                    }
                }
            };
            std::thread::Builder::new()
                .spawn_scoped(scope, work)
                .is_ok()
        };
        let threads = (0..threads).take_while(spawn).count();
        if threads == 0 {
            return None;
        }
        // One chunk a thread in the making and one waiting to be taken.
        for _ in 0..2 * threads {
            // The receiver lives until the end of this function.
            let _ = give_empty.send(C::default());
        }
        drop(give_full);
        // Dropping `give_empty` and `take_full` on the way out, in success or failure,
        // is what ends the threads.
        let (give_empty, take_full) = (give_empty, take_full);
        let mut early = BTreeMap::new();
        let mut wanted = 0;
        while wanted < chunks {
            let Ok((number, chunk)) = take_full.recv() else {
                break;
            };
            early.insert(number, chunk);
            while let Some(chunk) = early.remove(&wanted) {
                if let Err(error) = take(wanted, &chunk) {
                    return Some(Err(error));
                }
                wanted += 1;
                let _ = give_empty.send(chunk);
            }
        }
        Some(Ok(()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_come_in_order_from_any_number_of_threads() {
        for threads in [0, 1, 2, 5, usize::MAX] {
            for chunks in [0, 1, 3, 40] {
                let make = |(): &mut (), number, chunk: &mut u64| *chunk = number * number;
                let mut taken = Vec::new();
                let take = |number, chunk: &u64| {
                    taken.push((number, *chunk));
                    Ok::<(), ()>(())
                };
                assert_eq!(in_order(chunks, threads, make, take), Ok(()));
                let expected: Vec<_> = (0..chunks).map(|n| (n, n * n)).collect();
                assert_eq!(taken, expected, "{threads} threads");
            }
        }
    }

    #[test]
    fn chunks_are_aligned_and_cover_the_hairs_once() {
        const EACH: u64 = 1 << 16;
        for hairs in [
            0..1,
            0..EACH,
            5..3 * EACH + 7,
            EACH..EACH,
            u64::MAX - 3..u64::MAX,
        ] {
            let chunks = Chunks::new(hairs.clone(), EACH);
            let mut next = hairs.start;
            for number in 0..chunks.count() {
                let chunk = chunks.get(number);
                assert_eq!(chunk.start, next);
                assert!(chunk.end > chunk.start && chunk.end - chunk.start <= EACH);
                next = chunk.end;
                assert!(next == hairs.end || next % EACH == 0);
            }
            assert_eq!(next, hairs.end);
        }
    }
}
