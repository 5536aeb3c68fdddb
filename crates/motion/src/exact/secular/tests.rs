//! The motion from rest against exponentials of the joined system, differences and quadrature; its bounds
//! against the motion.

use std::f64::consts::TAU;

use faer::c64;

use super::{
    super::{
        block::Blocks,
        matrix_exponential::{Square, exponential},
        output::Output,
        propagator::Propagator,
    },
    SecularLoad,
};

/// A load and its block as they are at an excitation frequency.
#[derive(Debug, Clone, Copy)]
struct Case {
    /// `(k, c)`.
    block: (f64, f64),
    order: f64,
    /// Excitation frequency of the load, and the one where its inputs are as given [Hz].
    frequency_hz: f64,
    around_hz: f64,
    input: [c64; 2],
    input_by_frequency: [c64; 2],
    angle: f64,
}

impl Case {
    fn load(&self) -> SecularLoad {
        let moved = self.frequency_hz - self.around_hz;
        let input = [0, 1].map(|row| self.input[row] + self.input_by_frequency[row] * moved);
        let w = TAU * self.order * self.frequency_hz;
        SecularLoad::new(0, self.block, input, self.input_by_frequency, (w, TAU * self.order), self.angle)
    }

    /// The load in the joined system of [`joined`].
    fn turned(&self) -> [[c64; 2]; 2] {
        let turned = c64::new(self.angle.cos(), self.angle.sin());
        [self.input, self.input_by_frequency].map(|input| input.map(|u| u * turned))
    }

    /// Times up to 40 periods or decays.
    fn times(&self) -> [f64; 7] {
        let ((k, c), unit) = (self.block, TAU);
        [1e-7, 1e-3, 0.04, 0.3, 1.0, 7.0, 40.0].map(|x| x * unit / (k.sqrt() + c).max(0.5))
    }
}

/// Free blocks without damping and with light and heavy damping; slow ones, and one that is not; blocks at
/// resonance and on both sides of it, with damping and without, at both ends of what is near.
fn cases() -> Vec<Case> {
    let input = [c64::new(0.3, 0.0), c64::new(-1.7, 0.0)];
    let slope = [c64::new(-0.2, 0.0), c64::new(0.9, 0.0)];
    let constant = |block: (f64, f64)| Case {
        block,
        order: 0.0,
        frequency_hz: 2.0,
        around_hz: 2.0,
        input,
        input_by_frequency: slope,
        angle: 0.0,
    };
    let resonant = |(detuning, ratio): (f64, f64)| {
        let (hz, order, angle) = (0.7, 3.0, 0.8);
        let w: f64 = TAU * hz * order;
        Case {
            block: ((w * (1.0 + detuning)).powi(2), 2.0 * ratio * w),
            order,
            frequency_hz: hz,
            around_hz: hz,
            input: [c64::new(0.3, -0.1), c64::new(-1.7, 0.6)],
            input_by_frequency: [c64::new(-0.2, 0.5), c64::new(0.9, 0.1)],
            angle,
        }
    };
    let near = [
        (0.0, 0.0),
        (1e-12, 0.0),
        (-1e-9, 1e-10),
        (1e-6, 0.0),
        (9e-5, 0.0),
        (-9e-5, 3e-5),
        (0.0, 9e-5),
        (1e-5, 1e-7),
    ];
    let free = [0.0, 1e-9, 0.02, 1.0, 35.0].map(|c| (0.0, c));
    let slow = [(1e-12, 0.0), (1e-6, 1e-4), (3e-3, 0.0), (0.01, 0.09), (2.0, 1.0)];
    free.into_iter().chain(slow).map(constant).chain(near.map(resonant)).collect()
}

/// p, s, their derivatives by the frequency, C, S, t C and t S in one system with constant coefficients.
fn joined(case: &Case) -> Square<8> {
    let (k, c) = case.block;
    let (w, rate) = (TAU * case.order * case.frequency_hz, TAU * case.order);
    let [input, by_frequency] = case.turned();
    let mut system = [[0.0; 8]; 8];
    for offset in [0, 2] {
        system[offset][offset + 1] = 1.0;
        system[offset + 1][offset] = -k;
        system[offset + 1][offset + 1] = -c;
    }
    for row in 0..2 {
        (system[row][4], system[row][5]) = (input[row].re, -input[row].im);
        (system[2 + row][4], system[2 + row][5]) = (by_frequency[row].re, -by_frequency[row].im);
        (system[2 + row][6], system[2 + row][7]) = (-rate * input[row].im, -rate * input[row].re);
    }
    (system[4][5], system[5][4]) = (-w, w);
    (system[6][7], system[7][6]) = (-w, w);
    (system[6][4], system[7][5]) = (1.0, 1.0);
    system
}

