//! One-sided linear spring, with or without a damper beside it.
//! Equations (L2) to (L4) of the book, `docs/reference`.

use super::{
    Contact, Force, ForceLaw, ForcePoint, LawConstant, LawDescription, LawError, LawIdentity, LawKey,
    LawKeyKind, LawPart, LawPhrase, LawRest, LawSides, LawSymbol, LawWords, Pressure, VariesAs,
    force_law::no_constant, one_sided, quantity,
};

/// One-sided linear spring, with or without a damper beside it.
///
/// `f = -(k p + c p')` at penetration `p = r - level > 0` as long as that pushes, else `f = 0`: the stop does
/// not pull. With a damper the force sets in with a jump, `-c p'`, and ends where `k p + c p' = 0`, before
/// the penetration does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearStop {
    stiffness: f64,
    damping: f64,
    contact: [Contact; 1],
}

impl LinearStop {
    /// A spring of stiffness `k` [N/m] at rest distance `gap` [m].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Gap`] unless finite and not negative.
    pub fn with_gap(stiffness: f64, gap: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        Ok(Self { stiffness, damping: 0.0, contact: one_sided(super::valid_gap(gap)?, 1.0) })
    }

    /// A spring that presses on the undeformed structure with `preload` [N].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Preload`] unless finite and not
    /// negative.
    pub fn with_preload(stiffness: f64, preload: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        let level = -super::valid_preload(preload)? / stiffness;
        Ok(Self { stiffness, damping: 0.0, contact: one_sided(level, 1.0) })
    }

    /// The same stop with a damper `c` [N s/m] beside the spring.
    ///
    /// # Errors
    /// [`LawError::Damping`] unless finite and not negative.
    pub fn with_damping(self, damping: f64) -> Result<Self, LawError> {
        Ok(Self { damping: super::valid_damping(damping)?, ..self })
    }

    /// A stop whose spring begins at the relative displacement `level` [m], or one that presses.
    ///
    /// # Errors
    /// As [`LinearStop::with_gap`] and [`LinearStop::with_preload`].
    pub(super) fn resting(stiffness: f64, rest: LawRest) -> Result<Self, LawError> {
        match rest {
            LawRest::Preload(preload) => Self::with_preload(stiffness, preload),
            LawRest::Level(level) if level < 0.0 => Self::with_preload(stiffness, -stiffness * level),
            LawRest::Level(level) => Self::with_gap(stiffness, level),
        }
    }

    /// The part of the spring.
    fn elastic_force(&self, displacement: f64) -> f64 {
        -self.stiffness * (displacement - self.contact[0].level)
    }

    /// The force of spring and damper, also where it would pull.
    fn whole_force(&self, displacement: f64, velocity: f64) -> Force {
        Force {
            value: self.elastic_force(displacement) - self.damping * velocity,
            slope: -self.stiffness,
            damping: -self.damping,
        }
    }
}

impl ForceLaw for LinearStop {
    fn force(&self, displacement: f64, velocity: f64) -> Force {
        if displacement <= self.contact[0].level {
            return Force::ZERO;
        }
        let force = self.whole_force(displacement, velocity);
        if force.value < 0.0 { force } else { Force::ZERO }
    }

    fn pressing_force(&self, displacement: f64, velocity: f64) -> Force {
        let is_damped = self.damping > 0.0;
        if is_damped { self.whole_force(displacement, velocity) } else { self.force(displacement, velocity) }
    }

    fn contacts(&self) -> &[Contact] {
        &self.contact
    }

    /// `p + (c/k) p'`.
    fn pressure(&self) -> Option<Pressure> {
        let velocity = self.damping / self.stiffness;
        (velocity > 0.0).then_some(Pressure { displacement: 1.0, velocity, offset: 0.0 })
    }

    fn onset_damping(&self) -> f64 {
        self.damping
    }

    fn linear_beyond(&self) -> Option<f64> {
        Some(self.contact[0].level.abs())
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        match constant {
            LawConstant::Stiffness => Some(self.stiffness),
            LawConstant::Damping => Some(self.damping),
            _ => None,
        }
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        match constant {
            LawConstant::Gap => Self::with_gap(self.stiffness, value)?.with_damping(self.damping),
            LawConstant::Damping => self.with_damping(value),
            LawConstant::Stiffness => {
                super::positive_stiffness(value)?;
                Ok(Self { stiffness: value, ..*self })
            }
            other => no_constant("a linear stop", other),
        }
    }

    fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        (constant == LawConstant::Stiffness && self.damping == 0.0).then_some(self.stiffness)
    }

    fn by_constant(&self, constant: LawConstant, at: ForcePoint) -> f64 {
        match constant {
            LawConstant::Stiffness if self.damping == 0.0 => at.force / self.stiffness,
            LawConstant::Stiffness => self.elastic_force(at.displacement) / self.stiffness,
            LawConstant::Damping => -at.velocity,
            _ => 0.0,
        }
    }
}

/// The keys of a linear stop, which are also those of one on both sides.
pub(super) const KEYS: [LawKey; 2] = [
    LawKey::number("stiffness_n_m", "k", quantity::STIFFNESS)
        .meaning("stiffness k; of a stop of two slopes up to its second gap")
        .varying(LawConstant::Stiffness),
    LawKey {
        kind: LawKeyKind::Number { quantity: quantity::DAMPER, default: Some(0.0) },
        phrase: LawPhrase::Beside,
        varies: Some(VariesAs::UnlessZero(LawConstant::Damping)),
        ..LawKey::number("damping_n_s_m", "c", quantity::DAMPER).meaning("damper c beside the spring")
    },
];

pub(super) static DESCRIPTION: LawDescription = LawDescription {
    name: "linear",
    identity: LawIdentity::Named("linear"),
    force: "k d + c d'",
    sides: LawSides::One {
        no_preload: None,
        build: |values, rest| {
            let stop = LinearStop::resting(values.number(0), rest)?.with_damping(values.number(1))?;
            Ok(LawPart::whole(stop.into()))
        },
    },
    keys: &KEYS,
    alternative: None,
    symbol: LawSymbol::Spring,
    words: LawWords { report: "linear spring", caption: "spring", last_first: false },
};
