//! Laws of local elements: the force as a function of the relative displacement `r` and the relative velocity
//! `r'`.
//!
//! The force acts on the structure along `+r` (a restoring force is negative for positive `r`). One-sided
//! stops are oriented so that `r` is positive towards the stop; who builds the element turns the coordinate.
//!
//! **Laws that lose energy** push or are idle, they never pull. With the penetration `p = r - level` such a
//! law is `f = -h(p) s(p, p')` for `p > 0` and `s > 0`, else zero: contact is where there is penetration and
//! [`Pressure`] `s`. Where the pressure vanishes first, the surfaces have parted although there is
//! penetration left by the numbers (the surface does not follow): the contact has *parted*, and presses again
//! if the pressure comes back. The force is continuous where the pressure vanishes. Where the penetration
//! begins it is continuous too, or, for a damper, jumps by `-c p'`, see [`Law::onset_damping`]. Some laws
//! remember the speed with which the present contact began ([`Law::remembers_impact`]).

mod formula;
mod hertz;
mod hunt_crossley;
mod linear;
mod power;
mod restitution;
mod rigid;
mod two_sided;

pub use formula::{CONSTANTS, DEEPEST, Formula, FormulaError, Function, LONGEST, VARIABLES};
pub use hertz::HertzStop;
pub use hunt_crossley::HuntCrossleyStop;
pub use linear::LinearStop;
pub use power::{Degree, PowerSpring};
pub use restitution::{RestitutionModel, RestitutionStop};
pub use rigid::RigidStop;
pub use two_sided::TwoSidedStop;

/// Why a law cannot be built from its parameters.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// Stiffnesses are finite and positive (that of a power of the displacement may be negative).
    #[error("stiffness is {found}, must be finite and {allowed}")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Stiffness { found: f64, allowed: &'static str },
    /// Gaps are finite and not negative.
    #[error("gap is {found} m, must be finite and not negative")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Gap { found: f64 },
    /// Preloads are finite and not negative.
    #[error("preload is {found} N, must be finite and not negative")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Preload { found: f64 },
    /// Constants of damping are finite and not negative.
    #[error("damping is {found}, must be finite and not negative")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Damping { found: f64 },
    /// Coefficients of restitution are positive and at most one.
    #[error("coefficient of restitution is {found}, must be more than 0 and at most 1")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Restitution { found: f64 },
    /// Coefficients of restitution of a rigid stop are from 0 to 1.
    #[error("coefficient of restitution of a rigid stop is {found}, must be from 0 to 1")]
    #[expect(missing_docs, reason = "the message names its fields")]
    RigidRestitution { found: f64 },
    /// A rigid stop and a formula have no stiffness.
    #[error("{law} has no stiffness")]
    #[expect(missing_docs, reason = "the message names its fields")]
    NoStiffness { law: &'static str },
    /// A text that is no formula of a force.
    #[error(transparent)]
    Formula(#[from] FormulaError),
    /// A law that remembers how fast its contact began cannot be closed from the outset.
    #[error("the stop presses at rest, but its law needs the speed with which a contact begins")]
    MemoryOfPreload,
}

/// Force of a law and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Force {
    /// Force on the structure along `r` [N].
    pub value: f64,
    /// `df/dr` [N/m].
    pub slope: f64,
    /// `df/dr'` [N s/m].
    pub damping: f64,
}

impl Force {
    /// No force.
    pub const ZERO: Self = Self { value: 0.0, slope: 0.0, damping: 0.0 };

    /// A force that does not depend on the velocity.
    const fn elastic(value: f64, slope: f64) -> Self {
        Self { value, slope, damping: 0.0 }
    }
}

/// One of the ways in which an element can be loaded: contact is where `sign * (r - level) > 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Relative displacement at which the force begins [m].
    pub level: f64,
    /// +1.0 if contact lies above the level, -1.0 if below.
    pub sign: f64,
    /// Exponent with which the force sets in: 1.5 for Hertz, 1.0 for a linear spring.
    pub onset_exponent: f64,
}

/// What has to be positive besides the penetration p for a contact that loses energy to press: `displacement
/// p + velocity p' + offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressure {
    /// Factor of the penetration.
    pub displacement: f64,
    /// Factor of its rate.
    pub velocity: f64,
    /// Constant part.
    pub offset: f64,
}

