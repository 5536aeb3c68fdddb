//! van de Vorst, Fey, de Kraker, van Campen: the walk along the harmonic branch of figure 3, from 19 to 110
//! Hz through every fold and grazing point, unattended.
//!
//! Parameters are those of `van_de_vorst_harmonic_branch.rs`. Nothing here is known from print; these are
//! statements that hold for every branch of periodic orbits, checked on one that is hard to walk.
//! `HAMMERBEAM_EXTENSIVE=1` walks all of it in steps of 0.001 Hz.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::sync::OnceLock;

use crate::common::{
    ObservedSystem, Walked,
    crossings::{crossings, distance},
    extensive, folds, paper_beam, walk, walk_both,
};
use hammerbeam_orbit::{BranchRow, OrbitSettings, Side, Stability, StopReason};

const RANGE_HZ: (f64, f64) = (19.0, 110.0);
/// Two folds are the same below this [Hz]; the closest pair of distinct ones is 7e-8 Hz apart, so pairs are
/// told apart by their number.
const SAME_FOLD_HZ: f64 = 1e-6;

fn rig() -> &'static ObservedSystem {
    static RIG: OnceLock<ObservedSystem> = OnceLock::new();
    RIG.get_or_init(paper_beam)
}

fn walked_at(max_step: f64) -> Walked {
    walk_both(rig(), 30.0, RANGE_HZ, &OrbitSettings { max_step, ..OrbitSettings::default() })
}

/// The walk at the default steps.
fn branch() -> &'static Walked {
    static BRANCH: OnceLock<Walked> = OnceLock::new();
    BRANCH.get_or_init(|| walked_at(OrbitSettings::default().max_step))
}

fn coarse() -> &'static Walked {
    static COARSE: OnceLock<Walked> = OnceLock::new();
    COARSE.get_or_init(|| walked_at(0.05))
}

fn frequency(row: &BranchRow) -> f64 {
    row.solution.frequency_hz
}

#[test]
fn both_ends_of_the_range_are_reached_exactly() {
    let branch = branch();
    let end = |frequency_hz: f64| StopReason::RangeEnd { place: frequency_hz };
    assert_eq!(branch.reasons, [end(RANGE_HZ.0), end(RANGE_HZ.1)]);
    let (first, last) = (&branch.rows[0], &branch.rows[branch.rows.len() - 1]);
    assert_eq!(frequency(first).to_bits(), RANGE_HZ.0.to_bits());
    assert_eq!(frequency(last).to_bits(), RANGE_HZ.1.to_bits());
}

#[test]
fn every_row_is_converged() {
    let tolerance = OrbitSettings::default().tolerance;
    for row in &branch().rows {
        let solution = &row.solution;
        assert!(solution.error_estimate <= tolerance, "{} Hz", solution.frequency_hz);
        // A correction of the tolerance leaves a residual of the tolerance times the monodromy matrix.
        let largest = solution.floquet_multipliers[0];
        let growth = 100.0 * f64::hypot(largest[0], largest[1]).max(1.0);
        assert!(solution.residual <= growth * tolerance, "{} Hz", solution.frequency_hz);
    }
}

#[test]
fn every_multiplier_is_finite_and_they_are_ordered() {
    for row in &branch().rows {
        let multipliers = &row.solution.floquet_multipliers;
        assert_eq!(multipliers.len(), 12);
        assert!(multipliers.iter().flatten().all(|part| part.is_finite()));
        assert!(multipliers.is_sorted_by(|a, b| a[0].hypot(a[1]) >= b[0].hypot(b[1])));
    }
}

/// Liouville: the stop has no damping, so the product of the multipliers is `exp(-T tr C)`, here 1e-29 to
/// 1e-5. The smallest are near 1e-13, of a matrix with entries of 1e2 that is known to 1e-11 or so; the
/// product holds to 1e-7 all the same.
#[test]
fn product_of_the_multipliers_is_that_of_liouville_on_every_row() {
    let damping = &rig().system.model().damping;
    let trace: f64 = (0..6).map(|i| damping[(i, i)]).sum();
    for row in &branch().rows {
        let multipliers = &row.solution.floquet_multipliers;
        let logarithm: f64 = multipliers.iter().map(|[re, im]| re.hypot(*im).ln()).sum();
        let error = (logarithm + trace / frequency(row)).abs();
        assert!(error < 1e-7, "{error:.1e} at {} Hz", frequency(row));
    }
}

/// The fold is where the tangent has no part along the frequency, located to 1e-10 of the step or so; the
/// multiplier passes +1 with a slope that is largest just behind grazing, where it takes 2e-7 from 1 (20.005
/// Hz).
#[test]
fn a_multiplier_is_plus_one_at_every_fold() {
    let rows = branch().rows.iter().filter(|row| row.events.fold);
    for row in rows {
        let distances = row.solution.floquet_multipliers.iter().map(|[re, im]| (re - 1.0).hypot(*im));
        let nearest = distances.fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{nearest:.1e} at {} Hz", frequency(row));
    }
}

/// `det(M - 1) dx/ds = -dR/df df/ds` along a branch: the branch runs up exactly where an even number of
/// multipliers exceeds +1, once it does so somewhere. No determinant is used for this.
#[test]
fn branch_turns_exactly_where_a_multiplier_passes_plus_one() {
    let exceeding = |row: &BranchRow| {
        let multipliers = row.solution.floquet_multipliers.iter();
        multipliers.filter(|[re, im]| *im == 0.0 && *re > 1.0).count()
    };
    for pair in branch().rows.windows(2).filter(|pair| pair.iter().all(|row| !row.events.fold)) {
        let upwards = frequency(&pair[1]) > frequency(&pair[0]);
        for row in pair {
            assert_eq!(upwards, exceeding(row) % 2 == 0, "{} Hz", frequency(row));
        }
    }
}

