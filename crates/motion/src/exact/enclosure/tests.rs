//! The bounds against the motion inside solved steps, read by quadrature, and against closed forms.

use faer::Mat;
use hammerbeam_structure::ReducedModel;

use super::{HALVINGS, Hermite, MOST, is_above};
use crate::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    exact::{
        ExactIntegrator, ExactSettings,
        collocation::{Grading, NODES},
        event::Event,
        run::Run,
    },
    law::{AcrossHole, HertzStop, HuntCrossleyStop, LinearStop, RoundHole},
};

/// Excitation frequency of the stretch [Hz].
const FREQUENCY: f64 = 0.4;

/// A structure of two modes with an element on each of two points.
#[derive(Debug, Clone, Copy)]
struct Modes {
    frequencies: [f64; 2],
    /// Of each mode, and what couples them.
    damping: [f64; 3],
    /// Orders of the load with their amplitudes.
    load: [(u32, f64); 2],
}

impl Modes {
    /// Damped and driven by two orders.
    fn with(frequencies: [f64; 2]) -> Self {
        let [first, second] = frequencies.map(|w| 0.06 * w);
        Self { frequencies, damping: [first, second, 0.2], load: [(1, 0.8), (3, 0.8)] }
    }

    /// Under loads without a steady response: a body that is free, or has a damper; resonance of the second
    /// order, exact or nearly, beside a body that is free.
    fn under_secular_loads() -> [Self; 4] {
        let resonant = std::f64::consts::TAU * FREQUENCY * 2.0;
        let of = |frequencies, damping, load| Self { frequencies, damping, load };
        [
            of([0.0, 7.0], [0.0, 0.2, 0.0], [(0, 9.0), (1, 0.8)]),
            of([0.0, 7.0], [1.5, 0.2, 0.0], [(0, 9.0), (1, 0.8)]),
            of([3.0, resonant], [0.2, 0.0, 0.0], [(2, 3.0), (1, 0.8)]),
            of([0.0, resonant * (1.0 + 5e-5)], [0.3, 1e-4, 0.0], [(0, -4.0), (2, 3.0)]),
        ]
    }

    fn integrator(&self, laws: [Law; 2]) -> ExactIntegrator {
        let model = ReducedModel {
            damping: Mat::from_fn(2, 2, |i, j| self.damping[if i == j { i } else { 2 }]),
            natural_frequencies: self.frequencies.to_vec(),
            points: vec![],
            supports: vec![],
            uniform_acceleration: vec![0.0; 2],
        };
        let shapes = [vec![1.0, 0.6], vec![0.7, -1.1]];
        let elements = laws.into_iter().zip(shapes.clone()).map(|(law, shape)| LocalElement {
            name: "element".into(),
            shape,
            support_ratios: vec![0.0],
            law,
        });
        let force = |(order, amplitude): (u32, f64)| HarmonicForce {
            shape: shapes[0].clone(),
            harmonic: Harmonic { order, amplitude, phase: 0.3 * f64::from(order) },
        };
        let load = Load { support: vec![], forces: self.load.map(force).to_vec() };
        let system = System::new(model, &load, elements.collect()).unwrap();
        ExactIntegrator::new(system, ExactSettings::default()).unwrap()
    }
}

/// An integrator with one step solved from a state in which both contacts are closed.
fn solved(laws: [Law; 2], modes: Modes, length: f64, grading: Grading) -> (ExactIntegrator, Run) {
    let mut integrator = modes.integrator(laws);
    let stretch = Stretch { frequency_hz: FREQUENCY, start: 0.2, end: 8.0 };
    let mut run = integrator.begin(&stretch, &[0.3, 0.02, 0.4, 0.1], false).unwrap();
    let contact = |law: &Law| (!law.contacts().is_empty()).then_some(0);
    run.closed = integrator.laws.iter().map(contact).collect();
    integrator.note_start(&mut run, 20.0);
    integrator.set_active(&run);
    integrator.attempt(&run, length, grading).expect("the step is solved");
    (integrator, run)
}

