//! Points of codimension two: the test functions of a curve in their order, and which of their zeros are
//! marked.

use hammerbeam_path::{PathEvents, TestValue};

use super::{
    condition::Condition,
    row::{CurveEvents, CurveKind},
};
use crate::stability;

/// Distance from its place within which a further multiplier is critical: one that jumped over it, as where
/// contacts change, is not.
const CRITICAL: f64 = 1e-4;

/// Test functions of a curve.
///
/// * `own`: the test functions of its condition.
/// * `others`: the multipliers that the condition does not hold.
/// * `criticality`: the test of the coefficient of its normal form.
pub(super) fn tests(
    condition: &Condition,
    own: &[f64],
    others: &[[f64; 2]],
    criticality: TestValue,
) -> Vec<TestValue> {
    let (fold, flip) = (stability::fold(others), stability::flip(others));
    let pair = stability::neimark_sacker(others);
    match condition {
        Condition::Multiplier(bordered) if bordered.multiplier > 0.0 => {
            vec![signed(own[1]), signed(own[0]), flip, pair]
        }
        Condition::Multiplier(_) => vec![signed(own[0]), fold, pair, criticality],
        Condition::Pair(_) => {
            let k = own[0];
            let resonances = [1.0 - k, k + 1.0, k + 0.5, k].map(signed);
            resonances.into_iter().chain([fold, flip, pair, criticality]).collect()
        }
        Condition::Touch(_) => vec![fold, flip, signed(own[0]), pair],
    }
}

/// A test function that counts nothing but its sign.
pub(super) fn signed(value: f64) -> TestValue {
    TestValue::sign_change(value, u32::from(value < 0.0))
}

/// The zero, among the zeros of the tests, of the clearance of the opposite contact on a grazing curve
/// (`opposite.rs`), which comes behind [`tests`].
pub(super) const OPPOSITE_BIT: u32 = 4;

/// The number of the test function of criticality, where there is one.
pub(super) fn criticality_bit(condition: &Condition) -> Option<u32> {
    match condition {
        Condition::Multiplier(bordered) if bordered.multiplier < 0.0 => Some(3),
        Condition::Pair(_) => Some(7),
        Condition::Multiplier(_) | Condition::Touch(_) => None,
    }
}

impl CurveEvents {
    /// What the zeros of [`tests`] are.
    ///
    /// * `others`: the multipliers that the condition does not hold, at the point.
    pub(super) fn of(kind: CurveKind, events: PathEvents, others: &[[f64; 2]]) -> Self {
        let zero = |bit: u32| events.zeros >> bit & 1 == 1;
        let fold = |bit: u32| zero(bit) && is_at(others, 1.0);
        let flip = |bit: u32| zero(bit) && is_at(others, -1.0);
        let pair = |bit: u32| zero(bit) && has_pair_on_circle(others);
        let changes = events.signature_change;
        // Coefficients jump where contacts change.
        let is_smooth = !changes && !events.corner;
        let found = Self { turn: events.fold, grazing: changes, ..Self::default() };
        match kind {
            CurveKind::Fold => Self {
                cusp: zero(0),
                resonance: zero(1).then_some(1),
                fold_flip: flip(2),
                fold_neimark_sacker: pair(3),
                ..found
            },
            CurveKind::Flip => Self {
                resonance: zero(0).then_some(2),
                fold_flip: fold(1),
                flip_neimark_sacker: pair(2),
                degenerate_flip: zero(3) && is_smooth,
                ..found
            },
            CurveKind::NeimarkSacker => Self {
                resonance: (0..4).find(|bit| zero(*bit)).map(|bit| bit as u8 + 1),
                fold_neimark_sacker: fold(4),
                flip_neimark_sacker: flip(5),
                double_neimark_sacker: pair(6),
                degenerate_neimark_sacker: zero(7) && is_smooth,
                ..found
            },
            // The touch that is followed is no part of the signature: there is another one.
            CurveKind::Grazing { .. } => Self {
                grazing_fold: fold(0),
                grazing_flip: flip(1),
                degenerate_grazing: zero(2),
                grazing_neimark_sacker: pair(3),
                double_grazing: changes || zero(OPPOSITE_BIT),
                grazing: false,
                ..found
            },
        }
    }
}

fn is_at(multipliers: &[[f64; 2]], place: f64) -> bool {
    multipliers.iter().any(|[re, im]| (re - place).hypot(*im) < CRITICAL)
}

/// Whether a pair is on the unit circle and not nearer to becoming real.
fn has_pair_on_circle(multipliers: &[[f64; 2]]) -> bool {
    let is_near = |[re, im]: &[f64; 2]| *im > 0.0 && (re.hypot(*im) - 1.0).abs() < CRITICAL;
    multipliers.iter().any(is_near) && !stability::pair_turns_real(multipliers)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(kind: CurveKind, events: PathEvents, others: &[[f64; 2]]) -> String {
        CurveEvents::of(kind, events, others).label()
    }

    #[test]
    fn a_sign_that_changes_without_a_multiplier_in_its_place_is_no_mark() {
        let zero = |bit: u32| PathEvents { zeros: 1 << bit, ..PathEvents::default() };
        let on_circle = [[0.6, 0.8], [0.6, -0.8], [0.1, 0.0]];
        assert_eq!(label(CurveKind::Fold, zero(3), &on_circle), "fold-neimark-sacker");
        assert_eq!(
            label(CurveKind::Fold, zero(3), &[[2.0, 0.0], [0.5, 0.0], [0.1, 0.0]]),
            "",
            "neutral saddle"
        );
        let turns_real = [[1.00002, 1e-6], [1.00002, -1e-6], [0.1, 0.0]];
        assert_eq!(label(CurveKind::Fold, zero(3), &turns_real), "", "a pair that becomes real");
        assert_eq!(label(CurveKind::Flip, zero(2), &[[0.6, 0.81], [0.6, -0.81]]), "", "a pair that jumped");
        assert_eq!(
            label(CurveKind::NeimarkSacker, zero(4), &[[1.0, 0.0], [0.5, 0.0]]),
            "fold-neimark-sacker"
        );
        assert_eq!(
            label(CurveKind::NeimarkSacker, zero(5), &[[-1.2, 0.0], [0.5, 0.0]]),
            "",
            "a jump over -1"
        );
    }

    /// The coefficient of a normal form jumps where contacts change.
    #[test]
    fn criticality_that_jumps_with_the_contacts_is_no_mark() {
        let events = PathEvents { zeros: 1 << 3, ..PathEvents::default() };
        assert_eq!(label(CurveKind::Flip, events, &[[0.5, 0.0]]), "degenerate-flip");
        let events = PathEvents { signature_change: true, ..events };
        assert_eq!(label(CurveKind::Flip, events, &[[0.5, 0.0]]), "grazing");
        let kind = CurveKind::Grazing { contact: None };
        assert_eq!(label(kind, PathEvents { zeros: 0, ..events }, &[]), "double-grazing");
    }
}
