//! Round holes: against stops on both sides where motion stays in a plane, against the general integrator
//! where it does not, against differences, and against what is conserved.

use std::f64::consts::{PI, TAU};

use faer::Mat;
use hammerbeam_motion::{
    Law, LawError, Load, LocalElement, Parameter, Stretch, System, SystemError,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance, observe},
    law::{LinearStop, TwoSidedStop},
};

use crate::common::{
    assert_agreement, damped, differences::assert_sensitivities, element, force, hertz, integrator, model,
    rigid,
};

const GAP: f64 = 1e-3;

/// Modes of one plane.
struct Plane {
    rates: Vec<f64>,
    shape: Vec<f64>,
    ratio: f64,
}

/// A beam: five modes, from 20 Hz.
fn beam() -> Plane {
    let rates = [20.0, 125.0, 350.0, 690.0, 1140.0].map(|hz: f64| TAU * hz).to_vec();
    Plane { rates, shape: vec![1.9, -1.5, 1.1, -0.8, 0.9], ratio: 0.02 }
}

fn linear(stiffness: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness, GAP).unwrap())
}

impl Plane {
    fn spread(&self, values: &[f64], part: usize) -> Vec<f64> {
        values.iter().flat_map(|value| if part == 0 { [*value, 0.0] } else { [0.0, *value] }).collect()
    }

    /// A hole around the point, and forces on it in both directions: amplitudes and phases.
    fn with_hole(&self, law: &Law, forces: &[(usize, f64, f64)]) -> System {
        let rates: Vec<f64> = self.rates.iter().flat_map(|rate| [*rate, *rate]).collect();
        let n = rates.len();
        let damping = Mat::from_fn(n, n, |i, j| if i == j { 2.0 * self.ratio * rates[i] } else { 0.0 });
        let directions = [0, 1].map(|part| (self.spread(&self.shape, part), vec![]));
        let forces = forces
            .iter()
            .map(|&(part, amplitude, phase)| force(&self.spread(&self.shape, part), 1, amplitude, phase));
        let load = Load { support: vec![], forces: forces.collect() };
        let hole = law.in_round_hole().unwrap();
        let elements = LocalElement::round_hole("hole", directions, hole).to_vec();
        System::new(model(&rates, damping), &load, elements).unwrap()
    }

    /// The same in one plane between two stops.
    fn between_stops(&self, stiffness: f64, amplitude: f64) -> System {
        let n = self.rates.len();
        let damping = Mat::from_fn(n, n, |i, j| if i == j { 2.0 * self.ratio * self.rates[i] } else { 0.0 });
        let load = Load { support: vec![], forces: vec![force(&self.shape, 1, amplitude, 0.0)] };
        let law = Law::TwoSided(TwoSidedStop::new(stiffness, GAP, GAP).unwrap());
        System::new(model(&self.rates, damping), &load, vec![element(&self.shape, 0.0, law)]).unwrap()
    }
}

/// After four periods from rest, along a direction in the plane of the section; the same contacts.
#[test]
fn motion_in_a_plane_is_that_between_two_stops() {
    let (stiffness, amplitude, frequency_hz) = (2e5, 12.0, 27.0);
    let one = beam().between_stops(stiffness, amplitude);
    for angle in [0.0, 0.5, PI / 2.0, 2.3] {
        let (sin, cos) = f64::sin_cos(angle);
        let two =
            beam().with_hole(&linear(stiffness), &[(0, amplitude * cos, 0.0), (1, amplitude * sin, 0.0)]);
        let (mut straight, mut turned) = (vec![0.0; 10], vec![0.0; 20]);
        let (mut plain, mut round) = (integrator(&one), integrator(&two));
        let mut touches = 0;
        for _ in 0..4 {
            let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
            straight = plain.advance(&stretch, &straight).unwrap();
            turned = round.advance(&stretch, &turned).unwrap();
            assert_eq!(plain.touches().iter().sum::<u32>(), round.touches().iter().sum::<u32>());
            touches += round.touches()[0];
        }
        assert!(touches >= 8, "{touches}");
        let size = straight.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
        for (i, expected) in straight.iter().enumerate() {
            let scale = if i < 5 { beam().rates[i] } else { 1.0 };
            let error = [turned[2 * i] - cos * expected, turned[2 * i + 1] - sin * expected];
            assert!(error.iter().all(|error| error.abs() * scale < 2e-8 * size), "{angle}, {i}: {error:?}");
        }
        if angle == 0.0 {
            assert!(turned.iter().skip(1).step_by(2).all(|z| *z == 0.0), "{turned:?}");
        }
    }
}

