//! Derivatives of flows by parameters of the system, against differences of both integrators and a closed
//! form.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::{f64::consts::TAU, sync::Arc};

use crate::common::{element, hertz, modal_damping, model, paper_beam, settled};
use faer::Mat;
use hammerbeam_motion::{
    DampingPart, Family, Harmonic, HarmonicForce, Law, LawConstant, Load, Member, Parameter, ParameterError,
    Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, advance},
    law::{
        HertzStop, HuntCrossleyStop, LinearStop, PowerSpring, RestitutionModel, RestitutionStop, RigidStop,
        TwoSidedStop,
    },
};
use hammerbeam_structure::{ReducedModel, SupportInput};
use hammerbeam_testkit::stride;

const STRETCH: Stretch = Stretch { frequency_hz: 6.0, start: 0.1, end: 1.05 };
const STATE: [f64; 6] = [2e-3, 1e-3, -1e-5, -0.15, 0.02, 0.001];

/// Three modes on a shaken support under gravity, with a constant and a further harmonic force; a damper may
/// couple them.
fn three_modes(laws: &[Law], coupled: bool) -> System {
    let damper = [0.5, -0.7, 0.9];
    let damping = Mat::from_fn(3, 3, |i, j| {
        let modal = if i == j { [0.4, 2.0, 9.0][i] } else { 0.0 };
        modal + if coupled { 3.0 * damper[i] * damper[j] } else { 0.0 }
    });
    let support = SupportInput { inertia: vec![0.8, -0.3, 0.1], damping: vec![0.4, 0.1, -0.2] };
    let model =
        ReducedModel { supports: vec![support], ..model(&[TAU * 3.5, TAU * 23.0, TAU * 111.0], damping) };
    let force = |shape: &[f64], order, amplitude, phase| HarmonicForce {
        shape: shape.to_vec(),
        harmonic: Harmonic { order, amplitude, phase },
    };
    let load = Load {
        support: vec![Harmonic { order: 1, amplitude: 1.5e-3, phase: 0.4 }.into()],
        forces: vec![force(&[0.6, 0.2, 0.1], 0, -1.0, 0.0), force(&[0.3, -0.5, 0.4], 3, 0.5, 2.0)],
    };
    let elements = laws.iter().map(|law| element(&[-1.4, 1.1, -0.9], 0.3, law.clone())).collect();
    // Another damper between two points, one of which the support moves with.
    let other = [0.3, 0.8, -0.6];
    let part = DampingPart {
        matrix: Mat::from_fn(3, 3, |i, j| other[i] * other[j]),
        supports: vec![other.iter().map(|entry| 0.7 * entry).collect()],
    };
    System::new(model, &load, elements).unwrap().with_damping_part(part).unwrap()
}

/// A ratio of all modes, and a damper.
const DAMPINGS: [(Parameter, f64); 2] =
    [(Parameter::ADDED_DAMPING_RATIO, 1e-5), (Parameter::AddedDamping { part: 1 }, 1e-3)];

fn laws() -> Vec<Law> {
    vec![
        hertz(5e5, 2e-4),
        Law::Linear(LinearStop::with_gap(3e4, 2.5e-4).unwrap()),
        Law::TwoSided(TwoSidedStop::new(8e3, 3e-4, 3e-4).unwrap()),
        Law::Power(PowerSpring::cubic(1e8).unwrap()),
    ]
}

fn exact(system: &System, tolerance: f64) -> ExactIntegrator {
    ExactIntegrator::new(system.clone(), ExactSettings { tolerance }).unwrap()
}

/// Largest error of the column by a parameter against differences of fourth order, relative to the largest
/// entry of each half.
fn error_by_differences(
    (system, stretch, state): (&System, &Stretch, &[f64]),
    parameter: Parameter,
    step: f64,
    motion: impl Fn(&System) -> Vec<f64>,
) -> f64 {
    let mut integrator = exact(system, 1e-13);
    integrator.differentiate_by(Some(parameter)).unwrap();
    let column = integrator.flow(stretch, state).unwrap().by_parameter;
    let value = system.parameter(parameter).unwrap();
    let at = |k: f64| motion(&system.clone().with_parameter(parameter, value + k * step).unwrap());
    let [far_below, below, above, far_above] = [-2.0, -1.0, 1.0, 2.0].map(at);
    let difference = |i: usize| (8.0 * (above[i] - below[i]) - (far_above[i] - far_below[i])) / (12.0 * step);
    let n = column.len() / 2;
    let of_part = |part: std::ops::Range<usize>| {
        let largest = part.clone().map(|i| difference(i).abs()).fold(0.0, f64::max);
        part.map(|i| (column[i] - difference(i)).abs()).fold(0.0, f64::max) / largest
    };
    of_part(0..n).max(of_part(n..2 * n))
}

