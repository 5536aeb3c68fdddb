//! Whether the present orbit of a walk chatters at a rigid stop.
//!
//! Pressed on, impacts follow one another ever slower and sooner: `v_k+1 = e v_k` as they get weak, so that
//! any number of them fits into a finite time. Where a branch comes to an orbit with infinitely many, each
//! further impact sets in by grazing, in a small part of the way that is left, so that no step is short
//! enough. Of a motion that is near enough to it, one of its stops is struck [`IN_A_ROW`] times or more, each
//! time slower, and by [`SLOWER`] at the last.

use hammerbeam_motion::System;

use super::last_motion::LastMotion;

/// Fewest impacts of a chatter.
const IN_A_ROW: usize = 5;
/// Largest speed of the last one relative to the first.
const SLOWER: f64 = 0.2;

/// The rigid stop that is struck most often in a row, each time slower than before, and how often; `None` if
/// that is no chatter.
pub(super) fn chatters(system: &System, motion: &LastMotion) -> Option<(String, usize)> {
    let impacts = impacts(system, motion);
    let row = |(element, speeds): (usize, &Vec<f64>)| Some((element, longest_row(speeds)?));
    let rows = impacts.iter().enumerate().filter_map(row);
    let (element, impacts) = rows.max_by_key(|(_, impacts)| *impacts)?;
    Some((system.elements()[element].name.clone(), impacts))
}

/// Speeds of the impacts on each element over twice the orbit, in their order: a row may go on over its end.
fn impacts(system: &System, motion: &LastMotion) -> Vec<Vec<f64>> {
    let mut speeds = vec![Vec::new(); system.elements().len()];
    for impact in motion.impacts() {
        speeds[impact.element].push(impact.touch.velocity.abs());
    }
    speeds.into_iter().map(|once| once.repeat(2)).collect()
}

/// How long the longest row of a chatter is, if there is one.
fn longest_row(speeds: &[f64]) -> Option<usize> {
    let rows = speeds.chunk_by(|before, behind| behind < before);
    let is_chatter = |row: &&[f64]| row.len() >= IN_A_ROW && row[row.len() - 1] <= SLOWER * row[0];
    rows.filter(is_chatter).map(<[f64]>::len).max()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_of_impacts_is_chatter_if_it_is_long_and_slows_down() {
        let slower = |e: f64, count: usize| (0..count).map(|k| e.powi(k as i32)).collect::<Vec<f64>>();
        assert_eq!(longest_row(&slower(0.6, 5)), Some(5));
        assert_eq!(longest_row(&slower(0.6, 4)), None);
        assert_eq!(longest_row(&slower(0.9, 10)), None);
        assert_eq!(longest_row(&slower(0.9, 20)), Some(20));
        // A motion without order.
        assert_eq!(longest_row(&[1.0, 0.3, 0.8, 0.5, 0.2, 0.9, 0.1]), None);
        let after_a_hard_one = [slower(0.5, 3), slower(0.5, 8)].concat();
        assert_eq!(longest_row(&after_a_hard_one), Some(8));
    }
}
