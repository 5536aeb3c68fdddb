//! Structures and walks shared by the verification tests.
#![allow(dead_code, reason = "each test file uses some of them")]
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

pub mod crossings;
pub mod spectrum;

use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, System, law::HertzStop};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitSettings, PeriodicSolution, Response, Side, StopReason, find_start,
};
use hammerbeam_structure::{
    Beam, BeamPoint, Connection, Damping, End, GROUND, Lumped, LumpedMass, ReducedModel, Reduction, Section,
};

/// A system and the displacement that is observed.
#[derive(Debug, Clone)]
pub struct Rig {
    pub system: System,
    pub response: Response,
}

/// The beam of van de Vorst, Fey, de Kraker and van Campen, unreduced; parameters in the file of its
/// eigenfrequencies.
pub fn paper_beam_model(damping_ratio: f64) -> ReducedModel {
    let contact = BeamPoint {
        name: "contact".into(),
        at: 0.2432157,
        mass: 0.03756,
        rotary_inertia: 1.59e-8,
        ..BeamPoint::default()
    };
    let beam = Beam {
        length: 0.2579822,
        elements: 44,
        section: Section::rectangle(0.0298, 0.0020).unwrap(),
        youngs_modulus: 2.1e11,
        density: 7800.0,
        left: End::Clamped,
        right: End::Free,
        points: vec![contact],
    };
    let shaken = beam.structure().unwrap().with_support_motion(&["left"]).unwrap();
    let reduction = Reduction::FreeInterface { cut_off_hz: 1000.0 };
    shaken.reduce(&reduction, &Damping::modal(damping_ratio), &["contact"]).unwrap().model
}

/// The shaken beam with the stops `laws`, each below (`sign` -1) or above (+1) the contact point and riding
/// on the support.
pub fn paper_beam_with(damping_ratio: f64, laws: &[(f64, Law)]) -> Rig {
    let model = paper_beam_model(damping_ratio);
    let point = model.point("contact").unwrap().clone();
    let load = shaken(0.5015e-3);
    let element = |(sign, law): &(f64, Law)| LocalElement {
        name: "stop".into(),
        shape: point.shape.iter().map(|phi| sign * phi).collect(),
        support_ratios: vec![0.0],
        law: law.clone(),
    };
    let system = System::new(model, &load, laws.iter().map(element).collect()).unwrap();
    Rig { system, response: Response { shape: point.shape, support_ratios: point.support_ratios } }
}

/// The beam of the paper with its Hertz stop.
pub fn paper_beam() -> Rig {
    paper_beam_with(0.015, &[(-1.0, hertz(4.5e9, 0.0))])
}

/// `u = A cos(2 pi f t)`.
pub fn shaken(amplitude: f64) -> Load {
    Load { support: vec![Harmonic { order: 1, amplitude, phase: 0.0 }.into()], forces: vec![] }
}

pub fn hertz(stiffness: f64, gap: f64) -> Law {
    Law::Hertz(HertzStop::with_gap(stiffness, gap).unwrap())
}

/// One mass with a spring and a damper to the ground, which can move if `ground_moves`.
pub fn single_mass(mass: f64, stiffness: f64, damping: f64, ground_moves: bool) -> ReducedModel {
    masses(&[("mass", mass)], &[("mass", GROUND, stiffness)], &[("mass", GROUND, damping)], ground_moves)
}

/// Masses along a line with springs and dampers between them.
pub fn masses(
    masses: &[(&str, f64)],
    springs: &[(&str, &str, f64)],
    dampers: &[(&str, &str, f64)],
    ground_moves: bool,
) -> ReducedModel {
    let connections = |list: &[(&str, &str, f64)]| {
        list.iter()
            .map(|&(from, to, constant)| Connection { between: [from.into(), to.into()], constant })
            .collect()
    };
    let lumped = Lumped {
        masses: masses.iter().map(|&(name, mass)| LumpedMass { name: name.into(), mass }).collect(),
        springs: connections(springs),
        dampers: connections(dampers),
    };
    let structure = lumped.structure().unwrap();
    let structure = if ground_moves { structure.with_support_motion(&[GROUND]).unwrap() } else { structure };
    structure.reduce(&Reduction::None, &Damping::none(), &[]).unwrap().model
}

/// A force `amplitude cos(2 pi order f t + phase)` at a point; order 0 is constant.
pub fn force_at(model: &ReducedModel, point: &str, order: u32, amplitude: f64) -> HarmonicForce {
    let shape = model.point(point).unwrap().shape.clone();
    HarmonicForce { shape, harmonic: Harmonic { order, amplitude, phase: 0.0 } }
}

/// A local element between a point and its surroundings; `support_ratio` 0 if these ride on the support.
pub fn element_at(model: &ReducedModel, point: &str, law: Law) -> LocalElement {
    let point = model.point(point).unwrap();
    LocalElement { name: "element".into(), shape: point.shape.clone(), support_ratios: vec![0.0], law }
}

/// The displacement of a point.
pub fn response_of(model: &ReducedModel, point: &str) -> Response {
    let point = model.point(point).unwrap();
    Response { shape: point.shape.clone(), support_ratios: point.support_ratios.clone() }
}

/// A branch, both sides joined: the lower end first, as walked upwards.
#[derive(Debug)]
pub struct Walked {
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
    rig: &Rig,
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
pub fn walk_both(rig: &Rig, start_hz: f64, range_hz: (f64, f64), settings: &OrbitSettings) -> Walked {
    let start = find_start(&rig.system, &rig.response, start_hz, 1, settings).unwrap();
    let (mut rows, down, down_evaluations) = walk(rig, &start, Side::Down, range_hz, settings);
    rows.reverse();
    let index = rows.len() - 1;
    let (upper, up, up_evaluations) = walk(rig, &start, Side::Up, range_hz, settings);
    rows.extend(upper.into_iter().skip(1));
    Walked { rows, start: index, reasons: [down, up], evaluations: [down_evaluations, up_evaluations] }
}

/// Whether whole sweeps are asked for.
pub fn extensive() -> bool {
    std::env::var_os("HAMMERBEAM_EXTENSIVE").is_some_and(|value| value == "1")
}
