//! Filters, resampling, spectra, windows and envelopes against SciPy's results, to 1e-12 of the largest
//! value.
//!
//! The results are in `fixtures/scipy.json`, made by `fixtures/make_fixtures.py` with the version named
//! there.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_signal::{
    envelope::{analytic_signal, envelope},
    filter::{Band, butterworth},
    resample::{Ratio, resample, resample_periodic},
    spectrum::{Detrend, Scaling, WelchSettings, Window, amplitude_spectrum, welch},
};
use serde_json::Value;

/// Relative to the largest value of a result.
const TOLERANCE: f64 = 1e-12;

fn results() -> Value {
    serde_json::from_str(include_str!("fixtures/scipy.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

fn whole(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

#[track_caller]
fn assert_same(found: &[f64], expected: &Value, what: &str) {
    let expected = numbers(expected);
    assert_eq!(found.len(), expected.len(), "{what}");
    let largest = expected.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let difference = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(difference <= TOLERANCE * largest, "{what}: {:.2e}", difference / largest);
}

#[test]
fn butterworth_filters() {
    let results = results();
    let x = numbers(&results["x"]);
    for case in results["filters"].as_array().unwrap() {
        let cut_off = numbers(&case["cut_off"]);
        let band = match case["kind"].as_str().unwrap() {
            "lowpass" => Band::LowPass { cut_off_hz: cut_off[0] },
            "highpass" => Band::HighPass { cut_off_hz: cut_off[0] },
            _ => Band::BandPass { low_hz: cut_off[0], high_hz: cut_off[1] },
        };
        let order = whole(&case["order"]);
        let filter = butterworth(order, band, case["rate"].as_f64().unwrap()).unwrap();
        let what = format!("{band:?} of order {order}");
        assert_same(&filter.zero_phase(&x).unwrap(), &case["zero_phase"], &format!("{what}, zero-phase"));
        assert_same(&filter.causal_from_rest(&x), &case["causal"], &format!("{what}, causal"));
        assert_same(&filter.causal(&x), &case["settled"], &format!("{what}, causal and settled"));
    }
}

#[test]
fn polyphase_resampling() {
    let results = results();
    let x = numbers(&results["x"]);
    for case in results["polyphase"].as_array().unwrap() {
        let (up, down) = (whole(&case["up"]), whole(&case["down"]));
        let found = resample(&x, Ratio::new(up, down).unwrap()).unwrap();
        assert_same(&found, &case["y"], &format!("{up}/{down}"));
    }
}

#[test]
fn resampling_of_periods() {
    let results = results();
    let x = numbers(&results["x"]);
    for case in results["fourier"].as_array().unwrap() {
        let (from, length) = (whole(&case["from"]), whole(&case["length"]));
        let found = resample_periodic(&x[..from], length).unwrap();
        assert_same(&found, &case["y"], &format!("{from} to {length}"));
    }
}

fn window(name: &str) -> Window {
    match name {
        "boxcar" => Window::Rectangular,
        "hann" => Window::Hann,
        "hamming" => Window::Hamming,
        "blackman" => Window::Blackman,
        _ => Window::FlatTop,
    }
}

#[test]
fn windows() {
    for (name, values) in results()["windows"].as_object().unwrap() {
        assert_same(&window(name).values(50), values, name);
    }
}

#[test]
fn spectra_by_segments() {
    let results = results();
    let x = numbers(&results["x"]);
    for case in results["welch"].as_array().unwrap() {
        let settings = WelchSettings {
            segment: whole(&case["segment"]),
            overlap: whole(&case["overlap"]),
            window: window(case["window"].as_str().unwrap()),
            scaling: if case["scaling"] == "density" { Scaling::Density } else { Scaling::Power },
            detrend: match case["detrend"].as_str() {
                Some("constant") => Detrend::Constant,
                Some(_) => Detrend::Linear,
                None => Detrend::None,
            },
        };
        let found = welch(&x, 1000.0, &settings).unwrap();
        assert_same(&found.values, &case["y"], &format!("{settings:?}"));
    }
}

/// One-sided power of a line is half the square of its amplitude, but the square itself at half the sampling
/// rate; ours has the mean at zero.
#[test]
fn amplitudes_of_the_whole_record() {
    let results = results();
    let x = numbers(&results["x"]);
    for case in results["amplitude"].as_array().unwrap() {
        let (count, name) = (whole(&case["count"]), case["window"].as_str().unwrap());
        let found = amplitude_spectrum(&x[..count], 1000.0, window(name)).unwrap();
        let power =
            |(k, value): (usize, &f64)| if 2 * k == count { value * value } else { value * value / 2.0 };
        let powers: Vec<f64> = found.values.iter().enumerate().skip(1).map(power).collect();
        let expected = Value::Array(case["power"].as_array().unwrap()[1..].to_vec());
        assert_same(&powers, &expected, &format!("{name}, {count} samples"));
        assert!((found.values[0] - case["mean"].as_f64().unwrap().abs()).abs() < 1e-15);
    }
}

#[test]
fn envelopes() {
    let results = results();
    let x = numbers(&results["x"]);
    for (length, expected) in [300, 299].into_iter().zip(results["envelope"].as_array().unwrap()) {
        let found: Vec<f64> = analytic_signal(&x[..length]).unwrap().iter().map(|z| z.norm()).collect();
        assert_same(&found, expected, &format!("{length} samples"));
    }
    // About the mean: a decay on an offset.
    let decay: Vec<f64> =
        (0..4000).map(|k| 7.0 + (-1e-3 * f64::from(k)).exp() * (0.5 * f64::from(k)).cos()).collect();
    let envelope = envelope(&decay).unwrap();
    for k in (1000..3000).step_by(100) {
        // d/w is 2e-3, and the ends have an influence.
        assert!((envelope[k] * (1e-3 * k as f64).exp() - 1.0).abs() < 0.01, "sample {k}");
    }
}
