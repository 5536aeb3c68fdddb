//! Frequencies at which the linear system suggests to look for attractors.
//!
//! Over a range in which the linear response reaches a contact every motion has impacts, and many solutions
//! may follow one another within it, however narrow it is; some reach beyond its ends, at which the linear
//! response grazes. And impacts excite the modes: a solution of `n` periods is near where `n` times an
//! eigenfrequency equals the excitation frequency, one with several impacts a period near a part of an
//! eigenfrequency. Each of these places has a width; where the survey looks within it, nothing is added.

use std::f64::consts::TAU;

use hammerbeam_orbit::{OrbitSettings, Response, linear_contact_ranges};
use hammerbeam_study::Model;

/// Equal parts of a range with impacts, each of which is looked at.
const PARTS_OF_RANGE: u32 = 8;
/// Frequencies beyond either end of a range, in parts of its width.
const BEYOND: [f64; 2] = [0.1, 0.4];
/// Parts of an eigenfrequency.
const PARTS: [f64; 3] = [1.0, 2.0, 3.0];
/// Relative distance from such a place at which is looked if nothing damps the mode: at the place itself it
/// vibrates freely, and orbits of every amplitude belong to it.
const BESIDE: f64 = 1e-3;
/// Line width, relative to the frequency, up to which a mode counts as undamped here.
const UNDAMPED: f64 = 2e-6;

/// The frequencies of the survey: the middles of equal parts of the range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surveyed {
    pub range_hz: (f64, f64),
    pub spacing_hz: f64,
}

impl Surveyed {
    /// Whether one of them lies within an interval.
    fn looks_within(&self, [low, high]: [f64; 2]) -> bool {
        let place = |at: f64| (at - self.range_hz.0) / self.spacing_hz - 0.5;
        let last = place(self.range_hz.1) - 0.5;
        place(low).ceil().max(0.0) <= place(high).min(last)
    }
}

/// The frequencies, those that matter most first.
pub(super) fn resonances_hz(
    model: &Model,
    response: &Response,
    surveyed: &Surveyed,
    multiples: &[u32],
    settings: &OrbitSettings,
) -> Vec<f64> {
    let range_hz = surveyed.range_hz;
    let ranges = linear_contact_ranges(&model.system, response, range_hz, settings).unwrap_or_default();
    let mut places: Vec<f64> = ranges.iter().flat_map(|range| of_range(*range, surveyed)).collect();
    if !model.system.elements().is_empty() {
        let reduced = model.system.model();
        let modes = reduced.natural_frequencies.iter().enumerate();
        let modes = modes.map(|(mode, w)| [*w, reduced.damping[(mode, mode)]].map(|value| value / TAU));
        places.extend(modes.flat_map(|mode| of_mode(mode, multiples, surveyed)));
    }
    places.retain(|at| (range_hz.0..=range_hz.1).contains(at));
    places
}

/// Within a range with impacts and beyond its ends.
fn of_range([low, high]: [f64; 2], surveyed: &Surveyed) -> Vec<f64> {
    let part = (high - low) / f64::from(PARTS_OF_RANGE);
    let within = (0..PARTS_OF_RANGE).map(|k| low + part * (f64::from(k) + 0.5));
    let beyond = BEYOND.iter().map(|share| share * (high - low)).flat_map(|off| [high + off, low - off]);
    let is_open = |at: &f64| !surveyed.looks_within([at - 0.5 * part, at + 0.5 * part]);
    within.chain(beyond).filter(is_open).collect()
}

/// Multiples and parts of an eigenfrequency with its line width [Hz].
fn of_mode([at, width]: [f64; 2], multiples: &[u32], surveyed: &Surveyed) -> Vec<f64> {
    let parts = PARTS.iter().map(|part| 1.0 / part);
    let multiples = multiples.iter().filter(|multiple| **multiple > 1).map(|multiple| f64::from(*multiple));
    let is_open = |factor: &f64| {
        let [at, width] = [factor * at, factor * width];
        !surveyed.looks_within([at - width, at + width])
    };
    let beside = |place: f64| {
        let above = place * (1.0 + BESIDE);
        match width > UNDAMPED * at {
            true => place,
            false if above <= surveyed.range_hz.1 => above,
            false => place * (1.0 - BESIDE),
        }
    };
    parts.chain(multiples).filter(is_open).map(|factor| beside(factor * at)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surveyed(spacing_hz: f64) -> Surveyed {
        Surveyed { range_hz: (40.0, 90.0), spacing_hz }
    }

    #[test]
    fn each_part_of_a_range_of_impacts_is_looked_at() {
        for spacing_hz in [2.0, 0.7, 0.3] {
            let places = of_range([64.03, 65.63], &surveyed(spacing_hz));
            for part in 0..8 {
                let [low, high] = [part, part + 1].map(|k| 64.03 + 0.2 * f64::from(k));
                let looks = surveyed(spacing_hz).looks_within([low, high]);
                let added = places.iter().filter(|at| (low..high).contains(*at)).count();
                assert_eq!(added, usize::from(!looks), "{spacing_hz}, part {part}");
            }
        }
        let within = of_range([64.03, 65.63], &surveyed(0.15));
        assert!(within.is_empty(), "the survey looks into every part: {within:?}");
    }

    #[test]
    fn modes_are_looked_at_at_their_multiples_and_parts_unless_the_survey_is_there() {
        let of_mode = |width| of_mode([84.0, width], &[1, 2], &surveyed(2.0));
        let rounded = |places: Vec<f64>| places.iter().map(|at| at.round()).collect::<Vec<f64>>();
        // None is damped: a thousandth beside them, on the side that is in the range.
        let expected = [84.0 * 1.001, 42.0 * 1.001, 28.0 * 1.001, 168.0 * 0.999];
        let found = of_mode(0.0);
        assert!(found.iter().zip(expected).all(|(at, hz)| (at / hz - 1.0).abs() < 1e-12), "{found:?}");
        assert_eq!(rounded(of_mode(0.01)), [84.0, 42.0, 28.0, 168.0]);
        assert_eq!(rounded(of_mode(1.1)), [42.0, 28.0, 168.0], "the survey looks at 83 Hz and 85 Hz");
    }
}
