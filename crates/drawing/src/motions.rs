//! Figures of motions that need not repeat: sweeps, exponents, sections, basins.

use hammerbeam_attractor::{Attractor, Axis, Class, Grid, behind_rigid_stops};
use hammerbeam_figure::{
    BasinAttractor, BasinMap, ConvergenceDiagram, DrawnMotion, ExponentDiagram, ExponentPoint, FrequencyUnit,
    MotionKind, SectionDiagram, SweepDiagram, SweepOrigin,
};
use hammerbeam_jobs::{
    JobError, StoredBranches,
    basins::{GridAxis, direction},
};
use hammerbeam_results::{
    Store, StoreError,
    store::{ExponentRecord, RequestKind, RequestRecord, SettledMotion, SettledOrigin},
};
use hammerbeam_study::{Model, StudyFile};

use crate::{Album, DrawingError};

/// Draws the settled motions of every sweep.
pub fn draw_sweeps(store: &Store, drawn: &mut impl Album) -> Result<(), DrawingError> {
    let title = store.about("title")?;
    for request in store.requests()? {
        if matches!(request.kind, RequestKind::Sweep | RequestKind::Starts) {
            let motions = store.settled(request.id)?.iter().map(swept).collect();
            let figure = SweepDiagram { title: title.clone(), motions }.draw(&drawn.wide());
            drawn.add(&format!("sweep-{}", request.id), figure);
        }
    }
    Ok(())
}

/// Draws exponents over the frequency where a request has several.
pub fn draw_exponents(store: &Store, drawn: &mut impl Album) -> Result<(), DrawingError> {
    let title = store.about("title")?;
    for request in store.requests()? {
        if request.kind != RequestKind::Exponents {
            continue;
        }
        let records = store.exponents(request.id)?;
        if records.len() != 1 {
            let mut points: Vec<ExponentPoint> = records.iter().map(exponent).collect();
            points.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
            let figure = ExponentDiagram { title: title.clone(), points }.draw(&drawn.wide());
            drawn.add(&format!("exponents-{}", request.id), figure);
        }
    }
    Ok(())
}

/// Draws the convergence of the exponents of every motion.
pub fn draw_convergence(store: &Store, drawn: &mut impl Album) -> Result<(), DrawingError> {
    each_spectrum((store, drawn.frequency_unit()), |title, suffix, record| {
        let places = record.spectrum.convergence.iter();
        let places = places.map(|place| (place.time, place.exponents.clone())).collect();
        let diagram = ConvergenceDiagram { title, frequency_hz: record.frequency_hz, places };
        drawn.add(&format!("convergence{suffix}"), diagram.draw(&drawn.wide()));
    })
}

/// Draws the section of every motion whose exponents are stored.
pub fn draw_sections(store: &Store, drawn: &mut impl Album) -> Result<(), DrawingError> {
    each_spectrum((store, drawn.frequency_unit()), |title, suffix, record| {
        let points = record.section.iter().map(|[displacement, velocity]| (*displacement, *velocity));
        let frequency_hz = record.frequency_hz;
        let section = SectionDiagram { title, frequency_hz, points: points.collect() };
        drawn.add(&format!("section{suffix}"), section.draw(&drawn.narrow()));
    })
}

/// Hands over every motion whose exponents are stored, with the title of its figures and the end of their
/// names.
fn each_spectrum(
    (store, unit): (&Store, FrequencyUnit),
    mut each: impl FnMut(String, String, &ExponentRecord),
) -> Result<(), DrawingError> {
    let title = store.about("title")?;
    for request in store.requests()? {
        if request.kind != RequestKind::Exponents {
            continue;
        }
        let records = store.exponents(request.id)?;
        for (number, record) in records.iter().enumerate() {
            let suffix = if records.len() == 1 {
                format!("-{}", request.id)
            } else {
                format!("-{}-{}", request.id, number + 1)
            };
            each(format!("{title}, {}", unit.words(record.frequency_hz)), suffix, record);
        }
    }
    Ok(())
}

