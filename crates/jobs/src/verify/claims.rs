//! What is claimed to happen at a row.

use faer::c64;
use hammerbeam_orbit::{BranchEventKind, EventSet};

/// What is claimed to happen at a row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Claims {
    pub events: EventSet,
    /// The multiplier of an event that was bracketed only: it is said to lie there, and not in its place.
    pub bracketed: Option<[f64; 2]>,
}

/// How near to its place the multiplier of a bracketed event lies, if it does not jump over it.
const BRACKETED: f64 = 1e-2;

impl Claims {
    /// How far a multiplier is from where an event of this kind is said to put one.
    pub fn off_place(&self, kind: BranchEventKind, multiplier: c64) -> f64 {
        let said = self.bracketed.map(|[re, im]| c64::new(re, im));
        match said.filter(|said| off_place(kind, *said) <= BRACKETED) {
            Some(said) => (multiplier - said).norm(),
            None => off_place(kind, multiplier),
        }
    }
}

/// How far a multiplier is from its place at an event of this kind.
fn off_place(kind: BranchEventKind, multiplier: c64) -> f64 {
    match kind {
        BranchEventKind::Flip => (multiplier + 1.0).norm(),
        BranchEventKind::NeimarkSacker if multiplier.im == 0.0 => f64::INFINITY,
        BranchEventKind::NeimarkSacker => (multiplier.norm() - 1.0).abs(),
        _ => (multiplier - 1.0).norm(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_multiplier_of_a_bracketed_event_lies_where_it_was_said_to_if_that_is_near_its_place() {
        let events = EventSet::of([(true, BranchEventKind::Fold)]);
        let off = |said: f64, re: f64| {
            let claims = Claims { events, bracketed: Some([said, 0.0]) };
            claims.off_place(BranchEventKind::Fold, c64::new(re, 0.0))
        };
        assert_eq!([off(1.0078125, 1.0078125), off(1.0078125, 1.0)], [0.0, 0.0078125]);
        assert_eq!([off(1.5, 1.5), off(1.5, 1.0)], [0.5, 0.0]);
    }

    #[test]
    fn only_a_complex_multiplier_makes_a_neimark_sacker_point() {
        let claims =
            Claims { events: EventSet::of([(true, BranchEventKind::NeimarkSacker)]), bracketed: None };
        let off = |re, im| claims.off_place(BranchEventKind::NeimarkSacker, c64::new(re, im));
        assert_eq!([off(0.6, 0.8), off(1.0, 0.0)], [0.0, f64::INFINITY]);
    }
}
