//! Pieces on many threads, each computed by one; what they give is stored as soon as it is there.

use std::sync::{
    atomic::{AtomicBool, Ordering},
    mpsc::{self, Sender},
};

use hammerbeam_results::store::StoreError;

use super::{Failed, Found, watch::Watch};
use crate::{
    Observer, VariedProgress,
    pool::{PATIENCE, with_pool},
};

/// What threads report.
pub(super) enum News {
    /// A new solution of a piece.
    Row { piece: usize, value: f64, frequency_hz: f64, fraction: f64 },
    /// A piece is done, or given up.
    Done { piece: usize, found: Result<Found, Failed> },
}

/// Computes so many pieces and hands each over when it is done; whether all were, or the observer said stop.
///
/// * `names`: the parameter of each piece.
/// * `compute`: computes the piece of a number; called on several threads at once.
/// * `store`: takes what came of the piece of a number, on this thread.
pub(super) fn compute_all(
    names: &[&str],
    threads: usize,
    observer: &mut dyn Observer,
    compute: impl Fn(usize, &Watch<'_>) -> Result<Found, Failed> + Sync,
    mut store: impl FnMut(usize, Result<Found, Failed>) -> Result<(), StoreError>,
) -> Result<bool, StoreError> {
    let stop = AtomicBool::new(false);
    let (stop, compute) = (&stop, &compute);
    let mut desk = Desk::new(names);
    with_pool(threads.min(names.len()), |pool| {
        let (sender, news) = mpsc::channel();
        let mut result = Ok(());
        let mut next = 0;
        let mut busy = 0;
        loop {
            if observer.interrupted() {
                stop.store(true, Ordering::Relaxed);
            }
            while busy < pool.threads().max(1) && next < names.len() && !stop.load(Ordering::Relaxed) {
                let (piece, sender) = (next, sender.clone());
                pool.hand(move || work(piece, stop, sender, compute));
                next += 1;
                busy += 1;
            }
            if busy == 0 {
                return result.map(|()| desk.all_done());
            }
            match news.recv_timeout(PATIENCE) {
                Ok(News::Row { piece, value, frequency_hz, fraction }) => {
                    desk.note(piece, fraction);
                    observer.varied(&desk.progress(piece, value, frequency_hz));
                }
                Ok(News::Done { piece, found }) => {
                    busy -= 1;
                    if result.is_ok() && !matches!(found, Err(Failed::Interrupted)) {
                        result = store(piece, found);
                        desk.done(piece);
                    }
                    if result.is_err() {
                        stop.store(true, Ordering::Relaxed);
                    }
                }
                Err(_) => assert!(!pool.has_panicked(), "a thread has panicked"),
            }
        }
    })
}

/// Computes a piece and reports what came of it.
fn work(
    piece: usize,
    stop: &AtomicBool,
    news: Sender<News>,
    compute: &(impl Fn(usize, &Watch<'_>) -> Result<Found, Failed> + Sync),
) {
    let found = compute(piece, &Watch { piece, stop, news: &news });
    // Nobody may wait for it any more.
    let _ = news.send(News::Done { piece, found });
}

/// What is done of each piece.
struct Desk<'a> {
    names: &'a [&'a str],
    fractions: Vec<f64>,
    done: usize,
    solutions: u64,
}

impl<'a> Desk<'a> {
    fn new(names: &'a [&'a str]) -> Self {
        Self { names, fractions: vec![0.0; names.len()], done: 0, solutions: 0 }
    }

    fn note(&mut self, piece: usize, fraction: f64) {
        self.fractions[piece] = self.fractions[piece].max(fraction.clamp(0.0, 1.0));
        self.solutions += 1;
    }

    fn done(&mut self, piece: usize) {
        self.fractions[piece] = 1.0;
        self.done += 1;
    }

    fn all_done(&self) -> bool {
        self.done == self.names.len()
    }

    fn progress(&self, piece: usize, value: f64, frequency_hz: f64) -> VariedProgress<'a> {
        VariedProgress {
            parameter: self.names[piece],
            value,
            frequency_hz,
            pieces_done: self.done,
            pieces: self.names.len(),
            new_solutions: self.solutions,
            fraction: self.fractions.iter().sum::<f64>() / self.names.len().max(1) as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::{sync::atomic::AtomicUsize, thread};

    use super::*;
    use crate::Quiet;

    fn nothing(message: String) -> Found {
        Found { branches: Vec::new(), message: Some(message) }
    }

    /// The first piece waits until the others are stored.
    #[test]
    fn a_piece_is_stored_when_it_is_done_however_it_ends() {
        let names = ["a", "b", "c", "d"];
        for threads in [1, 2, 7] {
            let stored = AtomicUsize::new(0);
            let compute = |piece: usize, _: &Watch<'_>| {
                while piece == 0 && threads > 1 && stored.load(Ordering::Relaxed) < 3 {
                    thread::yield_now();
                }
                if piece == 2 { Err(Failed::Message("none".into())) } else { Ok(nothing(piece.to_string())) }
            };
            let mut order = Vec::new();
            let store = |piece, found: Result<Found, Failed>| {
                order.push((piece, found.is_ok()));
                stored.fetch_add(1, Ordering::Relaxed);
                Ok(())
            };
            assert!(compute_all(&names, threads, &mut Quiet, compute, store).expect("nothing refuses"));
            if threads > 1 {
                assert_eq!(order.last(), Some(&(0, true)), "{threads} threads");
            }
            order.sort_unstable();
            assert_eq!(order, [(0, true), (1, true), (2, false), (3, true)], "{threads} threads");
        }
    }

    #[derive(Default)]
    struct Listener {
        told: Vec<(f64, u64)>,
        stops: bool,
    }

    impl Observer for Listener {
        fn varied(&mut self, progress: &VariedProgress<'_>) {
            assert!((0.0..=1.0).contains(&progress.fraction) && progress.pieces == 2);
            self.told.push((progress.fraction, progress.new_solutions));
        }

        fn interrupted(&mut self) -> bool {
            self.stops
        }
    }

    #[test]
    fn progress_grows_with_every_row() {
        let mut listener = Listener::default();
        let compute = |_: usize, watch: &Watch<'_>| {
            (0..4).for_each(|k| watch.row(1.0, 2.0, 0.25 * f64::from(k)));
            Ok(nothing(String::new()))
        };
        assert!(compute_all(&["a", "b"], 2, &mut listener, compute, |_, _| Ok(())).expect("no refusal"));
        assert_eq!(listener.told.len(), 8);
        assert!(listener.told.windows(2).all(|pair| pair[0].0 <= pair[1].0 && pair[0].1 < pair[1].1));
    }

    /// A piece that hears of the interruption is not stored.
    #[test]
    fn an_interruption_reaches_every_thread() {
        let mut listener = Listener { stops: true, ..Listener::default() };
        let compute = |_: usize, watch: &Watch<'_>| {
            while !watch.interrupted() {
                thread::yield_now();
            }
            Err(Failed::Interrupted)
        };
        let stored = compute_all(&["a", "b"], 2, &mut listener, compute, |piece, _| panic!("{piece}"));
        assert!(!stored.expect("nothing refuses"));
    }
}