fn value(coefficients: &[f64], s: f64) -> f64 {
    let mut values = coefficients.to_vec();
    for level in 1..values.len() {
        for i in 0..values.len() - level {
            values[i] = (1.0 - s) * values[i] + s * values[i + 1];
        }
    }
    values[0]
}

/// How far the polynomials of one step are from the motion in it, relative to what is allowed, for
/// penetration and pressure of both contacts.
fn largest_distance((integrator, run): &(ExactIntegrator, Run)) -> f64 {
    let (grading, length) = (integrator.step.grading(), integrator.step.length);
    let hermite = Hermite::of(grading);
    let mut largest = 0.0_f64;
    for sought in integrator.possible_ends(run).collect::<Vec<_>>() {
        let element = sought.1.element();
        let mut guard = integrator.guard_of(run, sought.0, sought.1).unwrap();
        let remainder = match integrator.laws[element].round_hole() {
            Some(hole) => integrator.reading_remainder(run, element, hole),
            None => integrator.remainder(run, element, guard.parts),
        };
        let pressure = integrator.laws[element].pressure();
        let rounding = 1e3 * guard.rounding;
        guard.rounding = 0.0;
        let middle = hermite.lower(&guard, length, 0.0);
        let lowest = hermite.lower(&guard, length, remainder);
        for place in 0..=60 {
            let s = f64::from(place) / 60.0;
            let (time, mut state) = (grading.map(s).0 * length, run.state.clone());
            integrator.carry_in_step(&mut state, 0.0, time);
            let jet = integrator.forced_element_jet(&state, element, time);
            let level = integrator.closed_contact(run, element).unwrap().level;
            let expected = match (sought.1, pressure) {
                (Event::Part(_), Some(pressure)) => pressure.at(jet.value - level, jet.slope),
                _ => jet.value - level,
            };
            let [middle, lowest] = [middle, lowest].map(|c| value(&c[..hermite.count], s));
            let distance = (expected - middle).abs();
            assert!(distance <= (middle - lowest) + rounding, "{grading:?} {sought:?} at {s}: {distance:e}");
            if middle - lowest > rounding {
                largest = largest.max(distance / (middle - lowest));
            }
        }
    }
    largest
}

#[test]
fn the_motion_stays_within_the_bounds_of_its_polynomial() {
    let damped = Law::Linear(LinearStop::with_preload(5.0, 8.0).unwrap().with_damping(0.7).unwrap());
    let laws = [
        [Law::Linear(LinearStop::with_preload(3.0, 9.0).unwrap()), damped.clone()],
        [
            Law::Hertz(HertzStop::with_preload(3.0, 9.0).unwrap()),
            Law::Hertz(HertzStop::with_gap(2.0, 0.0).unwrap()),
        ],
        [
            Law::HuntCrossley(
                HuntCrossleyStop::new(HertzStop::with_preload(3.0, 9.0).unwrap(), 0.4).unwrap(),
            ),
            damped,
        ],
    ];
    let mut largest = 0.0_f64;
    for laws in laws {
        for frequencies in [[1.0, 3.0], [2.0, 7.0]] {
            for length in [0.05, 0.3, 0.9, 1.8] {
                for grading in [Grading::Smooth, Grading::Touch, Grading::Release] {
                    let solved = solved(laws.clone(), Modes::with(frequencies), length, grading);
                    largest = largest.max(largest_distance(&solved));
                }
            }
        }
    }
    assert!((1e-3..=1.0).contains(&largest), "the bounds are met and not absurdly wide: {largest:e}");
}

fn hole() -> [Law; 2] {
    [Law::RoundHole(RoundHole::linear(3.0, 0.2).unwrap()), Law::AcrossHole(AcrossHole)]
}