impl Pressure {
    /// Its value at a penetration and its rate.
    #[must_use]
    pub fn at(&self, penetration: f64, rate: f64) -> f64 {
        self.displacement * penetration + self.velocity * rate + self.offset
    }
}

/// The law of a local element.
#[derive(Debug, Clone, PartialEq)]
pub enum Law {
    /// Sphere on sphere, after Hertz.
    Hertz(HertzStop),
    /// Sphere on sphere, losing energy, after Hunt and Crossley.
    HuntCrossley(HuntCrossleyStop),
    /// Sphere on sphere, with a coefficient of restitution; remembers the speed of its impact.
    Restitution(RestitutionStop),
    /// One-sided linear spring.
    Linear(LinearStop),
    /// Linear springs on both sides of a clearance.
    TwoSided(TwoSidedStop),
    /// A power of the displacement, always active.
    Power(PowerSpring),
    /// A formula of displacement and velocity, always active.
    Formula(Formula),
    /// Rigid stop with a coefficient of restitution.
    Rigid(RigidStop),
}

impl Law {
    /// Force on the structure along `r` at the relative displacement `r` [m] and the relative velocity `r'`
    /// [m/s].
    #[must_use]
    pub fn force(&self, displacement: f64, velocity: f64) -> Force {
        match self {
            Self::Hertz(law) => law.force(displacement),
            Self::HuntCrossley(law) => law.force(displacement, velocity),
            Self::Restitution(law) => law.force(displacement, velocity),
            Self::Linear(law) => law.force(displacement, velocity),
            Self::TwoSided(law) => law.force(displacement),
            Self::Power(law) => law.force(displacement),
            Self::Formula(law) => law.force(displacement, velocity),
            Self::Rigid(_) => RigidStop::force(),
        }
    }

    /// The stop, if the law is that of a rigid one.
    #[must_use]
    pub fn rigid(&self) -> Option<&RigidStop> {
        if let Self::Rigid(law) = self { Some(law) } else { None }
    }

    /// Force of a contact that presses, continued smoothly to where its pressure has vanished: what a step
    /// that ends there follows.
    #[must_use]
    pub(crate) fn pressing_force(&self, displacement: f64, velocity: f64) -> Force {
        match self {
            Self::HuntCrossley(law) => law.pressing_force(displacement, velocity),
            Self::Restitution(law) => law.pressing_force(displacement, velocity),
            Self::Linear(law) if law.damping() > 0.0 => law.pressing_force(displacement, velocity),
            _ => self.force(displacement, velocity),
        }
    }

    /// What has to be positive for a contact to press, if its force depends on the velocity.
    #[must_use]
    pub fn pressure(&self) -> Option<Pressure> {
        match self {
            Self::HuntCrossley(law) => law.pressure(),
            Self::Restitution(law) => Some(law.pressure()),
            Self::Linear(law) => law.pressure(),
            Self::Hertz(_) | Self::TwoSided(_) | Self::Power(_) | Self::Formula(_) | Self::Rigid(_) => None,
        }
    }

    /// Whether a contact of the law can part while there is penetration left.
    #[must_use]
    pub fn has_pressure(&self) -> bool {
        self.pressure().is_some()
    }

    /// Whether the force depends on the displacement.
    #[must_use]
    pub fn depends_on_displacement(&self) -> bool {
        if let Self::Formula(law) = self { law.depends_on_displacement() } else { true }
    }

    /// Whether the force depends on the velocity: that of a contact that has a pressure, or a formula.
    #[must_use]
    pub fn depends_on_velocity(&self) -> bool {
        match self {
            Self::Formula(law) => law.depends_on_velocity(),
            _ => self.has_pressure(),
        }
    }

    /// Mean of `df/dr'` between two velocities, by which the force jumps with its velocity.
    pub(crate) fn mean_damping(&self, displacement: f64, velocities: [f64; 2]) -> f64 {
        match self {
            Self::Formula(law) => law.mean_damping(displacement, velocities),
            // Every other law is linear in the velocity while it presses.
            _ => self.pressing_force(displacement, velocities[1]).damping,
        }
    }

    /// Whether the force depends on the speed with which the present contact began, so that a contact has to
    /// be followed from its beginning.
    #[must_use]
    pub fn remembers_impact(&self) -> bool {
        matches!(self, Self::Restitution(_))
    }

