//! Work on many threads whose results do not depend on how many there are.

use std::{
    sync::{
        Mutex,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    thread,
};

/// Does the same work for every item, on so many threads; results are in the order of the items.
///
/// * `make`: makes what a thread works with. What it holds must not change results from one item to the next.
/// * `stop`: looked at before every item.
///
/// # Returns
/// `None` if it was stopped before all was done.
pub fn in_order<T: Sync, W, R: Send>(
    items: &[T],
    threads: usize,
    stop: &AtomicBool,
    make: impl Fn() -> W + Sync,
    work: impl Fn(&mut W, &T) -> R + Sync,
) -> Option<Vec<R>> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<Option<R>>> = Mutex::new(items.iter().map(|_| None).collect());
    thread::scope(|scope| {
        for _ in 0..threads.clamp(1, items.len().max(1)) {
            scope.spawn(|| {
                let mut worker = make();
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= items.len() || stop.load(Ordering::Relaxed) {
                        break;
                    }
                    let result = work(&mut worker, &items[index]);
                    results.lock().expect("no thread panics while it holds the results")[index] =
                        Some(result);
                }
            });
        }
    });
    results.into_inner().expect("no thread panics while it holds the results").into_iter().collect()
}
