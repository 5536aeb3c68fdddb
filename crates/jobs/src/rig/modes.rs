//! Which mode of the rig a measured one is.
//!
//! A decay numbers no modes, and one that fades too fast is missing in it. A measured eigenfrequency and a
//! mode of the rig belong together where each is the nearest to the other by the ratio of frequencies. The
//! mode of the model is that with the same number as the rig's.

use std::f64::consts::TAU;

use hammerbeam_study::{Model, file::Rig};

use super::{
    RigError,
    decay::{MeasuredMode, highest_hz, measured_modes},
};

/// A mode of the rig that a decay may show, or a measured one that is none of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigMode {
    /// Its number, from 1 on; `None` for a measured one that belongs to no mode.
    pub number: Option<usize>,
    /// Eigenfrequency of the rig, and of the mode of the model with that number [Hz].
    pub rig_hz: Option<f64>,
    /// See above.
    pub model_hz: Option<f64>,
    /// What the decay shows; `None` if it does not show the mode.
    pub measured: Option<MeasuredMode>,
}

/// The modes of the rig up to the highest frequency that a decay is looked at for, and what a decay shows of
/// them.
///
/// # Errors
/// [`RigError::Signal`].
pub fn rig_modes(rig: &Rig, rig_model: &Model, model: &Model) -> Result<Vec<RigMode>, RigError> {
    let hertz = |model: &Model| -> Vec<f64> {
        model.system.model().natural_frequencies.iter().map(|rate| rate / TAU).collect()
    };
    let measured = measured_modes(rig, rig_model)?;
    Ok(paired(&measured, &hertz(rig_model), &hertz(model), highest_hz(rig)))
}

/// Index of the nearest frequency by the ratio.
fn nearest(frequency_hz: f64, others: &[f64]) -> Option<usize> {
    let off = |k: usize| (others[k] / frequency_hz).ln().abs();
    (0..others.len()).min_by(|&i, &j| off(i).total_cmp(&off(j)))
}

fn paired(measured: &[MeasuredMode], rig_hz: &[f64], model_hz: &[f64], up_to_hz: f64) -> Vec<RigMode> {
    let shown: Vec<f64> = measured.iter().map(|mode| mode.frequency_hz.0).collect();
    let partner = |k: usize| nearest(rig_hz[k], &shown).filter(|&m| nearest(shown[m], rig_hz) == Some(k));
    let partners: Vec<Option<usize>> = (0..rig_hz.len()).map(partner).collect();
    let mode = |k: usize| RigMode {
        number: Some(k + 1),
        rig_hz: Some(rig_hz[k]),
        model_hz: model_hz.get(k).copied(),
        measured: partners[k].map(|m| measured[m]),
    };
    let wanted = |k: &usize| rig_hz[*k] <= up_to_hz || partners[*k].is_some();
    let others = (0..measured.len()).filter(|m| !partners.contains(&Some(*m)));
    let other =
        |m: usize| RigMode { number: None, rig_hz: None, model_hz: None, measured: Some(measured[m]) };
    (0..rig_hz.len()).filter(wanted).map(mode).chain(others.map(other)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(frequency_hz: f64) -> MeasuredMode {
        MeasuredMode { frequency_hz: (frequency_hz, 0.1), damping_ratio: (0.01, 1e-3) }
    }

    /// Number and measured frequency of each row.
    fn rows(shown: &[f64], up_to_hz: f64) -> Vec<(Option<usize>, Option<f64>)> {
        let shown: Vec<MeasuredMode> = shown.iter().map(|hz| measured(*hz)).collect();
        let found = paired(&shown, &[17.2, 128.9, 378.9, 900.0], &[17.5, 137.3, 414.3], up_to_hz);
        for mode in &found {
            let number = mode.number.map(|number| number - 1);
            assert_eq!(mode.rig_hz, number.map(|k| [17.2, 128.9, 378.9, 900.0][k]));
            assert_eq!(mode.model_hz, number.and_then(|k| [17.5, 137.3, 414.3].get(k).copied()));
        }
        found.iter().map(|mode| (mode.number, mode.measured.map(|of| of.frequency_hz.0))).collect()
    }

    /// The second mode, heavily damped, is missing: the third does not take its place.
    #[test]
    fn mode_that_is_not_measured_is_left_open() {
        let expected = [(Some(1), Some(17.2)), (Some(2), None), (Some(3), Some(378.7))];
        assert_eq!(rows(&[17.2, 378.7], 510.0), expected);
        assert_eq!(rows(&[378.7, 17.2], 510.0), expected);
        assert_eq!(rows(&[], 510.0), expected.map(|(number, _)| (number, None)));
    }

    /// Of two near one mode the nearer one is it, the other is none.
    #[test]
    fn measured_one_that_is_no_mode_is_told() {
        let expected = [(Some(1), Some(17.2)), (Some(2), Some(129.0)), (Some(3), None), (None, Some(150.0))];
        assert_eq!(rows(&[17.2, 129.0, 150.0], 510.0), expected);
    }
}
