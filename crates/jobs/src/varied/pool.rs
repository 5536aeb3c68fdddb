//! Pieces on many threads, each done by one at a time; what they give is stored as soon as it is there.

use std::sync::{
    atomic::{AtomicBool, Ordering},
    mpsc,
};

use hammerbeam_results::store::{Store, StoreError};

use super::{
    piece::{PieceTask, PieceWork},
    solver::PieceSolver,
    watch::{News, PieceNews, Watch},
};
use crate::{
    Observer, VariedProgress,
    pool::{PATIENCE, with_pool},
};

/// Computes what is left of the pieces and stores it; whether all are finished, or the observer said stop.
///
/// * `finished`: pieces of the study that an earlier run has finished.
pub(super) fn compute_all<'w>(
    store: &mut Store,
    (pieces, finished): (&mut [PieceWork<'w>], usize),
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<bool, StoreError> {
    let stop = AtomicBool::new(false);
    let stop = &stop;
    let names: Vec<String> = pieces.iter().map(|piece| piece.record.parameter.clone()).collect();
    with_pool(threads.min(names.len()), |pool| {
        let (sender, news) = mpsc::channel();
        let mut desk = Desk {
            names: &names,
            fractions: vec![0.0; names.len()],
            finished,
            done: 0,
            solutions: 0,
            busy: 0,
            most: pool.threads().max(1),
        };
        let hand = |(piece, solver, task): Handed<'w>| {
            let sender = sender.clone();
            pool.hand(move || PieceWork::work(solver, &task, &Watch { piece, stop, news: &sender }));
        };
        let result = loop {
            if observer.interrupted() {
                stop.store(true, Ordering::Relaxed);
            }
            if !stop.load(Ordering::Relaxed)
                && let Err(error) = desk.hand_out(store, pieces, &hand)
            {
                break Err(error);
            }
            if desk.busy == 0 {
                break Ok(desk.done == names.len());
            }
            match news.recv_timeout(PATIENCE) {
                Ok(news) => {
                    if let Err(error) = desk.take(store, pieces, news, observer) {
                        break Err(error);
                    }
                }
                Err(_) => assert!(!pool.has_panicked(), "a thread has panicked"),
            }
        };
        // Threads that still work do so for nothing.
        stop.store(true, Ordering::Relaxed);
        result
    })
}

/// A piece by its number, and what a thread is to do of it.
type Handed<'w> = (usize, &'w dyn PieceSolver, PieceTask);

/// What is done of each piece.
struct Desk<'a> {
    names: &'a [String],
    fractions: Vec<f64>,
    /// Pieces that an earlier run has finished, and those of this one.
    finished: usize,
    done: usize,
    solutions: u64,
    /// Threads that have a task, and how many there are.
    busy: usize,
    most: usize,
}

impl<'a> Desk<'a> {
    /// Hands out tasks of the pieces that nobody is at, in their order, as long as threads are idle.
    fn hand_out<'w>(
        &mut self,
        store: &mut Store,
        pieces: &mut [PieceWork<'w>],
        hand: &dyn Fn(Handed<'w>),
    ) -> Result<(), StoreError> {
        for (number, piece) in pieces.iter_mut().enumerate() {
            if self.busy == self.most {
                break;
            }
            if piece.is_running {
                continue;
            }
            if let (Some(task), Ok(solver)) = (piece.next_task(store)?, &piece.solver) {
                piece.is_running = true;
                self.busy += 1;
                hand((number, *solver, task));
            } else {
                self.fractions[number] = 1.0;
            }
        }
        self.done = pieces.iter().filter(|piece| piece.record.finished).count();
        Ok(())
    }

    /// Takes what a thread reports.
    fn take(
        &mut self,
        store: &mut Store,
        pieces: &mut [PieceWork<'_>],
        News { piece, what }: News,
        observer: &mut dyn Observer,
    ) -> Result<(), StoreError> {
        if let PieceNews::Row { value, frequency_hz, fraction } = what {
            self.note(piece, fraction);
            observer.varied(&self.progress(piece, value, frequency_hz));
            return Ok(());
        }
        pieces[piece].take(store, what)?;
        self.busy -= usize::from(!pieces[piece].is_running);
        Ok(())
    }

    fn note(&mut self, piece: usize, fraction: f64) {
        self.fractions[piece] = self.fractions[piece].max(fraction.clamp(0.0, 1.0));
        self.solutions += 1;
    }

    fn progress(&self, piece: usize, value: f64, frequency_hz: f64) -> VariedProgress<'a> {
        VariedProgress {
            parameter: &self.names[piece],
            value,
            frequency_hz,
            pieces_done: self.done,
            pieces: self.names.len(),
            new_solutions: self.solutions,
            fraction: (self.finished as f64 + self.fractions.iter().sum::<f64>())
                / (self.finished + self.names.len()).max(1) as f64,
        }
    }
}

#[cfg(test)]
mod tests;
