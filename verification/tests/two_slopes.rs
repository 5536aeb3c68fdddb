//! A mass against a spring whose stiffness changes at a second gap.
//!
//! Between kinks of the force the motion is harmonic, so a free period is a sum of arcs. In a region where
//! `x'' = -w^2 (x - c)` the angle of the motion is `acos((x - c)/A)` with the amplitude A from the energy.
//! The deepest penetration d of a mass that comes with the speed v follows from
//! `m v^2/2 = k s^2/2 + k s b + k_2 b^2/2` with `b = d - s`. And a stop that stiffens is the sum of two
//! linear stops, the second behind the second gap, which the integrator computes with two contacts and no
//! kink.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::{PI, TAU};

use crate::common::{ObservedSystem, element_at, force_at, masses, response_of, single_mass, walk_both};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use hammerbeam_motion::{
    Law, Load, LocalElement, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
    law::{LinearStop, TwoSlopeStop},
};
use hammerbeam_orbit::{OrbitSettings, find_start, free_orbit};
use hammerbeam_structure::GROUND;

/// The stop: N/m, m, N/m, and its gap in m.
#[derive(Debug, Clone, Copy)]
struct Stop {
    stiffness: f64,
    second_gap: f64,
    second_stiffness: f64,
    gap: f64,
}

const STIFFENING: Stop = Stop { stiffness: 8.0, second_gap: 0.3, second_stiffness: 60.0, gap: 0.2 };
/// One that yields.
const SOFTENING: Stop = Stop { stiffness: 60.0, second_gap: 0.1, second_stiffness: 3.0, gap: 0.2 };

impl Stop {
    fn law(self) -> Law {
        let second = (self.second_gap, self.second_stiffness);
        Law::TwoSlopes(TwoSlopeStop::with_gap(self.stiffness, second, self.gap).unwrap())
    }

    /// The two linear stops that add up to it.
    fn as_sum(self) -> [Law; 2] {
        let linear = |stiffness, gap| Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap());
        let further = self.second_stiffness - self.stiffness;
        [linear(self.stiffness, self.gap), linear(further, self.gap + self.second_gap)]
    }

    /// Energy in the stop [J] at a displacement [m].
    fn energy(self, x: f64) -> f64 {
        let penetration = (x - self.gap).max(0.0);
        let (first, beyond) = (penetration.min(self.second_gap), (penetration - self.second_gap).max(0.0));
        let kink = self.stiffness * self.second_gap;
        0.5 * self.stiffness * first * first + beyond * (kink + 0.5 * self.second_stiffness * beyond)
    }

    /// Stiffness [N/m] and rest position [m] of the motion of a mass on 1 N/m at a displacement.
    fn region(self, x: f64) -> (f64, f64) {
        let kink = self.gap + self.second_gap;
        if x <= self.gap {
            (1.0, 0.0)
        } else if x <= kink {
            (1.0 + self.stiffness, self.stiffness * self.gap / (1.0 + self.stiffness))
        } else {
            let pushed = self.second_stiffness * kink - self.stiffness * self.second_gap;
            (1.0 + self.second_stiffness, pushed / (1.0 + self.second_stiffness))
        }
    }

    /// Period [s] of 1 kg on 1 N/m that turns at `x = amplitude`, beyond the gap.
    fn free_period(self, amplitude: f64) -> f64 {
        let whole = 0.5 * amplitude * amplitude + self.energy(amplitude);
        // Time from one displacement down to a lower one within a region.
        let arc = |[from, to]: [f64; 2]| {
            let (square, centre) = self.region(0.5 * (from + to));
            let speed = (2.0 * (whole - 0.5 * from * from - self.energy(from))).max(0.0).sqrt();
            let radius = (from - centre).hypot(speed / square.sqrt());
            let angle = |x: f64| ((x - centre) / radius).clamp(-1.0, 1.0).acos();
            (angle(to) - angle(from)) / square.sqrt()
        };
        let levels = [self.gap + self.second_gap, self.gap, -(2.0 * whole).sqrt()];
        let mut time = 0.0;
        let mut from = amplitude;
        for level in levels.into_iter().filter(|level| *level < amplitude) {
            time += arc([from, level]);
            from = level;
        }
        2.0 * time
    }
}

/// 1 kg on 1 N/m with a damper, a force `amplitude cos W t`, and the laws above it.
fn oscillator(laws: &[Law], damper: f64, amplitude: f64) -> ObservedSystem {
    let model = single_mass(1.0, 1.0, damper, false);
    let forces = if amplitude == 0.0 { vec![] } else { vec![force_at(&model, "mass", 1, amplitude)] };
    let elements = laws.iter().map(|law| element_at(&model, "mass", law.clone())).collect();
    let response = response_of(&model, "mass");
    ObservedSystem {
        system: System::new(model, &Load { support: vec![], forces }, elements).unwrap(),
        response,
    }
}