/// A parameter and the step of its differences, for the elements of [`laws`].
fn parameters() -> Vec<(Parameter, f64)> {
    let mut all = vec![(Parameter::ExcitationScale, 3e-4)];
    all.extend(DAMPINGS);
    all.extend((0..3).map(|element| (Parameter::gap(element), 2e-7)));
    let stiffnesses = [5e5, 3e4, 8e3, 1e8].into_iter().enumerate();
    all.extend(stiffnesses.map(|(element, k)| (Parameter::stiffness(element), 1e-4 * k)));
    all
}

/// Laws that lose energy, and their parameters.
fn lossy_laws() -> Vec<Law> {
    let hertz = HertzStop::with_gap(5e5, 2e-4).unwrap();
    vec![
        Law::HuntCrossley(HuntCrossleyStop::new(hertz, 1.0).unwrap()),
        Law::Linear(LinearStop::with_gap(3e4, 2.5e-4).unwrap().with_damping(12.0).unwrap()),
        Law::Restitution(RestitutionStop::new(hertz, RestitutionModel::LankaraniNikravesh, 0.7).unwrap()),
    ]
}

fn lossy_parameters() -> Vec<(Parameter, f64)> {
    let mut all = vec![
        (Parameter::ExcitationScale, 3e-4),
        (Parameter::contact_damping(0), 1e-4),
        (Parameter::contact_damping(1), 1e-3),
        (Parameter::restitution(2), 1e-4),
    ];
    all.extend(DAMPINGS);
    // Times of contacts move with the root of the gap where they are slow: the steps are small.
    all.extend((0..3).map(|element| (Parameter::gap(element), 2e-8)));
    let stiffnesses = [5e5, 3e4, 5e5].into_iter().enumerate();
    all.extend(stiffnesses.map(|(element, k)| (Parameter::stiffness(element), 1e-4 * k)));
    all
}

/// Every formula of a loss, at several coefficients of restitution.
#[test]
fn derivatives_by_the_restitution_of_every_model_are_those_of_differences() {
    let hertz = HertzStop::with_gap(5e5, 2e-4).unwrap();
    for model in RestitutionModel::ALL {
        for restitution in [0.35, 0.8] {
            let law = Law::Restitution(RestitutionStop::new(hertz, model, restitution).unwrap());
            let system = three_modes(&[law], false);
            let parameter = Parameter::restitution(0);
            let motion = |system: &System| exact(system, 1e-14).advance(&STRETCH, &STATE).unwrap();
            let error = error_by_differences((&system, &STRETCH, &STATE), parameter, 1e-4, motion);
            assert!(error < 1e-7, "{model:?} {restitution}: {error:e}");
        }
    }
}

/// By default by every other parameter.
#[test]
fn derivatives_agree_with_differences_of_both_integrators() {
    let lossless = (laws(), parameters());
    let lossy = (lossy_laws(), lossy_parameters());
    // Noise of the differences: states good to 1e-13, steps of 1e-3 to 1e-4 of a parameter; those of gaps are
    // ten times shorter beside laws that lose energy.
    let cases = [(false, &lossless, 1e-8), (true, &lossless, 1e-8), (true, &lossy, 1e-7)];
    for (coupled, (laws, parameters), bound) in cases {
        let system = three_modes(laws, coupled);
        for &(parameter, step) in parameters.iter().step_by(stride(2)) {
            let case = (&system, &STRETCH, &STATE[..]);
            let of_exact = |system: &System| exact(system, 1e-14).advance(&STRETCH, &STATE).unwrap();
            let of_general = |system: &System| {
                advance(system, &STRETCH, &STATE, &GeneralSettings::with_tolerance(1e-13)).unwrap().flow.state
            };
            let errors = (
                error_by_differences(case, parameter, step, of_exact),
                error_by_differences(case, parameter, step, of_general),
            );
            assert!(errors.0 < bound && errors.1 < bound, "{parameter:?} coupled {coupled}: {errors:?}");
        }
    }
}

/// The paper's beam over three periods, with several contacts.
#[test]
fn derivatives_of_the_beam_agree_over_several_contacts() {
    let system = paper_beam();
    for frequency_hz in [22.0, 41.0] {
        let state = settled(&system, frequency_hz, 50, 0.0);
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let parameters = [
            (Parameter::ExcitationScale, 3e-5),
            (Parameter::stiffness(0), 1e-4 * 4.5e9),
            (Parameter::ADDED_DAMPING_RATIO, 1e-6),
        ];
        for (parameter, step) in parameters {
            let of_general = |system: &System| {
                advance(system, &stretch, &state, &GeneralSettings::with_tolerance(1e-13)).unwrap().flow.state
            };
            let error = error_by_differences((&system, &stretch, &state), parameter, step, of_general);
            assert!(error < 2e-8, "{parameter:?} at {frequency_hz} Hz: {error:e}");
        }
    }
}

