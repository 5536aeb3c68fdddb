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
//!
//! # How to add a law
//! 1. **The law**, one file beside this one. It has the struct with its constants, which checks them. It
//!    implements `ForceLaw` (`force_law.rs`): force, contacts, derivatives, the constants that can vary and
//!    the derivatives by them. And it has `DESCRIPTION`, a [`LawDescription`]: keys in the study file with
//!    units and ranges, formula, symbol, and how a stop is built from what was read. `two_slopes.rs` is a
//!    short one to start from.
//! 2. **The list**, in this file: its module, the struct among the laws of the kernel, the description among
//!    those of the study file. A law that is made of others has a description only.
//! 3. **The verification**, one file in `verification/tests`: the law against a closed form or a printed
//!    number. The list is also gone through by tests that know no single law: `law/tests.rs` (derivatives
//!    against differences), `exact` against the general integrator in `motion/tests/every_law.rs`, the
//!    documentation in the study crate, which asks for a row in `docs/reference/study-file.md`.
//!
//! Nothing else names a law. The study file, its identity, the parameters of `[[vary]]` and `[[curve]]`,
//! checkpoints, reports and sketches read the description; a constant that only this law has is
//! [`LawConstant::Further`].

mod constant;
mod description;
mod error;
mod force;
mod force_law;
#[macro_use]
mod laws;
pub mod quantity;

mod formula;
mod hertz;
mod hunt_crossley;
mod linear;
mod power;
mod restitution;
mod rigid;
mod round_hole;
mod two_sided;
mod two_slopes;

pub(crate) use constant::ForcePoint;
pub use constant::LawConstant;
pub use description::{
    HertzStiffness, LawAlternative, LawDescription, LawIdentity, LawKey, LawKeyKind, LawPart, LawPhrase,
    LawRest, LawSides, LawSymbol, LawValue, LawValues, LawWords, NoPreload, VariesAs,
};
pub use error::LawError;
use error::{positive_stiffness, valid_damping, valid_gap, valid_preload};
use force::one_sided;
pub use force::{Contact, Force, Pressure};
pub(crate) use force_law::ForceLaw;
pub use quantity::Quantity;

pub use formula::{CONSTANTS, DEEPEST, Formula, FormulaError, Function, LONGEST, VARIABLES};
pub use hertz::HertzStop;
pub use hunt_crossley::HuntCrossleyStop;
pub use linear::LinearStop;
pub use power::{Degree, PowerSpring};
pub use restitution::{RestitutionModel, RestitutionStop};
pub use rigid::RigidStop;
pub(crate) use round_hole::HoleForce;
pub use round_hole::{AcrossHole, RoundHole};
pub use two_sided::TwoSidedStop;
pub use two_slopes::TwoSlopeStop;

laws! { $
    /// Sphere on sphere, after Hertz.
    Hertz(HertzStop),
    /// Sphere on sphere, losing energy, after Hunt and Crossley.
    HuntCrossley(HuntCrossleyStop),
    /// Sphere on sphere, with a coefficient of restitution; remembers the speed of its impact.
    Restitution(RestitutionStop),
    /// One-sided linear spring.
    Linear(LinearStop),
    /// One-sided linear spring whose stiffness changes at a second gap.
    TwoSlopes(TwoSlopeStop),
    /// Linear springs on both sides of a clearance.
    TwoSided(TwoSidedStop),
    /// A power of the displacement, always active.
    Power(PowerSpring),
    /// A formula of displacement and velocity, always active.
    Formula(Formula),
    /// Rigid stop with a coefficient of restitution.
    Rigid(RigidStop),
    /// Round hole, as the element of its first direction.
    RoundHole(RoundHole),
    /// Second direction of the round hole before it.
    AcrossHole(AcrossHole),
}

/// The laws of the study file, in the order in which messages name them.
pub static DESCRIPTIONS: [&LawDescription; 15] = [
    &hertz::DESCRIPTION,
    &linear::DESCRIPTION,
    &two_sided::DESCRIPTION,
    &power::DESCRIPTION,
    &formula::DESCRIPTION,
    &rigid::DESCRIPTION,
    &hunt_crossley::DESCRIPTION,
    &restitution::DESCRIPTIONS[0],
    &restitution::DESCRIPTIONS[1],
    &restitution::DESCRIPTIONS[2],
    &restitution::DESCRIPTIONS[3],
    &restitution::DESCRIPTIONS[4],
    &restitution::DESCRIPTIONS[5],
    &restitution::DESCRIPTIONS[6],
    &two_slopes::DESCRIPTION,
];

mod dispatch;

#[cfg(test)]
mod tests;
