//! A system with what is observed, the beam of the paper as one, and walks of its branches.

use hammerbeam_motion::{Law, System};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitSettings, PeriodicSolution, Response, Side, StopReason, find_start,
};

use crate::{
    laws::hertz,
    structures::paper_beam_model,
    systems::{element, response_of, shaken},
};

/// A system and the displacement that is observed.
#[derive(Debug, Clone)]
pub struct ObservedSystem {
    /// The system.
    pub system: System,
    /// The displacement.
    pub response: Response,
}

/// The beam of the paper with its Hertz stop.
pub fn paper_rig() -> ObservedSystem {
    paper_rig_with(0.015, &[(-1.0, hertz(4.5e9, 0.0))])
}

/// The shaken beam with the stops `laws`, each below (`sign` -1) or above (+1) the contact point and riding
/// on the support.
pub fn paper_rig_with(damping_ratio: f64, laws: &[(f64, Law)]) -> ObservedSystem {
    let model = paper_beam_model(damping_ratio);
    let response = response_of(&model, "contact");
    let stop = |(sign, law): &(f64, Law)| {
        let shape: Vec<f64> = response.shape.iter().map(|phi| sign * phi).collect();
        element(&shape, 0.0, law.clone())
    };
    let system = System::new(model, &shaken(0.5015e-3), laws.iter().map(stop).collect()).unwrap();
    ObservedSystem { system, response }
}

/// A branch, both sides joined: the lower end first, as walked upwards.
#[derive(Debug)]
pub struct Walked {
    /// The rows.
    pub rows: Vec<BranchRow>,
    /// Index of the start.
    pub start: usize,
    /// Why the sides ended: down, up.
    pub reasons: [StopReason; 2],
    /// Shooting evaluations of the sides: down, up.
    pub evaluations: [u64; 2],
}

impl Walked {
    /// Frequencies of the folds, ascending.
    pub fn folds(&self) -> Vec<f64> {
        folds(&self.rows)
    }

    /// The row with the largest displacement at frequencies between these.
    pub fn peak(&self, low_hz: f64, high_hz: f64) -> &BranchRow {
        let within = self.rows.iter().filter(|row| (low_hz..=high_hz).contains(&row.solution.frequency_hz));
        within
            .max_by(|a, b| a.solution.maxima.displacement.total_cmp(&b.solution.maxima.displacement))
            .unwrap()
    }
}

/// Frequencies of the folds of some rows, ascending.
pub fn folds(rows: &[BranchRow]) -> Vec<f64> {
    let mut folds: Vec<f64> =
        rows.iter().filter(|row| row.events.fold).map(|row| row.solution.frequency_hz).collect();
    folds.sort_by(f64::total_cmp);
    folds
}

/// Walks one side to its end: the start row first.
pub fn walk(
    rig: &ObservedSystem,
    start: &PeriodicSolution,
    side: Side,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> (Vec<BranchRow>, StopReason, u64) {
    let mut walk = BranchWalk::new(&rig.system, &rig.response, start, side, range_hz, settings).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    loop {
        if let Some(reason) = walk.step(&mut rows).unwrap() {
            return (rows, reason, walk.evaluations());
        }
    }
}

/// Finds the harmonic orbit at `start_hz` and walks both ways.
pub fn walk_both(
    rig: &ObservedSystem,
    start_hz: f64,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> Walked {
    let start = find_start(&rig.system, &rig.response, start_hz, 1, settings).unwrap();
    let (mut rows, down, down_evaluations) = walk(rig, &start, Side::Down, range_hz, settings);
    rows.reverse();
    let index = rows.len() - 1;
    let (upper, up, up_evaluations) = walk(rig, &start, Side::Up, range_hz, settings);
    rows.extend(upper.into_iter().skip(1));
    Walked { rows, start: index, reasons: [down, up], evaluations: [down_evaluations, up_evaluations] }
}