/// Whirls, oblique impacts, slides along the wall.
fn motions() -> Vec<(System, Vec<f64>, &'static str)> {
    let turning = [(0, 9.0, 0.0), (1, 9.0, -PI / 2.0)];
    let elliptic = [(0, 12.0, 0.3), (1, 5.0, -1.1)];
    let mut oblique = vec![0.0; 20];
    (oblique[10], oblique[11]) = (0.12, 0.05);
    let mut sliding = vec![0.0; 20];
    (sliding[0], sliding[11]) = (0.53e-3, 0.09);
    let none: [(usize, f64, f64); 0] = [];
    vec![
        (beam().with_hole(&linear(2e5), &turning), vec![0.0; 20], "linear, turning load, from rest"),
        (beam().with_hole(&hertz(2e8, GAP), &turning), vec![0.0; 20], "Hertz, turning load, from rest"),
        (beam().with_hole(&linear(5e6), &elliptic), oblique.clone(), "linear, elliptic load, oblique"),
        (beam().with_hole(&hertz(4e9, GAP), &elliptic), oblique, "Hertz, elliptic load, oblique"),
        (beam().with_hole(&hertz(4e9, GAP), &none), sliding.clone(), "Hertz, free, sliding"),
        (beam().with_hole(&linear(3e4), &none), sliding, "linear, free, sliding"),
    ]
}

#[test]
fn flows_agree_with_the_general_integrator() {
    let mut touches = 0;
    for (system, state, what) in motions() {
        for (frequency_hz, end) in [(26.0, 1.0), (40.0, 1.4)] {
            let stretch = Stretch { frequency_hz, start: 0.25, end: 0.25 + end };
            touches += assert_agreement(&system, &stretch, &state, 1e-7, what);
        }
    }
    assert!(touches > 12, "{touches}");
}

#[test]
fn sensitivities_agree_with_differences() {
    let parameters = [
        Parameter::gap(0),
        Parameter::stiffness(0),
        Parameter::ExcitationScale,
        Parameter::ADDED_DAMPING_RATIO,
    ];
    for (system, state, _) in motions().into_iter().take(4) {
        let stretch = Stretch { frequency_hz: 26.0, start: 0.25, end: 1.0 };
        assert_sensitivities(&system, &stretch, &state, &parameters, 2e-6);
    }
}

/// Energy, and the moment of momentum about the axis where both planes are alike, of a free motion without
/// damping: of both integrators.
#[test]
fn energy_and_moment_of_momentum_are_kept() {
    let plane = Plane { ratio: 0.0, ..beam() };
    let mut state = vec![0.0; 20];
    (state[0], state[2], state[11], state[13]) = (0.2e-3, 0.1e-3, 0.16, -0.05);
    for (law, potential) in [
        (linear(2e5), (|p: f64| 0.5 * 2e5 * p * p) as fn(f64) -> f64),
        (hertz(1e9, GAP), |p: f64| 0.4 * 1e9 * p.powf(2.5)),
    ] {
        let system = plane.with_hole(&law, &[]);
        let energy = |state: &[f64]| {
            let displacement = |part: usize| -> f64 {
                system.elements()[part].shape.iter().zip(state).map(|(phi, q)| phi * q).sum()
            };
            let depth = (displacement(0).hypot(displacement(1)) - GAP).max(0.0);
            let rates = &system.model().natural_frequencies;
            let modes = (0..10).map(|i| 0.5 * (state[10 + i].powi(2) + (rates[i] * state[i]).powi(2)));
            modes.sum::<f64>() + potential(depth)
        };
        let moment = |state: &[f64]| {
            (0..10).step_by(2).map(|i| state[i] * state[11 + i] - state[i + 1] * state[10 + i]).sum::<f64>()
        };
        let stretch = Stretch { frequency_hz: 20.0, start: 0.0, end: 3.3 };
        let mut exact = integrator(&system);
        let ends = [
            exact.advance(&stretch, &state).unwrap(),
            advance(&system, &stretch, &state, &GeneralSettings::with_tolerance(1e-12)).unwrap().flow.state,
        ];
        assert!(exact.touches()[0] >= 3, "{:?}", exact.touches());
        for end in ends {
            assert!((energy(&end) / energy(&state) - 1.0).abs() < 1e-9, "{}", energy(&end) / energy(&state));
            assert!((moment(&end) / moment(&state) - 1.0).abs() < 1e-9, "{}", moment(&end) / moment(&state));
        }
    }
}

