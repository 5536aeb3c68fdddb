//! The threads of a job: one pool, with the same results for any number of threads.
//!
//! Work is handed over piece by piece and started in that order. Whoever hands it over asks for the result of
//! a piece in whatever order it likes, and does not compute itself: so it can look at its observer at any
//! time. Few pieces wait, so that they take little memory.

use std::{
    collections::VecDeque,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
        mpsc::{self, RecvTimeoutError, Sender},
    },
    thread::{self, Builder},
    time::Duration,
};

use hammerbeam_attractor::InOrder;

use crate::Observer;

/// Time between two looks at an observer.
pub const PATIENCE: Duration = Duration::from_millis(50);
/// Pieces of work that may wait for each thread.
const WAITING: usize = 2;

type Work<'work> = Box<dyn FnOnce() + Send + 'work>;

/// Threads to work with: those asked for, else one for each core.
#[must_use]
pub fn threads(asked: Option<u16>) -> usize {
    asked.map_or_else(|| thread::available_parallelism().map_or(1, usize::from), usize::from)
}

/// Threads, and the work that waits for them.
///
/// Pieces may borrow what lives as long as `'work`, that is what was there before [`with_pool`].
#[derive(Default)]
pub struct Pool<'work> {
    queue: Mutex<Queue<'work>>,
    /// A piece was put into the queue or taken from it, or the pool is closed.
    changed: Condvar,
    threads: AtomicUsize,
    has_panicked: AtomicBool,
}

#[derive(Default)]
struct Queue<'work> {
    waiting: VecDeque<Work<'work>>,
    is_closed: bool,
}

/// The result of a piece of work, which may not be there yet.
#[derive(Debug)]
pub struct Pending<T>(mpsc::Receiver<T>);

/// Calls a function with so many threads, at least one. When it returns, pieces that wait are not started any
/// more, and those under way are finished.
pub fn with_pool<'work, R>(threads: usize, lead: impl FnOnce(&Pool<'work>) -> R) -> R {
    let pool = Pool::default();
    thread::scope(|scope| {
        let _closes = Closes(&pool);
        // Where the machine gives no more threads, those that there are do.
        let start = |_: &usize| Builder::new().spawn_scoped(scope, || pool.serve()).is_ok();
        let started = (0..threads.max(1)).filter(start).count();
        pool.threads.store(started, Ordering::Relaxed);
        lead(&pool)
    })
}

/// Closes a pool, however its function ends.
struct Closes<'a, 'work>(&'a Pool<'work>);

impl Drop for Closes<'_, '_> {
    fn drop(&mut self) {
        let mut queue = self.0.lock();
        queue.is_closed = true;
        queue.waiting.clear();
        drop(queue);
        self.0.changed.notify_all();
    }
}

impl<'work> Pool<'work> {
    /// Number of threads; 0 if the machine gives none, and then each piece is done when it is handed over.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.threads.load(Ordering::Relaxed)
    }

    /// Whether a piece of work has panicked.
    #[must_use]
    pub fn has_panicked(&self) -> bool {
        self.has_panicked.load(Ordering::Relaxed)
    }

    /// Hands over a piece of work; waits while enough others wait.
    pub fn hand<T: Send + 'work>(&self, work: impl FnOnce() -> T + Send + 'work) -> Pending<T> {
        let (sender, receiver) = mpsc::channel();
        self.put(Box::new(move || {
            // Nobody may ask for it any more.
            let _ = sender.send(work());
        }));
        Pending(receiver)
    }

    fn put(&self, work: Work<'work>) {
        let most = WAITING * self.threads();
        if most == 0 {
            return self.run(work);
        }
        let is_full = |queue: &mut Queue<'work>| queue.waiting.len() >= most;
        let queue = self.changed.wait_while(self.lock(), is_full);
        queue.unwrap_or_else(PoisonError::into_inner).waiting.push_back(work);
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Queue<'work>> {
        // No work is done while the queue is locked, so that it is whole whatever panics.
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn serve(&self) {
        while let Some(work) = self.next() {
            self.run(work);
        }
    }

    /// A panic has been reported on standard error; whoever waits for the piece learns of it.
    fn run(&self, work: Work<'work>) {
        if catch_unwind(AssertUnwindSafe(work)).is_err() {
            self.has_panicked.store(true, Ordering::Relaxed);
        }
    }

    /// The next piece, waited for; none once the pool is closed.
    fn next(&self) -> Option<Work<'work>> {
        let is_idle = |queue: &mut Queue<'work>| queue.waiting.is_empty() && !queue.is_closed;
        let queue = self.changed.wait_while(self.lock(), is_idle);
        let work = queue.unwrap_or_else(PoisonError::into_inner).waiting.pop_front();
        self.changed.notify_all();
        work
    }
}

impl<T> Pending<T> {
    /// The result, if it is there within a time.
    ///
    /// # Panics
    /// The piece of work has panicked, or was not started before its pool was closed.
    pub fn wait(&self, most: Duration) -> Option<T> {
        match self.0.recv_timeout(most) {
            Ok(result) => Some(result),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => panic!("a piece of work gives something unless it panics"),
        }
    }
}

/// The same work for many items, on so many threads, until an observer says stop.
pub struct PooledOrder<'a> {
    threads: usize,
    observer: &'a mut dyn Observer,
}

impl<'a> PooledOrder<'a> {
    /// On so many threads.
    pub fn new(threads: usize, observer: &'a mut dyn Observer) -> Self {
        Self { threads, observer }
    }

