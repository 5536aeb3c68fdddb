//! Parameters of a system besides the excitation frequency: what they scale or shift, and how they are set.
//!
//! | parameter | value | what it changes |
//! |---|---|---|
//! | excitation scale `a` | 1 as built | all harmonics of order 1 and above: `b_m = a b_m(1)`, `U_m = a U_m(1)` |
//! | gap `g` | [m] | the levels of the contacts of one element; of a two-sided stop both, which must be equal |
//! | stiffness `k` | as the law has it | the force of one element, `f = k f(1)`, at the levels that its contacts have |
//! | restitution `e` | [-] | the impacts of one rigid stop |
//! | added damping ratio `z` | 0 as built | the modal damping matrix, `C = C(0) + diag(2 z w_i)` |

use crate::{Law, LawError, System, law::RigidStop};

/// A parameter of a system that a branch can be followed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// Factor of all harmonics of the load of order 1 and above [-], > 0; 1 for the load as given.
    ExcitationScale,
    /// Gap of an element [m], >= 0.
    Gap {
        /// Number of the element.
        element: usize,
    },
    /// Constant of the law of an element, in the unit of the law (N/m, N/m^1.5, N/m^3). The levels of its contacts stay, so it is the penetration
    /// at rest of a preloaded stop that is held, not the preload.
    Stiffness {
        /// Number of the element.
        element: usize,
    },
    /// Coefficient of restitution of a rigid stop [-], 0 to 1.
    Restitution {
        /// Number of the element.
        element: usize,
    },
    /// Ratio to critical damping [-] that every mode has besides the damping as given; negative takes damping away.
    AddedDampingRatio,
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
    /// Only rigid stops have a coefficient of restitution as a parameter.
    #[error("{name} is no rigid stop, it has no coefficient of restitution to vary")]
    NoRestitution { name: String },
    /// The law refuses the value.
    #[error("{name}: {source}")]
    Law { name: String, source: LawError },
    /// A factor of the excitation is finite and positive.
    #[error("the excitation scale is {found}, must be finite and positive")]
    ExcitationScale { found: f64 },
    /// Every mode keeps a damping that is not negative.
    #[error("an added damping ratio of {found} makes the damping of a mode negative or not finite")]
    DampingRatio { found: f64 },
    /// The derivative by the damping of a force that depends on the velocity is not known.
    #[error("{name} loses energy: there is no derivative by the damping with it")]
    LossyLaw { name: String },
}

impl System {
    /// Value of a parameter.
    ///
    /// # Errors
    /// [`ParameterError::NoElement`], [`ParameterError::NoGap`].
    pub fn parameter(&self, parameter: Parameter) -> Result<f64, ParameterError> {
        match parameter {
            Parameter::ExcitationScale => Ok(self.excitation_scale()),
            Parameter::AddedDampingRatio => Ok(self.added_damping_ratio()),
            Parameter::Stiffness { element } => {
                let element = self.element(element)?;
                let stiffness = Some(element.law.stiffness()).filter(|stiffness| stiffness.is_finite());
                stiffness.ok_or_else(|| ParameterError::NoStiffness { name: element.name.clone() })
            }
            Parameter::Restitution { element } => {
                let element = self.element(element)?;
                let missing = || ParameterError::NoRestitution { name: element.name.clone() };
                element.law.rigid().map(RigidStop::restitution).ok_or_else(missing)
            }
            Parameter::Gap { element } => {
                let element = self.element(element)?;
                element.law.gap().ok_or_else(|| ParameterError::NoGap { name: element.name.clone() })
            }
        }
    }

    /// The system with another value of a parameter.
    ///
    /// # Errors
    /// See [`ParameterError`].
    pub fn with_parameter(mut self, parameter: Parameter, value: f64) -> Result<Self, ParameterError> {
        self.set_parameter(parameter, value)?;
        Ok(self)
    }

    /// Gives a parameter another value; on an error nothing changes.
    ///
    /// # Errors
    /// See [`ParameterError`].
    pub fn set_parameter(&mut self, parameter: Parameter, value: f64) -> Result<(), ParameterError> {
        match parameter {
            Parameter::ExcitationScale => self.set_excitation_scale(value),
            Parameter::AddedDampingRatio => self.set_added_damping_ratio(value),
            Parameter::Stiffness { element }
            | Parameter::Gap { element }
            | Parameter::Restitution { element } => {
                // Says whether there is such an element, and such a gap.
                self.parameter(parameter)?;
                let element = &mut self.elements_mut()[element];
                let law = match (parameter, &element.law) {
                    (Parameter::Gap { .. }, law) => law.with_gap(value),
                    (Parameter::Restitution { .. }, Law::Rigid(law)) => {
                        law.with_restitution(value).map(Law::Rigid)
                    }
                    (_, law) => law.with_stiffness(value),
                };
                let name = element.name.clone();
                element.law = law.map_err(|source| ParameterError::Law { name, source })?;
                Ok(())
            }
        }
    }

    fn element(&self, element: usize) -> Result<&crate::LocalElement, ParameterError> {
        let missing = ParameterError::NoElement { element, count: self.elements().len() };
        self.elements().get(element).ok_or(missing)
    }
}