/// A mass on a spring turns with a force of constant size while it leans on the wall all the time, at the
/// radius R: `((k_0 + k - m W^2) R - k c)^2 + (d W R)^2 = F^2`.
#[test]
fn whirl_in_full_contact_is_the_closed_form() {
    let (spring, damper, wall, size) = (400.0, 3.0, 2e4, 4.0);
    let plane =
        Plane { rates: vec![f64::sqrt(spring)], shape: vec![1.0], ratio: damper / (2.0 * f64::sqrt(spring)) };
    let system = plane.with_hole(&linear(wall), &[(0, size, 0.0), (1, size, -PI / 2.0)]);
    for frequency_hz in [4.0, 8.0, 15.0] {
        let w = TAU * frequency_hz;
        let (a, d) = (spring + wall - w * w, damper * w);
        let (square, half) = (a * a + d * d, a * wall * GAP);
        let discriminant = half * half - square * ((wall * GAP).powi(2) - size * size);
        let radius = (half + discriminant.sqrt()) / square;
        assert!(radius > GAP);
        let lag = f64::atan2(d * radius, a * radius - wall * GAP);
        let (sin, cos) = lag.sin_cos();
        // (y, z) = R (cos(W t - lag), sin(W t - lag)).
        let state = [radius * cos, -radius * sin, w * radius * sin, w * radius * cos];
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let mut exact = integrator(&system);
        let flow = exact.flow(&stretch, &state).unwrap();
        let error = flow.state.iter().zip(state).map(|(end, start)| (end - start).abs()).fold(0.0, f64::max);
        assert!(error < 1e-11 * w * radius, "{frequency_hz}: {error:e}");
        assert_eq!((exact.touches(), exact.closed_throughout()), (&[0][..], 1));
        // Polynomials show that the hole stays closed: nothing is searched.
        assert_eq!(exact.counts().looks, 0, "{frequency_hz}");
    }
}

/// The same next to the wall, by so small a part of the clearance behind it or in front of it. In flight
/// looks grow like the third root of that part; behind the wall nothing is searched as long as it is proved.
#[test]
fn whirl_that_hardly_touches_is_followed_with_few_looks() {
    let (spring, damper, wall) = (400.0, 3.0, 2e4);
    let ratio = damper / (2.0 * f64::sqrt(spring));
    let plane = Plane { rates: vec![f64::sqrt(spring)], shape: vec![1.0], ratio };
    let w = TAU * 2.0;
    for part in [1e-4, 1e-6, 1e-8, -1e-4, -1e-6] {
        // The force that makes a whirl of this radius.
        let radius = GAP * (1.0 + part);
        let along = (spring - w * w) * radius + wall * (radius - GAP).max(0.0);
        let (size, lag) = (along.hypot(damper * w * radius), f64::atan2(damper * w * radius, along));
        let system = plane.with_hole(&linear(wall), &[(0, size, 0.0), (1, size, -PI / 2.0)]);
        let (sin, cos) = lag.sin_cos();
        let state = [radius * cos, -radius * sin, w * radius * sin, w * radius * cos];
        let stretch = Stretch { frequency_hz: 2.0, start: 0.0, end: 1.0 };
        let mut exact = integrator(&system);
        let end = exact.advance(&stretch, &state).unwrap();
        let error = end.iter().zip(state).map(|(end, start)| (end - start).abs()).fold(0.0, f64::max);
        assert!(error < 1e-11 * w * radius, "{part}: {error:e}");
        assert_eq!(exact.closed_throughout(), u64::from(part > 0.0), "{part}");
        assert!(exact.counts().looks < 10_000, "{part}: {}", exact.counts().looks);
    }
}

