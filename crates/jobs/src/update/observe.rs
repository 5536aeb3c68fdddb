//! What the model says to what was measured: eigenfrequencies and damping ratios.

use faer::{Mat, c64};
use hammerbeam_structure::{ModeTables, ReducedModel};

use super::data::FrequencyTable;

/// A table of eigenfrequencies [Hz].
pub(super) fn table(tables: &ModeTables, which: FrequencyTable) -> &[f64] {
    match which {
        FrequencyTable::Clamped => &tables.clamped_hz,
        FrequencyTable::FreeInterface => &tables.free_interface_hz,
        FrequencyTable::FixedInterface => &tables.fixed_interface_hz,
        FrequencyTable::Reduced => &tables.reduced_hz,
    }
}

/// Damping ratios of the oscillating modes, lowest frequency first.
///
/// Of the eigenvalues `l` of the damped structure with an imaginary part, `-Re l/|l|`, in the order of `|l|`.
/// Modal damping of a ratio z gives z for every mode; discrete dampers couple modes, and then the ratio is
/// that of the decay of each.
pub(super) fn damping_ratios(model: &ReducedModel) -> Vec<f64> {
    let (n, w) = (model.dof(), &model.natural_frequencies);
    // In the variables w q and q' the matrix is as well scaled as the modes are.
    let entry = |i: usize, j: usize| match (i < n, j < n) {
        (true, true) => 0.0,
        (true, false) => {
            if i + n == j {
                w[i]
            } else {
                0.0
            }
        }
        (false, true) => {
            if i == j + n {
                -w[j]
            } else {
                0.0
            }
        }
        (false, false) => -model.damping[(i - n, j - n)],
    };
    let values: Vec<c64> = Mat::from_fn(2 * n, 2 * n, entry).eigenvalues().unwrap_or_default();
    let mut pairs: Vec<(f64, f64)> =
        values.iter().filter(|l| l.im > 0.0).map(|l| (l.norm(), -l.re / l.norm())).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    pairs.into_iter().map(|(_, ratio)| ratio).collect()
}
