//! States reconstructed from a series by delays.

/// Delay vectors of a series as states: state `i` has the coordinates `x_i, x_{i+J}, ..`.
pub(super) struct DelayStates<'a> {
    series: &'a [f64],
    delay: usize,
    pub dimension: usize,
}

impl<'a> DelayStates<'a> {
    pub(super) const fn new(series: &'a [f64], delay: usize, dimension: usize) -> Self {
        Self { series, delay, dimension }
    }

    /// Number of states.
    pub(super) const fn len(&self) -> usize {
        self.series.len().saturating_sub((self.dimension - 1) * self.delay)
    }

    /// A coordinate of a state.
    pub(super) fn coordinate(&self, state: usize, index: usize) -> f64 {
        self.series[state + index * self.delay]
    }

    /// Squared distance of two states.
    pub(super) fn square(&self, one: usize, other: usize) -> f64 {
        (0..self.dimension).map(|c| (self.coordinate(one, c) - self.coordinate(other, c)).powi(2)).sum()
    }
}
