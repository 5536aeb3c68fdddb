//! Branches with all their events, and independent looks at an orbit by the general integrator.

use faer::Mat;
use hammerbeam_motion::{
    Law, Stretch, System,
    general::{GeneralSettings, advance},
};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, Crossing, Events, OrbitSettings, PeriodicSolution, Response, Side, StopReason,
};
use hammerbeam_testkit::systems;

pub type Subject = (System, Response);

/// `x'' + c x' + k x = F cos(2 pi f t) + f(x)` with the force `f` of a law; unit mass.
pub fn oscillator(stiffness: f64, damper: f64, force: f64, law: Law) -> Subject {
    oscillator_driven_at(0.0, stiffness, damper, force, law)
}

/// The same with the force `F cos(2 pi f t + phase)`.
pub fn oscillator_driven_at(phase: f64, stiffness: f64, damper: f64, force: f64, law: Law) -> Subject {
    systems::oscillator(stiffness, damper, (force, phase), law)
}

pub fn step_of(max_step: f64) -> OrbitSettings {
    OrbitSettings { max_step, ..OrbitSettings::default() }
}

/// One side of a branch with its start, and why it ended.
pub fn side(
    (system, response): &Subject,
    start: &PeriodicSolution,
    side: Side,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> (Vec<BranchRow>, StopReason) {
    let mut walk = BranchWalk::new(system, response, start, side, range_hz, settings).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    let reason = finish(&mut walk, &mut rows);
    (rows, reason)
}

/// Both sides end to end, the down side reversed.
pub fn whole(
    subject: &Subject,
    start: &PeriodicSolution,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> Vec<BranchRow> {
    let (mut rows, _) = side(subject, start, Side::Down, range_hz, settings);
    rows.reverse();
    rows.extend(side(subject, start, Side::Up, range_hz, settings).0.into_iter().skip(1));
    rows
}

/// The branch that leaves at a row, to one side.
pub fn leaving(
    (system, response): &Subject,
    row: &BranchRow,
    side: Side,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> (Vec<BranchRow>, StopReason) {
    let crossing = crossing(row);
    let mut walk = BranchWalk::from_crossing(system, response, &crossing, side, range_hz, settings).unwrap();
    let mut rows = Vec::new();
    let reason = finish(&mut walk, &mut rows);
    (rows, reason)
}

/// The first rows of the branch that leaves at a row, over the distance from it relative to the frequency:
/// `measure` of them as long as it grows to no more than `most`.
pub fn growth(
    (system, response): &Subject,
    row: &BranchRow,
    (range_hz, settings): ((f64, f64), &OrbitSettings),
    most: f64,
    measure: impl Fn(&PeriodicSolution) -> f64,
) -> Vec<(f64, f64)> {
    let crossing = crossing(row);
    let mut walk =
        BranchWalk::from_crossing(system, response, &crossing, Side::Up, range_hz, settings).unwrap();
    let (mut rows, mut points) = (Vec::new(), Vec::new());
    while walk.step(&mut rows).unwrap().is_none() {
        let orbit = &rows[rows.len() - 1].solution;
        let grown = measure(orbit);
        if grown > most {
            break;
        }
        points.push(((orbit.frequency_hz / row.solution.frequency_hz - 1.0).abs(), grown));
    }
    points
}

fn finish(walk: &mut BranchWalk, rows: &mut Vec<BranchRow>) -> StopReason {
    loop {
        if let Some(reason) = walk.step(rows).unwrap() {
            return reason;
        }
    }
}

pub fn crossing(row: &BranchRow) -> Crossing {
    let direction = row.located.as_ref().unwrap().direction.clone();
    Crossing { orbit: row.solution.clone(), direction, factor: if row.events.flip { 2 } else { 1 } }
}

pub fn with(rows: &[BranchRow], which: fn(&Events) -> bool) -> Vec<&BranchRow> {
    rows.iter().filter(|row| which(&row.events)).collect()
}

/// Frequencies of rows, ascending.
pub fn sorted(rows: &[&BranchRow]) -> Vec<f64> {
    let mut frequencies: Vec<f64> = rows.iter().map(|row| row.solution.frequency_hz).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies
}

/// The same frequencies to a relative tolerance.
#[track_caller]
pub fn assert_same(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}: {found:?} and {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        let error = (found / expected - 1.0).abs();
        assert!(error < tolerance, "{what}: {found} and {expected} Hz, {error:.1e}");
    }
}

/// State after some excitation periods, by the general integrator.
pub fn general_advance(system: &System, frequency_hz: f64, state: &[f64], periods: u32) -> Vec<f64> {
    let settings = GeneralSettings::with_tolerance(1e-11).state_only();
    let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
    let one = |state: Vec<f64>| advance(system, &stretch, &state, &settings).unwrap().flow.state;
    (0..periods).fold(state.to_vec(), |state, _| one(state))
}

/// Floquet multipliers by the variational equations of the general integrator, largest modulus first.
pub fn general_multipliers(system: &System, orbit: &PeriodicSolution) -> Vec<[f64; 2]> {
    let size = 2 * system.dof();
    let settings = GeneralSettings::with_tolerance(1e-12);
    let stretch = first_period(orbit);
    let mut state = orbit.nodes[0].clone();
    let mut monodromy = Mat::<f64>::identity(size, size);
    for _ in 0..orbit.period_multiple {
        let flow = advance(system, &stretch, &state, &settings).unwrap().flow;
        monodromy = &flow.by_state * &monodromy;
        state = flow.state;
    }
    let mut values: Vec<[f64; 2]> =
        monodromy.eigenvalues().unwrap().iter().map(|value| [value.re, value.im]).collect();
    values.sort_by(|a, b| b[0].hypot(b[1]).total_cmp(&a[0].hypot(a[1])));
    values
}

/// How far apart the first node of an orbit and the state after its period are, by the general integrator,
/// relative to the first.
pub fn misses_itself_by(system: &System, orbit: &PeriodicSolution) -> f64 {
    let settings = GeneralSettings::with_tolerance(1e-12).state_only();
    let one = |state: Vec<f64>| advance(system, &first_period(orbit), &state, &settings).unwrap().flow.state;
    let later = (0..orbit.period_multiple).fold(orbit.nodes[0].clone(), |state, _| one(state));
    apart(system, &orbit.nodes[0], &later)
}

/// The first excitation period of an orbit from the phase at which it begins.
fn first_period(orbit: &PeriodicSolution) -> Stretch {
    Stretch { frequency_hz: orbit.frequency_hz, start: orbit.phase, end: orbit.phase + 1.0 }
}

/// Distance of two states in the energy norm, relative to the first.
pub fn apart(system: &System, a: &[f64], b: &[f64]) -> f64 {
    let n = system.dof();
    let unit = |i: usize| if i < n { system.model().natural_frequencies[i] } else { 1.0 };
    let norm =
        |value: &dyn Fn(usize) -> f64| (0..2 * n).map(|i| (value(i) * unit(i)).powi(2)).sum::<f64>().sqrt();
    norm(&|i| a[i] - b[i]) / norm(&|i| a[i])
}

/// After how many excitation periods, up to `most`, motion from a state repeats to `tolerance` when it has
/// settled for `settling` periods, by the general integrator; `None` if it does not.
pub fn settled_period(
    system: &System,
    frequency_hz: f64,
    state: &[f64],
    (settling, most): (u32, usize),
    tolerance: f64,
) -> Option<usize> {
    let mut states = vec![general_advance(system, frequency_hz, state, settling)];
    for k in 0..most {
        states.push(general_advance(system, frequency_hz, &states[k], 1));
    }
    (1..=most).find(|&period| apart(system, &states[0], &states[period]) < tolerance)
}

/// Half the distance of the states of an orbit an excitation period apart.
pub fn alternation(system: &System, orbit: &PeriodicSolution) -> f64 {
    let later = general_advance(system, orbit.frequency_hz, &orbit.nodes[0], orbit.period_multiple / 2);
    0.5 * apart(system, &orbit.nodes[0], &later)
}

/// Exponent `p` at which `y` grows with `x` at first, `x = c y^(1/p) (1 + d y^2)`: what grows to either side
/// alike has a next term of that order. A regression of `ln x` on `ln y` and `y^2`.
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let deviations = |of: fn(&(f64, f64)) -> f64| -> Vec<f64> {
        let mean = points.iter().map(of).sum::<f64>() / count;
        points.iter().map(|point| of(point) - mean).collect()
    };
    let (power, next, distance) =
        (deviations(|(_, y)| y.ln()), deviations(|(_, y)| y * y), deviations(|(x, _)| x.ln()));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (pp, pn, nn) = (dot(&power, &power), dot(&power, &next), dot(&next, &next));
    let (pd, nd) = (dot(&power, &distance), dot(&next, &distance));
    (pp * nn - pn * pn) / (nn * pd - pn * nd)
}
