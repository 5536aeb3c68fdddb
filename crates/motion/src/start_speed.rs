//! How far about the motion without contacts searches for other motions begin.
//!
//! They begin at up to sixteen times that motion. Beyond resonance, or where a constant load hides it at
//! phase 0, that may be a small part of a gap, and motions with impacts as large as the gap exist all the
//! same. From states that reach no stop all go back to the motion without contacts.

use std::f64::consts::TAU;

use crate::{LocalElement, System};

/// Part of what reaches the nearest stop that is the least unit of a search: it begins at up to four times
/// the gap.
const OF_GAP: f64 = 0.25;

impl System {
    /// Velocity V [kg^1/2 m/s] that a search takes for its unit: that of the motion without contacts, or a
    /// quarter of what reaches the nearest stop which the undeformed structure does not touch, if that is
    /// more. A state of size one in it moves mode i, from 0, by `V/max(w_i, 2 pi f)/(i + 1)`: low modes move
    /// most.
    ///
    /// * `linear`: that of the motion without contacts.
    #[must_use]
    pub fn start_speed(&self, frequency_hz: f64, linear: f64) -> f64 {
        let to_gap = |element: &LocalElement| {
            let modes = element.shape.iter().zip(&self.model().natural_frequencies).enumerate();
            let part =
                |(i, (phi, w)): (usize, (&f64, &f64))| phi.abs() / w.max(TAU * frequency_hz) / (i + 1) as f64;
            let per_speed: f64 = modes.map(part).sum();
            let open = element.law.contacts().iter().filter(|contact| contact.sign * contact.level > 0.0);
            let nearest = open.map(|contact| contact.level.abs()).reduce(f64::min)?;
            Some(nearest / per_speed).filter(|speed| speed.is_finite())
        };
        let nearest = self.elements().iter().filter_map(to_gap).reduce(f64::min);
        linear.max(OF_GAP * nearest.unwrap_or(0.0))
    }
}
