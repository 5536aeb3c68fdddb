//! The test functions at the last points, by which the next step is compared.

use crate::problem::TestValue;

/// Value relative to that behind a zero at which the zero is left.
const LEFT: f64 = 1e-3;

/// The test functions of a follower at the point accepted last and at the one before.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TestRecord {
    /// As they are after the point accepted last; that settles the doubt at a zero, where the sign is
    /// rounding.
    pub values: Vec<TestValue>,
    /// Those at the point before it, where the history has it.
    pub before: Vec<TestValue>,
    /// What the judge noted at the point accepted last, see [`Judge::note`](crate::Judge::note).
    pub noted: Vec<f64>,
    /// Bit `k` is set while test function `k` has not left the zero behind which the path goes on.
    pub zeros_near: u32,
}

impl TestRecord {
    /// A test function now and at the trial, for each.
    pub(crate) fn pairs<'a>(
        &'a self,
        trial: &'a [TestValue],
    ) -> impl Iterator<Item = (&'a TestValue, &'a TestValue)> {
        self.values.iter().zip(trial)
    }

    /// Beside a zero the sign of a test function is rounding: as long as it is small it counts as what it was
    /// found to be behind the zero. Bits of those that are.
    ///
    /// * `but`: the function whose zero the trial is.
    pub(crate) fn stay_behind_zeros(&self, trial: &mut [TestValue], but: Option<usize>) -> u32 {
        let mut near = 0;
        for (index, (behind, trial)) in self.values.iter().zip(trial).enumerate() {
            let is_near = has_bit(self.zeros_near, index) && but != Some(index);
            if is_near && trial.value.abs() < LEFT * behind.value.abs() {
                *trial = *behind;
                near |= 1 << index;
            }
        }
        near
    }

    /// Goes on to an accepted point.
    ///
    /// * `left`: bits of the functions that were zero at the point that is left.
    /// * `zeros_near`: bits of those that have not left a zero, or are at one, at the new point.
    pub(crate) fn go_on(&mut self, values: &[TestValue], noted: &[f64], left: u32, zeros_near: u32) {
        std::mem::swap(&mut self.values, &mut self.before);
        // Where a function was zero, what was noted is its value beyond.
        let at_zero = self.before.iter_mut().enumerate().filter(|(k, _)| has_bit(left, *k));
        at_zero.for_each(|(_, test)| test.value = 0.0);
        values.clone_into(&mut self.values);
        noted.clone_into(&mut self.noted);
        self.zeros_near = zeros_near;
    }
}

/// Whether the bit of a test function is set; the functions beyond those that have bits never vanish.
pub(crate) fn has_bit(bits: u32, index: usize) -> bool {
    bits.checked_shr(index as u32).is_some_and(|from| from & 1 == 1)
}
