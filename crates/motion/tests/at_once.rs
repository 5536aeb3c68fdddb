//! Contacts that begin or end in one instant while another force acts: stops of the same level on one mass, a
//! mass at rest on the level of a stop, and impacts on a rigid stop within a damped contact.
//!
//! Held against the general integrator, which ends its steps on one boundary after the other.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{
    assert_agreement, damped, diagonal, difference, element, force, hertz, model, remembering,
};
use faer::Mat;
use hammerbeam_motion::{
    Law, LawConstant, Load, LocalElement, Parameter, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, observe, sample},
    law::{
        HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel, RestitutionStop, RigidStop, TwoSidedStop,
    },
};
use hammerbeam_testkit::stride;

/// Natural circular frequency [rad/s].
const W: f64 = TAU * 10.0;
/// Displacement of the mass under its load at rest [m].
const STATIC: f64 = 1e-3;

/// Unit mass on a spring with a harmonic load and these stops; one with a preload pushes it towards the
/// others.
fn mass(stops: &[(f64, Law)], load: f64) -> System {
    let pushing =
        Law::Hertz(HertzStop::with_preload(5.0 * W * W / STATIC.sqrt(), 1.5 * STATIC * W * W).unwrap());
    let stops = stops.iter().map(|(shape, law)| element(&[*shape], 0.0, law.clone()));
    let elements: Vec<LocalElement> = std::iter::once(element(&[-0.6], 0.0, pushing)).chain(stops).collect();
    let load = Load { support: vec![], forces: vec![force(&[1.0], 1, load * STATIC * W * W, 0.0)] };
    System::new(model(&[W], diagonal(&[0.1 * W])), &load, elements).unwrap()
}

/// Follows motions from rest period by period; the number of contacts.
fn agree_over_periods(system: &System, bound: f64) -> u32 {
    let mut touches = 0;
    for k in 0..12 {
        let frequency_hz = 3.0 + 0.37 * f64::from(k);
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-12 }).unwrap();
        let mut state = vec![0.0; 2];
        for period in 0..4 {
            let what = format!("{frequency_hz} Hz, period {period}");
            let next = exact.advance(&stretch, &state).unwrap();
            // No flow with sensitivities begins in a contact that remembers its impact, and where a rigid
            // stop has held the mass they vanish.
            let can_begin = !system.is_in_remembered_contact(frequency_hz, 0.0, &state);
            if can_begin && exact.directions_lost() == 0 {
                touches += assert_agreement(system, &stretch, &state, bound, &what);
            }
            state = next;
        }
    }
    touches
}

fn linear(stiffness: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness * W * W, 0.0).unwrap())
}

/// Their forces end in the same instant.
#[test]
fn linear_stops_of_one_level_open_at_once() {
    for (first, second) in [(280.0, 480.0), (30.0, 30.0), (1000.0, 20.0)] {
        let system = mass(&[(0.8, linear(first)), (0.3, linear(second))], 2.0);
        assert!(agree_over_periods(&system, 1e-8) > 50);
    }
}

/// Their forces begin in the same instant, each located with the accuracy of its law.
#[test]
fn stops_of_different_laws_close_at_once() {
    let stiffness = 300.0 * W * W / STATIC.sqrt();
    let damped = HuntCrossleyStop::new(HertzStop::with_gap(stiffness, 0.0).unwrap(), 20.0).unwrap();
    for other in [linear(300.0), hertz(stiffness, 0.0), Law::HuntCrossley(damped)] {
        let system = mass(&[(0.8, hertz(0.3 * stiffness, 0.0)), (0.5, other)], 2.0);
        assert!(agree_over_periods(&system, 1e-8) > 50);
    }
}

