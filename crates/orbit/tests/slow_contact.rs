//! A branch that ends where a contact begins with next to no speed: with a law that loses in proportion to
//! one over that speed, the sensitivities within the contact round by so much there that one evaluation takes
//! tens of thousands of steps of the motion, while steps of the path are not short.
//!
//! A mass bounces on a stop, once more with each fall of the frequency, and the last bounce begins ever more
//! slowly.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::events::{general_multipliers, misses_itself_by, side};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, System,
    law::{HertzStop, RestitutionModel, RestitutionStop},
};
use hammerbeam_orbit::{BranchWalk, OrbitSettings, Response, Side, StopReason, find_start};
use hammerbeam_structure::{Connection, Damping, GROUND, Lumped, LumpedMass, ReducedModel, Reduction};

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
        supports: vec![],
        uniform_acceleration: vec![1.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: 4.903, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let elastic = HertzStop::with_gap(9.9513e8, 0.0).unwrap();
    let law = RestitutionStop::new(elastic, RestitutionModel::HuntCrossley, RESTITUTION).unwrap();
    let law = Law::Restitution(law);
    let stop = LocalElement { name: "stop".into(), shape: vec![-1.0], support_ratios: vec![0.0], law };
    (System::new(model, &load, vec![stop]).unwrap(), Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

#[test]
fn a_contact_that_starts_too_slowly_to_be_computed_ends_the_branch_where_it_reopens() {
    let (system, response) = bouncing();
    let settings = OrbitSettings { max_step: 0.1, ..OrbitSettings::default() };
    let start = find_start(&system, &response, 6.1, 1, &settings).unwrap();
    let mut walk = BranchWalk::new(&system, &response, &start, Side::Down, (2.0, 60.0), &settings).unwrap();
    let mut rows = Vec::new();
    let mut end = None;
    while end.is_none() && rows.len() < MOST_ROWS {
        end = walk.step(&mut rows).unwrap();
    }
    assert!(matches!(&end, Some(StopReason::ContactReopens { element, .. }) if element == "stop"), "{end:?}");
}

/// Two masses in a row, 1 and 0.478 kg on 1 and 1.498 N/m, the outer one driven and 0.401 m above a stop
/// after Flores.
fn above_a_stop() -> (System, Response) {
    let mass = |name: &str, mass: f64| LumpedMass { name: name.into(), mass };
    let link = |to: &str, constant: f64| Connection { between: ["a".into(), to.into()], constant };
    let springs = vec![link(GROUND, 1.0), link("b", 1.498)];
    let masses = vec![mass("a", 1.0), mass("b", 0.478)];
    let lumped = Lumped { masses, springs, dampers: vec![] };
    let damping = Damping::rayleigh(0.0433, 0.01082);
    let model = lumped.structure().unwrap().reduce(&Reduction::None, &damping, &[]).unwrap().model;
    let outer = model.point("b").unwrap().clone();
    let harmonic = Harmonic { order: 1, amplitude: 0.599, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: outer.shape.clone(), harmonic }] };
    let elastic = HertzStop::with_gap(188.343, 0.401).unwrap();
    let law = Law::Restitution(RestitutionStop::new(elastic, RestitutionModel::Flores, 0.37).unwrap());
    let shape = outer.shape.iter().map(|phi| -phi).collect();
    let stop = LocalElement { name: "stop".into(), shape, support_ratios: vec![0.0], law };
    let system = System::new(model, &load, vec![stop]).unwrap();
    (system, Response { shape: outer.shape, support_ratios: vec![0.0] })
}

/// Multipliers go like the distance from the end to the power of -4, and beyond some 1e8 the general
/// integrator finds a motion without the contact that begins last.
#[test]
fn rows_beside_a_reopening_are_distinguished_from_the_other_side() {
    let subject = above_a_stop();
    let settings = OrbitSettings { max_step: 1e-3, ..OrbitSettings::default() };
    let start = find_start(&subject.0, &subject.1, 0.38, 2, &settings).unwrap();
    let (rows, end) = side(&subject, &start, Side::Down, (0.29677, 0.44867), &settings);
    assert!(matches!(&end, StopReason::ContactReopens { element, .. } if element == "stop"), "{end:?}");
    let largest = rows[rows.len() - 1].solution.largest_multiplier();
    assert!(largest > 1e5, "{largest:e}: that is not up to the end");
    for orbit in rows.iter().rev().take(5).map(|row| &row.solution) {
        let missed = misses_itself_by(&subject.0, orbit);
        assert!(missed < 1e-8 * orbit.largest_multiplier(), "{} Hz: {missed:e}", orbit.frequency_hz);
        let [re, im] = general_multipliers(&subject.0, orbit)[0];
        let error = (re.hypot(im) / orbit.largest_multiplier() - 1.0).abs();
        assert!(error < 0.1, "{} Hz: {re:e}, {:e}", orbit.frequency_hz, orbit.largest_multiplier());
    }
}
