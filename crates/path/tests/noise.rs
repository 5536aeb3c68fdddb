//! Rounding in the residual, as from an integrator with a tolerance, neither stops a branch nor invents
//! events.

use crate::support::*;
use approx::assert_abs_diff_eq;

/// Noise of this size, a fixed function of the point: the same point always gives the same bits.
fn noise(x: f64, l: f64, size: f64) -> f64 {
    let mut bits = x.to_bits() ^ l.to_bits().rotate_left(17);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    size * ((bits >> 40) as f64 / f64::from(1 << 23) - 1.0)
}

fn noisy_graph(
    size: f64,
    g: impl Fn(f64) -> (f64, f64, u64) + Clone,
) -> impl Fn(f64, f64) -> (f64, f64, f64, u64) + Clone {
    move |x, l| {
        let (value, slope, signature) = g(x);
        (value - l + noise(x, l, size), slope, -1.0, signature)
    }
}

/// Up to the default floor of 1e-12 events keep their accuracy; beyond it they may be off by what noise
/// hides.
#[test]
fn sharp_folds_survive_noise() {
    for (size, accuracy) in [(1e-13, 1e-11), (1e-12, 1e-10), (1e-11, 1e-7), (1e-10, 1e-6)] {
        for radius in [0.0, 1e-8, 1e-7, 1e-5, 1e-3] {
            for step in [0.05, 0.001] {
                let hairpin = move |x: f64| {
                    let root = x.hypot(radius);
                    let sign = if radius == 0.0 { x.signum() } else { x / root };
                    (-root, -sign, u64::from(x > 0.0))
                };
                let start = mixed_point(4, 0.2, -0.5, -0.5_f64.hypot(radius));
                let mut problem = mixed(4, 0.2, noisy_graph(size, hairpin));
                let branch = up(&mut problem, &start, -0.6, 1.0, steps_of(step));
                assert_reached_end(&branch, -0.6);
                assert_eq!(folds(&branch).len(), 1, "noise {size}, radius {radius}, step {step}");
                assert_abs_diff_eq!(folds(&branch)[0], -radius, epsilon = accuracy);
            }
        }
    }
}

#[test]
fn smooth_folds_survive_noise_at_no_cost() {
    for size in [1e-13, 1e-12, 1e-11, 1e-10] {
        for (step, evaluations) in [(0.05, 1.85), (0.01, 1.5), (0.001, 1.05)] {
            let sine = |x: f64| (x / 20.0 + x.sin(), 0.05 + x.cos(), 0);
            let mut problem = mixed(4, 0.2, noisy_graph(size, sine));
            let branch = up(&mut problem, &mixed_point(4, 0.2, 0.0, 0.0), -1.0, 1.5, steps_of(step));
            assert_reached_end(&branch, 1.5);
            assert_eq!(folds(&branch).len(), 4);
            assert!(evaluations_per_point(&branch) < evaluations, "{size} {step} {:?}", branch.counters);
        }
    }
}
