//! Curves of bifurcations, from the events of stored branches.

use hammerbeam_orbit::{
    CurveEnd, CurveKind, CurveRow, CurveSettings, CurveWalk, EventStatus, Events, LocatedEvent, OrbitError,
    PathError, PeriodicSolution, Side,
};
use hammerbeam_results::{
    reason::{CAME_BACK, OVER_PARAMETER, splits},
    store::{Store, StoreError, VariedBranch, VariedRow, solution_key},
};
use hammerbeam_study::{
    Model, Study, StudyParameter,
    file::{Curve, CurveOf},
};

use super::{
    Failed, Found,
    watch::{Watch, Way},
};
use crate::orbit_solver::settings;

/// Longest step of a curve, in hundredths of the ranges.
const MAX_STEP: f64 = 0.5;
/// Relative distance within which events may be the same.
const SIDE_BY_SIDE: f64 = 1e-4;

/// The orbit at the event nearest to the frequency of the curve, or why there is none.
pub(super) fn start(
    store: &Store,
    curve: &Curve,
) -> Result<Result<(PeriodicSolution, LocatedEvent), String>, StoreError> {
    let Some((solution, event)) = nearest_event(store, curve)? else {
        let (multiple, of) = (curve.period_multiple, curve.of.name());
        return Ok(Err(format!("no branch of period multiple {multiple} has an event \"{of}\" to begin at")));
    };
    let is_corner = event.status == EventStatus::Bracketed && !event.contacts.is_empty();
    if is_corner && curve.of != CurveOf::Grazing {
        let (of, hz) = (curve.of.name(), solution.frequency_hz);
        return Ok(Err(format!(
            "the {of} nearest to it, at {hz} Hz, is a corner of the branch at a grazing, where multipliers jump: ask for the curve of the grazing"
        )));
    }
    Ok(Ok((solution, event)))
}

/// The curve through that event.
pub(super) fn follow(
    model: &Model,
    study: &Study,
    (curve, (start, event)): (&Curve, &(PeriodicSolution, LocatedEvent)),
    watch: &Watch<'_>,
) -> Result<Found, Failed> {
    let parameter = model.parameter(study, &curve.parameter).map_err(Failed::Message)?;
    let kind = kind_of(curve.of, event);
    let [low, high] = study.excitation.range_hz();
    let [from, to] = curve.parameter.range;
    let curve_settings = CurveSettings {
        parameter: parameter.parameter,
        range: (parameter.in_system(from), parameter.in_system(to)),
        range_hz: (low, high),
        max_step: MAX_STEP,
        max_rows: study.continuation.budget_solutions,
    };
    let branch = both_sides(model, study, (start, kind), (curve, &curve_settings, &parameter), watch)?;
    Ok(Found { branches: vec![branch], message: None })
}

fn kind_of(of: CurveOf, event: &LocatedEvent) -> CurveKind {
    match (of, event.contacts.first()) {
        (CurveOf::Fold, _) => CurveKind::Fold,
        (CurveOf::Flip, _) => CurveKind::Flip,
        (CurveOf::NeimarkSacker, _) => CurveKind::NeimarkSacker,
        (CurveOf::Grazing, change) => CurveKind::Grazing { contact: change.map(|change| change.contact) },
    }
}

fn both_sides(
    model: &Model,
    study: &Study,
    (start, kind): (&PeriodicSolution, CurveKind),
    (curve, curve_settings, parameter): (&Curve, &CurveSettings, &StudyParameter),
    watch: &Watch<'_>,
) -> Result<VariedBranch, Failed> {
    let orbits = settings(&study.continuation);
    let value = model.system.parameter(parameter.parameter).map_err(|e| Failed::Message(e.to_string()))?;
    let mut way = Way::new(curve.parameter.range, parameter.in_study(value));
    let (mut rows, mut ends) = (Vec::new(), Vec::new());
    for side in [Side::Down, Side::Up] {
        let of_side = (kind, side);
        let mut walk =
            CurveWalk::new(&model.system, &model.response, start, of_side, curve_settings, &orbits)
                .map_err(|error| failed(error, curve, parameter))?;
        let mut walked = if side == Side::Up { vec![walk.start_row()?] } else { Vec::new() };
        let end = loop {
            if watch.interrupted() {
                return Err(Failed::Interrupted);
            }
            match walk.step()? {
                Ok(row) => {
                    let value = parameter.in_study(row.parameter);
                    watch.row(value, row.solution.frequency_hz, way.at(value, side == Side::Up));
                    walked.push(row);
                }
                Err(end) => break end,
            }
        };
        if let Some(last) = walked.last_mut() {
            last.events.mark_end(kind, &end);
        }
        if side == Side::Down {
            walked.reverse();
        }
        rows.extend(walked.into_iter().map(|row| varied(row, parameter, curve.parameter.range)));
        ends.push(in_words(&end, kind, curve, parameter));
        if end == CurveEnd::Closed {
            ends.push(ends[0].clone());
            break;
        }
    }
    let [down, up] = [ends.swap_remove(0), ends.pop().unwrap_or_default()];
    let kind = curve.of.name().to_owned();
    Ok(VariedBranch { period_multiple: curve.period_multiple, kind, up, down, rows })
}

fn varied(row: CurveRow, parameter: &StudyParameter, range: [f64; 2]) -> VariedRow {
    let event = row.events.label();
    VariedRow {
        parameter: parameter.in_range(row.parameter, range),
        solution: row.solution,
        event,
        located: None,
    }
}

