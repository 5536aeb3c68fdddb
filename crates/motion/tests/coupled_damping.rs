//! Dampers that couple modes: the block coordinates against the matrix exponential and the general
//! integrator.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{assert_agreement, element, hertz, modal_damping, model};
use faer::Mat;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
};

/// Rates by which displacements are scaled to velocities.
fn rates(frequencies: &[f64], time: f64) -> Vec<f64> {
    frequencies.iter().map(|w| w.max(time.recip())).collect()
}

/// `exp(A t)` of `[rate q; v]` by Taylor's series and squarings; errors of about `1e-16 |A| t`.
fn exponential(frequencies: &[f64], damping: &Mat<f64>, time: f64) -> Mat<f64> {
    let (n, rates) = (frequencies.len(), rates(frequencies, time));
    let matrix = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, true) => 0.0,
        (true, false) => {
            if i == j - n {
                rates[i]
            } else {
                0.0
            }
        }
        (false, true) => {
            if i - n == j {
                -frequencies[j].powi(2) / rates[j]
            } else {
                0.0
            }
        }
        (false, false) => -damping[(i - n, j - n)],
    });
    let norm =
        (0..2 * n).map(|i| (0..2 * n).map(|j| matrix[(i, j)].abs()).sum::<f64>()).fold(0.0, f64::max) * time;
    let squarings = (norm / 0.25).log2().ceil().max(0.0) as i32;
    let scaled = &matrix * faer::Scale(time / 2f64.powi(squarings));
    let mut sum = Mat::<f64>::identity(2 * n, 2 * n);
    let mut term = sum.clone();
    for m in 1..=16 {
        term = &term * &scaled * faer::Scale(1.0 / f64::from(m));
        sum += &term;
    }
    for _ in 0..squarings {
        sum = &sum * &sum;
    }
    sum
}

/// Largest difference of the fundamental matrix, scaled to velocities, from the exponential, relative to the
/// largest entry.
fn error(frequencies: &[f64], damping: &Mat<f64>, time: f64) -> f64 {
    let n = frequencies.len();
    let system = System::new(model(frequencies, damping.clone()), &Load::default(), vec![]).unwrap();
    let mut exact = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
    let stretch = Stretch { frequency_hz: 1.0 / time, start: 0.0, end: 1.0 };
    let found = exact.flow(&stretch, &vec![0.0; 2 * n]).unwrap().by_state;
    let expected = exponential(frequencies, damping, time);
    let rates = rates(frequencies, time);
    let scale = |i: usize| if i < n { rates[i] } else { 1.0 };
    let (mut error, mut norm) = (0.0_f64, 0.0_f64);
    for i in 0..2 * n {
        for j in 0..2 * n {
            norm = norm.max(expected[(i, j)].abs());
            error = error.max((found[(i, j)] * scale(i) / scale(j) - expected[(i, j)]).abs());
        }
    }
    error / norm
}

/// Numbers between -1 and 1 that look random.
fn numbers(seed: u64) -> impl Iterator<Item = f64> {
    let mut state = seed;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    })
}

/// `modal + strength shape shape^T` for each of the shapes.
fn dampers(frequencies: &[f64], ratio: f64, strength: f64, shapes: &[Vec<f64>]) -> Mat<f64> {
    let modal = modal_damping(frequencies, ratio);
    let n = frequencies.len();
    Mat::from_fn(n, n, |i, j| {
        modal[(i, j)] + shapes.iter().map(|shape| strength * shape[i] * shape[j]).sum::<f64>()
    })
}

#[test]
fn point_dampers_from_light_to_heavy_keep_ten_digits() {
    for (modes, seed) in [(2, 1), (3, 2), (6, 3), (12, 4), (24, 5)] {
        let frequencies: Vec<f64> = (0..modes).map(|i| TAU * 17.5 * (i as f64 + 0.6).powi(2) * 2.8).collect();
        for dampers_count in [1, 2] {
            let mut random = numbers(seed);
            let shapes: Vec<Vec<f64>> =
                (0..dampers_count).map(|_| random.by_ref().take(modes).map(|x| 2.0 * x).collect()).collect();
            for strength in [1e-3, 1.0, 30.0, 300.0, 3e3, 3e4] {
                let damping = dampers(&frequencies, 0.01, strength, &shapes);
                for time in [1e-4, 3e-3, 0.05] {
                    let error = error(&frequencies, &damping, time);
                    assert!(
                        error < 1e-10,
                        "{modes} modes, {dampers_count} dampers of {strength:e}, {time:e} s: {error:e}"
                    );
                }
            }
        }
    }
}

