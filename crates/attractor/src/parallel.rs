//! The same work for many items: on the calling thread here, on many by whoever drives it.

/// Does the same work for every item, on one thread or on many.
///
/// A round of [`Basins`](crate::Basins) is given to whoever drives it in this way: no thread is started here.
pub trait InOrder {
    /// Does the work of every item; results are in the order of the items, whoever did them.
    ///
    /// * `make`: makes what a thread works with. What it holds must not change results from one item to the
    ///   next.
    ///
    /// # Returns
    /// `None` if it was stopped before all was done.
    fn in_order<T: Sync, W, R: Send>(
        &mut self,
        items: &[T],
        make: &(dyn Fn() -> W + Sync),
        work: &(dyn Fn(&mut W, &T) -> R + Sync),
    ) -> Option<Vec<R>>;
}

/// One item after the other, on the calling thread.
#[derive(Debug, Clone, Copy, Default)]
pub struct OneByOne;

impl InOrder for OneByOne {
    fn in_order<T: Sync, W, R: Send>(
        &mut self,
        items: &[T],
        make: &(dyn Fn() -> W + Sync),
        work: &(dyn Fn(&mut W, &T) -> R + Sync),
    ) -> Option<Vec<R>> {
        let mut worker = make();
        Some(items.iter().map(|item| work(&mut worker, item)).collect())
    }
}