fn integrator(system: &System) -> ExactIntegrator {
    ExactIntegrator::new(system.clone(), ExactSettings::default()).unwrap()
}

/// The closed form itself: one region is half a period of `pi/w`, and with `k_2 = k` nothing happens at the
/// second gap, as in the bilinear oscillator, whose frequency is `2 w1 w2/(w1 + w2)`.
#[test]
fn the_closed_form_has_the_bilinear_oscillator_in_it() {
    let bilinear = Stop { stiffness: 3.0, second_gap: 0.3, second_stiffness: 3.0, gap: 0.0 };
    for amplitude in [0.1, 0.5, 2.0] {
        assert_relative_eq!(bilinear.free_period(amplitude), PI + PI / 2.0, max_relative = 1e-12);
    }
}

/// Turning within the first slope, just beyond the kink, and far beyond.
#[test]
fn free_period_is_the_sum_of_its_arcs() {
    for stop in [STIFFENING, SOFTENING] {
        let rig = oscillator(&[stop.law()], 0.0, 0.0);
        let kink = stop.gap + stop.second_gap;
        for amplitude in [0.5 * (stop.gap + kink), 1.001 * kink, 1.2 * kink, 3.0] {
            let orbit = free_orbit(&rig.system, &rig.response, amplitude, &OrbitSettings::default()).unwrap();
            let expected = 1.0 / stop.free_period(amplitude);
            // Tolerance of the integrator.
            assert_relative_eq!(orbit.frequency_hz, expected, max_relative = 1e-8);
        }
    }
}

/// A free mass of 1 kg before the stop, which has no gap.
fn free_mass(stop: Stop) -> System {
    let model = masses(&[("mass", 1.0)], &[], &[], false);
    let element = element_at(&model, "mass", Stop { gap: 0.0, ..stop }.law());
    System::new(model, &Load::default(), vec![element]).unwrap()
}

/// A free mass comes with the speed v, stops at the depth d of the energy balance, and leaves with -v after
/// twice the time of its arcs. It is one contact.
#[test]
fn an_impact_gives_back_its_energy_as_one_contact() {
    for stop in [STIFFENING, SOFTENING] {
        let Stop { stiffness: k, second_gap: s, second_stiffness: k_2, .. } = stop;
        let system = free_mass(stop);
        for speed in [0.5 * k.sqrt() * s, 1.001 * k.sqrt() * s, 2.0] {
            // v^2 = k s^2 + 2 k s b + k_2 b^2.
            let left = speed * speed - k * s * s;
            let beyond = if left > 0.0 { ((k * s).hypot((k_2 * left).sqrt()) - k * s) / k_2 } else { 0.0 };
            let (deepest, at_kink) = (s + beyond, left.max(0.0).sqrt());
            let first = (k.sqrt() * s / speed).min(1.0).asin() / k.sqrt();
            // Behind the kink the mass turns about the penetration at which the second slope would be zero.
            let second = (at_kink * k_2.sqrt()).atan2(k * s) / k_2.sqrt();
            let [time, force] = if left > 0.0 {
                [2.0 * (first + second), k * s + k_2 * beyond]
            } else {
                [PI / k.sqrt(), k.sqrt() * speed]
            };
            let (before, after) = (0.3, 0.2);
            let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: before + time + after };
            let mut exact = integrator(&system);
            let trace = exact.trace(&stretch, &[-before * speed, speed], &[before + 0.5 * time]).unwrap();
            assert_abs_diff_eq!(trace.state[0], -after * speed, epsilon = 1e-9 * speed);
            assert_abs_diff_eq!(trace.state[1], -speed, epsilon = 1e-10 * speed);
            if left > 0.0 {
                assert_relative_eq!(trace.samples[0][0], deepest, max_relative = 1e-9);
            }
            let [piece] = trace.contacts.as_slice() else { panic!("{} contacts", trace.contacts.len()) };
            assert_relative_eq!(piece.impulse, 2.0 * speed, max_relative = 1e-9);
            assert_abs_diff_eq!(piece.energy_lost, 0.0, epsilon = 1e-9 * speed * speed);
            assert_relative_eq!(piece.peak_force, force, max_relative = 1e-4);
            exact.begin_course();
            let start = [-before * speed, speed];
            let maxima = exact.observe(&[(stretch, &start)]).unwrap();
            assert_eq!(maxima.touches, 1);
            assert_relative_eq!(maxima.contact_force, force, max_relative = 1e-9);
            assert_relative_eq!(maxima.impact_velocity, speed, max_relative = 1e-9);
        }
    }
}

