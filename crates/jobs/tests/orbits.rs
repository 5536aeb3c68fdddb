//! Searches for the periodic solutions at one frequency: what they reach, and interruptions.

use hammerbeam_jobs::{Observer, PreparedStudy, Quiet, orbits::orbits};

use crate::varied::STUDY;

/// Interrupts when it was asked so often.
struct StopAfter(u32);

impl Observer for StopAfter {
    fn interrupted(&mut self) -> bool {
        let stops = self.0 == 0;
        self.0 = self.0.saturating_sub(1);
        stops
    }
}

#[test]
fn an_interrupted_search_says_so_and_gives_what_it_has_found() {
    let study = PreparedStudy::parse("study.toml", STUDY).unwrap();
    let search = |asked: u32| orbits(&study, 0.25, 1, &mut StopAfter(asked));
    let whole = search(u32::MAX).unwrap();
    assert!(!whole.is_interrupted() && whole.orbits.len() > 1, "{whole:?}");
    // The first trial of Newton's method comes before the first question.
    let cut = search(0).unwrap();
    assert!(cut.is_interrupted() && !cut.orbits.is_empty(), "{cut:?}");
    assert!(cut.orbits.len() < whole.orbits.len(), "{cut:?}");
}

/// Far above resonance the motion without contacts is a twelfth of the gaps, and at phase 0 the constant
/// force takes most of that away. A motion of two periods strikes the stop above: an integrator that shares
/// nothing comes to it from 34 of 60 states within the gaps.
#[test]
fn motions_as_large_as_a_gap_are_found_where_the_linear_response_is_much_smaller() {
    let text = include_str!("../../../verification/studies/unequal-stops.toml");
    let study = PreparedStudy::parse("unequal-stops.toml", text).unwrap();
    let found = orbits(&study, 7.3, 2, &mut Quiet).unwrap();
    assert!(found.orbits.iter().any(|orbit| orbit.may_be_stable()), "{found:?}");
}
