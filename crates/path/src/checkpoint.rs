//! Everything a follower knows between two points, as plain data.

use crate::{point::Counters, state::PathState, test_record::TestRecord};

/// State of a [`Follower`](crate::Follower) after an accepted point.
///
/// [`Follower::resume`](crate::Follower::resume) continues from it bit by bit like the run it was taken from,
/// once all accepted points, the start first, were handed to
/// [`Follower::remember`](crate::Follower::remember).
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    /// Where it is.
    pub state: PathState,
    /// The test functions at the last points.
    pub tests: TestRecord,
    /// Work done so far.
    pub counters: Counters,
}