/// Theorems 3 and 5.
#[test]
fn so_it_does_under_secular_loads_also_in_a_round_hole() {
    let damped = Law::Linear(LinearStop::with_preload(5.0, 8.0).unwrap().with_damping(0.7).unwrap());
    let stops = [Law::Hertz(HertzStop::with_preload(3.0, 9.0).unwrap()), damped];
    // Products of two series are wider than one, most of all beside a resonant load.
    for (laws, least) in [(stops, 1e-4), (hole(), 1e-7)] {
        let mut largest = [0.0_f64; 4];
        for (modes, largest) in Modes::under_secular_loads().into_iter().zip(&mut largest) {
            for length in [0.05, 0.3, 0.9, 1.8] {
                for grading in [Grading::Smooth, Grading::Touch, Grading::Release] {
                    let solved = solved(laws.clone(), modes, length, grading);
                    *largest = largest.max(largest_distance(&solved));
                }
            }
        }
        assert!(largest.iter().all(|part| (least..=1.0).contains(part)), "{laws:?}: {largest:?}");
    }
}

/// The first coefficients of `y << Y`, which the products of theorem 5 need: the displacement, its slope and
/// half its second derivative.
#[test]
fn series_of_displacements_hold_what_secular_loads_do() {
    for modes in Modes::under_secular_loads() {
        for length in [0.05, 0.9] {
            let (integrator, run) = solved(hole(), modes, length, Grading::Smooth);
            for output in [0, 1] {
                let series = integrator.displacement_series(&run, output);
                for place in 0..=60 {
                    let (time, mut state) = (length * f64::from(place) / 60.0, run.state.clone());
                    integrator.carry_in_step(&mut state, 0.0, time);
                    let jet = integrator.forced_jet(&state, output, time);
                    let parts = [jet.value, length * jet.slope, 0.5 * length * length * jet.curvature];
                    for (part, bound) in parts.into_iter().zip(series) {
                        assert!(
                            part.abs() <= bound * (1.0 + 1e-12),
                            "{modes:?} {length}: {jet:?} {series:?}"
                        );
                    }
                }
            }
        }
    }
}

/// Theorem 4, for displacements and velocities.
#[test]
fn what_all_blocks_have_in_common_bounds_their_sum() {
    let hertz = Law::Hertz(HertzStop::with_preload(3.0, 9.0).unwrap());
    let damped = Law::Linear(LinearStop::with_preload(5.0, 8.0).unwrap().with_damping(0.7).unwrap());
    let steady = [[1.0, 1.0], [1.0, 3.0], [2.0, 7.0]].map(Modes::with);
    for modes in steady.into_iter().chain(Modes::under_secular_loads()) {
        for grading in [Grading::Smooth, Grading::Touch, Grading::Release] {
            let (integrator, run) = solved([hertz.clone(), damped.clone()], modes, 0.9, grading);
            for (element, parts) in [(0, [1.0, 0.0]), (1, [1.0, 0.0]), (1, [0.3, 0.7])] {
                let sum = integrator.remainder(&run, element, parts);
                let common = integrator.common_remainder(&run, element, parts);
                assert!(sum > 0.0 && sum <= common, "{modes:?} {grading:?}: {sum:e}, {common:e}");
            }
        }
    }
}

#[test]
fn what_is_kept_of_the_end_of_a_step_goes_with_the_step() {
    let hertz = Law::Hertz(HertzStop::with_preload(3.0, 9.0).unwrap());
    let (mut integrator, run) = solved([hertz.clone(), hertz], Modes::with([1.0, 3.0]), 0.3, Grading::Smooth);
    let read = integrator.free_jet_at_step_end(&run, 1);
    integrator.keep_step_end(&run, 1);
    assert_eq!(integrator.free_jet_at_step_end(&run, 1), read);
    integrator.attempt(&run, 0.2, Grading::Smooth).expect("the step is solved");
    let shorter = integrator.free_jet_at_step_end(&run, 1);
    assert!(shorter.value != read.value && integrator.step.known_ends.is_empty());
}

