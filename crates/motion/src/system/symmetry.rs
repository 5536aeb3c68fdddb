//! Systems that a mirror image leaves as they are.

use faer::c64;

use super::System;
use crate::LocalElement;

impl System {
    /// Whether `q(t) -> -q(t + T/2)` takes motions to motions, T being the excitation period: all loads are
    /// of odd order, so that they change their sign over half a period, and forces change theirs with the
    /// displacement, each by itself or with an opposite element of the same law.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        let loads_are_odd =
            (0..self.orders.len()).all(|index| self.orders[index] % 2 == 1 || !self.acts(index));
        loads_are_odd && self.elements.iter().all(|element| self.has_image(element))
    }

    /// Whether a load of the order with that index is more than zero.
    fn acts(&self, index: usize) -> bool {
        let given = self.forces[index].iter().chain(&self.supports[index]);
        given.chain(self.driven.amplitudes(index)).any(|value| *value != c64::new(0.0, 0.0))
    }

    fn has_image(&self, element: &LocalElement) -> bool {
        let is_opposite = |other: &LocalElement| {
            let opposite = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| *a == -b);
            other.law == element.law
                && opposite(&other.support_ratios, &element.support_ratios)
                && opposite(&other.shape, &element.shape)
        };
        element.law.is_odd() || self.elements.iter().any(is_opposite)
    }
}