/// The systems over a parameter that has an exact column, as a family.
#[derive(Debug)]
struct Over(System, Parameter);

impl Family for Over {
    fn member(&self, value: f64) -> Result<Member, String> {
        let system = self.0.clone().with_parameter(self.1, value).map_err(|error| error.to_string())?;
        Ok(Member { system, response: (vec![0.0; 3], vec![0.0]) })
    }
}

/// By differences of the motions of neighbours: on both sides, and on one where the other has no system.
#[test]
fn the_column_of_a_family_is_that_of_its_parameter() {
    for (laws, parameters, bound) in [(laws(), parameters(), 1e-6), (lossy_laws(), lossy_parameters(), 1e-6)]
    {
        let system = three_modes(&laws, true);
        for (parameter, step) in parameters {
            let value = system.parameter(parameter).unwrap();
            let kin =
                system.clone().with_family(Arc::new(Over(system.clone(), parameter)), value, 100.0 * step);
            let mut integrator = exact(&kin, 1e-13);
            let mut column = |by| {
                integrator.differentiate_by(Some(by)).unwrap();
                integrator.flow(&STRETCH, &STATE).unwrap().by_parameter
            };
            let (found, expected) = (column(Parameter::OfFamily { family: 0 }), column(parameter));
            let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            let error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size;
            assert!(error < bound, "{parameter:?}: {error:e}");
            let family = Parameter::OfFamily { family: 0 };
            integrator.set_parameter(family, value + step).unwrap();
            let built = system.clone().with_parameter(parameter, value + step).unwrap();
            let moved = exact(&built, 1e-13).advance(&STRETCH, &STATE).unwrap();
            assert_eq!(integrator.advance(&STRETCH, &STATE).unwrap(), moved, "{parameter:?}");
        }
    }
    let system = three_modes(&laws(), false);
    let none = system.with_parameter(Parameter::OfFamily { family: 0 }, 1.0);
    assert!(matches!(none, Err(ParameterError::NoFamily { .. })));
}

/// `q'' + w^2 q = a cos(W t)` from rest: the motion is proportional to `a`, also on the eigenfrequency.
#[test]
fn a_linear_motion_from_rest_is_proportional_to_the_excitation() {
    for frequency_hz in [1.0, 1.3] {
        let harmonic = Harmonic { order: 1, amplitude: 2.0, phase: 0.3 };
        let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
        let system = System::new(model(&[TAU], modal_damping(&[TAU], 0.0)), &load, vec![])
            .unwrap()
            .with_parameter(Parameter::ExcitationScale, 0.7)
            .unwrap();
        let mut integrator = exact(&system, 1e-11);
        integrator.differentiate_by(Some(Parameter::ExcitationScale)).unwrap();
        let flow = integrator.flow(&Stretch { frequency_hz, start: 0.2, end: 1.7 }, &[0.0, 0.0]).unwrap();
        for i in 0..2 {
            assert!(
                (0.7 * flow.by_parameter[i] - flow.state[i]).abs() < 1e-13 * flow.state[i].abs().max(0.1)
            );
        }
    }
}

/// What is set in place moves like a system that was built so.
#[test]
fn an_integrator_takes_new_values_in_place() {
    let system = three_modes(&laws(), true);
    let mut integrator = exact(&system, 1e-11);
    for (parameter, step) in parameters() {
        let value = system.parameter(parameter).unwrap();
        integrator.set_parameter(parameter, value + 100.0 * step).unwrap();
        let built = system.clone().with_parameter(parameter, value + 100.0 * step).unwrap();
        let expected = exact(&built, 1e-11).advance(&STRETCH, &STATE).unwrap();
        assert_eq!(integrator.advance(&STRETCH, &STATE).unwrap(), expected, "{parameter:?}");
        integrator.set_parameter(parameter, value).unwrap();
    }
}

/// A chosen parameter changes the steps only as far as its own error asks for.
#[test]
fn without_a_parameter_there_is_no_column() {
    let mut integrator = exact(&three_modes(&laws(), false), 1e-11);
    assert!(integrator.flow(&STRETCH, &STATE).unwrap().by_parameter.is_empty());
}