/// `Omega A z^n/n!` with `Omega = (12!)^2/24! = 1/2704156`.
#[test]
fn a_mode_in_a_smooth_step_has_the_remainder_of_its_power_series() {
    let series = super::remainder::DerivativeSeries::of(Grading::Smooth);
    let (z, amplitude) = (2.0_f64, 0.7);
    let factorial: f64 = (1..=16).map(f64::from).product();
    let expected = amplitude * z.powi(16) / factorial;
    let [displacement, _] = series.last(z, amplitude * z, &[0.0; NODES]);
    assert!((displacement / expected - 1.0).abs() < 1e-14);
    let hermite = Hermite::of(Grading::Smooth);
    // `omega` times the largest of `binomial(11, j)/binomial(15, j + 2)`, at the middle.
    let largest = hermite.margin.iter().fold(0.0_f64, |largest, m| largest.max(*m));
    assert!((largest * 2_704_156.0 - 462.0 / 6435.0).abs() < 1e-9, "{largest:e}");
}

/// What is given comes back, to rounding: polynomials of the full degree.
#[test]
fn polynomials_of_the_degree_are_met() {
    for grading in [Grading::Smooth, Grading::Touch, Grading::Release] {
        let hermite = Hermite::of(grading);
        let t = |s: f64| grading.map(s).0;
        // A polynomial in the time is one of twice the degree in s where the step is graded.
        let degree = if grading == Grading::Smooth { 15 } else { 8 };
        let of = |s: f64| (t(s) - 0.3).powi(degree) + 0.1 * t(s);
        let slope = |s: f64| f64::from(degree) * (t(s) - 0.3).powi(degree - 1) + 0.1;
        let guard = super::Guard {
            nodal: grading.rule().s.map(of),
            values: [of(0.0), of(1.0)],
            slopes: [slope(0.0), slope(1.0)],
            parts: [1.0, 0.0],
            rounding: 0.0,
        };
        let coefficients = hermite.lower(&guard, 1.0, 0.0);
        for place in 0..=40 {
            let s = f64::from(place) / 40.0;
            assert!((value(&coefficients[..hermite.count], s) - of(s)).abs() < 1e-11, "{grading:?} {s}");
        }
    }
}

fn bernstein(of: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64) -> [f64; MOST] {
    let guard = super::Guard {
        nodal: Grading::Smooth.rule().s.map(&of),
        values: [of(0.0), of(1.0)],
        slopes: [slope(0.0), slope(1.0)],
        parts: [1.0, 0.0],
        rounding: 0.0,
    };
    Hermite::of(Grading::Smooth).lower(&guard, 1.0, 0.0)
}

/// Simple and double zeros at either end of the step, those of contacts that were just touched and of a turn
/// at the level, are no openings.
#[test]
fn zeros_at_the_ends_of_a_step_do_not_hinder_the_proof() {
    for (from, to) in [(1, 0), (0, 1), (1, 1), (2, 0), (0, 2), (2, 2), (1, 2)] {
        let power = |x: f64, k: i32| if k < 0 { 0.0 } else { x.powi(k) };
        let of = |s: f64| power(s, from) * power(1.0 - s, to);
        let slope = |s: f64| {
            f64::from(from) * power(s, from - 1) * power(1.0 - s, to)
                - f64::from(to) * power(s, from) * power(1.0 - s, to - 1)
        };
        let coefficients = bernstein(of, slope);
        assert!(is_above(&coefficients[..16], -1e-15, HALVINGS), "{from} {to}: {coefficients:?}");
    }
}

/// Behind the first node, between two, before the last; in the first and last gap, too, where no node is.
#[test]
fn a_dip_below_zero_is_never_proved_away() {
    for depth in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
        for bottom in [0.003, 0.02, 0.07, 0.31, 0.5, 0.77, 0.95, 0.985, 0.997] {
            let of = |s: f64| (s - bottom).powi(2) * (1.0 + s) - depth;
            let slope = |s: f64| 2.0 * (s - bottom) * (1.0 + s) + (s - bottom).powi(2);
            let coefficients = bernstein(of, slope);
            assert!(!is_above(&coefficients[..16], -1e-12, HALVINGS), "{depth:e} at {bottom}");
        }
    }
}