/// The force of the damper jumps in the instant of the impact, whose speed the other law keeps: its
/// sensitivities are those of the motion before.
#[test]
fn an_impact_that_is_remembered_is_that_before_a_damper_of_the_same_level_acts() {
    let level = 0.2 * STATIC;
    let elastic = HertzStop::with_gap(300.0 * W * W / STATIC.sqrt(), level).unwrap();
    let remembers = Law::Restitution(RestitutionStop::new(elastic, RestitutionModel::HuGuo, 0.5).unwrap());
    let damped = LinearStop::with_gap(300.0 * W * W, level).unwrap().with_damping(5.0 * W).unwrap();
    let load = Load { support: vec![], forces: vec![force(&[1.0], 1, 2.0 * STATIC * W * W, 0.0)] };
    for laws in [[remembers.clone(), Law::Linear(damped)], [Law::Linear(damped), remembers]] {
        let stops = laws.map(|law| element(&[1.0], 0.0, law)).to_vec();
        let system = System::new(model(&[W], diagonal(&[0.1 * W])), &load, stops).unwrap();
        let mut touches = 0;
        for frequency_hz in [2.2, 3.1, 4.7, 6.3, 9.2] {
            let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
            // Up to seven impacts of each, whose sensitivities grow like one over their speeds.
            touches += assert_agreement(&system, &stretch, &[0.0, 0.0], 1e-7, &format!("{frequency_hz} Hz"));
        }
        assert!(touches >= 20, "{touches}");
    }
}

/// At rest on the level, with the preload `0.9 s w^2` towards the stop, s being the static displacement, and
/// a load `l s w^2 cos` along with it.
///
/// With `l = -1/2` that presses with 0.4 at first and ever more from then on: the contact closes in the first
/// instant and does not open. With `l = -1.2` it pulls by 0.3 at first, and pushes from the time on at which
/// `cos = 3/4`: the mass leaves, and comes back with some speed. With `l = 1/2` it presses with 1.4 at first
/// and ever less: an oscillation about the place of rest that was as large as that is larger later, and the
/// mass leaves and comes back, how often the other integrator tells.
#[test]
fn a_mass_at_rest_on_a_level_closes_the_contact_without_speed_or_leaves() {
    for load in [-0.5, -1.2, 0.5] {
        for law in [hertz(300.0 * W * W / STATIC.sqrt(), 0.0), linear(300.0)] {
            let (system, what) = (mass(&[(0.8, law.clone())], load), format!("{load} {law:?}"));
            let stretch = Stretch { frequency_hz: 4.0, start: 0.0, end: 0.2 };
            let touches = assert_agreement(&system, &stretch, &[0.0, 0.0], 1e-8, &what);
            let phases: Vec<f64> = (1..20_000).map(|k| 1e-5 * f64::from(k)).collect();
            let settings = GeneralSettings::with_tolerance(1e-11);
            let states = sample(&system, &stretch, &[0.0, 0.0], &phases, &settings).unwrap();
            let inside: Vec<bool> = states.iter().map(|state| state[0] > 0.0).collect();
            let closings = inside.windows(2).filter(|pair| !pair[0] && pair[1]).count();
            let expected = usize::from(inside[0]) + closings;
            assert_eq!((touches as usize, inside[0]), (expected, load != -1.2), "{what}");
            assert!(if load > 0.0 { touches > 1 } else { touches == 1 }, "{what}: {touches}");
            assert!(load != -0.5 || inside.iter().all(|inside| *inside), "{what}");
        }
    }
}

