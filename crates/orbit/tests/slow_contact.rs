//! A branch that ends where a contact begins with next to no speed: with a law that loses in proportion to one over that speed, the sensitivities within the contact round by so much there that one
//! evaluation takes tens of thousands of steps of the motion, while steps of the path are not short.
//!
//! A mass bounces on a stop, once more with each fall of the frequency, and the last bounce begins ever more slowly.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, System,
    law::{HertzStop, RestitutionModel, RestitutionStop},
};
use hammerbeam_orbit::{BranchWalk, OrbitSettings, Response, Side, StopReason, find_start};
use hammerbeam_structure::ReducedModel;

const STIFFNESS: f64 = 4480.5;
const RESTITUTION: f64 = 0.7;
/// More than it takes, and few enough to fail soon.
const MOST_ROWS: usize = 160;

/// Unit mass without a gap from its stop.
fn bouncing() -> (System, Response) {
    let model = ReducedModel {
        natural_frequencies: vec![STIFFNESS.sqrt()],
        damping: faer::mat![[10.59 + 0.4 * STIFFNESS.sqrt()]],
        points: vec![],
        support: None,
        uniform_acceleration: vec![1.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: 4.903, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let elastic = HertzStop::with_gap(9.9513e8, 0.0).unwrap();
    let law = RestitutionStop::new(elastic, RestitutionModel::HuntCrossley, RESTITUTION).unwrap();
    let law = Law::Restitution(law);
    let stop = LocalElement { name: "stop".into(), shape: vec![-1.0], support_ratio: 0.0, law };
    (System::new(model, &load, vec![stop]).unwrap(), Response { shape: vec![1.0], support_ratio: 0.0 })
}

#[test]
fn a_contact_that_begins_too_slowly_to_be_computed_ends_the_branch_where_it_splits() {
    let (system, response) = bouncing();
    let settings = OrbitSettings { max_step_hz: 0.1, ..OrbitSettings::default() };
    let start = find_start(&system, &response, 6.1, 1, &settings).unwrap();
    let mut walk = BranchWalk::new(&system, &response, &start, Side::Down, (2.0, 60.0), &settings).unwrap();
    let mut rows = Vec::new();
    let mut end = None;
    while end.is_none() && rows.len() < MOST_ROWS {
        end = walk.step(&mut rows).unwrap();
    }
    assert!(matches!(&end, Some(StopReason::ContactSplits { element, .. }) if element == "stop"), "{end:?}");
}
