//! Parameters of a system besides the excitation frequency: what they scale or shift, and how they are set.
//!
//! * excitation scale `a`: value 1 as built; what it changes all harmonics of order 1 and above: `b_m = a
//!   b_m(1)`, `U_m = a U_m(1)`.
//! * constant of a law: value as the law has it; what it changes one element, or the two that stand for the
//!   sides of one stop: its gap shifts the levels of its contacts, of a two-sided stop both, which must be
//!   equal; the restitution of a rigid stop its impacts; any other its force at the levels that its contacts
//!   have ([`LawConstant`]).
//! * number of a family: value in its unit; what it changes the whole structure, its modes and their
//!   coordinates ([`Family`](crate::Family)).
//! * added damping `z_k`: value 0 as built; what it changes the damping, `C = C(0) + sum_k z_k D_k`, `d =
//!   d(0) + sum_k z_k d_k`; part 0 is a ratio to critical damping, `D_0 = diag(2 w_i)`.

use crate::{LawConstant, LawError};

/// A parameter of a system that a branch can be followed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// Factor of all harmonics of the load of order 1 and above [-], > 0; 1 for the load as given.
    ExcitationScale,
    /// A constant of the law of an element, in the unit of the law.
    OfLaw {
        /// Number of the element, of both sides of a stop that of the first.
        element: usize,
        /// Whether the next element, the other side of the stop, has it in common with that, with one value.
        both_sides: bool,
        /// The constant.
        constant: LawConstant,
    },
    /// A number that the structure depends on, in its unit.
    OfFamily {
        /// Number of the family, see [`System::with_family`].
        family: usize,
    },
    /// How much of a part of the damping the structure has besides the damping as given; negative takes
    /// damping away.
    AddedDamping {
        /// Number of the part, see [`DampingPart`].
        part: usize,
    },
}

impl Parameter {
    /// Ratio to critical damping [-] that every mode has besides the damping as given.
    pub const ADDED_DAMPING_RATIO: Self = Self::AddedDamping { part: 0 };

    /// A constant of the law of one element.
    #[must_use]
    pub const fn of_law(element: usize, constant: LawConstant) -> Self {
        Self::OfLaw { element, both_sides: false, constant }
    }

    /// The gap of an element.
    #[must_use]
    pub const fn gap(element: usize) -> Self {
        Self::of_law(element, LawConstant::Gap)
    }

    /// The stiffness of the law of an element.
    #[must_use]
    pub const fn stiffness(element: usize) -> Self {
        Self::of_law(element, LawConstant::Stiffness)
    }

    /// The coefficient of restitution of an element.
    #[must_use]
    pub const fn restitution(element: usize) -> Self {
        Self::of_law(element, LawConstant::Restitution)
    }

    /// The damping of the contact of an element.
    #[must_use]
    pub const fn contact_damping(element: usize) -> Self {
        Self::of_law(element, LawConstant::Damping)
    }

    /// The numbers that stand for it in checkpoints: what it is, and of which element, part or family. The
    /// first is never 0.
    #[must_use]
    pub fn code(self) -> (u8, usize) {
        match self {
            Self::ExcitationScale => (1, 0),
            Self::AddedDamping { part } => (2, part),
            Self::OfFamily { family } => (7, family),
            Self::OfLaw { element, both_sides, constant } => {
                (constant.code(), 2 * element + usize::from(both_sides))
            }
        }
    }

    /// The parameter with these numbers; `None` if none has them.
    #[must_use]
    pub fn of_code((kind, number): (u8, usize)) -> Option<Self> {
        match kind {
            1 => Some(Self::ExcitationScale),
            2 => Some(Self::AddedDamping { part: number }),
            7 => Some(Self::OfFamily { family: number }),
            _ => Some(Self::OfLaw {
                element: number / 2,
                both_sides: number % 2 == 1,
                constant: LawConstant::of_code(kind)?,
            }),
        }
    }

    /// The constant that it is of the law of an element, if it is of that element.
    #[must_use]
    pub fn constant_of(self, of: usize) -> Option<LawConstant> {
        match self {
            Self::OfLaw { element, both_sides, constant }
                if of == element || (both_sides && of == element + 1) =>
            {
                Some(constant)
            }
            _ => None,
        }
    }

    /// Whether it is the gap of an element, alone or with that of the other side.
    #[must_use]
    pub fn is_gap_of(self, element: usize) -> bool {
        self.constant_of(element) == Some(LawConstant::Gap)
    }

    /// What is left of it if the gaps of these elements do not change with it; `None` if nothing.
    #[must_use]
    pub fn without_gaps_of(self, elements: &[usize]) -> Option<Self> {
        let Self::OfLaw { element, both_sides, constant: LawConstant::Gap } = self else {
            return Some(self);
        };
        let is_left = |element: usize| !elements.contains(&element);
        match (is_left(element), both_sides && is_left(element + 1)) {
            (true, true) => Some(self),
            (true, false) => Some(Self::gap(element)),
            (false, true) => Some(Self::gap(element + 1)),
            (false, false) => None,
        }
    }
}

/// Why a parameter cannot have a value.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum ParameterError {
    /// The element does not exist.
    #[error("there is no element {element}, the system has {count}")]
    NoElement { element: usize, count: usize },
    /// A preloaded stop, a spring, or a stop with two different gaps.
    #[error("{name} has no single gap")]
    NoGap { name: String },
    /// A rigid stop has no stiffness.
    #[error("{name} is rigid, it has no stiffness")]
    NoStiffness { name: String },
    /// Only rigid stops and contacts that remember their impacts have a coefficient of restitution.
    #[error("{name} has no coefficient of restitution to vary")]
    NoRestitution { name: String },
    /// Only forces that depend on the velocity by a constant of their own have one.
    #[error("{name} has no damping to vary")]
    NoContactDamping { name: String },
    /// The law has no such constant.
    #[error("{name} has no such constant to vary")]
    NoConstant { name: String },
    /// Without damping a contact is of another kind: it ends where the penetration does.
    #[error("{name}: the damping of a contact is {found}, must be finite and more than 0 to be varied")]
    ContactDamping { name: String, found: f64 },
    /// The part does not exist.
    #[error("there is no part {part} of the damping, the system has {count}")]
    NoDampingPart { part: usize, count: usize },
    /// A part of the damping over another number of modes.
    #[error("a part of the damping has {found} modes, the system has {expected}")]
    DampingPartSize { found: usize, expected: usize },
    /// A part of the damping over another number of supports.
    #[error("a part of the damping has {found} moving supports, the system has {expected}")]
    DampingPartSupports { found: usize, expected: usize },
    /// The law refuses the value.
    #[error("{name}: {source}")]
    Law { name: String, source: LawError },
    /// The family does not exist.
    #[error("there is no family {family}, the system has {count}")]
    NoFamily { family: usize, count: usize },
    /// A family has no such member.
    #[error("{0}")]
    NoMember(String),
    /// A factor of the excitation is finite and positive.
    #[error("the excitation scale is {found}, must be finite and positive")]
    ExcitationScale { found: f64 },
    /// Every mode keeps a damping that is not negative.
    #[error("an added damping of {found} makes the damping of a mode negative or not finite")]
    AddedDamping { found: f64 },
    /// What both sides of a stop have in common is one value.
    #[error("\"{}\" and \"{}\" have different values of it", names[0], names[1])]
    SidesDiffer { names: [String; 2] },
}
