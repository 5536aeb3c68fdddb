use super::*;
use crate::predictor::Node;
use std::f64::consts::FRAC_PI_2;

/// A helix in twelve unknowns with unit speed: a long smooth path whose sketch is a projection.
fn on_helix(s: f64) -> ContinuationPoint {
    let mut point = ContinuationPoint::empty(13);
    let rate = 1.0 / 7.0_f64.sqrt();
    for k in 0..12 {
        let frequency = 1.0 + (k / 2) as f64;
        let (phase, amplitude) = (frequency * s + FRAC_PI_2 * (k % 2) as f64, 1.0 / frequency);
        point.point[k] = amplitude * phase.sin() * rate;
        point.tangent[k] = phase.cos() * rate;
    }
    point.point[12] = s * rate;
    point.tangent[12] = rate;
    point.arc_length = s;
    point
}

fn candidate(point: &ContinuationPoint) -> Candidate {
    let mut candidate = Candidate::new(point.point.len());
    candidate.node = Node { point: point.point.clone(), tangent: point.tangent.clone() };
    candidate
}

fn helix_memory(step: f64) -> PathMemory {
    let settings = Settings { max_step_length: step, ..Settings::default() };
    let mut memory = PathMemory::new(&[1.0; 13], &settings);
    (0..1000).for_each(|k| memory.remember(&on_helix(step * f64::from(k)), &[1.0]));
    memory
}

#[test]
fn a_point_between_stored_ones_is_met_at_its_arc_length() {
    let memory = helix_memory(0.02);
    for s in [0.011, 3.337, 12.345] {
        let met = memory.meets(&candidate(&on_helix(s)), 1.0, &[1.0]).unwrap();
        assert!((met - s).abs() < 1e-3, "{met} for {s}");
    }
}

#[test]
fn a_sheet_beside_or_one_that_runs_back_is_not_met() {
    let memory = helix_memory(0.02);
    let mut beside = on_helix(3.337);
    beside.point[3] += 1e-5;
    assert_eq!(memory.meets(&candidate(&beside), 1.0, &[1.0]), None);
    let mut back = on_helix(3.337);
    back.tangent.iter_mut().for_each(|t| *t = -*t);
    assert_eq!(memory.meets(&candidate(&back), 1.0, &[1.0]), None);
    assert!(
        memory.meets(&candidate(&back), -1.0, &[1.0]).is_some(),
        "with the other orientation it is a retrace"
    );
}

/// The helix in steps of a tenth of the zone beside a corner, the last point being one.
fn memory_at_corner(step: f64) -> PathMemory {
    let mut memory = PathMemory::new(&[1.0; 13], &Settings { max_step_length: 0.02, ..Settings::default() });
    for k in 0..=20 {
        let mut point = on_helix(step * f64::from(k));
        point.events.corner = k == 20;
        memory.remember(&point, &[1.0]);
    }
    memory
}

#[test]
fn close_behind_a_corner_only_the_same_point_is_met() {
    let step = 0.1 * BESIDE_CORNER * Settings::default().sheet_distance;
    let memory = memory_at_corner(step);
    let beside = |s: f64, off: f64| {
        let mut point = on_helix(s);
        point.point[3] += off;
        memory.meets(&candidate(&point), 1.0, &[1.0])
    };
    let (near, far) = (14.5 * step, 4.5 * step);
    assert!(beside(near, 0.0).is_some_and(|met| (met - near).abs() < 1e-9));
    assert_eq!(beside(near, 1e-9), None);
    assert!(beside(far, 1e-9).is_some(), "farther before it errors of points are allowed");
    // As soon as the path has gone on as far, they are everywhere.
    let mut gone = memory.clone();
    gone.remember(&on_helix(31.0 * step), &[1.0]);
    let mut off = on_helix(near);
    off.point[3] += 1e-9;
    assert!(gone.meets(&candidate(&off), 1.0, &[1.0]).is_some());
}

#[test]
fn the_segment_that_ends_at_a_corner_is_not_met() {
    let step = 0.02;
    let mut memory = memory_at_corner(step);
    (21..30).for_each(|k| memory.remember(&on_helix(step * f64::from(k)), &[1.0]));
    let met = |s: f64| memory.meets(&candidate(&on_helix(s)), 1.0, &[1.0]);
    assert!(met(18.5 * step).is_some() && met(21.5 * step).is_some());
    assert_eq!(met(19.5 * step), None);
}

#[test]
fn a_point_with_more_unknowns_is_met_by_the_part_that_is_remembered() {
    let memory = helix_memory(0.02);
    let mut longer = on_helix(3.337);
    for values in [&mut longer.point, &mut longer.tangent] {
        let parameter = values.pop().unwrap();
        values.extend([7.0, -3.0, parameter]);
    }
    let met = memory.meets(&candidate(&longer), 1.0, &[1.0]).unwrap();
    assert!((met - 3.337).abs() < 1e-3, "{met}");
}

#[test]
fn the_end_of_the_stored_path_is_not_met() {
    let memory = helix_memory(0.02);
    assert_eq!(memory.meets(&candidate(&on_helix(999.5 * 0.02)), 1.0, &[1.0]), None);
    assert_eq!(
        memory.meets(&candidate(&on_helix(998.5 * 0.02)), 1.0, &[1.0]),
        None,
        "nor is the step before"
    );
}

#[test]
fn a_path_that_outgrows_its_first_units_is_met_and_takes_no_more_memory() {
    // In units that double every ten points a path has steps of one length.
    let settings = Settings { max_step_length: 0.02, ..Settings::default() };
    let mut memory = PathMemory::new(&[1.0; 13], &settings);
    let mut at = vec![0.0];
    for k in 0..400 {
        at.push(at[k] + 0.02 * 2f64.powf(0.1 * k as f64));
    }
    let straight = |s: f64| {
        let mut point = on_helix(0.0);
        point.tangent = vec![0.0; 13];
        (point.tangent[0], point.tangent[12]) = (0.8, 0.6);
        (point.point[0], point.point[12], point.arc_length) = (0.8 * s, 0.6 * s, s);
        point
    };
    at.iter().for_each(|s| memory.remember(&straight(*s), &[1.0]));
    for k in [20, 150, 300, 390] {
        let s = at[k] + 0.4 * (at[k + 1] - at[k]);
        let met = memory.meets(&candidate(&straight(s)), 1.0, &[1.0]);
        assert!(met.is_some_and(|met| (met - s).abs() < 1e-6 * s), "{met:?} for {s}");
    }
    assert!(memory.links.len() < 40 * at.len(), "{} links", memory.links.len());
}

#[test]
fn a_vertex_takes_no_more_than_200_bytes() {
    assert!(size_of::<Vertex>() <= 160);
    let memory = helix_memory(0.02);
    let links = memory.links.len() * size_of::<(u32, u32)>();
    assert!(
        links <= 40 * memory.vertices.len(),
        "{links} bytes of links for {} points",
        memory.vertices.len()
    );
}
