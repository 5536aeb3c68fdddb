//! Motions that do not repeat: those of sweeps, and the sections of all that have one.

use hammerbeam_attractor::Class;
use hammerbeam_figure::{MotionKind, PageMotion, PageSection, SectionPlane};
use hammerbeam_results::{
    Store, StoreError,
    store::{ExponentRecord, RequestKind, RequestRecord, SettledMotion, SettledOrigin},
};

use super::motions;

/// Motions of sweeps that do not repeat.
pub fn of_sweeps(store: &Store) -> Result<Vec<PageMotion>, StoreError> {
    let mut found = Vec::new();
    for request in store.requests()? {
        found.extend(irregular(store, &request)?.iter().map(|motion| PageMotion {
            frequency_hz: motion.point.frequency_hz,
            kind: motions::kind(motion.point.class),
            displacement_m: motion.point.max_abs_displacement,
        }));
    }
    Ok(found)
}

/// Stroboscopic points of every motion whose exponents are stored, and of those of sweeps that do not repeat,
/// by their frequencies.
pub fn sections(store: &Store) -> Result<Vec<PageSection>, StoreError> {
    let mut sections = Vec::new();
    for request in store.requests()? {
        if request.kind == RequestKind::Exponents {
            let records = store.exponents(request.id)?;
            sections.extend(records.iter().map(|record| of_spectrum(request.id, record)));
        }
        sections.extend(irregular(store, &request)?.iter().map(|motion| of_sweep(request.id, motion)));
    }
    // Of the same frequency those of spectra come first: they have the velocity, and more points.
    sections.sort_by(|a, b| {
        let place = |section: &PageSection| section.plane == SectionPlane::NextDisplacement;
        a.frequency_hz.total_cmp(&b.frequency_hz).then(place(a).cmp(&place(b)))
    });
    Ok(sections)
}

fn irregular(store: &Store, request: &RequestRecord) -> Result<Vec<SettledMotion>, StoreError> {
    if !matches!(request.kind, RequestKind::Sweep | RequestKind::Starts) {
        return Ok(Vec::new());
    }
    let mut settled = store.settled(request.id)?;
    settled.retain(|motion| !matches!(motion.point.class, Class::Periodic { .. }));
    Ok(settled)
}

fn of_spectrum(request: i64, record: &ExponentRecord) -> PageSection {
    let largest = record.spectrum.exponents.first();
    let is_chaotic = largest.is_some_and(|exponent| exponent.value > exponent.half_width);
    PageSection {
        frequency_hz: record.frequency_hz,
        origin: format!("exponents {request}"),
        kind: is_chaotic.then_some(MotionKind::Chaotic),
        exponent_per_s: largest.map(|exponent| (exponent.value, exponent.half_width)),
        dimension: Some(record.spectrum.kaplan_yorke_dimension),
        plane: SectionPlane::Velocity,
        points: record.section.iter().map(|point| (point[0], point[1])).collect(),
    }
}

/// A sweep keeps displacements at phase 0 alone: each is drawn over the one before.
fn of_sweep(request: i64, motion: &SettledMotion) -> PageSection {
    let samples = &motion.point.samples;
    let origin = match motion.origin {
        direction @ (SettledOrigin::Up | SettledOrigin::Down) => format!("sweep {request}, {direction}"),
        SettledOrigin::Start(start) => format!("sweep {request}, start {start}"),
    };
    PageSection {
        frequency_hz: motion.point.frequency_hz,
        origin,
        kind: Some(motions::kind(motion.point.class)),
        exponent_per_s: motion.point.largest_exponent.map(|exponent| (exponent.value, exponent.half_width)),
        dimension: None,
        plane: SectionPlane::NextDisplacement,
        points: samples.iter().copied().zip(samples.iter().skip(1).copied()).collect(),
    }
}
