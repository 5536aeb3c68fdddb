//! What is read off the motion: relative displacements of elements, displacement of a point.
//! Equations (F5) and (F6) of the book, `docs/theory`.

use super::block::Blocks;

/// A displacement `r = row . x + support_ratios . u` and the rows of its derivatives.
#[derive(Debug, Clone)]
pub(crate) struct Output {
    /// Row over the block state, length 2n.
    pub row: Vec<f64>,
    /// `row A`: the velocity, apart from inputs.
    pub velocity_row: Vec<f64>,
    /// `row A^2`: the acceleration, apart from inputs.
    pub acceleration_row: Vec<f64>,
    /// `row A^3` and `row A^4`.
    pub jerk_row: Vec<f64>,
    pub snap_row: Vec<f64>,
    /// Its parts of the displacements of the supports [-].
    pub support_ratios: Vec<f64>,
    /// Factors of the energy norm `sqrt(k p^2 + s^2)` of each block in a bound on the value, as far as its
    /// stiffness bounds it.
    pub value_bound: Vec<f64>,
    /// The same for the first derivative.
    pub first_bound: Vec<f64>,
    /// The same for the second derivative.
    pub second_bound: Vec<f64>,
    /// The same for the third derivative.
    pub third_bound: Vec<f64>,
    /// The same for the fourth derivative.
    pub fourth_bound: Vec<f64>,
    /// The same for the fifth derivative.
    pub fifth_bound: Vec<f64>,
}

impl Output {
    /// Reads `shape . q + support_ratios . u`.
    pub fn new(blocks: &Blocks, shape: &[f64], support_ratios: &[f64]) -> Self {
        Self::of_row(blocks, blocks.output(shape), support_ratios)
    }

    /// Reads `row . x + support_ratios . u` from the block state.
    pub fn of_row(blocks: &Blocks, row: Vec<f64>, support_ratios: &[f64]) -> Self {
        let velocity_row = blocks.row_times_system(&row);
        let acceleration_row = blocks.row_times_system(&velocity_row);
        let jerk_row = blocks.row_times_system(&acceleration_row);
        let second_bound = energy_factors(blocks, &acceleration_row);
        let third_bound = energy_factors(blocks, &jerk_row);
        let snap_row = blocks.row_times_system(&jerk_row);
        let fourth_bound = energy_factors(blocks, &snap_row);
        let fifth_bound = energy_factors(blocks, &blocks.row_times_system(&snap_row));
        let (value_bound, first_bound) =
            (energy_factors(blocks, &row), energy_factors(blocks, &velocity_row));
        Self {
            row,
            velocity_row,
            acceleration_row,
            jerk_row,
            snap_row,
            support_ratios: support_ratios.to_vec(),
            value_bound,
            first_bound,
            second_bound,
            third_bound,
            fourth_bound,
            fifth_bound,
        }
    }
}

/// Smallest `g_i` with `|row_p p + row_s s| <= g_i sqrt(k p^2 + s^2)`; a row on `p` where `k = 0` is zero for
/// derivatives.
fn energy_factors(blocks: &Blocks, row: &[f64]) -> Vec<f64> {
    let n = blocks.count();
    let factor = |i: usize| {
        let position = if blocks.stiffness[i] > 0.0 { row[i] / blocks.stiffness[i].sqrt() } else { 0.0 };
        position.hypot(row[n + i])
    };
    (0..n).map(factor).collect()
}