    /// See [`InOrder::in_order`]; the work is given a flag that is raised when the observer says stop, and
    /// the observer is handed over with the number of items whenever one more is done.
    pub fn each<T: Sync, W, R: Send>(
        &mut self,
        items: &[T],
        make: &(dyn Fn() -> W + Sync),
        work: &(dyn Fn(&mut W, &T, &AtomicBool) -> R + Sync),
        mut done: impl FnMut(&mut dyn Observer, usize),
    ) -> Option<Vec<R>> {
        let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let serve = |results: &Sender<(usize, R)>| {
            let mut worker = make();
            while !stop.load(Ordering::Relaxed) {
                let index = next.fetch_add(1, Ordering::Relaxed);
                let Some(item) = items.get(index) else { return };
                // Who waits for the results waits for all threads.
                let _ = results.send((index, work(&mut worker, item, &stop)));
            }
        };
        let serve = &serve;
        with_pool(self.threads.min(items.len()), |pool| {
            let (sender, results) = mpsc::channel();
            for _ in 0..pool.threads().max(1) {
                let sender = sender.clone();
                pool.hand(move || serve(&sender));
            }
            drop(sender);
            let mut found: Vec<Option<R>> = items.iter().map(|_| None).collect();
            let mut count = 0;
            loop {
                if self.observer.interrupted() {
                    stop.store(true, Ordering::Relaxed);
                }
                match results.recv_timeout(PATIENCE) {
                    Ok((index, result)) => {
                        found[index] = Some(result);
                        count += 1;
                        done(self.observer, count);
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => break,
                }
            }
            assert!(!pool.has_panicked(), "a thread has panicked");
            found.into_iter().collect()
        })
    }
}

impl InOrder for PooledOrder<'_> {
    fn in_order<T: Sync, W, R: Send>(
        &mut self,
        items: &[T],
        make: &(dyn Fn() -> W + Sync),
        work: &(dyn Fn(&mut W, &T) -> R + Sync),
    ) -> Option<Vec<R>> {
        self.each(items, make, &|worker, item, _| work(worker, item), |_, _| {})
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Barrier};

    use super::*;
    use crate::Quiet;

    const LONG: Duration = Duration::from_secs(60);

    #[test]
    fn everything_is_done_once_and_given_to_whoever_handed_it_over() {
        for threads in [1, 2, 5] {
            let done = AtomicUsize::new(0);
            let piece = |k: usize| {
                done.fetch_add(1, Ordering::Relaxed);
                k * k
            };
            let piece = &piece;
            with_pool(threads, |pool| {
                assert_eq!(pool.threads(), threads);
                let pending: Vec<Pending<usize>> = (0..200).map(|k| pool.hand(move || piece(k))).collect();
                let backwards: Vec<usize> = pending.iter().rev().filter_map(|one| one.wait(LONG)).collect();
                assert!(backwards.into_iter().eq((0..200).rev().map(|k| k * k)), "{threads} threads");
            });
            assert_eq!(done.load(Ordering::Relaxed), 200);
        }
    }

    /// Three pieces that wait for one another end only if three threads are at work at once.
    #[test]
    fn threads_work_at_the_same_time() {
        let barrier = Barrier::new(3);
        let barrier = &barrier;
        with_pool(3, |pool| {
            let pending: Vec<_> = (0..3).map(|_| pool.hand(move || barrier.wait().is_leader())).collect();
            assert_eq!(pending.iter().filter(|one| one.wait(LONG).unwrap()).count(), 1);
        });
    }

    #[test]
    fn one_thread_does_everything_in_order() {
        let order = Arc::new(Mutex::new(Vec::new()));
        with_pool(1, |pool| {
            let pending: Vec<_> = (0..20)
                .map(|k| {
                    let order = Arc::clone(&order);
                    pool.hand(move || order.lock().unwrap().push(k))
                })
                .collect();
            pending.iter().for_each(|one| one.wait(LONG).unwrap());
        });
        assert!(order.lock().unwrap().iter().copied().eq(0..20));
    }

    #[test]
    #[should_panic(expected = "unless it panics")]
    fn work_that_panics_is_not_waited_for_without_end() {
        with_pool(2, |pool| {
            let pending = pool.hand(|| panic!("as it should"));
            pending.wait(LONG).unwrap_or(());
        });
    }

    #[test]
    fn results_are_in_the_order_of_the_items_for_any_number_of_threads() {
        let items: Vec<u64> = (0..1000).collect();
        for threads in [1, 3, 8] {
            let mut quiet = Quiet;
            let squares = PooledOrder::new(threads, &mut quiet).in_order(&items, &|| 2, &|two, item| {
                *two = 2;
                item.pow(*two)
            });
            assert!(squares.unwrap().into_iter().eq(items.iter().map(|item| item * item)));
        }
    }

    struct Stops;

    impl Observer for Stops {
        fn interrupted(&mut self) -> bool {
            true
        }
    }

    #[test]
    fn an_observer_that_says_stop_reaches_every_thread() {
        let work = |(): &mut (), _: &i32, stop: &AtomicBool| {
            while !stop.load(Ordering::Relaxed) {
                thread::yield_now();
            }
        };
        let found = PooledOrder::new(2, &mut Stops).each(&[1, 2, 3], &|| (), &work, |_, _| {});
        assert!(found.is_none(), "the third was not started");
    }
}
