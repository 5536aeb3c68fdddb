//! A system with other values of its parameters ([`Parameter`]): of the scale of its load, of parts of its
//! damping, of constants of its laws, and of the numbers over which it is one of a family.

use std::sync::Arc;

use faer::Mat;

use super::{DampingPart, Family, Kin, Member, System};
use crate::{Law, LawConstant, LocalElement, Parameter, ParameterError};

impl System {
    /// Value of a parameter.
    ///
    /// # Errors
    /// That the system does not have it, see [`ParameterError`].
    pub fn parameter(&self, parameter: Parameter) -> Result<f64, ParameterError> {
        match parameter {
            Parameter::ExcitationScale => Ok(self.excitation_scale()),
            Parameter::AddedDamping { part } => {
                let missing = ParameterError::NoDampingPart { part, count: self.added_damping().len() };
                self.added_damping().get(part).copied().ok_or(missing)
            }
            Parameter::OfFamily { family } => Ok(self.family(family)?.value),
            Parameter::OfLaw { element, both_sides, constant } => {
                let value = self.law_constant(element, constant)?;
                if both_sides && self.law_constant(element + 1, constant)? != value {
                    let names = [element, element + 1].map(|side| self.elements()[side].name.clone());
                    return Err(ParameterError::SidesDiffer { names });
                }
                Ok(value)
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
            Parameter::AddedDamping { part } => {
                self.parameter(parameter)?;
                self.set_added_damping(part, value)
            }
            Parameter::OfFamily { family } => {
                *self = self.member(family, value)?.system;
                Ok(())
            }
            Parameter::OfLaw { element, both_sides, constant } => {
                // Says whether there is such an element, and such a constant.
                self.parameter(parameter)?;
                let places = element..=element + usize::from(both_sides);
                let laws = self.elements()[places.clone()].iter().map(|element| {
                    let name = || element.name.clone();
                    if constant == LawConstant::Damping && !(value.is_finite() && value > 0.0) {
                        return Err(ParameterError::ContactDamping { name: name(), found: value });
                    }
                    let law = element.law.with_constant(constant, value);
                    law.map_err(|source| ParameterError::Law { name: name(), source })
                });
                let laws = laws.collect::<Result<Vec<Law>, ParameterError>>()?;
                let elements = self.elements[places].iter_mut();
                elements.zip(laws).for_each(|(element, law)| element.law = law);
                Ok(())
            }
        }
    }

    fn law_constant(&self, element: usize, constant: LawConstant) -> Result<f64, ParameterError> {
        let element = self.element(element)?;
        let varies = |value: &f64| constant != LawConstant::Damping || *value > 0.0;
        let value = element.law.constant(constant).filter(varies);
        value.ok_or_else(|| missing(element.name.clone(), constant))
    }

    fn element(&self, element: usize) -> Result<&LocalElement, ParameterError> {
        let missing = ParameterError::NoElement { element, count: self.elements().len() };
        self.elements().get(element).ok_or(missing)
    }

    /// Makes a number that the structure depends on a parameter, by the next number: [`Parameter::OfFamily`].
    ///
    /// * `value`: of this system, which must be the member there.
    /// * `size`: change of the number that counts as large, for differences.
    #[must_use]
    pub fn with_family(mut self, family: Arc<dyn Family>, value: f64, size: f64) -> Self {
        self.families.push(Kin { family, value, size });
        self
    }

    /// The member of a family with a value; laws of elements that have been changed are so in it, too.
    ///
    /// # Errors
    /// [`ParameterError::NoFamily`], [`ParameterError::NoMember`].
    pub(crate) fn member(&self, family: usize, value: f64) -> Result<Member, ParameterError> {
        let mut member = self.family(family)?.family.member(value).map_err(ParameterError::NoMember)?;
        if !member.system.is_like(self) {
            let message = format!("with {value} the modes or the contacts are others");
            return Err(ParameterError::NoMember(message));
        }
        member.system.take_after(self);
        member.system.families[family].value = value;
        Ok(member)
    }

    /// The family of that number.
    ///
    /// # Errors
    /// [`ParameterError::NoFamily`].
    pub(crate) fn family(&self, family: usize) -> Result<&Kin, ParameterError> {
        let missing = ParameterError::NoFamily { family, count: self.families.len() };
        self.families.get(family).ok_or(missing)
    }

    /// Factor of the harmonics of order 1 and above, see
    /// [`Parameter::ExcitationScale`](crate::Parameter::ExcitationScale).
    #[must_use]
    pub fn excitation_scale(&self) -> f64 {
        self.excitation_scale
    }

    /// Lets a further part of the damping vary, by the next number:
    /// [`Parameter::AddedDamping`](crate::Parameter::AddedDamping).
    ///
    /// # Errors
    /// [`ParameterError::DampingPartSize`] if it is over another number of modes,
    /// [`ParameterError::DampingPartSupports`] if over another number of supports.
    pub fn with_damping_part(mut self, part: DampingPart) -> Result<Self, ParameterError> {
        let expected = self.dof();
        let transmitted = part.supports.iter().map(Vec::len);
        for found in [part.matrix.nrows(), part.matrix.ncols()].into_iter().chain(transmitted) {
            if found != expected {
                return Err(ParameterError::DampingPartSize { found, expected });
            }
        }
        let (found, expected) = (part.supports.len(), self.model.supports.len());
        if found != expected {
            return Err(ParameterError::DampingPartSupports { found, expected });
        }
        self.damping_parts.push(part);
        self.added_damping.push(0.0);
        Ok(self)
    }

    /// The parts of the damping that can be added; the first is a ratio to critical damping of every mode.
    #[must_use]
    pub fn damping_parts(&self) -> &[DampingPart] {
        &self.damping_parts
    }

    /// How much of each part is added to the damping as given.
    #[must_use]
    pub fn added_damping(&self) -> &[f64] {
        &self.added_damping
    }

    /// Whether it has as many modes, and the same elements with as many contacts.
    fn is_like(&self, other: &Self) -> bool {
        let same = |(a, b): (&LocalElement, &LocalElement)| {
            a.name == b.name && a.law.contacts().len() == b.law.contacts().len()
        };
        self.dof() == other.dof()
            && self.elements.len() == other.elements.len()
            && self.elements.iter().zip(&other.elements).all(same)
    }

    /// Takes over the families of a relative, and its laws where they are not as given.
    fn take_after(&mut self, other: &Self) {
        self.families.clone_from(&other.families);
        let laws = other.elements.iter().zip(&other.given_laws);
        for (own, (theirs, given)) in self.elements.iter_mut().zip(laws) {
            if theirs.law != *given {
                own.law = theirs.law.clone();
            }
        }
    }

    fn set_excitation_scale(&mut self, scale: f64) -> Result<(), ParameterError> {
        if !(scale.is_finite() && scale > 0.0) {
            return Err(ParameterError::ExcitationScale { found: scale });
        }
        self.excitation_scale = scale;
        for (index, &order) in self.orders.iter().enumerate() {
            let factor = if order == 0 { 1.0 } else { scale };
            let supports = self.supports[index].iter_mut().zip(&self.unscaled.0[index]);
            supports.for_each(|(support, given)| *support = given * factor);
            let forces = self.forces[index].iter_mut().zip(&self.unscaled.1[index]);
            forces.for_each(|(force, given)| *force = given * factor);
        }
        Ok(())
    }

    fn set_added_damping(&mut self, part: usize, value: f64) -> Result<(), ParameterError> {
        let n = self.dof();
        let added: Vec<f64> = (0..self.added_damping.len())
            .map(|other| if other == part { value } else { self.added_damping[other] })
            .collect();
        let parts = || self.damping_parts.iter().zip(&added).filter(|(_, value)| **value != 0.0);
        let given = &self.given_damping;
        let sum = |i: usize, j: usize| parts().map(|(part, value)| value * part.matrix[(i, j)]).sum::<f64>();
        let damping = Mat::from_fn(n, n, |i, j| given.matrix[(i, j)] + sum(i, j));
        if !(0..n).all(|i| damping[(i, i)].is_finite() && damping[(i, i)] >= 0.0) {
            return Err(ParameterError::AddedDamping { found: value });
        }
        let transmitted =
            |s: usize, i: usize| parts().map(|(part, value)| value * part.supports[s][i]).sum::<f64>();
        for (s, input) in self.model.supports.iter_mut().enumerate() {
            input.damping = (0..n).map(|i| given.supports[s][i] + transmitted(s, i)).collect();
        }
        self.model.damping = damping;
        self.added_damping = added;
        Ok(())
    }
}

/// What is said of an element without a constant.
fn missing(name: String, constant: LawConstant) -> ParameterError {
    match constant {
        LawConstant::Gap => ParameterError::NoGap { name },
        LawConstant::Stiffness => ParameterError::NoStiffness { name },
        LawConstant::Restitution => ParameterError::NoRestitution { name },
        LawConstant::Damping => ParameterError::NoContactDamping { name },
        LawConstant::Further(_) => ParameterError::NoConstant { name },
    }
}