#[test]
fn parameters_that_are_not_there_are_refused() {
    let preloaded = Law::Hertz(HertzStop::with_preload(5e6, 3.0).unwrap());
    let uneven = Law::TwoSided(TwoSidedStop::new(8e4, 1e-3, 2e-3).unwrap());
    let system = three_modes(&[preloaded, uneven, Law::Power(PowerSpring::cubic(1e8).unwrap())], false);
    for element in 0..3 {
        let error = system.parameter(Parameter::gap(element)).unwrap_err();
        assert!(matches!(error, ParameterError::NoGap { .. }), "{error}");
    }
    let missing = system.parameter(Parameter::stiffness(3)).unwrap_err();
    assert_eq!(missing, ParameterError::NoElement { element: 3, count: 3 });
    for (parameter, value) in [
        (Parameter::ExcitationScale, 0.0),
        (Parameter::ExcitationScale, f64::NAN),
        (Parameter::ADDED_DAMPING_RATIO, -1.0),
        (Parameter::stiffness(0), -1.0),
        (Parameter::AddedDamping { part: 1 }, -1e3),
        (Parameter::AddedDamping { part: 2 }, 0.0),
        (Parameter::contact_damping(0), 1.0),
        (Parameter::restitution(0), 0.5),
    ] {
        assert!(system.clone().with_parameter(parameter, value).is_err(), "{parameter:?} {value}");
    }
    let lossy = three_modes(&lossy_laws(), false);
    for (parameter, value) in [
        (Parameter::contact_damping(0), 0.0),
        (Parameter::contact_damping(1), f64::INFINITY),
        (Parameter::contact_damping(2), 1.0),
        (Parameter::restitution(1), 0.5),
        (Parameter::restitution(2), 0.0),
        (Parameter::restitution(2), 1.1),
    ] {
        assert!(lossy.clone().with_parameter(parameter, value).is_err(), "{parameter:?} {value}");
    }
    let small = DampingPart { matrix: Mat::zeros(2, 2), supports: vec![vec![0.0; 3]] };
    assert!(matches!(lossy.with_damping_part(small), Err(ParameterError::DampingPartSize { .. })));
}

/// Free vibration of the amplitude a, short of a rigid stop by less than some and by less than all steps of
/// differences: what the gap does to motions that strike is nothing to one that does not.
#[test]
fn beside_a_grazing_a_family_is_differentiated_on_the_side_of_the_motion() {
    let (w, a) = (TAU * 3.5, 0.01);
    let stretch = Stretch { frequency_hz: 3.0, start: 0.0, end: 1.0 };
    for clearance in [1e-8, 1e-10, 1e-12] {
        let stop = Law::Rigid(RigidStop::with_gap(0.6, a + clearance).unwrap());
        let model = model(&[w], Mat::zeros(1, 1));
        let system = System::new(model, &Load::default(), vec![element(&[1.0], 0.0, stop)]).unwrap();
        let over = Arc::new(Over(system.clone(), Parameter::gap(0)));
        let mut integrator = exact(&system.with_family(over, a + clearance, a), 1e-13);
        integrator.differentiate_by(Some(Parameter::OfFamily { family: 0 })).unwrap();
        let flow = integrator.flow(&stretch, &[0.0, w * a]).unwrap();
        assert_eq!(integrator.touches(), [0], "{clearance:e}");
        assert_eq!(flow.by_parameter, [0.0, 0.0], "{clearance:e}");
    }
}

#[test]
fn what_both_sides_have_in_common_is_one_parameter_of_two_elements() {
    let both = Parameter::OfLaw { element: 3, both_sides: true, constant: LawConstant::Gap };
    for parameter in [both, Parameter::gap(3), Parameter::gap(4), Parameter::stiffness(0)] {
        assert_eq!(Parameter::of_code(parameter.code()), Some(parameter));
    }
    assert_eq!([2, 3, 4, 5].map(|element| both.is_gap_of(element)), [false, true, true, false]);
    assert_eq!(both.without_gaps_of(&[1]), Some(both));
    assert_eq!(both.without_gaps_of(&[3]), Some(Parameter::gap(4)));
    assert_eq!(both.without_gaps_of(&[4]), Some(Parameter::gap(3)));
    assert_eq!(both.without_gaps_of(&[4, 3]), None);
    let damping = Parameter::OfLaw { element: 3, both_sides: true, constant: LawConstant::Damping };
    assert_eq!(damping.without_gaps_of(&[3]), Some(damping));
    let stop = |gap: f64| Law::Rigid(RigidStop::with_gap(0.6, gap).unwrap());
    let between = |gaps: [f64; 2]| {
        let elements = vec![element(&[1.0], 0.0, stop(gaps[0])), element(&[-1.0], 0.0, stop(gaps[1]))];
        System::new(model(&[TAU], Mat::zeros(1, 1)), &Load::default(), elements).unwrap()
    };
    let gap = Parameter::OfLaw { element: 0, both_sides: true, constant: LawConstant::Gap };
    let set = between([0.1, 0.1]).with_parameter(gap, 0.2).unwrap();
    assert_eq!([0, 1].map(|element| set.parameter(Parameter::gap(element)).unwrap()), [0.2, 0.2]);
    let differ = between([0.1, 0.2]).parameter(gap);
    assert!(matches!(differ, Err(ParameterError::SidesDiffer { .. })), "{differ:?}");
}
