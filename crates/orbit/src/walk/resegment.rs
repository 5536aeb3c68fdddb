//! Cutting the orbit of a walk into more segments, where its multipliers have outgrown the present ones.
//! Where nodes have to keep clear of impacts on rigid stops each segment becomes two (`halves.rs`), and
//! orbits with impact-speed-dependent laws are not cut.
//!
//! New nodes lie on the motion from the old ones; their tangents follow from the flow, `t_j = dZ/dz t_k +
//! dZ/df t_f`. The present point and the start of the walk are cut anew, and the follower goes on in the new
//! unknowns with all that it knows: a loop still closes at its start. Neither the orientation of the path nor
//! its memory, which holds first nodes alone, depends on the number of segments.

use super::{orbit_path::OrbitPath, refine::refine, start_phase::halve};
use crate::{OrbitError, cut::must_start_off_contacts};

/// Segments become this many times as many,
const FACTOR: usize = 4;
/// up to this number.
const MOST: usize = 64;

/// Goes on from the present point with more segments; false if there are enough already, or if neither
/// point is found with more.
pub(super) fn resegment(path: &mut OrbitPath) -> Result<bool, OrbitError> {
    let OrbitPath { problem, follower, .. } = path;
    let segments = problem.segments();
    if must_start_off_contacts(problem.system()) {
        return Ok(halve(path));
    }
    if segments * FACTOR > MOST {
        return Ok(false);
    }
    let current = refine(problem, follower.current(), FACTOR)?;
    let start = refine(problem, &follower.state().start, FACTOR)?;
    problem.set_segments(segments * FACTOR);
    if follower.transfer(problem, &current, Some(&start)).is_err() {
        // The walk stays where it was, with its own reason to stop.
        problem.set_segments(segments);
        return Ok(false);
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

    use hammerbeam_motion::{Law, System, law::PowerSpring};

    use crate::{
        BranchRow, BranchWalk, OrbitSettings, Response, Side, StopReason, find_start,
        test_oscillator::oscillator,
    };

    const RANGE: (f64, f64) = (0.3, 1.2);

    /// `x'' + 0.06 x' + x + x^3 = 3 cos(2 pi f t)`: its 1/3 subharmonic orbits make a closed loop from 0.52
    /// to 1.09 Hz.
    fn duffing() -> (System, Response) {
        oscillator(0.06, 3.0, Law::Power(PowerSpring::cubic(1.0).unwrap()))
    }

    /// The loop from its start, cut into more segments after as many steps as `cuts` says, stored and taken
    /// up again after `stored` steps.
    fn walk(cuts: &[usize], stored: usize) -> (Vec<BranchRow>, StopReason, usize) {
        let (system, response) = duffing();
        let settings = OrbitSettings { max_step: 0.005, ..OrbitSettings::default() };
        let start = find_start(&system, &response, 0.7, 3, &settings).unwrap();
        let mut walk = BranchWalk::new(&system, &response, &start, Side::Up, RANGE, &settings).unwrap();
        let (mut rows, mut journal) = (vec![walk.start_row().unwrap()], Vec::new());
        for step in 1.. {
            if let Some(reason) = walk.step(&mut rows).unwrap() {
                return (rows, reason, walk.path.problem.segments());
            }
            if cuts.contains(&step) {
                assert!(super::resegment(&mut walk.path).unwrap());
            }
            if step == stored {
                journal.extend(walk.take_journal());
                let checkpoint = walk.checkpoint();
                walk = BranchWalk::resume(&system, &response, (&checkpoint, &journal), RANGE, &settings)
                    .unwrap();
            }
        }
        unreachable!("a walk ends");
    }

    fn folds(rows: &[BranchRow]) -> Vec<f64> {
        rows.iter().filter(|row| row.events.fold).map(|row| row.solution.frequency_hz).collect()
    }

    #[test]
    fn a_loop_that_is_cut_on_the_way_closes_at_its_start() {
        let (whole, reason, segments) = walk(&[], 0);
        assert_eq!((reason, segments), (StopReason::Closed, 3));
        for cuts in [&[50_usize][..], &[50, 200], &[whole.len() / 2]] {
            let (rows, reason, segments) = walk(cuts, 0);
            assert_eq!(reason, StopReason::Closed);
            assert_eq!(segments, 3 * 4_usize.pow(cuts.len() as u32));
            // Twice the same stretch would be a third fold, or more rows.
            assert_eq!(folds(&rows).len(), 2);
            for (found, expected) in folds(&rows).iter().zip(folds(&whole)) {
                assert!((found - expected).abs() < 1e-9, "{found}, {expected}");
            }
            assert!(rows.len() < whole.len() + whole.len() / 10, "{} rows, {}", rows.len(), whole.len());
            let [first, last] = [&rows[0], &rows[rows.len() - 1]].map(|row| &row.solution);
            assert!((first.frequency_hz - last.frequency_hz).abs() < 1e-9);
            // The start is met within ten tolerances, 1e-9 of an orbit whose norm is a few metres.
            assert!((first.maxima.displacement - last.maxima.displacement).abs() < 1e-8);
        }
    }

    #[test]
    fn a_walk_stored_after_a_cut_goes_on_with_the_same_bits() {
        let undisturbed = walk(&[50], 0);
        assert!(undisturbed == walk(&[50], 50));
        assert!(undisturbed == walk(&[50], 120));
    }
}
