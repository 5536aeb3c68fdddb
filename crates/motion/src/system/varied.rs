//! What of a system varies with its parameters (`parameter.rs`): the scale of its load, parts of its damping,
//! laws, and the families that it belongs to.

use faer::Mat;

use super::System;
use crate::{DampingPart, LocalElement, ParameterError, parameter::Kin};

impl System {
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

    pub(crate) fn families(&self) -> &[Kin] {
        &self.families
    }

    pub(crate) fn families_mut(&mut self) -> &mut Vec<Kin> {
        &mut self.families
    }

    /// Whether it has as many modes, and the same elements with as many contacts.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let same = |(a, b): (&LocalElement, &LocalElement)| {
            a.name == b.name && a.law.contacts().len() == b.law.contacts().len()
        };
        self.dof() == other.dof()
            && self.elements.len() == other.elements.len()
            && self.elements.iter().zip(&other.elements).all(same)
    }

    /// Takes over the families of a relative, and its laws where they are not as given.
    pub(crate) fn take_after(&mut self, other: &Self) {
        self.families.clone_from(&other.families);
        let laws = other.elements.iter().zip(&other.given_laws);
        for (own, (theirs, given)) in self.elements.iter_mut().zip(laws) {
            if theirs.law != *given {
                own.law = theirs.law.clone();
            }
        }
    }

    pub(crate) fn elements_mut(&mut self) -> &mut [LocalElement] {
        &mut self.elements
    }

    pub(crate) fn set_excitation_scale(&mut self, scale: f64) -> Result<(), ParameterError> {
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

    pub(crate) fn set_added_damping(&mut self, part: usize, value: f64) -> Result<(), ParameterError> {
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