    /// The law in a contact that began with that speed [m/s]; as built, a law that remembers loses nothing.
    #[must_use]
    pub fn struck_at(&self, impact_speed: f64) -> Self {
        match self {
            Self::Restitution(law) => Self::Restitution(law.struck_at(impact_speed)),
            law => law.clone(),
        }
    }

    /// The speed of the impact that the law remembers [m/s]; infinite before the first, and of a law that
    /// remembers none.
    pub(crate) fn impact_speed(&self) -> f64 {
        if let Self::Restitution(law) = self { law.impact_speed() } else { f64::INFINITY }
    }

    /// Whether the law knows how its contact began, if it needs to.
    pub(crate) fn is_struck(&self) -> bool {
        if let Self::Restitution(law) = self { law.is_struck() } else { true }
    }

    /// Derivative of the force of a pressing contact by the speed with which it began.
    pub(crate) fn by_impact_speed(&self, displacement: f64, velocity: f64) -> f64 {
        if let Self::Restitution(law) = self { law.by_impact_speed(displacement, velocity) } else { 0.0 }
    }

    /// The constant c [N s/m] of the force `-c r'` with which a contact begins; 0 where the force is
    /// continuous.
    #[must_use]
    pub fn onset_damping(&self) -> f64 {
        if let Self::Linear(law) = self { law.damping() } else { 0.0 }
    }

    /// Derivative of the force of a pressing contact by [`Law::stiffness`].
    pub(crate) fn by_stiffness(&self, displacement: f64, velocity: f64) -> f64 {
        match self {
            Self::Linear(law) => law.elastic_force(displacement) / law.stiffness(),
            _ => self.pressing_force(displacement, velocity).value / self.stiffness(),
        }
    }

    /// The constant of the damping of a force that depends on the velocity, in its unit (N s/m, s/m); `None`
    /// where a law has none.
    #[must_use]
    pub fn damping(&self) -> Option<f64> {
        match self {
            Self::HuntCrossley(law) => Some(law.loss()),
            Self::Linear(law) => Some(law.damping()),
            _ => None,
        }
    }

    /// The law with another constant of the damping; a law without one stays as it is.
    ///
    /// # Errors
    /// [`LawError::Damping`].
    pub fn with_damping(&self, damping: f64) -> Result<Self, LawError> {
        Ok(match self {
            Self::HuntCrossley(law) => Self::HuntCrossley(law.with_loss(damping)?),
            Self::Linear(law) => Self::Linear(law.with_damping(damping)?),
            law => law.clone(),
        })
    }

    /// Derivative of the force of a pressing contact by [`Law::damping`].
    pub(crate) fn by_damping(&self, displacement: f64, velocity: f64) -> f64 {
        match self {
            Self::HuntCrossley(law) => law.by_loss(displacement, velocity),
            Self::Linear(_) => -velocity,
            _ => 0.0,
        }
    }

    /// The coefficient of restitution [-] of a rigid stop, or of a contact that remembers its impacts; `None`
    /// where a law has none.
    #[must_use]
    pub fn restitution(&self) -> Option<f64> {
        match self {
            Self::Rigid(law) => Some(law.restitution()),
            Self::Restitution(law) => Some(law.restitution()),
            _ => None,
        }
    }

    /// The law with another coefficient of restitution; a law without one stays as it is.
    ///
    /// # Errors
    /// [`LawError::RigidRestitution`], [`LawError::Restitution`].
    pub fn with_restitution(&self, restitution: f64) -> Result<Self, LawError> {
        Ok(match self {
            Self::Rigid(law) => Self::Rigid(law.with_restitution(restitution)?),
            Self::Restitution(law) => Self::Restitution(law.with_restitution(restitution)?),
            law => law.clone(),
        })
    }

    /// Derivative of the force of a pressing contact by [`Law::restitution`].
    pub(crate) fn by_restitution(&self, displacement: f64, velocity: f64) -> f64 {
        if let Self::Restitution(law) = self { law.by_restitution(displacement, velocity) } else { 0.0 }
    }

    /// The contacts of the law; none for a law that is always active.
    #[must_use]
    pub fn contacts(&self) -> &[Contact] {
        match self {
            Self::Hertz(law) => law.contacts(),
            Self::HuntCrossley(law) => law.contacts(),
            Self::Restitution(law) => law.contacts(),
            Self::Linear(law) => law.contacts(),
            Self::TwoSided(law) => law.contacts(),
            Self::Power(_) | Self::Formula(_) => &[],
            Self::Rigid(law) => law.contacts(),
        }
    }

