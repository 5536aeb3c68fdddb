//! Linear springs on both sides of a clearance.
//! Equation (L11) of the book, `docs/reference`.

use super::{
    Contact, Force, ForceLaw, LawConstant, LawDescription, LawError, LawIdentity, LawPart, LawRest, LawSides,
    LawSymbol, LawWords, LinearStop, force_law::no_constant, linear,
};

/// A linear spring on either side of a clearance.
///
/// `f = -k (r - g_+)` for `r > g_+`, `f = -k (r + g_-)` for `r < -g_-`, else `f = 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSidedStop {
    stiffness: f64,
    contacts: [Contact; 2],
}

impl TwoSidedStop {
    /// Springs of stiffness `k` [N/m] at the rest distances `gap_above` and `gap_below` [m].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Gap`] unless both gaps are finite and
    /// not negative.
    pub fn new(stiffness: f64, gap_above: f64, gap_below: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        let above = Contact { level: super::valid_gap(gap_above)?, sign: 1.0, onset_exponent: 1.0 };
        let below = Contact { level: -super::valid_gap(gap_below)?, sign: -1.0, onset_exponent: 1.0 };
        Ok(Self { stiffness, contacts: [above, below] })
    }
}

impl ForceLaw for TwoSidedStop {
    fn force(&self, displacement: f64, _: f64) -> Force {
        for contact in &self.contacts {
            let beyond = displacement - contact.level;
            if contact.sign * beyond > 0.0 {
                return Force::elastic(-self.stiffness * beyond, -self.stiffness);
            }
        }
        Force::ZERO
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn is_odd(&self) -> bool {
        self.contacts[0].level == -self.contacts[1].level
    }

    fn linear_beyond(&self) -> Option<f64> {
        Some(self.contacts[0].level.abs().max(self.contacts[1].level.abs()))
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        (constant == LawConstant::Stiffness).then_some(self.stiffness)
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        match constant {
            LawConstant::Gap => Self::new(self.stiffness, value, value),
            LawConstant::Stiffness => {
                super::positive_stiffness(value)?;
                Ok(Self { stiffness: value, ..*self })
            }
            other => no_constant("a two-sided stop", other),
        }
    }

    fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        self.constant(constant)
    }
}

pub(super) static DESCRIPTION: LawDescription = LawDescription {
    name: "two-sided",
    identity: LawIdentity::Named("two-sided"),
    force: "k d + c d'",
    sides: LawSides::Two {
        pair: (1, &linear::DESCRIPTION),
        build: |values, levels| of_levels(values.number(0), levels),
    },
    keys: &linear::KEYS,
    alternative: None,
    symbol: LawSymbol::TwoSprings,
    words: LawWords { report: "linear springs", caption: "springs", last_first: false },
};

/// One element; two of them where the structure rests past one of the springs.
fn of_levels(stiffness: f64, [above, below]: [f64; 2]) -> Result<Vec<LawPart>, LawError> {
    if above >= 0.0 && below >= 0.0 {
        return Ok(LawPart::whole(TwoSidedStop::new(stiffness, above, below)?.into()));
    }
    let one = |(level, suffix, is_turned)| {
        let law = LinearStop::resting(stiffness, LawRest::Level(level))?.into();
        Ok(LawPart { suffix, law, is_turned })
    };
    [(above, " (above)", false), (below, " (below)", true)].into_iter().map(one).collect()
}
