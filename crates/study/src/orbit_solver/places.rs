//! Frequencies at which the linear system tells to look for attractors.
//!
//! Over a range in which the linear response reaches a contact every motion has impacts, and many solutions
//! may follow one another within it, however narrow it is; some
//! reach beyond its ends, at which the linear response grazes. And impacts wake the modes: a solution of `n`
//! periods is near where `n` times an eigenfrequency is that of
//! the excitation, one with several impacts a period near a part of an eigenfrequency.

use hammerbeam_orbit::{OrbitSettings, Response, linear_contact_ranges};

use crate::Model;

/// Frequencies in the middles of equal parts of a range, if the survey has fewer there.
const WITHIN: u32 = 8;
/// Frequencies beyond either end of a range, in parts of its width.
const BEYOND: [f64; 2] = [0.1, 0.4];
/// Parts of an eigenfrequency.
const PARTS: [f64; 3] = [1.0, 2.0, 3.0];

/// The frequencies, those that matter most first.
///
/// * `spacing_hz`: distance of the frequencies of the survey.
pub(super) fn resonances_hz(
    model: &Model,
    response: &Response,
    (range_hz, spacing_hz): ((f64, f64), f64),
    multiples: &[u32],
    settings: &OrbitSettings,
) -> Vec<f64> {
    let ranges = linear_contact_ranges(&model.system, response, range_hz, settings).unwrap_or_default();
    let mut places: Vec<f64> = ranges.iter().flat_map(|range| of_range(*range, spacing_hz)).collect();
    if !model.system.elements().is_empty() {
        places.extend(of_modes(&model.system.model().natural_frequencies, multiples));
    }
    places.retain(|at| (range_hz.0..=range_hz.1).contains(at));
    places
}

/// Within a range that is narrow for the survey, and beyond its ends.
fn of_range([low, high]: [f64; 2], spacing_hz: f64) -> Vec<f64> {
    let width = high - low;
    if width > f64::from(WITHIN) * spacing_hz {
        return Vec::new();
    }
    let middle = |k: u32| low + width * (f64::from(k) + 0.5) / f64::from(WITHIN);
    let beyond = BEYOND.iter().flat_map(|part| [high + part * width, low - part * width]);
    (0..WITHIN).map(middle).chain(beyond).collect()
}

/// Multiples and parts of the eigenfrequencies [Hz], the lowest modes first.
fn of_modes(natural_frequencies: &[f64], multiples: &[u32]) -> Vec<f64> {
    let of_mode = |w: &f64| {
        let at = w / std::f64::consts::TAU;
        let parts = PARTS.iter().map(move |part| at / part);
        let multiples = multiples.iter().filter(|multiple| **multiple > 1);
        parts.chain(multiples.map(move |multiple| at * f64::from(*multiple))).collect::<Vec<f64>>()
    };
    natural_frequencies.iter().flat_map(of_mode).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_range_of_impacts_is_looked_at_more_closely_than_the_survey_does() {
        let places = of_range([64.0, 65.8], 2.1);
        assert_eq!(places.iter().filter(|at| (64.0..65.8).contains(*at)).count(), 8);
        assert!(places.iter().any(|at| *at > 65.8) && places.iter().any(|at| *at < 64.0));
        assert!(of_range([64.0, 65.8], 0.1).is_empty(), "the survey looks at 18 frequencies there");
    }

    #[test]
    fn modes_are_looked_at_at_their_multiples_and_parts() {
        assert_eq!(of_modes(&[std::f64::consts::TAU * 6.0], &[1, 3]), [6.0, 3.0, 2.0, 18.0]);
    }
}