/// The motion, its first four derivatives by the time, and the derivatives by the frequency of the motion and
/// of its rate.
#[test]
fn motions_are_those_of_the_exponential_of_the_joined_system() {
    for case in cases() {
        let (load, system) = (case.load(), joined(&case));
        let unit = case.block.0.sqrt().max(1.0);
        for time in case.times() {
            let found: [[f64; 2]; 5] = load.derivatives(time);
            let by_frequency = load.by_frequency(time);
            let exponential = exponential(&system, time);
            let mut states: [f64; 8] = std::array::from_fn(|row| exponential[row][4]);
            // Errors grow with the radians and with the squarings of the exponential.
            let rate = (unit + case.block.1) * time;
            let rounding = 4e-15 * (1.0 + rate);
            for (j, [p, s]) in found.into_iter().enumerate() {
                let scale = unit.powi(j as i32) * (1.0 + case.block.1).powi(j as i32);
                let size = (unit * states[0].abs() + states[1].abs()).max(2.0 * scale * time.max(1.0));
                let error = (unit * (p - states[0]).abs()).max((s - states[1]).abs()) / size;
                assert!(error < rounding, "{case:?} {time} {j}: {p} {s} {states:?} {error:e}");
                if j < 2 {
                    let [p, s] = by_frequency[j];
                    let reach = case.order * TAU * time + 1.0;
                    let error = (unit * (p - states[2]).abs()).max((s - states[3]).abs()) / (size * reach);
                    assert!(
                        error < rounding,
                        "{case:?} {time} by frequency {j}: {p} {s} {states:?} {error:e}"
                    );
                }
                states = system.map(|row| row.iter().zip(&states).map(|(a, x)| a * x).sum());
            }
        }
    }
}

/// A force `cos(w t)` on a block at rest: `p = t^2/2`, `s = t` and, since its slope by w is `-w t^2`, `p_f
/// = -w w' t^4/12`, `s_f = -w w' t^3/3`, all but for terms of `(w t)^2`.
#[test]
fn shortly_after_the_start_all_digits_are_kept() {
    let w = TAU * 1.3;
    let force = [c64::new(0.0, 0.0), c64::new(1.0, 0.0)];
    let load =
        SecularLoad::new(0, (w * w * (1.0 + 1e-5), 0.0), force, [c64::new(0.0, 0.0); 2], (w, TAU), 0.0);
    for time in [1e-9, 1e-7, 1e-5, 1e-3].map(|x| x / w) {
        let ([[p, s]], [[p_f, s_f], _]) = (load.derivatives(time), load.by_frequency(time));
        let slope = -w * TAU * time.powi(3);
        let parts = [p / (0.5 * time * time), s / time, p_f / (slope * time / 12.0), s_f / (slope / 3.0)];
        let allowed = (w * time).powi(2) + 1e-15;
        assert!(parts.iter().all(|part| (part - 1.0).abs() < allowed), "{time}: {parts:?}");
    }
}

/// By the frequency and by the damping of the block itself, by differences of the closed form.
#[test]
fn sensitivities_are_those_of_differences() {
    let differences = |step: f64, at: &dyn Fn(f64) -> [[f64; 2]; 2]| {
        let [x, y, z, w] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(k * step));
        let entry = |i: usize, j: usize| (8.0 * (z[i][j] - y[i][j]) - (w[i][j] - x[i][j])) / (12.0 * step);
        [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
    };
    for case in cases() {
        let (load, damping) = (case.load(), case.block.1);
        let unit = case.block.0.sqrt().max(1.0);
        let own = load.change(0, case.block, &[[0.0, 0.0], [0.0, -1.0]]);
        for time in case.times() {
            let moved =
                |step: f64| Case { frequency_hz: case.frequency_hz + step, ..case }.load().derivatives(time);
            // As many radians in the step as keep the next term of the differences below 1e-10.
            let by_frequency = differences(3e-3 / (TAU * case.order * time).max(1.0), &moved);
            let damped =
                |step: f64| Case { block: (case.block.0, damping + step), ..case }.load().derivatives(time);
            let by_damping = differences(3e-3 / time.max(1.0), &damped);
            let found: [[f64; 2]; 2] = own.derivatives(time);
            for (what, found, expected, factor) in [
                ("frequency", load.by_frequency(time), by_frequency, 1.0 + TAU * case.order * time),
                ("damping", found, by_damping, 1.0 + time),
            ] {
                let [[p, s], [v, a]] = load.derivatives(time);
                let sizes = [unit * p.abs() + s.abs(), unit * v.abs() + a.abs()];
                for j in 0..2 {
                    let size = (sizes[j] + unit * (1.0 + time)) * factor;
                    let error = (unit * (found[j][0] - expected[j][0]).abs())
                        .max((found[j][1] - expected[j][1]).abs())
                        / size;
                    assert!(error < 1e-9, "{case:?} {time} {what} {j}: {found:?} {expected:?} {error:e}");
                }
            }
        }
    }
}