/// Draws the basins of every request.
pub fn draw_basins(
    store: &Store,
    (file, model): (&StudyFile, &Model),
    drawn: &mut impl Album,
) -> Result<(), DrawingError> {
    let requests: Vec<RequestRecord> =
        store.requests()?.into_iter().filter(|request| request.kind == RequestKind::Basins).collect();
    if requests.is_empty() {
        return Ok(());
    }
    let title = store.about("title")?;
    let branches = StoredBranches::open(store.folder(), file)?;
    for request in requests {
        if drawn.is_stopped() {
            break;
        }
        let (cells, attractors) = store.basins(request.id)?;
        let frequency_hz = number(&request, "frequency_hz")?;
        let mut destinations = Vec::new();
        for attractor in &attractors {
            let branch = match attractor.class {
                Class::Periodic { .. } => branches.branch_of(model, frequency_hz, &attractor.states)?,
                _ => None,
            };
            let places = places(&request, model.system.dof(), attractor);
            destinations.push(BasinAttractor { kind: kind(attractor.class), branch, places });
        }
        let range = |axis: &str| {
            let scale =
                if request.word(&format!("{axis}.coordinate")) == Some("displacement") { 1e3 } else { 1.0 };
            Ok::<_, StoreError>((
                scale * number(&request, &format!("{axis}.low"))?,
                scale * number(&request, &format!("{axis}.high"))?,
            ))
        };
        let behind_stop = behind_stops(&request, model, frequency_hz)?;
        let map = BasinMap {
            title: format!("{title}, {}", drawn.frequency_unit().words(frequency_hz)),
            x_label: coordinate(&request, "x"),
            y_label: coordinate(&request, "y"),
            x_range: range("x")?,
            y_range: range("y")?,
            cells_along: number(&request, "grid")? as usize,
            cells,
            behind_stop,
            attractors: destinations,
        };
        drawn.add(&format!("basins-{}", request.id), map.draw(&drawn.narrow()));
    }
    Ok(())
}

/// Ranges of the frequency in which a stored sweep has a chaotic motion, or a stored series of exponents one
/// whose largest exponent is positive with confidence: each reaches half-way to the next frequency of its
/// sweep or series.
pub fn chaotic_ranges(store: &Store) -> Result<Vec<(f64, f64)>, StoreError> {
    let mut ranges = Vec::new();
    for request in store.requests()? {
        if matches!(request.kind, RequestKind::Sweep | RequestKind::Starts) {
            let is_chaotic = |motion: &SettledMotion| motion.point.class == Class::Chaotic;
            let motions = store.settled(request.id)?;
            let seen = motions.iter().map(|motion| (motion.point.frequency_hz, is_chaotic(motion)));
            ranges.extend(ranges_of(&seen.collect::<Vec<_>>()));
        }
        if request.kind == RequestKind::Exponents {
            let is_chaotic = |point: &ExponentPoint| point.largest_per_s > point.half_width_per_s;
            let points: Vec<ExponentPoint> = store.exponents(request.id)?.iter().map(exponent).collect();
            let seen = points.iter().map(|point| (point.frequency_hz, is_chaotic(point)));
            ranges.extend(ranges_of(&seen.collect::<Vec<_>>()));
        }
    }
    ranges.sort_by(|a: &(f64, f64), b| a.0.total_cmp(&b.0));
    let mut joined: Vec<(f64, f64)> = Vec::new();
    for (from, to) in ranges {
        match joined.last_mut() {
            Some(last) if from <= last.1 => last.1 = last.1.max(to),
            _ => joined.push((from, to)),
        }
    }
    Ok(joined)
}

/// Ranges around the frequencies at which something chaotic was seen.
fn ranges_of(seen: &[(f64, bool)]) -> Vec<(f64, f64)> {
    let mut frequencies: Vec<f64> = seen.iter().map(|(frequency, _)| *frequency).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    let is_chaotic =
        |frequency: f64| seen.iter().any(|(other, is_chaotic)| *other == frequency && *is_chaotic);
    let half_way = |place: usize, other: Option<usize>| {
        let beside = other.and_then(|other| frequencies.get(other)).unwrap_or(&frequencies[place]);
        0.5 * (frequencies[place] + beside)
    };
    (0..frequencies.len())
        .filter(|place| is_chaotic(frequencies[*place]))
        .map(|place| (half_way(place, place.checked_sub(1)), half_way(place, place.checked_add(1))))
        .collect()
}

