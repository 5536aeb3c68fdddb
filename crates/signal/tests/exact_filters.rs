//! Filters with low cut-offs against the same filters in arithmetic of 60 digits.
//!
//! Here the rounding of SciPy can exceed 1e-12 of the largest value (`scipy_.._off_by` in
//! `fixtures/exact_filters.json`, up to 2e-10), so it is not a reference: poles near one amplify the rounding
//! of coefficients in powers of z. Ours are in powers of z - 1.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_signal::filter::{Band, butterworth};
use serde_json::Value;

/// Relative to the largest value. The worst case here has 4e-14, a band-pass filter of order 8.
const TOLERANCE: f64 = 1e-13;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect()
}

#[test]
fn filters_with_low_cut_offs_match_exact_arithmetic() {
    let cases: Value = serde_json::from_str(include_str!("fixtures/exact_filters.json")).unwrap();
    let x: Vec<f64> = (0..2000_u32).map(|n| f64::from((7 * n * n + 13 * n) % 1009) / 256.0 - 1.5).collect();
    let mut failed = Vec::new();
    for case in cases.as_array().unwrap() {
        let cut_off = numbers(&case["cut_off"]);
        let band = match case["kind"].as_str().unwrap() {
            "lowpass" => Band::LowPass { cut_off_hz: cut_off[0] },
            "highpass" => Band::HighPass { cut_off_hz: cut_off[0] },
            _ => Band::BandPass { low_hz: cut_off[0], high_hz: cut_off[1] },
        };
        let order = case["order"].as_u64().unwrap() as usize;
        let filter = butterworth(order, band, 10_000.0).unwrap();
        let off_by = |found: &[f64], key: &str| {
            let every = case["every"].as_u64().unwrap() as usize;
            let expected = numbers(&case[key]);
            let largest = case[format!("largest_{key}")].as_f64().unwrap();
            assert_eq!(found.len().div_ceil(every), expected.len());
            assert!(found.iter().all(|value| value.is_finite()));
            let difference =
                found.iter().step_by(every).zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            difference / largest
        };
        let causal = off_by(&filter.causal_from_rest(&x), "causal");
        let zero_phase = off_by(&filter.zero_phase(&x).unwrap(), "zero_phase");
        if causal.max(zero_phase) > TOLERANCE {
            failed
                .push(format!("{band:?} of order {order}: causal {causal:.1e}, zero-phase {zero_phase:.1e}"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