/// Stability changes only as multipliers pass the unit circle: one real, or one pair.
#[test]
fn stability_changes_as_one_multiplier_or_one_pair_passes_the_unit_circle() {
    let outside = |row: &BranchRow| {
        row.solution.floquet_multipliers.iter().filter(|[re, im]| re.hypot(*im) > 1.0).count()
    };
    let rows = &branch().rows;
    // At the bifurcation itself a multiplier is on the circle as well as it is known.
    let decided: Vec<usize> =
        (0..rows.len()).filter(|&k| rows[k].solution.stability() != Stability::Marginal).collect();
    let mut changes = 0;
    for pair in decided.windows(2) {
        let [first, second] = [pair[0], pair[1]].map(|k| &rows[k]);
        if first.solution.stable() == second.solution.stable()
            || rows[pair[0]..=pair[1]].iter().any(|row| row.events.fold)
        {
            continue; // At a fold the multiplier is 1 to rounding.
        }
        let unstable = if first.solution.stable() { second } else { first };
        let leading = unstable.solution.floquet_multipliers[0];
        let expected = if leading[1] == 0.0 { 1 } else { 2 };
        assert_eq!(outside(unstable), expected, "{} Hz", frequency(unstable));
        assert!(leading[1] != 0.0 || leading[0] < 0.0, "+1 is passed at folds only: {leading:?}");
        changes += 1;
    }
    assert!(changes > 20, "{changes}");
}

#[test]
fn number_of_contacts_changes_at_grazing_points_only() {
    let mut changes = 0;
    for pair in branch().rows.windows(2) {
        let [before, after] = [&pair[0], &pair[1]].map(|row| row.solution.maxima.contacts);
        assert!((1..=4).contains(&after), "{after} contacts at {} Hz", frequency(&pair[1]));
        if before != after {
            assert_eq!(before.abs_diff(after), 1);
            assert!(pair.iter().any(|row| row.events.grazing), "{} Hz", frequency(&pair[0]));
            changes += 1;
        }
    }
    assert_eq!(changes, branch().rows.iter().filter(|row| row.events.grazing).count());
}

/// Pairs of folds are as close as 1e-5 Hz and closer.
#[test]
fn folds_come_in_pairs_as_close_as_1e_5_hz() {
    let folds = branch().folds();
    assert_eq!(folds.len() % 2, 0, "the branch runs from one end of the range to the other");
    let close = folds.windows(2).filter(|pair| pair[1] - pair[0] < 2e-5).count();
    assert!(close >= 2, "{folds:?}");
}

/// Where the branch has several orbits at one frequency these are distinct: the distance of any two is far
/// above what separates the same orbit in two walks of different steps, both read off by chords.
#[test]
fn no_stretch_is_walked_twice() {
    let (system, branch, coarse, folds) = (&rig().system, branch(), coarse(), branch().folds());
    let mut several = 0;
    for step in 0..31_600 {
        let at_hz = 19.000_217 + 0.0005 * f64::from(step);
        if folds.iter().any(|fold| (fold - at_hz).abs() < 5e-5) {
            continue; // Orbits merge at a fold.
        }
        let (orbits, others) =
            (crossings(system, &branch.rows, at_hz), crossings(system, &coarse.rows, at_hz));
        assert_eq!(orbits.len(), others.len(), "{at_hz} Hz");
        assert_eq!(orbits.len() % 2, 1);
        several += usize::from(orbits.len() > 1);
        for (i, orbit) in orbits.iter().enumerate() {
            let same = distance(orbit, &others[i]);
            let nearest =
                orbits.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other)| distance(orbit, other));
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(nearest > 3.0 * same, "{at_hz} Hz: {nearest:.2e} apart, resolution {same:.2e}");
        }
    }
    assert!(several > 1000, "{several}");
}

fn assert_same_folds(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}: {found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < SAME_FOLD_HZ, "{what}: {found} and {expected} Hz");
    }
}

#[test]
fn folds_do_not_depend_on_a_step_of_0_05_hz() {
    assert_same_folds(&coarse().folds(), &branch().folds(), "0.05 Hz");
}

#[test]
fn folds_do_not_depend_on_a_step_of_0_01_hz() {
    assert_same_folds(&walked_at(0.01).folds(), &branch().folds(), "0.01 Hz");
}

/// From just above each range of dense folds to just below it; the whole range if asked for.
#[test]
fn folds_do_not_depend_on_a_step_of_0_001_hz() {
    if extensive() {
        assert_same_folds(&walked_at(0.001).folds(), &branch().folds(), "0.001 Hz");
        return;
    }
    let settings = OrbitSettings { max_step: 0.001, ..OrbitSettings::default() };
    let rows = &branch().rows;
    let mut total = 0;
    for (low_hz, high_hz) in [(19.19, 20.36), (22.74, 23.31), (27.83, 27.93), (34.72, 34.75)] {
        let above = rows.iter().rposition(|row| frequency(row) < high_hz).unwrap();
        let start = &rows[above].solution;
        let (found, reason, _) = walk(rig(), start, Side::Down, (low_hz, high_hz), &settings);
        assert_eq!(reason, StopReason::RangeEnd { place: low_hz });
        let within: Vec<f64> =
            branch().folds().into_iter().filter(|fold| (low_hz..high_hz).contains(fold)).collect();
        assert_same_folds(&folds(&found), &within, "0.001 Hz");
        total += within.len();
    }
    assert_eq!(total, branch().folds().len());
}
