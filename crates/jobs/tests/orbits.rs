//! Searches for the periodic solutions at one frequency that are interrupted.

use hammerbeam_jobs::{Observer, PreparedStudy, orbits::orbits};

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
