//! Oscillators that do not touch each other, as one system, of which the solver knows no better: its
//! multipliers are the multipliers of all of them.

use faer::Mat;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, System, law};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, CurveEnd, CurveKind, CurveRow, CurveSettings, CurveWalk, EventStatus, Events,
    OrbitSettings, Response, Side, find_start,
};
use hammerbeam_structure::{PointOutput, ReducedModel};

pub type Case = (System, Response);

/// `q'' + C q' + W^2 q = F cos(2 pi f t)`, of unit mass, with local forces along shapes.
#[derive(Clone)]
pub struct Part {
    pub frequencies: Vec<f64>,
    /// C by rows.
    pub damping: Vec<Vec<f64>>,
    pub force: Vec<f64>,
    pub elements: Vec<(Vec<f64>, Law)>,
}

/// One mode.
pub fn oscillator(frequency: f64, damping: f64, force: f64, law: Law) -> Part {
    Part {
        frequencies: vec![frequency],
        damping: vec![vec![damping]],
        force: vec![force],
        elements: vec![(vec![1.0], law)],
    }
}

/// A hardening spring.
pub fn cubic(stiffness: f64) -> Law {
    Law::Power(law::PowerSpring::cubic(stiffness).unwrap())
}

/// A stop.
pub fn stop(stiffness: f64, gap: f64) -> Law {
    Law::Linear(law::LinearStop::with_gap(stiffness, gap).unwrap())
}

/// Two equal modes at rest, so damped that `q_1 - q_2` has the damper `damping`, which an added ratio takes
/// to zero at `-damping/(2 frequency)`: there its multipliers `exp(+-i frequency T)` are on the unit circle,
/// whatever the rest of the system does.
pub fn resting_pair(frequency: f64, damping: f64) -> Part {
    Part {
        frequencies: vec![frequency; 2],
        damping: vec![vec![0.3, 0.3 - damping], vec![0.3 - damping, 0.3]],
        force: vec![0.0; 2],
        elements: Vec::new(),
    }
}

/// Two modes with two cubic springs, driven so hard that they interact: they have Neimark-Sacker points.
pub fn two_modes() -> Part {
    Part {
        frequencies: vec![1.0, 1.5],
        damping: vec![vec![0.05, 0.0], vec![0.0, 0.05]],
        force: vec![1.5, 0.45],
        elements: vec![(vec![1.0, 1.0], cubic(1.0)), (vec![1.0, -1.0], cubic(0.5))],
    }
}

/// All parts as one system; the response is the first mode.
pub fn together(parts: &[Part]) -> Case {
    let firsts: Vec<usize> = parts
        .iter()
        .scan(0, |next, part| {
            *next += part.frequencies.len();
            Some(*next - part.frequencies.len())
        })
        .collect();
    let count = parts.iter().map(|part| part.frequencies.len()).sum();
    let wide = |first: usize, values: &[f64]| -> Vec<f64> {
        let mut wide = vec![0.0; count];
        wide[first..first + values.len()].copy_from_slice(values);
        wide
    };
    let mut damping = Mat::zeros(count, count);
    let (mut force, mut elements) = (vec![0.0; count], Vec::new());
    for (part, &first) in parts.iter().zip(&firsts) {
        for (i, row) in part.damping.iter().enumerate() {
            row.iter().enumerate().for_each(|(j, entry)| damping[(first + i, first + j)] = *entry);
            force[first + i] = part.force[i];
        }
        elements.extend(part.elements.iter().map(|(shape, law)| LocalElement {
            name: "local".into(),
            shape: wide(first, shape),
            support_ratios: vec![0.0],
            law: law.clone(),
        }));
    }
    let response = wide(0, &[1.0]);
    let model = ReducedModel {
        natural_frequencies: parts.iter().flat_map(|part| part.frequencies.clone()).collect(),
        damping,
        points: vec![PointOutput {
            name: "first".into(),
            shape: response.clone(),
            support_ratios: vec![0.0],
        }],
        supports: vec![],
        uniform_acceleration: response.clone(),
    };
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: force, harmonic }] };
    (System::new(model, &load, elements).unwrap(), Response { shape: response, support_ratios: vec![0.0] })
}

/// The same with another value of a parameter.
pub fn with(case: &Case, parameter: Parameter, value: f64) -> Case {
    (case.0.clone().with_parameter(parameter, value).unwrap(), case.1.clone())
}

/// Rows with an event, sharply located, of the branch through the orbit of the period of the excitation at
/// the lower end of a range.
pub fn events(case: &Case, range_hz: (f64, f64), wanted: fn(&Events) -> bool) -> Vec<BranchRow> {
    events_up_to(case, range_hz, wanted, f64::INFINITY)
}

/// Those up to one at this frequency, to five digits.
pub fn events_up_to(
    case: &Case,
    range_hz: (f64, f64),
    wanted: fn(&Events) -> bool,
    last_hz: f64,
) -> Vec<BranchRow> {
    let settings = OrbitSettings::for_range(range_hz);
    let start = find_start(&case.0, &case.1, 1.001 * range_hz.0, 1, &settings).unwrap();
    let sharp = |row: &BranchRow| row.located.as_ref().is_some_and(|l| l.status == EventStatus::Located);
    let is_last = |row: &BranchRow| (row.solution.frequency_hz / last_hz - 1.0).abs() < 1e-5;
    let (mut found, mut rows): (Vec<BranchRow>, Vec<BranchRow>) = (Vec::new(), Vec::new());
    for side in [Side::Down, Side::Up] {
        let mut walk = BranchWalk::new(&case.0, &case.1, &start, side, range_hz, &settings).unwrap();
        while !found.last().is_some_and(is_last) && walk.step(&mut rows).unwrap().is_none() {
            found.extend(rows.drain(..).filter(|row| wanted(&row.events) && sharp(row)));
        }
    }
    found
}

/// The nearest of the frequencies of events to another one, relative to it.
pub fn nearest(rows: &[BranchRow], to: f64) -> f64 {
    rows.iter().map(|row| (row.solution.frequency_hz / to - 1.0).abs()).fold(f64::INFINITY, f64::min)
}

/// Both sides of a curve, with their ends.
pub fn curve(
    (system, response): &Case,
    start: &BranchRow,
    kind: CurveKind,
    (parameter, range, range_hz): (Parameter, (f64, f64), (f64, f64)),
) -> (Vec<CurveRow>, [CurveEnd; 2]) {
    let settings = CurveSettings { parameter, range, range_hz, max_step: 1.0, max_rows: 5000 };
    let mut rows = Vec::new();
    let ends = [Side::Down, Side::Up].map(|side| {
        let orbits = OrbitSettings::default();
        let mut walk =
            CurveWalk::new(system, response, &start.solution, (kind, side), &settings, &orbits).unwrap();
        loop {
            match walk.step().unwrap() {
                Ok(row) => rows.push(row),
                Err(end) => break end,
            }
        }
    });
    (rows, ends)
}

/// Rows with that word among their events.
pub fn marked<'a>(rows: &'a [CurveRow], name: &str) -> Vec<&'a CurveRow> {
    rows.iter().filter(|row| row.events.label().split('+').any(|word| word == name)).collect()
}
