//! What of the touches of a stretch counts in an orbit that is made of stretches.

use super::stick::STUCK_TOUCHES;

/// A contact at an end of a stretch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AtEnd {
    /// Not closed.
    Open,
    /// Closed, with pressure or without, and closing.
    Closing,
    /// Closed, and opening or at rest.
    Opening,
}

/// What the touches of two stretches lack that follow each other: one if a touch lies between them, the state
/// at the end of the first being before it by rounding and that at the start of the second behind it; minus
/// one the other way round, where both count it. What opens there is no touch.
#[must_use]
pub fn touches_lacking(end: AtEnd, start: AtEnd) -> i32 {
    match (end, start) {
        (AtEnd::Open, AtEnd::Closing) => 1,
        (AtEnd::Closing, AtEnd::Open) => -1,
        _ => 0,
    }
}

/// Numbers of touches over an orbit, from the sums over its stretches: where chatter came to its end on a
/// rigid stop, how often that was stands for the number of impacts, which is infinite and was cut somewhere.
pub fn complete_touches(touches: &mut [u32]) {
    for touches in touches.iter_mut().filter(|touches| **touches >= STUCK_TOUCHES) {
        *touches -= *touches % STUCK_TOUCHES;
    }
}
