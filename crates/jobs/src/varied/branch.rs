//! Branches in a parameter at a fixed frequency.

use hammerbeam_orbit::{
    BranchRow, BranchWalk, ContinuationParameter, LocatedEvent, Matcher, OrbitSettings, PeriodicSolution,
    Side, StopReason, find_orbits,
};
use hammerbeam_results::{
    reason,
    store::{VariedBranch, VariedRow},
};
use hammerbeam_study::{
    Model, Study, StudyParameter,
    file::{VariedParameter, Vary},
};

use super::{
    Failed, Found,
    watch::{Watch, Way},
};
use crate::orbit_solver::settings;

/// All branches of the orbits at the frequency.
pub(super) fn follow(model: &Model, study: &Study, vary: &Vary, watch: &Watch<'_>) -> Result<Found, Failed> {
    let parameter = model.parameter(study, &vary.parameter).map_err(Failed::Message)?;
    let value = model.system.parameter(parameter.parameter).map_err(|e| Failed::Message(e.to_string()))?;
    let [low, high] = study.excitation.range_hz();
    let searching =
        OrbitSettings { max_solutions: study.continuation.budget_solutions, ..settings(&study.continuation) };
    let orbit = (vary.frequency_hz, vary.period_multiple);
    let found = find_orbits(&model.system, &model.response, orbit, (low, high), &searching, &mut || {
        watch.interrupted()
    })?;
    let mut branches = Vec::new();
    let mut known: Vec<(f64, Vec<f64>)> = Vec::new();
    let orbits = found.orbits.len() as f64;
    for (number, start) in found.orbits.iter().enumerate() {
        let matcher = Matcher::new(&model.system, &model.response, start, &searching)?;
        if known.iter().any(|(phase, guess)| matcher.is_near((*phase, guess))) {
            continue;
        }
        let tell = |value: f64, frequency_hz: f64, part: f64| {
            watch.row(value, frequency_hz, (number as f64 + part) / orbits);
        };
        let branch = both_sides(model, study, (vary, &parameter), start, (watch, &tell))?;
        known.extend(crossings(&branch.rows, &parameter, value));
        branches.push(branch);
    }
    let message = match found.incomplete {
        Some(error) => Some(error.to_string()),
        None if branches.is_empty() => Some(format!("no periodic solution was found at {} Hz", orbit.0)),
        None => None,
    };
    Ok(Found { branches, message })
}

fn both_sides(
    model: &Model,
    study: &Study,
    (vary, parameter): (&Vary, &StudyParameter),
    start: &PeriodicSolution,
    (watch, tell): (&Watch<'_>, &dyn Fn(f64, f64, f64)),
) -> Result<VariedBranch, Failed> {
    let range = (parameter.in_system(vary.parameter.range[0]), parameter.in_system(vary.parameter.range[1]));
    let settings = OrbitSettings {
        max_step_hz: (range.1 - range.0) / f64::from(vary.steps),
        max_solutions: study.continuation.budget_solutions,
        ..settings(&study.continuation)
    };
    let other =
        ContinuationParameter::Other { parameter: parameter.parameter, frequency_hz: vary.frequency_hz };
    let value = model.system.parameter(parameter.parameter).map_err(|e| Failed::Message(e.to_string()))?;
    let mut way = Way::new(vary.parameter.range, parameter.in_study(value));
    let mut rows = Vec::new();
    let mut ends = Vec::new();
    for side in [Side::Down, Side::Up] {
        let of_side = (other, side, range);
        let mut walk = BranchWalk::varying(&model.system, &model.response, start, of_side, &settings)?;
        let mut walked = if side == Side::Up { vec![walk.start_row()?] } else { Vec::new() };
        let end = loop {
            if watch.interrupted() {
                return Err(Failed::Interrupted);
            }
            let before = walked.len();
            let reason = walk.step(&mut walked)?;
            for row in &walked[before..] {
                let value = row.parameter.map_or(f64::NAN, |value| parameter.in_study(value));
                tell(value, row.solution.frequency_hz, way.at(value, side == Side::Up));
            }
            if let Some(reason) = reason {
                break reason;
            }
        };
        if side == Side::Down {
            walked.reverse();
            for row in &mut walked {
                row.located = row.located.take().map(LocatedEvent::backwards);
            }
        }
        rows.extend(walked.into_iter().map(|row| varied(row, parameter, vary.parameter.range)));
        let closed = end == StopReason::Closed;
        ends.push(in_words(&end, &vary.parameter, parameter));
        if closed {
            // One walk is all of it.
            ends.push(ends[0].clone());
            break;
        }
    }
    let [down, up] = [ends.swap_remove(0), ends.pop().unwrap_or_default()];
    Ok(VariedBranch { period_multiple: start.period_multiple, kind: "branch".to_owned(), up, down, rows })
}

fn varied(row: BranchRow, parameter: &StudyParameter, range: [f64; 2]) -> VariedRow {
    let value = row.parameter.map_or(f64::NAN, |value| parameter.in_range(value, range));
    let located = row.located.map(|event| in_unit(event, value, parameter));
    VariedRow { parameter: value, event: row.events.label(), solution: row.solution, located }
}

/// The event with its uncertainty, and the last entry of its direction, in the unit of the parameter's name.
fn in_unit(mut event: LocatedEvent, value: f64, parameter: &StudyParameter) -> LocatedEvent {
    event.uncertainty = parameter.change_in_study(event.uncertainty).abs().max(f64::EPSILON * value.abs());
    if let Some(last) = event.direction.last_mut() {
        *last = parameter.change_in_study(*last);
    }
    event
}

/// Phases and states near the orbits in which a branch passes the value of the study.
fn crossings(rows: &[VariedRow], parameter: &StudyParameter, value: f64) -> Vec<(f64, Vec<f64>)> {
    let value = parameter.in_study(value);
    let mut found = Vec::new();
    for pair in rows.windows(2) {
        let (a, b) = (pair[0].parameter - value, pair[1].parameter - value);
        if a * b > 0.0 {
            continue;
        }
        let share = if a == b { 0.0 } else { a / (a - b) };
        let [from, to] = [&pair[0].solution, &pair[1].solution];
        if from.phase == to.phase {
            let states = from.nodes[0].iter().zip(&to.nodes[0]);
            found.push((from.phase, states.map(|(x, y)| x + share * (y - x)).collect()));
        } else {
            // The orbits were cut anew between the rows: their nodes are no neighbours.
            found.extend([from, to].map(|orbit| (orbit.phase, orbit.nodes[0].clone())));
        }
    }
    found
}

fn in_words(reason: &StopReason, varied: &VariedParameter, parameter: &StudyParameter) -> String {
    let (name, range) = (&varied.name, varied.range);
    reason::in_words(reason, &reason::OVER_PARAMETER, |value| {
        format!("{name} = {}", parameter.in_range(value, range))
    })
}
