//! Hertz contact of two spheres.
//! Equations (L5) and (L6) of the book, `docs/reference`.

use super::{
    Contact, Force, ForceLaw, HertzStiffness, LawConstant, LawDescription, LawError, LawIdentity, LawKey,
    LawPart, LawRest, LawSides, LawSymbol, LawWords, force_law::no_constant, one_sided,
};

/// One-sided stop after Hertz.
///
/// `f = -k p^1.5` at penetration `p = r - level > 0`, else `f = 0`; `level` is the gap, or minus the
/// penetration that gives the preload.
///
/// # Source
/// Goldsmith, *Impact* (1960), chapter 4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzStop {
    stiffness: f64,
    contact: [Contact; 1],
}

impl HertzStop {
    /// A stop of stiffness `k` [N/m^1.5] at rest distance `gap` [m].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Gap`] unless finite and not negative.
    pub fn with_gap(stiffness: f64, gap: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        Ok(Self { stiffness, contact: one_sided(super::valid_gap(gap)?, 1.5) })
    }

    /// A stop that presses on the undeformed structure with `preload` [N].
    ///
    /// # Errors
    /// [`LawError::Stiffness`] unless finite and positive, [`LawError::Preload`] unless finite and not
    /// negative.
    pub fn with_preload(stiffness: f64, preload: f64) -> Result<Self, LawError> {
        super::positive_stiffness(stiffness)?;
        let level = -(super::valid_preload(preload)? / stiffness).powf(2.0 / 3.0);
        Ok(Self { stiffness, contact: one_sided(level, 1.5) })
    }

    /// The constant `k` [N/m^1.5] of two spheres in contact.
    ///
    /// `k = 4/3 E sqrt(R)` with `1/E = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2` and `1/R = 1/R_1 + 1/R_2`.
    ///
    /// * `radii`: `R_1`, `R_2` [m]; an infinite radius is a plane.
    /// * `moduli`: `E_1`, `E_2` [Pa].
    /// * `poisson_ratios`: `nu_1`, `nu_2` [-].
    #[must_use]
    pub fn stiffness_of_spheres(radii: [f64; 2], moduli: [f64; 2], poisson_ratios: [f64; 2]) -> f64 {
        let compliance: f64 = (0..2).map(|i| (1.0 - poisson_ratios[i] * poisson_ratios[i]) / moduli[i]).sum();
        let curvature: f64 = radii.iter().map(|radius| 1.0 / radius).sum();
        4.0 / 3.0 / compliance / curvature.sqrt()
    }

    /// A stop whose force begins at the relative displacement `level` [m], or one that presses.
    ///
    /// # Errors
    /// As [`HertzStop::with_gap`] and [`HertzStop::with_preload`].
    pub(super) fn resting(stiffness: f64, rest: LawRest) -> Result<Self, LawError> {
        match rest {
            LawRest::Preload(preload) => Self::with_preload(stiffness, preload),
            LawRest::Level(level) if level < 0.0 => {
                Self::with_preload(stiffness, stiffness * (-level).powf(1.5))
            }
            LawRest::Level(level) => Self::with_gap(stiffness, level),
        }
    }
}

impl ForceLaw for HertzStop {
    fn force(&self, displacement: f64, _: f64) -> Force {
        let penetration = displacement - self.contact[0].level;
        if penetration <= 0.0 {
            return Force::ZERO;
        }
        let root = penetration.sqrt();
        Force::elastic(-self.stiffness * penetration * root, -1.5 * self.stiffness * root)
    }

    fn contacts(&self) -> &[Contact] {
        &self.contact
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        (constant == LawConstant::Stiffness).then_some(self.stiffness)
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        match constant {
            LawConstant::Gap => Self::with_gap(self.stiffness, value),
            LawConstant::Stiffness => {
                super::positive_stiffness(value)?;
                Ok(Self { stiffness: value, ..*self })
            }
            other => no_constant("a Hertz contact", other),
        }
    }

    fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        self.constant(constant)
    }
}

impl HertzStiffness {
    /// The constant [N/m^1.5].
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::Given(stiffness) => stiffness,
            Self::Spheres { radii_m, moduli_pa, poisson_ratios } => {
                let radii = radii_m.map(|radius| radius.unwrap_or(f64::INFINITY));
                HertzStop::stiffness_of_spheres(radii, moduli_pa, poisson_ratios)
            }
        }
    }
}

pub(super) static DESCRIPTION: LawDescription = LawDescription {
    name: "hertz",
    identity: LawIdentity::Named("hertz"),
    force: "k d^1.5",
    sides: LawSides::One {
        no_preload: None,
        build: |values, rest| Ok(LawPart::whole(HertzStop::resting(values.number(0), rest)?.into())),
    },
    keys: &[LawKey::hertz_stiffness()],
    alternative: None,
    symbol: LawSymbol::Sphere,
    words: LawWords { report: "Hertz contact", caption: "Hertz contact", last_first: false },
};