/// The solution at the event of that kind nearest to the frequency, over all branches of that period.
fn nearest_event(
    store: &Store,
    curve: &Curve,
) -> Result<Option<(PeriodicSolution, LocatedEvent)>, StoreError> {
    let wanted = |events: Events| match curve.of {
        CurveOf::Fold => events.fold,
        CurveOf::Flip => events.flip,
        CurveOf::NeimarkSacker => events.neimark_sacker,
        CurveOf::Grazing => events.grazing,
    };
    let mut nearest: Option<(f64, i64)> = None;
    let mut found = Vec::new();
    for branch in store.branches()?.iter().filter(|branch| branch.period_multiple == curve.period_multiple) {
        for side in [Side::Up, Side::Down] {
            for (number, row) in store.walked(branch.start, side)?.iter().enumerate() {
                if !wanted(row.events) {
                    continue;
                }
                let distance = (row.frequency_hz - curve.near_hz).abs();
                let key = solution_key(branch.start, side, number as u32);
                found.push((row.frequency_hz, key));
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, key));
                }
            }
        }
    }
    let Some((_, key)) = nearest else { return Ok(None) };
    let Some(event) = store.event(key)? else { return Ok(None) };
    let (key, event) = best_known(store, &found, (key, event))?;
    Ok(Some((store.solution_of_key(key)?, event)))
}

/// Of events that cannot be told from the nearest one by their places, as at a corner that several rows mark,
/// the one that is known best.
///
/// * `found`: frequencies [Hz] and keys.
fn best_known(
    store: &Store,
    found: &[(f64, i64)],
    (key, event): (i64, LocatedEvent),
) -> Result<(i64, LocatedEvent), StoreError> {
    let hz = found.iter().find(|(_, other)| *other == key).map_or(f64::NAN, |(hz, _)| *hz);
    let (uncertainty, mut best) = (event.uncertainty, (key, event));
    for &(other_hz, other) in found.iter().filter(|(_, other)| *other != key) {
        if (other_hz - hz).abs() > SIDE_BY_SIDE * hz {
            continue;
        }
        let Some(event) = store.event(other)? else { continue };
        let is_same = (other_hz - hz).abs() <= uncertainty + event.uncertainty;
        if is_same && event.uncertainty < best.1.uncertainty {
            best = (other, event);
        }
    }
    Ok(best)
}

/// Why no curve begins, in the unit of its parameter.
fn failed(error: OrbitError, curve: &Curve, parameter: &StudyParameter) -> Failed {
    match error {
        OrbitError::Path(PathError::Start { parameter: value, cause }) => {
            let start = named(value, curve, parameter);
            Failed::Message(format!("the start at {start} was not corrected: {cause}"))
        }
        error => error.into(),
    }
}

fn named(value: f64, curve: &Curve, parameter: &StudyParameter) -> String {
    format!("{} = {}", curve.parameter.name, parameter.in_range(value, curve.parameter.range))
}

fn in_words(end: &CurveEnd, kind: CurveKind, curve: &Curve, parameter: &StudyParameter) -> String {
    match end {
        CurveEnd::RangeEnd => "end of the range of the parameter".to_owned(),
        CurveEnd::FrequencyRangeEnd => "end of the frequency range".to_owned(),
        CurveEnd::Closed => format!("the curve {CAME_BACK}"),
        CurveEnd::Resonance => "the second frequency of the motion came into a resonance of 1:1 or 1:2 \
            with its own, where its pair of multipliers becomes real and Neimark-Sacker points end"
            .to_owned(),
        CurveEnd::OwnImage { parameter: value, mirrored: true } => format!(
            "the orbits become symmetric at {}, where pairs of mirror images branch off: the curve comes back from there as that of the mirror images, over the same values",
            named(*value, curve, parameter)
        ),
        CurveEnd::OwnImage { parameter: value, mirrored: false } => format!(
            "the orbits become those of half their period at {}, where they branch off in a flip: the curve comes back from there as that of the same orbits half a period later, over the same values",
            named(*value, curve, parameter)
        ),
        CurveEnd::Grazing { parameter: value, cause } => {
            let cause = cause.as_ref().map_or(String::new(), |cause| format!(" ({cause})"));
            let resonant = kind.resonant_grazing().map_or(String::new(), |name| {
                format!(": a resonant grazing ({name}) where the curve ends on that of the grazing")
            });
            format!("met a grazing at {}{resonant}{cause}", named(*value, curve, parameter))
        }
        CurveEnd::GrazedAsWell { parameter: value, element } => {
            format!("{element} is grazed as well at {} and struck beyond", named(*value, curve, parameter))
        }
        CurveEnd::ContactSplits { parameter: value, element, phase } => {
            format!("beyond {} {}", named(*value, curve, parameter), splits(element, *phase, &OVER_PARAMETER))
        }
        CurveEnd::Crawls { parameter: value, rows } => {
            format!(
                "ended early at {}: the last {rows} solutions brought the curve no further",
                named(*value, curve, parameter)
            )
        }
        CurveEnd::Budget => "the budget of solutions is used up; with a larger budget_solutions \
            ([continuation]) a new run gets further"
            .to_owned(),
        CurveEnd::Stopped { parameter: value, message } => {
            format!("ended early at {}: {message}", named(*value, curve, parameter))
        }
    }
}
