//! Systems shared by the tests of periodic orbits.
#![allow(dead_code, reason = "each test file uses some of them")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

pub mod events;
pub mod independent;

use faer::Mat;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, System,
    law::{HertzStop, LinearStop, PowerSpring},
};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitSettings, PeriodicSolution, Response, Segments, Side, StopReason, find_start,
    reach_orbit,
};
use hammerbeam_structure::{
    Beam, BeamPoint, Connection, Damping, End, GROUND, Lumped, LumpedMass, PointOutput, ReducedModel,
    Reduction, Section,
};

/// The six-dof beam of the paper with its Hertz stop.
pub fn beam() -> (System, Response) {
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
    let model = shaken.reduce(&reduction, &Damping::modal(0.015), &["contact"]).unwrap().model;
    let point = model.point("contact").unwrap().clone();
    let load = Load {
        support: vec![Harmonic { order: 1, amplitude: 0.5015e-3, phase: 0.0 }.into()],
        forces: vec![],
    };
    let stop = LocalElement {
        name: "stop".into(),
        shape: point.shape.iter().map(|phi| -phi).collect(),
        support_ratios: vec![0.0],
        law: Law::Hertz(HertzStop::with_gap(4.5e9, 0.0).unwrap()),
    };
    let system = System::new(model, &load, vec![stop]).unwrap();
    (system, Response { shape: point.shape, support_ratios: point.support_ratios })
}

/// Three masses in a row with springs, and dampers that couple the modes; a force on the last, and a stop out
/// of its reach or none.
pub fn chain(with_stop: bool) -> (System, Response) {
    let mass = |name: &str, mass: f64| LumpedMass { name: name.into(), mass };
    let link =
        |from: &str, to: &str, constant: f64| Connection { between: [from.into(), to.into()], constant };
    let lumped = Lumped {
        masses: vec![mass("a", 1.0), mass("b", 2.0), mass("c", 0.5)],
        springs: vec![link("a", GROUND, 900.0), link("a", "b", 1600.0), link("b", "c", 400.0)],
        dampers: vec![link("a", GROUND, 0.9), link("b", "c", 0.7)],
    };
    let model = lumped.structure().unwrap().reduce(&Reduction::None, &Damping::none(), &[]).unwrap().model;
    let last = model.point("c").unwrap().clone();
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: last.shape.clone(), harmonic }] };
    let law = Law::Linear(LinearStop::with_gap(1000.0, 1.0).unwrap());
    let stop =
        LocalElement { name: "stop".into(), shape: last.shape.clone(), support_ratios: vec![0.0], law };
    let elements = if with_stop { vec![stop] } else { vec![] };
    let system = System::new(model, &load, elements).unwrap();
    (system, Response { shape: last.shape, support_ratios: vec![0.0] })
}

/// `x'' + damping x' + x = 0`.
pub fn unit_mass(damping: f64) -> ReducedModel {
    ReducedModel {
        natural_frequencies: vec![1.0],
        damping: Mat::from_fn(1, 1, |_, _| damping),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0],
    }
}

/// `x'' + 0.1 x' + x + x^3 = 0.3 cos(2 pi f t)`.
pub fn duffing() -> (System, Response) {
    let model = unit_mass(0.1);
    let harmonic = Harmonic { order: 1, amplitude: 0.3, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let law = Law::Power(PowerSpring::cubic(1.0).unwrap());
    let spring = LocalElement { name: "spring".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
    let system = System::new(model, &load, vec![spring]).unwrap();
    (system, Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

/// The harmonic orbit at a frequency, along its branch from where motions settle on it.
pub fn orbit_at((system, response): &(System, Response), frequency_hz: f64) -> PeriodicSolution {
    reach_orbit(system, response, (frequency_hz, 1), &OrbitSettings::default(), &mut || false).unwrap()
}

/// Both sides of a harmonic branch joined, the lower end first, and the shooting evaluations they took.
pub fn walk_both(
    (system, response): &(System, Response),
    start_hz: f64,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> (Vec<BranchRow>, u64) {
    let start = find_start(system, response, start_hz, 1, settings).unwrap();
    let (mut rows, down) = walk(system, response, &start, Side::Down, range_hz, settings);
    rows.reverse();
    let (upper, up) = walk(system, response, &start, Side::Up, range_hz, settings);
    rows.extend(upper.into_iter().skip(1));
    (rows, down + up)
}

/// Walks one side to the end of the range: the start row first.
pub fn walk(
    system: &System,
    response: &Response,
    start: &PeriodicSolution,
    side: Side,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> (Vec<BranchRow>, u64) {
    let mut walk = BranchWalk::new(system, response, start, side, range_hz, settings).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    loop {
        if let Some(reason) = walk.step(&mut rows).unwrap() {
            assert!(matches!(reason, StopReason::RangeEnd { .. }), "{reason:?}");
            return (rows, walk.evaluations());
        }
    }
}

/// The same orbit computed with other settings: corrected by the start of a walk.
pub fn recomputed(
    system: &System,
    response: &Response,
    orbit: &PeriodicSolution,
    settings: &OrbitSettings,
) -> PeriodicSolution {
    let range = (0.5 * orbit.frequency_hz, 2.0 * orbit.frequency_hz);
    let mut walk = BranchWalk::new(system, response, orbit, Side::Up, range, settings).unwrap();
    walk.start_row().unwrap().solution
}

/// Settings with that many segments.
pub fn with_segments(count: usize) -> OrbitSettings {
    OrbitSettings { segments: Segments::Fixed(count), ..OrbitSettings::default() }
}
