//! One-sided linear spring whose stiffness changes at a second gap.
//! Equation (L15) of the book, `docs/reference`.

use super::{
    Contact, Force, ForceLaw, ForcePoint, LawConstant, LawDescription, LawError, LawIdentity, LawKey,
    LawPart, LawRest, LawSides, LawSymbol, LawWords, Quantity,
    force_law::no_constant,
    one_sided,
    quantity::{self, Bound},
};

/// One-sided linear spring whose stiffness changes at a second gap: two fenders behind one another, a snubber
/// that meets its bracket, or one that yields.
///
/// `f = -k p` at penetration `0 < p = r - level <= s`, `f = -(k s + k_2 (p - s))` for `p > s`, else `f = 0`:
/// continuous, with a kink at the penetration s, the second gap. Nothing jumps there in the sensitivities
/// either, since the force does not.
///
/// # Source
/// Of the piecewise linear oscillator: Shaw and Holmes, J. Sound Vib. 90 (1983), 129-155; here with one more
/// slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSlopeStop {
    stiffness: f64,
    second_gap: f64,
    second_stiffness: f64,
    contact: [Contact; 1],
    piece: Piece,
}

/// The piece of the force that holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Piece {
    /// All of it, as built.
    All,
    /// Up to the second gap, continued beyond.
    First,
    /// Beyond the second gap, continued up to it.
    Second,
}

/// The further constants of the law.
const SECOND_STIFFNESS: LawConstant = LawConstant::Further(0);
const SECOND_GAP: LawConstant = LawConstant::Further(1);

impl TwoSlopeStop {
    /// A spring of two slopes at rest distance `gap` [m].
    ///
    /// * `stiffness`: k [N/m] up to the second gap.
    /// * `(second_gap, second_stiffness)`: penetration s [m] from which on the stiffness is k_2 [N/m], more
    ///   or less than k.
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless both are finite and positive, [`LawError::Constant`] unless the second
    /// gap is, [`LawError::Gap`] unless the gap is finite and not negative.
    pub fn with_gap(
        stiffness: f64,
        (second_gap, second_stiffness): (f64, f64),
        gap: f64,
    ) -> Result<Self, LawError> {
        Self::at_level(stiffness, (second_gap, second_stiffness), super::valid_gap(gap)?)
    }

    /// A spring of two slopes that presses on the undeformed structure with `preload` [N].
    ///
    /// # Errors
    /// As [`TwoSlopeStop::with_gap`]; [`LawError::Preload`] unless finite and not negative.
    pub fn with_preload(
        stiffness: f64,
        (second_gap, second_stiffness): (f64, f64),
        preload: f64,
    ) -> Result<Self, LawError> {
        let stop = Self::at_level(stiffness, (second_gap, second_stiffness), 0.0)?;
        let beyond = super::valid_preload(preload)? - stiffness * second_gap;
        let penetration =
            if beyond > 0.0 { second_gap + beyond / second_stiffness } else { preload / stiffness };
        Ok(Self { contact: one_sided(-penetration, 1.0), ..stop })
    }

    /// The same at the relative displacement `level` [m], negative where it presses on the undeformed
    /// structure.
    fn at_level(stiffness: f64, second: (f64, f64), level: f64) -> Result<Self, LawError> {
        let (second_gap, second_stiffness) = (valid_second_gap(second.0)?, second.1);
        super::positive_stiffness(stiffness)?;
        super::positive_stiffness(second_stiffness)?;
        let contact = one_sided(level, 1.0);
        Ok(Self { stiffness, second_gap, second_stiffness, contact, piece: Piece::All })
    }

    fn resting(stiffness: f64, second: (f64, f64), rest: LawRest) -> Result<Self, LawError> {
        match rest {
            LawRest::Level(level) => Self::at_level(stiffness, second, level),
            LawRest::Preload(preload) => Self::with_preload(stiffness, second, preload),
        }
    }

    /// Penetration, and whether the force there is that beyond the second gap.
    fn place(&self, displacement: f64) -> (f64, bool) {
        let penetration = displacement - self.contact[0].level;
        let is_second = match self.piece {
            Piece::All => penetration > self.second_gap,
            Piece::First => false,
            Piece::Second => true,
        };
        (penetration, is_second)
    }
}

fn valid_second_gap(found: f64) -> Result<f64, LawError> {
    let refused = LawError::Constant { what: "second gap", found, allowed: "more than 0 m" };
    if found.is_finite() && found > 0.0 { Ok(found) } else { Err(refused) }
}

impl ForceLaw for TwoSlopeStop {
    fn force(&self, displacement: f64, _: f64) -> Force {
        match self.place(displacement) {
            (penetration, true) => {
                let beyond = self.second_stiffness * (penetration - self.second_gap);
                Force::elastic(-(self.stiffness * self.second_gap + beyond), -self.second_stiffness)
            }
            (penetration, false) if penetration > 0.0 => {
                Force::elastic(-self.stiffness * penetration, -self.stiffness)
            }
            _ => Force::ZERO,
        }
    }