    /// The constant of the law, in its unit; infinite for a rigid stop, not a number for a formula.
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        match self {
            Self::Hertz(law) => law.stiffness(),
            Self::HuntCrossley(law) => law.stiffness(),
            Self::Restitution(law) => law.elastic().stiffness(),
            Self::Linear(law) => law.stiffness(),
            Self::TwoSided(law) => law.stiffness(),
            Self::Power(law) => law.stiffness(),
            Self::Formula(_) => f64::NAN,
            Self::Rigid(_) => f64::INFINITY,
        }
    }

    /// The gap [m]; `None` for a spring, a preloaded stop and a stop with two different gaps.
    #[must_use]
    pub fn gap(&self) -> Option<f64> {
        let contacts = self.contacts();
        let gap = contacts.first()?.sign * contacts[0].level;
        (gap >= 0.0 && contacts.iter().all(|contact| contact.sign * contact.level == gap)).then_some(gap)
    }

    /// The law with another constant and the same levels.
    ///
    /// # Errors
    /// [`LawError::Stiffness`], [`LawError::NoStiffness`].
    pub fn with_stiffness(&self, stiffness: f64) -> Result<Self, LawError> {
        Ok(match self {
            Self::Hertz(law) => Self::Hertz(law.with_stiffness(stiffness)?),
            Self::HuntCrossley(law) => Self::HuntCrossley(law.with_stiffness(stiffness)?),
            Self::Restitution(law) => {
                Self::Restitution(law.with_elastic(law.elastic().with_stiffness(stiffness)?))
            }
            Self::Linear(law) => Self::Linear(law.with_stiffness(stiffness)?),
            Self::TwoSided(law) => Self::TwoSided(law.with_stiffness(stiffness)?),
            Self::Power(law) => Self::Power(law.with_stiffness(stiffness)?),
            Self::Formula(_) => return Err(LawError::NoStiffness { law: "a formula" }),
            Self::Rigid(_) => return Err(LawError::NoStiffness { law: "a rigid stop" }),
        })
    }

    /// The law with another gap, on both sides of a two-sided stop; a spring stays as it is.
    ///
    /// # Errors
    /// [`LawError::Gap`].
    pub fn with_gap(&self, gap: f64) -> Result<Self, LawError> {
        Ok(match self {
            Self::Hertz(law) => Self::Hertz(HertzStop::with_gap(law.stiffness(), gap)?),
            Self::HuntCrossley(law) => Self::HuntCrossley(HuntCrossleyStop::new(
                HertzStop::with_gap(law.stiffness(), gap)?,
                law.loss(),
            )?),
            Self::Restitution(law) => {
                Self::Restitution(law.with_elastic(HertzStop::with_gap(law.elastic().stiffness(), gap)?))
            }
            Self::Linear(law) => {
                Self::Linear(LinearStop::with_gap(law.stiffness(), gap)?.with_damping(law.damping())?)
            }
            Self::TwoSided(law) => Self::TwoSided(TwoSidedStop::new(law.stiffness(), gap, gap)?),
            Self::Power(_) | Self::Formula(_) => self.clone(),
            Self::Rigid(law) => Self::Rigid(RigidStop::with_gap(law.restitution(), gap)?),
        })
    }

    /// Derivative of the level by the gap, of the contact that acts at a displacement.
    pub(crate) fn level_by_gap(&self, displacement: f64) -> f64 {
        let acts = |contact: &&Contact| contact.sign * (displacement - contact.level) > 0.0;
        self.contacts().iter().find(acts).map_or(0.0, |contact| contact.sign)
    }
}

fn positive_stiffness(found: f64) -> Result<(), LawError> {
    if found.is_finite() && found > 0.0 {
        Ok(())
    } else {
        Err(LawError::Stiffness { found, allowed: "positive" })
    }
}

fn valid_gap(found: f64) -> Result<f64, LawError> {
    if found.is_finite() && found >= 0.0 { Ok(found) } else { Err(LawError::Gap { found }) }
}

fn valid_damping(found: f64) -> Result<f64, LawError> {
    if found.is_finite() && found >= 0.0 { Ok(found) } else { Err(LawError::Damping { found }) }
}

fn valid_preload(found: f64) -> Result<f64, LawError> {
    if found.is_finite() && found >= 0.0 { Ok(found) } else { Err(LawError::Preload { found }) }
}

#[cfg(test)]
mod tests;
