//! Which constant of a law varies: one name for the study file, the parameters of a system, the derivatives
//! in the kernel and checkpoints.

/// A constant of a law that a branch can be followed in.
///
/// The first four mean the same in every law that has them. What a law has besides is numbered in its own
/// file; elsewhere nothing needs to know what it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LawConstant {
    /// Gap [m], >= 0: the level at which contact begins; of a two-sided stop both, which must be equal.
    Gap,
    /// The stiffness, in the unit of the law (N/m, N/m^1.5, N/m^3). The levels of contacts stay, so it is the
    /// penetration at rest of a preloaded stop that is held, not the preload.
    Stiffness,
    /// Coefficient of restitution [-].
    Restitution,
    /// The constant of the damping of a force that depends on the velocity, in the unit of the law (N s/m,
    /// s/m), > 0.
    Damping,
    /// A further constant of the law, by its number there.
    Further(u8),
}

impl LawConstant {
    /// Code of the first further constant; the codes between belong to other parameters, see
    /// [`Parameter::code`](crate::Parameter::code).
    const FIRST_FURTHER: u8 = 16;

    /// The number that stands for it in checkpoints.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Gap => 3,
            Self::Stiffness => 4,
            Self::Restitution => 5,
            Self::Damping => 6,
            Self::Further(number) => Self::FIRST_FURTHER + number,
        }
    }

    /// The constant with that code.
    pub(crate) fn of_code(code: u8) -> Option<Self> {
        match code {
            3 => Some(Self::Gap),
            4 => Some(Self::Stiffness),
            5 => Some(Self::Restitution),
            6 => Some(Self::Damping),
            _ => code.checked_sub(Self::FIRST_FURTHER).map(Self::Further),
        }
    }

    /// What it is called in messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Gap => "gap",
            Self::Stiffness => "stiffness",
            Self::Restitution => "coefficient of restitution",
            Self::Damping => "damping",
            Self::Further(_) => "such constant",
        }
    }
}

/// A point of a motion at which the derivative of a force by a constant is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ForcePoint {
    /// Relative displacement [m].
    pub displacement: f64,
    /// Relative velocity [m/s]; 0 where no force depends on it.
    pub velocity: f64,
    /// The force there [N], as it was solved for.
    pub force: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_constant_has_a_code_of_its_own() {
        let known =
            [LawConstant::Gap, LawConstant::Stiffness, LawConstant::Restitution, LawConstant::Damping];
        for constant in known.into_iter().chain((0..200).map(LawConstant::Further)) {
            assert_eq!(LawConstant::of_code(constant.code()), Some(constant));
        }
        assert_eq!([0, 1, 2, 7, 15].map(LawConstant::of_code), [None; 5]);
    }
}