    fn contacts(&self) -> &[Contact] {
        &self.contact
    }

    fn linear_beyond(&self) -> Option<f64> {
        let level = self.contact[0].level;
        Some(level.abs().max((level + self.second_gap).abs()))
    }

    fn has_kinks(&self) -> bool {
        true
    }

    fn kinks(&self) -> [Option<f64>; 2] {
        let kink = Some(self.contact[0].level + self.second_gap);
        match self.piece {
            Piece::All => [None; 2],
            Piece::First => [None, kink],
            Piece::Second => [kink, None],
        }
    }

    fn in_piece(&self, displacement: f64) -> Self {
        let is_second = displacement - self.contact[0].level > self.second_gap;
        Self { piece: if is_second { Piece::Second } else { Piece::First }, ..*self }
    }

    fn beyond_kink(&self, deeper: bool) -> Self {
        Self { piece: if deeper { Piece::Second } else { Piece::First }, ..*self }
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        match constant {
            LawConstant::Stiffness => Some(self.stiffness),
            SECOND_STIFFNESS => Some(self.second_stiffness),
            SECOND_GAP => Some(self.second_gap),
            _ => None,
        }
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        let (k, s, k_2) = (self.stiffness, self.second_gap, self.second_stiffness);
        let level = self.contact[0].level;
        match constant {
            LawConstant::Gap => Self::with_gap(k, (s, k_2), value),
            LawConstant::Stiffness => Self::at_level(value, (s, k_2), level),
            SECOND_STIFFNESS => Self::at_level(k, (s, value), level),
            SECOND_GAP => Self::at_level(k, (value, k_2), level),
            other => no_constant("a stop of two slopes", other),
        }
    }

    /// `df/dk = -min(p, s)`, `df/dk_2 = -(p - s)` and `df/ds = k_2 - k` beyond the second gap.
    fn by_constant(&self, constant: LawConstant, at: ForcePoint) -> f64 {
        match (constant, self.place(at.displacement)) {
            (LawConstant::Stiffness, (_, true)) => -self.second_gap,
            (LawConstant::Stiffness, (penetration, false)) => -penetration.max(0.0),
            (SECOND_STIFFNESS, (penetration, true)) => -(penetration - self.second_gap),
            (SECOND_GAP, (_, true)) => self.second_stiffness - self.stiffness,
            _ => 0.0,
        }
    }
}

pub(super) static DESCRIPTION: LawDescription = LawDescription {
    name: "two-slopes",
    identity: LawIdentity::Named("two-slopes"),
    force: "`k d` up to `d = s`, `k s + k2 (d - s)` beyond",
    sides: LawSides::One {
        no_preload: None,
        build: |values, rest| {
            let second = (values.number(1), values.number(2));
            Ok(LawPart::whole(TwoSlopeStop::resting(values.number(0), second, rest)?.into()))
        },
    },
    keys: &[
        LawKey::number("stiffness_n_m", "k", quantity::STIFFNESS)
            .meaning("stiffness k; of a stop of two slopes up to its second gap")
            .varying(LawConstant::Stiffness),
        LawKey::number("second_gap_m", "s", Quantity::new("m", Bound::Excluding(0.0), Bound::Including(1e6)))
            .named("second gap")
            .meaning("penetration s at which the stiffness of a stop of two slopes changes")
            .varying(SECOND_GAP),
        LawKey::number("second_stiffness_n_m", "k2", quantity::STIFFNESS)
            .named("second stiffness")
            .meaning("its stiffness k2 from there on, more or less than k")
            .varying(SECOND_STIFFNESS),
    ],
    alternative: None,
    symbol: LawSymbol::Spring,
    words: LawWords { report: "linear spring of two slopes", caption: "spring", last_first: false },
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_gap_is_finite_and_positive() {
        for found in [0.0, -1e-9, f64::INFINITY] {
            let refused = LawError::Constant { what: "second gap", found, allowed: "more than 0 m" };
            assert_eq!(TwoSlopeStop::with_gap(1.0, (found, 2.0), 0.0), Err(refused));
        }
        assert!(TwoSlopeStop::with_gap(1.0, (f64::NAN, 2.0), 0.0).is_err());
        assert!(TwoSlopeStop::with_gap(1.0, (1.0, 0.0), 0.0).is_err());
        assert!(TwoSlopeStop::with_gap(0.0, (1.0, 1.0), 0.0).is_err());
    }

    /// A preload below and above the force at the kink: 3 N/m up to 0.5 m, then 8 N/m.
    #[test]
    fn a_preload_of_two_slopes_is_the_force_on_the_undeformed_structure() {
        for preload in [0.0, 1.2, 1.5, 7.5] {
            let stop = TwoSlopeStop::with_preload(3.0, (0.5, 8.0), preload).unwrap();
            let found = -stop.force(0.0, 0.0).value;
            assert!((found - preload).abs() <= 1e-15 * preload, "{found} N, not {preload} N");
        }
    }
}
