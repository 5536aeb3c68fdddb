//! Contacts that are barely touched, from either side.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{assert_agreement, diagonal, element, force, hertz, model};
use hammerbeam_motion::{
    HarmonicForce, Law, Load, Parameter, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::LinearStop,
};

/// A mass of 1 kg on a spring of 1 N/m.
fn mass(forces: Vec<HarmonicForce>, law: Law) -> ExactIntegrator {
    let load = Load { forces, ..Load::default() };
    let system =
        System::new(model(&[1.0], diagonal(&[0.1])), &load, vec![element(&[1.0], 0.0, law)]).unwrap();
    ExactIntegrator::new(system, ExactSettings { tolerance: 5e-12 }).unwrap()
}

/// One whose motion turns twice beside a stop within a period of its force.
fn beside_a_stop(law: Law) -> ExactIntegrator {
    mass(vec![force(&[1.0], 1, 1.0, 0.0)], law)
}

const PERIOD: Stretch = Stretch { frequency_hz: 0.105, start: 0.0, end: 1.0 };

/// Contacts of a motion that begins at the displacement `q`.
fn touches(integrator: &mut ExactIntegrator, q: f64) -> u32 {
    integrator.flow(&PERIOD, &[q, -2.34]).unwrap();
    integrator.touches()[0]
}

/// The displacement at which the first contact of the period is grazed, to rounding: there are two below and
/// one above.
fn grazed(integrator: &mut ExactIntegrator) -> f64 {
    let (mut two, mut one) = (0.0, 0.5);
    assert_eq!([touches(integrator, two), touches(integrator, one)], [2, 1]);
    for _ in 0..60 {
        let middle = 0.5 * (two + one);
        *if touches(integrator, middle) == 2 { &mut two } else { &mut one } = middle;
    }
    two
}

/// With derivatives by the parameters of a stop contacts of a depth of rounding and more cost no more steps
/// than others.
#[test]
fn a_contact_of_any_depth_takes_few_steps_with_derivatives_by_its_parameters() {
    let linear = || Law::Linear(LinearStop::with_gap(37.7, 1.0).unwrap());
    for law in [linear, || hertz(100.0, 1.0)] {
        for parameter in [Parameter::stiffness(0), Parameter::gap(0)] {
            let mut integrator = beside_a_stop(law());
            integrator.differentiate_by(Some(parameter)).unwrap();
            let grazed = grazed(&mut integrator);
            for decade in -16..-4 {
                for part in 0..50 {
                    let before = integrator.counts().solves;
                    let depth = 10f64.powf(f64::from(decade) + 0.02 * f64::from(part));
                    touches(&mut integrator, grazed - depth);
                    let solves = integrator.counts().solves - before;
                    assert!(solves < 200, "{parameter:?}, {depth:e} from the grazing: {solves} solves");
                }
            }
        }
    }
}

/// A shallow contact is a parabola, so its impulse goes like the power 3/2 of its depth, and so does what the
/// stiffness changes of the motion behind it, up to the next contact.
#[test]
fn what_the_stiffness_of_a_shallow_contact_changes_goes_with_its_impulse() {
    let mut integrator = beside_a_stop(Law::Linear(LinearStop::with_gap(37.7, 1.0).unwrap()));
    integrator.differentiate_by(Some(Parameter::stiffness(0))).unwrap();
    let grazed = grazed(&mut integrator);
    let mut change = |depth: f64| {
        let behind = Stretch { end: 0.6, ..PERIOD };
        let by_stiffness = integrator.flow(&behind, &[grazed - depth, -2.34]).unwrap().by_parameter;
        by_stiffness[0].hypot(by_stiffness[1])
    };
    for (depth, error) in [(1e-10, 1e-3), (1e-9, 1e-4), (1e-8, 1e-4), (1e-7, 1e-3)] {
        let ratio = change(4.0 * depth) / change(depth);
        assert!((ratio / 8.0 - 1.0).abs() < error, "depth {depth:e}: {ratio}");
    }
}

/// The mass is pressed on its stop by a constant force so that the penetration `1 + cos(w t + phase)`, up to
/// `lift`, just vanishes once a period; the motion is linear as long as it does not leave.
#[test]
fn a_stretch_may_end_where_a_contact_is_about_to_open() {
    let (frequency_hz, stiffness) = (0.2, 5.9);
    let w = TAU * frequency_hz;
    // Of x'' + 0.1 x' + 6.9 x = F cos(w t).
    let (re, im) = (1.0 + stiffness - w * w, 0.1 * w);
    let lag = im.atan2(re);
    let opens = (0.5 * TAU + lag) / TAU;
    for lift in [0.0, 1e-15, -1e-14, 1e-12, -1e-11, 1e-10, 1e-9] {
        let forces = vec![
            force(&[1.0], 0, (1.0 + stiffness) * (1.0 + lift), 0.0),
            force(&[1.0], 1, re.hypot(im), 0.0),
        ];
        let mut integrator = mass(forces, Law::Linear(LinearStop::with_gap(stiffness, 0.0).unwrap()));
        for early in [0.0, 1e-12, -1e-10, 1e-9, -1e-8, 1e-7, 1e-6, 1e-5, 1e-4] {
            for length in [0.05, 0.2, 0.3, 0.5, 0.7] {
                let end = opens - early;
                let stretch = Stretch { frequency_hz, start: end - length, end };
                let at = |phase: f64| {
                    let (sine, cosine) = (TAU * phase - lag).sin_cos();
                    [1.0 + lift + cosine, -w * sine]
                };
                let found = integrator.advance(&stretch, &at(end - length)).unwrap();
                for (found, expected) in found.iter().zip(at(end)) {
                    assert!(
                        (found - expected).abs() < 1e-10,
                        "{lift}, {early}, {length}: {found}, {expected}"
                    );
                }
            }
        }
    }
}

/// One such stretch, found on a curve of grazings, over which the release was sought and refuted for ever.
#[test]
fn an_orbit_may_be_cut_where_its_contact_is_about_to_open() {
    let (mass, force_n) = (0.637_f64, 0.813);
    let shape = [mass.sqrt().recip()];
    let load = Load { forces: vec![force(&shape, 1, force_n, 0.0)], ..Load::default() };
    let law = Law::Linear(LinearStop::with_gap(11.79, 0.0).unwrap());
    let model = model(&[(2.632 / mass).sqrt()], diagonal(&[0.1 / mass]));
    let system = System::new(model, &load, vec![element(&shape, 0.0, law)]).unwrap();
    let begin = 0.797_380_738_139_989_3;
    let stretch = Stretch { frequency_hz: 0.066_846_374_143_072, start: begin, end: begin + 1.0 };
    assert_agreement(&system, &stretch, &[6.318_959_244_744_349e-12, -1.885_540_013_249_476e-6], 1e-7, "");
}
