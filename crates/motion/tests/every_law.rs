//! Whatever laws there are: what the exact integrator makes of each, against the general one and differences.
//!
//! A law that is added to the list is tested here without being named.

use hammerbeam_motion::{
    Harmonic, LawConstant, Load, LocalElement, Parameter, Stretch, System,
    law::{DESCRIPTIONS, LawDescription, LawSides},
};

use crate::common::{
    assert_agreement, beam_model, differences::assert_by_parameters, element, integrator, settled,
};

const STRETCH: Stretch = Stretch { frequency_hz: 33.0, start: 0.25, end: 1.25 };

/// The beam against a stop of each law, and a motion of it that has settled.
fn systems() -> impl Iterator<Item = (&'static LawDescription, System, Vec<f64>)> {
    beams(&[-1.0])
}

/// The beam between two stops of each law that has but one side.
fn between_stops() -> impl Iterator<Item = (&'static LawDescription, System, Vec<f64>)> {
    beams(&[-1.0, 1.0]).filter(|(described, ..)| matches!(described.sides, LawSides::One { .. }))
}

/// * `signs`: of the directions in which stops are.
fn beams<'a>(signs: &'a [f64]) -> impl Iterator<Item = (&'static LawDescription, System, Vec<f64>)> + 'a {
    DESCRIPTIONS.iter().map(move |described| {
        let model = beam_model(0.015);
        let elements: Vec<LocalElement> = signs
            .iter()
            .flat_map(|sign| {
                let shape: Vec<f64> = model.points[0].shape.iter().map(|phi| sign * phi).collect();
                let parts = described.sample(1e-4).unwrap().into_iter();
                parts.map(move |part| element(&shape, 0.0, part.law))
            })
            .collect();
        let support = vec![Harmonic { order: 1, amplitude: 0.5015e-3, phase: 0.0 }.into()];
        let system = System::new(model, &Load { support, ..Load::default() }, elements).unwrap();
        let state = settled(&system, STRETCH.frequency_hz, 40, STRETCH.start);
        (*described, system, state)
    })
}

/// What its description lets vary.
fn constants(described: &LawDescription) -> Vec<LawConstant> {
    let values = described.sample_values();
    described.keys.iter().zip(&values).filter_map(|(key, value)| key.constant(value)).collect()
}

/// The general integrator runs at 1e-13 a step; see `agreement.rs`.
#[test]
fn flows_agree_with_the_general_integrator() {
    for (described, system, state) in systems() {
        let contacts = assert_agreement(&system, &STRETCH, &state, 1e-9, described.name);
        let acts = system.elements()[0].law.contacts().is_empty();
        assert!(contacts > 0 || acts, "{}: no contact", described.name);
    }
}

/// Differences of steps of 1e-6 leave some 1e-7 of the largest entry, and more where impacts amplify them.
/// The columns by state are held against those of the general integrator above.
#[test]
fn columns_of_parameters_agree_with_differences() {
    for (described, system, state) in systems() {
        let constants = constants(described).into_iter().chain([LawConstant::Gap]);
        let of_element = constants.map(|constant| Parameter::of_law(0, constant));
        let varies = |parameter: &Parameter| system.parameter(*parameter).is_ok();
        let parameters: Vec<Parameter> =
            [Parameter::ExcitationScale].into_iter().chain(of_element.filter(varies)).collect();
        assert!(parameters.len() > 1 || described.name == "formula", "{}: nothing varies", described.name);
        assert_by_parameters(&system, &STRETCH, &state, &parameters, 2e-5);
    }
}

/// Each of which agrees with differences, see above.
#[test]
fn the_column_of_what_both_sides_have_in_common_is_the_sum_of_those_of_the_sides() {
    for (described, system, _) in between_stops() {
        let (from_rest, stretch) = (vec![0.0; 2 * system.dof()], Stretch { end: 2.25, ..STRETCH });
        let mut integrator = integrator(&system);
        for constant in constants(described).into_iter().chain([LawConstant::Gap]) {
            let mut column = |parameter| {
                integrator.differentiate_by(Some(parameter)).unwrap();
                integrator.flow(&stretch, &from_rest).unwrap().by_parameter
            };
            if system.parameter(Parameter::of_law(0, constant)).is_err() {
                continue;
            }
            let both = column(Parameter::OfLaw { element: 0, both_sides: true, constant });
            let sides = [0, 1].map(|element| column(Parameter::of_law(element, constant)));
            let size = sides.iter().flatten().fold(0.0_f64, |size, entry| size.max(entry.abs()));
            for (i, both) in both.iter().enumerate() {
                let sum = sides[0][i] + sides[1][i];
                assert!((both - sum).abs() <= 1e-9 * size, "{}: {constant:?}", described.name);
            }
            let is_touched = integrator.touches().iter().all(|touches| *touches > 0);
            // A second slope may not be reached.
            assert!(
                is_touched && (size > 0.0 || matches!(constant, LawConstant::Further(_))),
                "{}: {constant:?}",
                described.name
            );
        }
    }
}

/// A law has the constants that its description says can vary, and takes other values of them.
#[test]
fn constants_that_vary_are_those_of_the_law() {
    for (described, system, _) in systems() {
        let law = &system.elements()[0].law;
        for constant in constants(described) {
            let value = law.constant(constant).unwrap();
            let other = law.with_constant(constant, 0.9 * value).unwrap();
            assert_eq!(other.constant(constant), Some(0.9 * value), "{}: {constant:?}", described.name);
            assert_eq!(other.contacts(), law.contacts(), "{}", described.name);
        }
    }
}
