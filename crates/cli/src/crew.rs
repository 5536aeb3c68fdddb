//! Work on several threads that gives the same with any number of them.
//!
//! Work is handed over piece by piece and begun in that order; what comes of a piece is asked for by whoever
//! handed it over, in whatever order that one likes. The thread that hands over works as well: while it
//! waits, and where more is waiting than the others can begin with. So a crew of one has no other thread, and
//! what waits takes little memory.

use std::{
    collections::VecDeque,
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, mpsc},
    thread::{Builder, JoinHandle},
};

/// Pieces of work that may wait for each thread besides the one that hands them over.
const WAITING: usize = 2;

type Work = Box<dyn FnOnce() + Send>;

/// Threads, and the work that waits for them.
pub struct Crew {
    bench: Arc<Bench>,
    others: Vec<JoinHandle<()>>,
}

/// What will come of a piece of work.
pub struct Pending<T>(mpsc::Receiver<T>);

#[derive(Default)]
struct Bench {
    queue: Mutex<Queue>,
    /// Something was put into the queue, or the crew is sent home.
    changed: Condvar,
}

#[derive(Default)]
struct Queue {
    waiting: VecDeque<Work>,
    is_over: bool,
}

impl Crew {
    /// So many threads, at least one: that of the caller.
    pub fn of(threads: usize) -> Self {
        let bench = Arc::new(Bench::default());
        let other = |_| {
            let bench = Arc::clone(&bench);
            // Where the machine gives no more threads, those that there are do.
            Builder::new().spawn(move || bench.serve()).ok()
        };
        let others = (1..threads).filter_map(other).collect();
        Self { bench, others }
    }

    /// Threads, that of the caller among them.
    pub fn threads(&self) -> usize {
        self.others.len() + 1
    }

    /// Hands over a piece of work.
    pub fn hand<T: Send + 'static>(&self, work: impl FnOnce() -> T + Send + 'static) -> Pending<T> {
        let (sender, receiver) = mpsc::channel();
        let work = Box::new(move || {
            // Nobody may ask for it any more.
            let _ = sender.send(work());
        });
        self.bench.queue().waiting.push_back(work);
        self.bench.changed.notify_one();
        while let Some(work) = self.bench.beyond(WAITING * self.others.len()) {
            work();
        }
        Pending(receiver)
    }

    /// What came of a piece of work; until then this thread does some of what waits.
    pub fn wait<T>(&self, pending: &Pending<T>) -> T {
        loop {
            if let Ok(found) = pending.0.try_recv() {
                return found;
            }
            match self.bench.beyond(0) {
                Some(work) => work(),
                // Then it was begun by another thread.
                None => return pending.0.recv().expect("a piece of work gives something unless it panics"),
            }
        }
    }
}

/// What waits is not begun any more, what was begun is finished.
impl Drop for Crew {
    fn drop(&mut self) {
        let mut queue = self.bench.queue();
        queue.is_over = true;
        queue.waiting.clear();
        drop(queue);
        self.bench.changed.notify_all();
        for other in self.others.drain(..) {
            // One that panicked has said so.
            let _ = other.join();
        }
    }
}

impl Bench {
    fn queue(&self) -> MutexGuard<'_, Queue> {
        // No work is done while the queue is locked, so that it is whole whatever panics.
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The first piece that waits, if more than so many do.
    fn beyond(&self, most: usize) -> Option<Work> {
        let mut queue = self.queue();
        if queue.waiting.len() > most { queue.waiting.pop_front() } else { None }
    }

    fn serve(&self) {
        while let Some(work) = self.next() {
            work();
        }
    }

    /// The next piece, waited for; none once the crew is sent home.
    fn next(&self) -> Option<Work> {
        let is_idle = |queue: &mut Queue| queue.waiting.is_empty() && !queue.is_over;
        let queue = self.changed.wait_while(self.queue(), is_idle);
        queue.unwrap_or_else(PoisonError::into_inner).waiting.pop_front()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{
        Barrier,
        atomic::{AtomicUsize, Ordering},
    };

    use super::*;

    #[test]
    fn everything_is_done_once_and_given_to_whoever_handed_it_over() {
        for threads in [1, 2, 5] {
            let crew = Crew::of(threads);
            assert_eq!(crew.threads(), threads);
            let done = Arc::new(AtomicUsize::new(0));
            let piece = |k: usize| {
                let done = Arc::clone(&done);
                crew.hand(move || {
                    done.fetch_add(1, Ordering::Relaxed);
                    k * k
                })
            };
            let pending: Vec<Pending<usize>> = (0..200).map(piece).collect();
            let backwards: Vec<usize> = pending.iter().rev().map(|one| crew.wait(one)).collect();
            assert!(backwards.into_iter().eq((0..200).rev().map(|k| k * k)), "{threads} threads");
            assert_eq!(done.load(Ordering::Relaxed), 200);
        }
    }

    /// Three pieces that wait for one another end only if three threads are at work at once, the caller's
    /// among them.
    #[test]
    fn threads_work_at_the_same_time() {
        let (crew, barrier) = (Crew::of(3), Arc::new(Barrier::new(3)));
        let piece = |_| {
            let barrier = Arc::clone(&barrier);
            crew.hand(move || barrier.wait().is_leader())
        };
        let pending: Vec<Pending<bool>> = (0..3).map(piece).collect();
        assert_eq!(pending.iter().filter(|one| crew.wait(one)).count(), 1);
    }

    #[test]
    fn a_crew_of_one_does_everything_at_once_and_in_order() {
        let (crew, order) = (Crew::of(1), Arc::new(Mutex::new(Vec::new())));
        for k in 0..5 {
            let order = Arc::clone(&order);
            crew.hand(move || order.lock().unwrap().push(k));
        }
        assert_eq!(*order.lock().unwrap(), [0, 1, 2, 3, 4]);
    }

    #[test]
    #[should_panic(expected = "unless it panics")]
    fn work_that_panics_is_not_waited_for_without_end() {
        let crew = Crew::of(2);
        let (begun, begins) = mpsc::channel();
        let pending = crew.hand(move || {
            begun.send(()).unwrap();
            panic!("as it should");
        });
        begins.recv().unwrap();
        crew.wait::<()>(&pending);
    }
}