/// Like an unreduced model: modes from 1e2 to 1e7 rad/s and a damper at a point that all of them move.
#[test]
fn stiff_spectra_keep_ten_digits() {
    for modes in [4, 12, 24] {
        let frequencies: Vec<f64> =
            (0..modes).map(|i| 1e2 * 1e5_f64.powf(i as f64 / (modes as f64 - 1.0))).collect();
        let shape: Vec<f64> = numbers(11).take(modes).map(|x| 1.0 + 0.5 * x).collect();
        for strength in [1.0, 1e2, 1e4, 1e6] {
            let damping = dampers(&frequencies, 0.005, strength, std::slice::from_ref(&shape));
            for time in [1e-6, 1e-4, 1e-3] {
                let error = error(&frequencies, &damping, time);
                assert!(error < 1e-10, "{modes} modes, damper {strength:e}, {time:e} s: {error:e}");
            }
        }
    }
}

/// Two equal modes, a damper that makes one pair critically damped, and a damped mode next to a rigid one.
#[test]
fn equal_and_critical_and_rigid_modes_keep_ten_digits() {
    let cases: [(&str, Vec<f64>, Mat<f64>); 4] = [
        ("equal frequencies", vec![50.0, 50.0], dampers(&[50.0, 50.0], 0.02, 4.0, &[vec![1.0, 0.8]])),
        (
            "critical",
            vec![50.0, 50.0, 300.0],
            dampers(&[50.0, 50.0, 300.0], 0.0, 100.0, &[vec![0.6, 0.8, 0.0]]),
        ),
        ("rigid", vec![0.0, 40.0, 300.0], dampers(&[0.0, 40.0, 300.0], 0.01, 20.0, &[vec![1.0, -0.5, 0.4]])),
        ("heavy", vec![20.0, 40.0, 300.0], dampers(&[20.0, 40.0, 300.0], 0.01, 5e3, &[vec![1.0, -0.5, 0.4]])),
    ];
    for (what, frequencies, damping) in cases {
        for time in [1e-3, 0.02, 0.3] {
            let error = error(&frequencies, &damping, time);
            assert!(error < 1e-10, "{what}, {time:e} s: {error:e}");
        }
    }
}

/// Contacts of a structure with dampers at two points, loaded by forces.
#[test]
fn contacts_of_damped_structures_agree_with_the_general_integrator() {
    let frequencies: Vec<f64> = [9.0, 43.0, 130.0, 310.0, 700.0].iter().map(|f| TAU * f).collect();
    let shapes = [vec![1.2, -0.8, 0.9, 0.5, -0.4], vec![0.3, 0.9, -0.7, 0.8, 0.6]];
    for strength in [1.0, 40.0, 900.0] {
        let damping = dampers(&frequencies, 0.01, strength, &shapes);
        let push = |order, amplitude, phase| HarmonicForce {
            shape: shapes[0].clone(),
            harmonic: Harmonic { order, amplitude, phase },
        };
        let load =
            Load { support: vec![], forces: vec![push(1, 8.0, 0.3), push(2, 5.0, -1.0), push(0, 1.0, 0.0)] };
        let stop = element(&[1.8, -1.5, 1.4, -1.2, 1.1], 0.0, hertz(1e8, 1e-4));
        let system = System::new(model(&frequencies, damping), &load, vec![stop]).unwrap();
        let state = [0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.02, 0.01, 0.0, 0.0];
        let stretch = Stretch { frequency_hz: 12.0, start: 0.2, end: 1.7 };
        let contacts = assert_agreement(&system, &stretch, &state, 1e-9, &format!("dampers of {strength}"));
        assert!(contacts > 0, "dampers of {strength}: no contact");
    }
}