/// The same by the general integrator, also where the mass comes just beyond the kink: a step that passed it
/// there and back would be off by the part of the second slope.
#[test]
fn the_general_integrator_gives_back_the_energy_of_an_impact() {
    for stop in [STIFFENING, SOFTENING] {
        let Stop { stiffness: k, second_gap: s, second_stiffness: k_2, .. } = stop;
        let system = free_mass(stop);
        for beyond in [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.3, 3.0] {
            let speed = (1.0 + beyond) * k.sqrt() * s;
            let at_kink = (speed * speed - k * s * s).sqrt();
            let first = (k.sqrt() * s / speed).asin() / k.sqrt();
            let second = (at_kink * k_2.sqrt()).atan2(k * s) / k_2.sqrt();
            let (before, after) = (0.3, 0.2);
            let end = before + 2.0 * (first + second) + after;
            let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end };
            let settings = GeneralSettings::with_tolerance(1e-12);
            let flow = advance(&system, &stretch, &[-before * speed, speed], &settings).unwrap().flow;
            assert_abs_diff_eq!(flow.state[0], -after * speed, epsilon = 1e-10 * speed);
            assert_abs_diff_eq!(flow.state[1], -speed, epsilon = 1e-10 * speed);
        }
    }
}

/// Pressed by a constant force F, a mass on 1 N/m with a strong damper comes to rest where the spring and the
/// second slope balance it: `x = (F - k s + k_2 (g + s))/(1 + k_2)`.
#[test]
fn a_constant_force_presses_to_the_depth_of_the_balance() {
    for stop in [STIFFENING, SOFTENING] {
        let (model, force) = (single_mass(1.0, 1.0, 8.0, false), 9.0);
        let load = Load { support: vec![], forces: vec![force_at(&model, "mass", 0, force)] };
        let element = element_at(&model, "mass", stop.law());
        let system = System::new(model, &load, vec![element]).unwrap();
        let stretch = Stretch { frequency_hz: 0.01, start: 0.0, end: 2.0 };
        let end = integrator(&system).advance(&stretch, &[0.0, 0.0]).unwrap();
        let (square, centre) = stop.region(1.0);
        assert_relative_eq!(end[0], centre + force / square, max_relative = 1e-9);
    }
}

/// State, sensitivities and the column of the frequency over three periods of a motion that passes the kink
/// many times, from states on all sides of it. The bound is what two integrations at the default tolerance
/// leave.
#[test]
fn flows_are_those_of_two_linear_stops() {
    let [one, sum] = [vec![STIFFENING.law()], STIFFENING.as_sum().to_vec()];
    let [one, sum] = [one, sum].map(|laws| integrator(&oscillator(&laws, 0.05, 1.3).system));
    let (mut one, mut sum) = (one, sum);
    let stretch = Stretch { frequency_hz: 0.21, start: 0.1, end: 3.1 };
    for state in [[0.0, 0.3], [0.35, -0.4], [0.5, 0.2], [0.7, 0.0], [-1.0, 2.0]] {
        let [found, expected] = [&mut one, &mut sum].map(|exact| exact.flow(&stretch, &state).unwrap());
        let size = (0..2).flat_map(|i| (0..2).map(move |j| (i, j)));
        let size = size.map(|at| expected.by_state[at].abs()).fold(1.0, f64::max);
        for i in 0..2 {
            assert_abs_diff_eq!(found.state[i], expected.state[i], epsilon = 1e-9);
            let frequency = expected.by_frequency[i].abs().max(size);
            assert_abs_diff_eq!(found.by_frequency[i], expected.by_frequency[i], epsilon = 1e-8 * frequency);
            for j in 0..2 {
                assert_abs_diff_eq!(found.by_state[(i, j)], expected.by_state[(i, j)], epsilon = 1e-8 * size);
            }
        }
        assert!(one.touches().len() == 1 && sum.touches()[1] > 0, "{:?}", sum.touches());
        assert_eq!(one.touches()[0], sum.touches()[0]);
    }
}

/// Orbits of the two systems have the same multipliers; the largest force is that of the two stops at the
/// deepest penetration.
#[test]
fn orbits_and_multipliers_are_those_of_two_linear_stops() {
    let settings = OrbitSettings::default();
    let [one, sum] = [oscillator(&[STIFFENING.law()], 0.1, 1.0), oscillator(&STIFFENING.as_sum(), 0.1, 1.0)];
    let mut passages = 0;
    for frequency_hz in [0.19, 0.23, 0.3] {
        let [found, expected] = [&one, &sum]
            .map(|rig| find_start(&rig.system, &rig.response, frequency_hz, 1, &settings).unwrap());
        let (x, y) = (found.maxima.displacement, expected.maxima.displacement);
        assert_relative_eq!(x, y, max_relative = 1e-8);
        for (a, b) in found.floquet_multipliers.iter().zip(&expected.floquet_multipliers) {
            assert_abs_diff_eq!(a[0], b[0], epsilon = 1e-7);
            assert_abs_diff_eq!(a[1], b[1], epsilon = 1e-7);
        }
        assert_eq!(found.maxima.contacts, 1);
        passages += expected.maxima.contacts - 1;
    }
    assert!(passages > 0, "no orbit comes to the kink");
}

