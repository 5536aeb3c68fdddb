//! Systems shared by the tests.
#![allow(dead_code, reason = "each test file uses some of them")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::{
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

use hammerbeam_attractor::InOrder;
use hammerbeam_motion::{LocalElement, System};
use hammerbeam_testkit::systems::{force, forced};
#[allow(unused_imports, reason = "the benches use some of them")]
pub use hammerbeam_testkit::{
    extensive,
    laws::hertz,
    structures::modes as model,
    systems::{element, modal_beam as paper_beam, modal_beam_with as beam_with},
};

/// A mass of 1 kg on a spring of `stiffness` with damping `damping`, driven by `amplitude cos(W t)`, with
/// elements that act on it.
pub fn oscillator(stiffness: f64, damping: f64, amplitude: f64, elements: Vec<LocalElement>) -> System {
    let model = model(&[stiffness.sqrt()], faer::mat![[damping]]);
    System::new(model, &forced(vec![force(&[1.0], 1, amplitude, 0.0)]), elements).unwrap()
}

/// Work on so many threads.
#[derive(Debug, Clone, Copy)]
pub struct Threads {
    pub count: usize,
    /// Whether it is stopped before anything is done.
    pub is_stopped: bool,
}

impl Threads {
    pub fn of(count: usize) -> Self {
        Self { count, is_stopped: false }
    }
}

impl InOrder for Threads {
    fn in_order<T: Sync, W, R: Send>(
        &mut self,
        items: &[T],
        make: &(dyn Fn() -> W + Sync),
        work: &(dyn Fn(&mut W, &T) -> R + Sync),
    ) -> Option<Vec<R>> {
        let next = AtomicUsize::new(if self.is_stopped { items.len() } else { 0 });
        let results: Mutex<Vec<Option<R>>> = Mutex::new(items.iter().map(|_| None).collect());
        thread::scope(|scope| {
            for _ in 0..self.count {
                scope.spawn(|| {
                    let mut worker = make();
                    loop {
                        let index = next.fetch_add(1, Ordering::Relaxed);
                        let Some(item) = items.get(index) else { break };
                        let result = work(&mut worker, item);
                        results.lock().unwrap()[index] = Some(result);
                    }
                });
            }
        });
        results.into_inner().unwrap().into_iter().collect()
    }
}
