//! Where a branch crosses a frequency.

use hammerbeam_motion::System;
use hammerbeam_orbit::BranchRow;

/// States of the orbits at which the rows cross `frequency_hz`, between two rows by the chord; in the energy
/// norm's units.
pub fn crossings(system: &System, rows: &[BranchRow], frequency_hz: f64) -> Vec<Vec<f64>> {
    let n = system.dof();
    let frequencies = &system.model().natural_frequencies;
    let scale = |i: usize| if i < n { frequencies[i] } else { 1.0 };
    let pairs = rows.windows(2).map(|pair| (&pair[0].solution, &pair[1].solution));
    let crossing = pairs.filter(|(a, b)| (a.frequency_hz < frequency_hz) != (b.frequency_hz < frequency_hz));
    crossing
        .map(|(a, b)| {
            let share = (frequency_hz - a.frequency_hz) / (b.frequency_hz - a.frequency_hz);
            let entry = |i: usize| (a.nodes[0][i] + share * (b.nodes[0][i] - a.nodes[0][i])) * scale(i);
            (0..2 * n).map(entry).collect()
        })
        .collect()
}

/// Distance of two scaled states.
pub fn distance(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
