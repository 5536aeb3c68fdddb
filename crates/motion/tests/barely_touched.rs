//! Contacts that are barely touched, with derivatives by the parameters of their stop: of a depth of rounding and more, they cost no more steps than others.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{diagonal, element, force, hertz, model};
use hammerbeam_motion::{
    Law, Load, Parameter, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::LinearStop,
};

/// One mass whose motion turns twice beside a stop within a period of its force.
fn beside_a_stop(law: Law) -> ExactIntegrator {
    let load = Load { forces: vec![force(&[1.0], 1, 1.0, 0.0)], ..Load::default() };
    let system =
        System::new(model(&[1.0], diagonal(&[0.1])), &load, vec![element(&[1.0], 0.0, law)]).unwrap();
    ExactIntegrator::new(system, ExactSettings { tolerance: 5e-12 }).unwrap()
}

const PERIOD: Stretch = Stretch { frequency_hz: 0.105, start: 0.0, end: 1.0 };

/// Contacts of a motion that begins at the displacement `q`.
fn touches(integrator: &mut ExactIntegrator, q: f64) -> u32 {
    integrator.flow(&PERIOD, &[q, -2.34]).unwrap();
    integrator.touches()[0]
}

/// The displacement at which the first contact of the period is grazed, to rounding: there are two below and one above.
fn grazed(integrator: &mut ExactIntegrator) -> f64 {
    let (mut two, mut one) = (0.0, 0.5);
    assert_eq!([touches(integrator, two), touches(integrator, one)], [2, 1]);
    for _ in 0..60 {
        let middle = 0.5 * (two + one);
        *if touches(integrator, middle) == 2 { &mut two } else { &mut one } = middle;
    }
    two
}

#[test]
fn a_contact_of_any_depth_takes_few_steps_with_derivatives_by_its_parameters() {
    let linear = || Law::Linear(LinearStop::with_gap(37.7, 1.0).unwrap());
    for law in [linear, || hertz(100.0, 1.0)] {
        for parameter in [Parameter::Stiffness { element: 0 }, Parameter::Gap { element: 0 }] {
            let mut integrator = beside_a_stop(law());
            integrator.differentiate_by(Some(parameter)).unwrap();
            let grazed = grazed(&mut integrator);
            for decade in -16..-4 {
                let before = integrator.counts();
                let motions = 50_u32;
                for k in 0..motions {
                    let depth = 10f64.powf(f64::from(decade) + f64::from(k) / f64::from(motions));
                    touches(&mut integrator, grazed - depth);
                }
                let counts = integrator.counts();
                let solves = (counts.solves - before.solves) / u64::from(motions);
                assert!(solves < 60, "{parameter:?}, 1e{decade} from the grazing: {solves} solves a motion");
            }
        }
    }
}