/// An ellipse whose long half axis passes the wall by 1e-9 of the clearance touches it at both ends, one that
/// stays away by as much does not.
#[test]
fn a_graze_of_any_direction_is_a_contact_and_a_near_miss_is_none() {
    let plane = Plane { rates: vec![1.0], shape: vec![1.0], ratio: 0.0 };
    let system = plane.with_hole(&linear(1e-3), &[]);
    let stretch = Stretch { frequency_hz: 1.0 / TAU, start: 0.0, end: 1.0 };
    for (beyond, expected) in [(1e-9, 2), (-1e-9, 0), (1e-5, 2), (1e-2, 2)] {
        for angle in [0.1, 1.0, 2.0] {
            let (long, short) = (GAP * (1.0 + beyond), 0.3 * GAP);
            let (sin, cos) = f64::sin_cos(angle);
            // Along the long axis `a sin(t - 0.4)`, across `b cos(t - 0.4)`.
            let (s, c) = f64::sin_cos(-0.4);
            let (along, across) = ([long * s, long * c], [short * c, -short * s]);
            let place = |k: usize| [cos * along[k] - sin * across[k], sin * along[k] + cos * across[k]];
            let state = [place(0), place(1)].concat();
            let mut exact = ExactIntegrator::new(system.clone(), ExactSettings::default()).unwrap();
            exact.advance(&stretch, &state).unwrap();
            assert_eq!(exact.touches(), [expected], "{beyond}, {angle}");
        }
    }
}

/// What both integrators observe of the same motion.
#[test]
fn maxima_agree_with_the_general_integrator() {
    for (system, state, what) in motions() {
        let shape = system.elements()[0].shape.clone();
        let stretch = Stretch { frequency_hz: 26.0, start: 0.25, end: 1.25 };
        let settings = ExactSettings { tolerance: 1e-12 };
        let mut exact = ExactIntegrator::watching(system.clone(), settings, Some((&shape, &[]))).unwrap();
        let found = exact.observe(&[(stretch, &state)]).unwrap();
        let settings = GeneralSettings::with_tolerance(1e-12).state_only();
        let expected = observe(&system, &stretch, &state, (&shape, &[]), &settings).unwrap();
        let same = |a: f64, b: f64| (a - b).abs() <= 1e-7 * b.abs();
        assert_eq!(found.touches as usize, expected.touches.len(), "{what}");
        assert!(same(found.displacement, expected.displacement), "{what}: {found:?} {expected:?}");
        assert!(same(found.acceleration, expected.acceleration), "{what}: {found:?} {expected:?}");
        assert!(same(found.contact_force, expected.contact_force), "{what}: {found:?} {expected:?}");
        assert!(same(found.impact_velocity, expected.impact_velocity), "{what}: {found:?} {expected:?}");
        assert!(same(found.impulse, expected.impulse), "{what}: {found:?} {expected:?}");
    }
}

#[test]
fn half_a_hole_and_losses_beside_one_are_refused() {
    let whole = beam().with_hole(&hertz(1e8, GAP), &[]);
    let made = |elements: Vec<LocalElement>| System::new(whole.model().clone(), &Load::default(), elements);
    let [first, second] = [0, 1].map(|k| whole.elements()[k].clone());
    for half in [vec![first.clone()], vec![second.clone()], vec![second.clone(), first.clone()]] {
        assert!(matches!(made(half), Err(SystemError::HalfHole { .. })));
    }
    let shape = first.shape.clone();
    for law in [rigid(0.5, GAP), damped(1e5, 10.0, GAP)] {
        let beside = vec![first.clone(), second.clone(), element(&shape, 0.0, law)];
        assert!(matches!(made(beside), Err(SystemError::BesideHole { .. })));
    }
    made(vec![element(&shape, 0.0, hertz(1e8, GAP)), first, second]).unwrap();
    for law in [rigid(0.5, GAP), damped(1e5, 10.0, GAP)] {
        assert_eq!(law.in_round_hole(), Err(LawError::NotForHole));
    }
}