fn swept(motion: &SettledMotion) -> DrawnMotion {
    DrawnMotion {
        origin: match motion.origin {
            SettledOrigin::Up => SweepOrigin::Up,
            SettledOrigin::Down => SweepOrigin::Down,
            SettledOrigin::Start(_) => SweepOrigin::Start,
        },
        frequency_hz: motion.point.frequency_hz,
        kind: kind(motion.point.class),
        samples_m: motion.point.samples.clone(),
        max_displacement_m: motion.point.max_abs_displacement,
    }
}

fn exponent(record: &ExponentRecord) -> ExponentPoint {
    let largest = record.spectrum.exponents.first();
    ExponentPoint {
        frequency_hz: record.frequency_hz,
        largest_per_s: largest.map_or(f64::NAN, |exponent| exponent.value),
        half_width_per_s: largest.map_or(f64::NAN, |exponent| exponent.half_width),
        dimension: record.spectrum.kaplan_yorke_dimension,
    }
}

pub fn kind(class: Class) -> MotionKind {
    match class {
        Class::Periodic { period } => MotionKind::Periodic { period: period as u32 },
        Class::QuasiPeriodic => MotionKind::QuasiPeriodic,
        Class::Chaotic => MotionKind::Chaotic,
        Class::Doubtful(_) => MotionKind::Doubtful,
    }
}

/// A number among the words of a request.
fn number(request: &RequestRecord, key: &str) -> Result<f64, StoreError> {
    let found = request.word(key).unwrap_or_default();
    found.parse().map_err(|_| StoreError::Unknown { what: "grid of basins", found: found.to_owned() })
}

/// Whether each cell of a request begins behind a rigid stop.
fn behind_stops(
    request: &RequestRecord,
    model: &Model,
    frequency_hz: f64,
) -> Result<Vec<bool>, DrawingError> {
    let axis = |name: &str, axis: GridAxis| {
        let coordinate = request.word(&format!("{name}.coordinate")).unwrap_or_default();
        Ok::<_, DrawingError>(Axis {
            direction: direction(coordinate, axis, model).map_err(JobError::from)?,
            low: number(request, &format!("{name}.low"))?,
            high: number(request, &format!("{name}.high"))?,
            count: number(request, "grid")? as usize,
        })
    };
    let grid = Grid {
        base: vec![0.0; 2 * model.system.dof()],
        x: axis("x", GridAxis::X)?,
        y: axis("y", GridAxis::Y)?,
    };
    Ok(behind_rigid_stops(&model.system, frequency_hz, &grid)?)
}

/// A coordinate of the initial state in words, with its unit.
fn coordinate(request: &RequestRecord, axis: &str) -> String {
    let name = request.word(&format!("{axis}.coordinate")).unwrap_or_default();
    match name.split_at_checked(1) {
        _ if name == "displacement" => "Initial displacement (mm)".to_owned(),
        _ if name == "velocity" => "Initial velocity (m/s)".to_owned(),
        Some(("q", number)) => format!("Initial modal displacement {number} (√kg m)"),
        Some(("v", number)) => format!("Initial modal velocity {number} (√kg m/s)"),
        _ => name.to_owned(),
    }
}

/// Where an attractor lies in the plane of a map: only of a single mode is that the whole state.
fn places(request: &RequestRecord, dof: usize, attractor: &Attractor) -> Vec<(f64, f64)> {
    let index = |axis: &str| match request.word(&format!("{axis}.coordinate")) {
        Some("q1") => Some(0),
        Some("v1") => Some(1),
        _ => None,
    };
    match (dof, index("x"), index("y")) {
        (1, Some(x), Some(y)) if matches!(attractor.class, Class::Periodic { .. }) => {
            attractor.states.iter().map(|state| (state[x], state[y])).collect()
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_reach_half_way_to_the_neighbours_and_end_with_the_series() {
        let seen = [(10.0, true), (12.0, true), (13.0, false), (20.0, true)];
        assert_eq!(ranges_of(&seen), [(10.0, 11.0), (11.0, 12.5), (16.5, 20.0)]);
        assert_eq!(ranges_of(&[(12.0, false), (10.0, true), (12.0, true)]), [(10.0, 11.0), (11.0, 12.0)]);
        assert!(ranges_of(&[(10.0, true)]).iter().all(|(from, to)| from == to), "one frequency is no range");
        assert!(ranges_of(&[]).is_empty());
    }
}