/// `int_0^t E(t - v) K x(v) dv` by Simpson's rule, for blocks as fast, faster and without stiffness.
#[test]
fn the_change_of_another_block_is_the_integral_of_its_propagator() {
    let coupling = [[0.3, -0.02], [2.0, -0.7]];
    for case in cases() {
        let load = case.load();
        for block in [case.block, (3.0, 0.4), (900.0, 1.0), (0.0, 0.0), (0.0, 5.0)] {
            let change = load.change(1, block, &coupling);
            assert_eq!(change.block, 1);
            for time in [0.05, 0.9] {
                let panels = 4000;
                let mut sum = [0.0; 2];
                for i in 0..=panels {
                    let v = time * f64::from(i) / f64::from(panels);
                    let weight = if i == 0 || i == panels { 1.0 } else { 2.0 * f64::from(1 + i % 2) };
                    let [[p, s]] = load.derivatives(v);
                    let driven = coupling.map(|row| row[0] * p + row[1] * s);
                    let (p, s) = Propagator::new(block.0, block.1, time - v).apply(driven[0], driven[1]);
                    let weight = weight * time / (3.0 * f64::from(panels));
                    sum = [sum[0] + weight * p, sum[1] + weight * s];
                }
                let [[p, s]] = change.derivatives(time);
                let size = sum[0].abs() + sum[1].abs();
                let error = (p - sum[0]).abs().max((s - sum[1]).abs()) / size;
                assert!(error < 1e-9, "{case:?} {block:?} {time}: {p} {s} {sum:?} {error:e}");
            }
        }
    }
}

/// At many times; and they are met to a factor, by each derivative of some of the loads.
#[test]
fn bounds_and_majorants_hold_and_are_not_absurdly_wide() {
    const N: usize = 16;
    // Of resonant loads, then of free ones.
    let mut closest = [[0.0_f64; N]; 2];
    for case in cases() {
        let load = case.load();
        let blocks = Blocks::of(vec![case.block], None);
        for row in [[1.0, 0.0], [0.0, 1.0], [0.7, -0.4]] {
            let output = Output::of_row(&blocks, row.to_vec(), &[]);
            for until in case.times() {
                let bounds: [f64; N] = load.bounds(&output, until);
                let majorant = load.majorant(&output, until);
                let closest = &mut closest[usize::from(load.is_constant())];
                assert!(bounds.iter().all(|bound| bound.is_finite()));
                for place in 0..=200 {
                    let states: [[f64; 2]; N] = load.derivatives(until * f64::from(place) / 200.0);
                    for (j, [p, s]) in states.into_iter().enumerate() {
                        let value = (row[0] * p + row[1] * s).abs();
                        let what = format!("{case:?} {row:?} {until} {place} {j}: {value:e}");
                        let least = value * (1.0 - 1e-12) - 1e-300;
                        assert!(least <= bounds[j], "{what} {:e}", bounds[j]);
                        closest[j] = closest[j].max(value / bounds[j].max(1e-300));
                        let all = match j {
                            0 => continue,
                            1 => majorant.speed,
                            _ => {
                                majorant.rate.powi(j as i32 - 2)
                                    * (majorant.rate * majorant.speed + majorant.acceleration)
                            }
                        };
                        assert!(least <= all, "{what} {all:e}");
                    }
                }
            }
        }
    }
    assert!(closest[1].iter().all(|ratio| *ratio > 0.99), "{closest:?}");
    // At resonance half of the size of a load that oscillates works.
    assert!(closest[0].iter().all(|ratio| (0.4..0.9).contains(ratio)), "{closest:?}");
}