/// A branch goes through the frequencies at which its orbits come to the kink, where there is no event: its
/// peak, and the force there, are those of the two linear stops.
#[test]
fn a_branch_passes_the_kink_as_that_of_two_linear_stops_does() {
    let settings = OrbitSettings { max_step: 0.002, ..OrbitSettings::default() };
    let range_hz = (1.05 / TAU, 1.9 / TAU);
    let [one, sum] = [oscillator(&[STIFFENING.law()], 0.2, 0.3), oscillator(&STIFFENING.as_sum(), 0.2, 0.3)];
    let [found, expected] = [&one, &sum].map(|rig| walk_both(rig, 1.06 / TAU, range_hz, &settings));
    let [peak, other] = [&found, &expected].map(|walked| walked.peak(range_hz.0, range_hz.1));
    let height = peak.solution.maxima.displacement;
    assert!(height > STIFFENING.gap + STIFFENING.second_gap, "{height}: the kink is not reached");
    // Peaks lie between points, whose distance leaves some 1e-4 of them.
    assert_relative_eq!(height, other.solution.maxima.displacement, max_relative = 1e-3);
    let kinks = |rows: &[hammerbeam_orbit::BranchRow]| rows.iter().filter(|row| row.events.grazing).count();
    assert!(kinks(&found.rows) < kinks(&expected.rows), "the second gap is no event");
    let (folds, others) = (found.folds(), expected.folds());
    assert_eq!(folds.len(), others.len());
    for (fold, other) in folds.iter().zip(&others) {
        assert_relative_eq!(fold, other, max_relative = 1e-7);
    }
}

/// Two masses with random numbers: second slopes up to thirty times the first, kinks from shallow to deep,
/// another stop at the same mass. What differs is the error of two integrations, which impacts amplify as the
/// largest sensitivity says.
#[test]
fn random_motions_are_those_of_two_linear_stops() {
    let mut random = hammerbeam_verification::attractors::Random::new(7);
    let mut between = |low: f64, high: f64| low + (high - low) * random.part();
    let mut passed = 0;
    for case in 0..60 {
        let (k, ratio) = (between(2.0, 60.0), between(1.05, 30.0));
        let stop = Stop {
            stiffness: k,
            second_gap: between(0.005, 0.4),
            second_stiffness: ratio * k,
            gap: between(0.0, 0.4),
        };
        let springs = [("a", GROUND, between(0.5, 2.0)), ("a", "b", between(1.0, 4.0))];
        let model = masses(
            &[("a", 1.0), ("b", between(0.3, 1.5))],
            &springs,
            &[("a", GROUND, between(0.02, 0.2)), ("b", GROUND, 0.1)],
            false,
        );
        let load = Load { support: vec![], forces: vec![force_at(&model, "b", 1, between(0.5, 2.0))] };
        let other = Law::Linear(LinearStop::with_gap(between(1.0, 30.0), between(0.1, 0.6)).unwrap());
        let other = LocalElement { shape: response_of(&model, "b").shape, ..element_at(&model, "a", other) };
        let system = |laws: &[Law]| {
            let of_law = |law: &Law| element_at(&model, "a", law.clone());
            let elements = laws.iter().map(of_law).chain([other.clone()]).collect();
            System::new(model.clone(), &load, elements).unwrap()
        };
        let start: Vec<f64> = (0..4).map(|_| between(-0.6, 0.6)).collect();
        let stretch = Stretch { frequency_hz: between(0.1, 0.4), start: 0.0, end: 2.0 };
        let [mut one, mut sum] =
            [vec![stop.law()], stop.as_sum().to_vec()].map(|laws| integrator(&system(&laws)));
        let found = one.flow(&stretch, &start).unwrap_or_else(|error| panic!("case {case}: {error}"));
        let expected = sum.flow(&stretch, &start).unwrap();
        let at = |i: usize| (i / 4, i % 4);
        let size = (0..16).map(|i| expected.by_state[at(i)].abs()).fold(1.0, f64::max);
        for i in 0..16 {
            assert_abs_diff_eq!(found.by_state[at(i)], expected.by_state[at(i)], epsilon = 1e-7 * size);
        }
        for i in 0..4 {
            assert_abs_diff_eq!(found.state[i], expected.state[i], epsilon = 1e-9 * size);
        }
        passed += sum.touches()[1];
    }
    assert!(passed >= 40, "{passed} passages of the kink");
}