/// Stops at one mass have one displacement, and the columns of a parameter are each stop's own. Stops whose
/// lever differs by a millionth of a millionth have as many displacements as stops.
#[test]
fn columns_of_several_stops_at_a_mass_are_those_of_stops_taken_apart() {
    let linear = |share: f64, gap: f64| {
        Law::Linear(LinearStop::with_gap(share * 300.0 * W * W, gap * STATIC).unwrap())
    };
    let hertz = Law::Hertz(HertzStop::with_gap(90.0 * W * W / STATIC.sqrt(), 0.1 * STATIC).unwrap());
    let laws = [linear(0.2, 0.1), linear(0.5, 0.1), linear(0.3, 0.2), hertz];
    let levers = |apart: f64| [0.0, 1.0, 2.0, 3.0].map(|k| 0.8 * (1.0 + k * apart));
    let [mut together, mut apart] = [0.0, 1e-12].map(|apart| {
        let stops: Vec<(f64, Law)> = levers(apart).into_iter().zip(laws.clone()).collect();
        ExactIntegrator::new(mass(&stops, 2.0), ExactSettings { tolerance: 1e-12 }).unwrap()
    });
    let of_law = Parameter::of_law;
    let parameters = [
        Parameter::ExcitationScale,
        of_law(1, LawConstant::Gap),
        of_law(3, LawConstant::Gap),
        of_law(4, LawConstant::Gap),
        of_law(2, LawConstant::Stiffness),
    ];
    let stretch = Stretch { frequency_hz: 3.7, start: 0.0, end: 0.8 };
    for parameter in parameters {
        let [found, expected] = [&mut together, &mut apart].map(|integrator| {
            integrator.differentiate_by(Some(parameter)).unwrap();
            integrator.flow(&stretch, &[0.4 * STATIC, 0.0]).unwrap()
        });
        assert!(together.touches().iter().skip(1).all(|touches| *touches > 1), "{:?}", together.touches());
        for (found, expected) in found.by_parameter.iter().zip(&expected.by_parameter) {
            assert!((found - expected).abs() <= 1e-7 * expected.abs(), "{parameter:?}: {found} {expected}");
        }
    }
}

/// Three stops that share the stiffness of one are that one: all of their contacts begin, part and end in the
/// same instants.
#[test]
fn three_stops_of_one_level_are_one_of_their_stiffnesses_added() {
    let damped = |share: f64| {
        LinearStop::with_gap(share * 300.0 * W * W, 0.0).unwrap().with_damping(share * 20.0 * W).unwrap()
    };
    let elastic = |share: f64| HertzStop::with_gap(share * 300.0 * W * W / STATIC.sqrt(), 0.0).unwrap();
    // The damped spring stops the bouncing: its last touches are slow, and sensitivities have the rounding of
    // the level over their speed.
    let laws: [(&dyn Fn(f64) -> Law, f64); 4] = [
        (&|share| linear(share * 300.0), 1e-8),
        (&|share| Law::Linear(damped(share)), 1e-7),
        (&|share| Law::Hertz(elastic(share)), 1e-8),
        (&|share| Law::HuntCrossley(HuntCrossleyStop::new(elastic(share), 20.0).unwrap()), 1e-8),
    ];
    for (index, (law, bound)) in laws.into_iter().enumerate() {
        let three = mass(&[0.2, 0.5, 0.3].map(|share| (0.8, law(share))), 2.0);
        let of_one = mass(&[(0.8, law(1.0))], 2.0);
        let [mut three, mut one] = [three, of_one.clone()]
            .map(|system| ExactIntegrator::new(system, ExactSettings { tolerance: 1e-12 }).unwrap());
        for k in (0..40).step_by(stride(4)) {
            let stretch = Stretch { frequency_hz: 3.0 + 0.11 * f64::from(k), start: 0.0, end: 1.0 };
            let mut state = vec![0.0; 2];
            for period in 0..4 {
                let what = format!("law {index}, {stretch:?}, period {period}");
                let expected = one.flow(&stretch, &state).unwrap();
                let found = three.flow(&stretch, &state).expect(&what);
                let error = difference(&of_one, &stretch, &found, &expected);
                assert!(error.largest() <= bound, "{what}: {error:?}");
                state = expected.state;
            }
        }
    }
}

