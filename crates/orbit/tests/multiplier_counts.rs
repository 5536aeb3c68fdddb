//! How many multipliers lie outside the unit circle changes by what the events of a branch say, and by
//! nothing else.
//!
//! A chain of five masses with a linear stop and a Hertz contact between two of them, shaken in two
//! harmonics: beside a fold of its harmonic branch a pair leaves the unit circle, turns real and comes back
//! at +1 within 3e-5 Hz.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use crate::common::events::{Subject, general_multipliers, step_of, whole};
use hammerbeam_motion::{
    Harmonic, Law, Load, LocalElement, System,
    law::{HertzStop, LinearStop},
};
use hammerbeam_orbit::{BranchRow, BranchWalk, EventStatus, Response, Side, find_start};
use hammerbeam_structure::{Connection, Damping, GROUND, Lumped, LumpedMass, Reduction};

fn chain() -> Subject {
    let masses = [("a", 1.0), ("b", 0.7), ("c", 1.3), ("d", 0.4), ("e", 0.9)];
    let link =
        |(from, to, constant): (&str, &str, f64)| Connection { between: [from.into(), to.into()], constant };
    let springs =
        [(GROUND, "a", 4e3), ("a", "b", 3e3), ("b", "c", 5e3), ("c", "d", 2.5e3), ("d", "e", 1.8e3)];
    let lumped = Lumped {
        masses: masses.map(|(name, mass)| LumpedMass { name: name.into(), mass }).to_vec(),
        springs: springs.map(link).to_vec(),
        dampers: [(GROUND, "a", 4.0), ("b", "c", 90.0), ("d", "e", 2.0)].map(link).to_vec(),
    };
    let shaken = lumped.structure().unwrap().with_support_motion(&[GROUND]).unwrap();
    let model = shaken.reduce(&Reduction::None, &Damping::rayleigh(0.4, 1e-4), &[]).unwrap().model;
    let point = |name: &str| model.point(name).unwrap().clone();
    let (b, d, e) = (point("b"), point("d"), point("e"));
    let element = |name: &str, shape: Vec<f64>, support_ratio: f64, law: Law| LocalElement {
        name: name.into(),
        shape,
        support_ratios: vec![support_ratio],
        law,
    };
    let between = b.shape.iter().zip(&d.shape).map(|(b, d)| b - d).collect();
    let hertz = Law::Hertz(HertzStop::with_gap(3e6, 0.5e-3).unwrap());
    let linear = Law::Linear(LinearStop::with_gap(8e3, 1e-3).unwrap());
    let elements = vec![
        element("s1", e.shape.clone(), e.support_ratios[0], linear),
        element("s2", between, b.support_ratios[0] - d.support_ratios[0], hertz),
    ];
    let harmonic = |order: u32, amplitude: f64, phase: f64| Harmonic { order, amplitude, phase };
    let support = vec![harmonic(1, 0.5e-3, 0.0).into(), harmonic(2, 0.1e-3, 1.0).into()];
    let system = System::new(model.clone(), &Load { support, forces: vec![] }, elements).unwrap();
    (system, Response { shape: e.shape, support_ratios: e.support_ratios })
}

/// How many multipliers lie outside, without those this close to the circle, and with them.
fn outside(row: &BranchRow) -> [usize; 2] {
    [1e-4, -1e-4].map(|margin| {
        let beyond = |[re, im]: &&[f64; 2]| re.hypot(*im) > 1.0 + margin;
        row.solution.floquet_multipliers.iter().filter(beyond).count()
    })
}

/// The fold near 3.57637 Hz, reached from these starts upwards: beside it a Neimark-Sacker point, the pair of
/// which is on the circle by other means too.
#[test]
fn a_pair_that_crosses_and_comes_back_real_beside_a_fold_is_found() {
    let subject = chain();
    for start_hz in [3.41, 3.43, 3.45, 3.47, 3.49, 3.51] {
        let start = find_start(&subject.0, &subject.1, start_hz, 1, &step_of(0.0021)).unwrap();
        let mut walk =
            BranchWalk::new(&subject.0, &subject.1, &start, Side::Up, (1.5, 12.0), &step_of(0.0021)).unwrap();
        let mut rows = Vec::new();
        let at_fold = |row: &BranchRow| row.events.fold && (row.solution.frequency_hz - 3.57637).abs() < 1e-5;
        let beyond = |row: &BranchRow| (row.solution.frequency_hz - 3.57637).abs() > 1e-4;
        while !rows.iter().any(at_fold) || !rows.last().is_some_and(beyond) {
            assert_eq!(walk.step(&mut rows).unwrap(), None);
        }
        let fold = rows.iter().find(|row| at_fold(row)).unwrap().solution.frequency_hz;
        let near =
            |row: &&BranchRow| row.events.neimark_sacker && (row.solution.frequency_hz - fold).abs() < 1e-4;
        let found: Vec<&BranchRow> = rows.iter().filter(near).collect();
        assert_eq!(found.len(), 1, "from {start_hz} Hz");
        assert_eq!(found[0].located.as_ref().unwrap().status, EventStatus::Located);
        let multipliers = general_multipliers(&subject.0, &found[0].solution);
        let pair =
            multipliers.iter().filter(|[_, im]| *im != 0.0).map(|[re, im]| (re.hypot(*im) - 1.0).abs());
        assert!(pair.fold(f64::INFINITY, f64::min) < 1e-5, "{multipliers:?}");
    }
}

#[test]
fn no_more_multipliers_cross_the_circle_than_events_say() {
    let subject = chain();
    let start = find_start(&subject.0, &subject.1, 3.45, 1, &step_of(0.002)).unwrap();
    let rows = whole(&subject, &start, (3.4, 3.65), &step_of(0.002));
    let crossing = |row: &BranchRow| {
        let events = row.events;
        usize::from(events.fold || events.branch_point)
            + usize::from(events.flip)
            + 2 * usize::from(events.neimark_sacker)
    };
    // Between two rows without an event no multiplier crosses. At a change of contact they may jump.
    for pair in
        rows.windows(2).filter(|pair| pair.iter().all(|row| crossing(row) == 0 && !row.events.grazing))
    {
        let [before, after] = [outside(&pair[0]), outside(&pair[1])];
        assert!(
            before[0] <= after[1] && after[0] <= before[1],
            "{before:?} and {after:?} outside at {} Hz",
            pair[1].solution.frequency_hz
        );
    }
    // Over an event as many cross as it says.
    for triple in rows.windows(3).filter(|rows| crossing(&rows[1]) > 0) {
        let clear =
            |row: &BranchRow| crossing(row) == 0 && !row.events.grazing && outside(row)[0] == outside(row)[1];
        if clear(&triple[0]) && clear(&triple[2]) && !triple[1].events.grazing {
            let change = outside(&triple[0])[0].abs_diff(outside(&triple[2])[0]);
            assert_eq!(change, crossing(&triple[1]), "at {} Hz", triple[1].solution.frequency_hz);
        }
    }
}