/// The mass leaves a damped contact that has parted at the level at which another one closes on the other
/// side.
#[test]
fn a_contact_is_left_where_another_one_closes() {
    let damped = LinearStop::with_gap(300.0 * W * W, 0.0).unwrap().with_damping(20.0 * W).unwrap();
    let elastic = HertzStop::with_gap(300.0 * W * W / STATIC.sqrt(), 0.0).unwrap();
    let hunt_crossley = HuntCrossleyStop::new(elastic, 20.0).unwrap();
    let two_sided = Law::TwoSided(TwoSidedStop::new(200.0 * W * W, 0.0, STATIC).unwrap());
    for law in [Law::Linear(damped), Law::HuntCrossley(hunt_crossley)] {
        let system = mass(&[(0.8, law), (-0.5, two_sided.clone())], 2.0);
        assert!(agree_over_periods(&system, 1e-7) > 50);
    }
}

/// A rigid stop behind a damped contact: the impact turns the speed round, with which the contact would have
/// to pull, so its force ends with the impact.
#[test]
fn an_impact_takes_the_force_off_a_damped_contact() {
    let [gap, behind] = [0.1 * STATIC, 0.3 * STATIC];
    let damped = LinearStop::with_gap(30.0 * W * W, gap).unwrap().with_damping(10.0 * W).unwrap();
    let elastic = HertzStop::with_gap(30.0 * W * W / STATIC.sqrt(), gap).unwrap();
    let hunt_crossley = HuntCrossleyStop::new(elastic, 40.0).unwrap();
    let remembers = RestitutionStop::new(elastic, RestitutionModel::HuGuo, 0.3).unwrap();
    let mut touches = 0;
    for law in [Law::Linear(damped), Law::HuntCrossley(hunt_crossley), Law::Restitution(remembers)] {
        for restitution in [0.8, 0.3] {
            let rigid = Law::Rigid(RigidStop::with_gap(restitution, behind).unwrap());
            let system = mass(&[(1.0, law.clone()), (1.0, rigid)], 3.0);
            touches += agree_over_periods(&system, 1e-7);
        }
    }
    assert!(touches > 100, "{touches}");
}

/// Two masses with a damped stop on one side and one that remembers its impact on the other, both at the
/// level zero: the pair passes from one to the other at some 1e-5 m/s, 1e-8 m deep, while the masses move at
/// 1 m/s. It closes four times, wherever rounding puts the zeros of the two penetrations.
#[test]
fn two_stops_of_one_level_change_in_one_instant_however_slowly_it_is_passed() {
    let damping = [[0.080_801_577_734, 0.025_391_706_235], [0.025_391_706_235, 0.099_385_924_786]];
    let free = model(&[0.837_718_754_612, 1.451_777_140_202], Mat::from_fn(2, 2, |i, j| damping[i][j]));
    let shape = [0.190_423_413_426, -1.010_310_352_589];
    let onto = |law: Law, sign: f64| element(&shape.map(|phi| sign * phi), 0.0, law);
    let remembers =
        remembering(37.677_406_860_209, RestitutionModel::LankaraniNikravesh, 0.735_701_571_475, 0.0);
    let stops = vec![onto(damped(6.632_029_976_090, 0.108_987_073_807, 0.0), 1.0), onto(remembers, -1.0)];
    let loads = [0.379_200_667_532_f64, -0.265_025_047_209];
    let (size, phase) = (0.112_547_370_156_f64.hypot(loads[0]), -0.112_547_370_156_f64.atan2(loads[0]));
    let shaken = force(&[1.0, loads[1] / loads[0]], 1, size, phase);
    let load = Load { support: vec![], forces: vec![shaken] };
    let system = System::new(free, &load, stops).unwrap();
    let stretch =
        Stretch { frequency_hz: 0.164_773_535_786_562_18, start: 0.115_234_375, end: 1.115_234_375 };
    for number in (0..100).step_by(stride(5)) {
        let rounding = 1e-15 * f64::from(number);
        let state =
            [-0.747_484_226_390_7 + rounding, -0.162_751_820_063_1, 0.678_187_589_630_5, 0.104_255_277_400_8];
        let settings = GeneralSettings::with_tolerance(1e-11);
        let found = observe(&system, &stretch, &state, (&[1.0, 0.0], &[]), &settings).unwrap();
        assert_eq!(found.touches.len(), 4, "{number}: {:?}", found.counts);
    }
}
