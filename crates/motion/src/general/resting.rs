//! Contacts that rest: held rigid stops keep their penetration at zero, as those of the same place do, or of
//! one between two points that are both held.
//!
//! With the shapes `phi_j` of the held stops, such a contact has `phi = sum_j c_j phi_j`, and the same of its
//! support ratio and its level, so that `r - level = sum_j c_j (r_j - level_j)` vanishes as long as they are
//! held. It has no force, and what the numbers say of its penetration and of the rate of that is rounding:
//! neither tells whether it is closed. So its switching function is its distance from the next change, the
//! least force with which a stop presses that has a part in it. Then `r_j` falls, and with `c_j > 0` the
//! contact is open from there on. One with `c_j < 0`, on the other side, closes there.

use super::{
    stops::Resting,
    system_field::{SystemField, region::switches_of},
};
use crate::vectors::dot;

/// What a shape or a level may differ from that of held stops, relative to its parts, and be the same but for
/// rounding.
const SAME: f64 = 1e-10;

impl SystemField<'_> {
    /// Whether a contact of the element rests.
    pub(super) fn rests(&self, e: usize) -> bool {
        self.rigid.resting.iter().any(|contact| contact.element == e)
    }

    /// Holds the stop of an element, too.
    pub(super) fn add_held(&mut self, e: usize) {
        self.rigid.held.push(e);
        self.rigid.held.sort_unstable();
        self.rigid.resting = self.resting_on(&self.rigid.held);
    }

    /// A contact does not close without a rigid stop of its place being met, though rounding may have the one
    /// before its level and the other behind.
    pub(super) fn meet_companions(&self, inside: &mut [bool], before: &[bool]) {
        let open = self.rigid.stops.iter().filter(|(e, _)| !self.rigid.held.contains(e) && !self.rests(*e));
        for &(e, switch) in open {
            inside[switch] |= !self.closing_companions(e, inside, before).is_empty();
        }
    }

    /// Contacts that close in the instant in which a rigid stop of their place is met are open: it does not
    /// let them be penetrated. Stops that touch at one instant are met in the order of the elements, so those
    /// that come before it are touched.
    pub(super) fn open_companions(
        &mut self,
        e: usize,
        time: f64,
        state: &[f64],
        (inside, before): (&mut [bool], &[bool]),
    ) {
        let velocities = &state[self.system.dof()..];
        for contact in self.closing_companions(e, inside, before) {
            let element = &self.system.elements()[contact.element];
            if element.law.rigid().is_some() {
                continue;
            }
            contact.open(inside);
            if contact.element < e {
                let carried = self.carried(&element.support_ratios, time)[1];
                let speed = (dot(&element.shape, velocities) + carried).abs();
                self.rigid.touches.push((contact.element, speed));
            }
        }
    }

    /// Contacts that close and would rest if the stop of an element were held, too, and open as that is left.
    fn closing_companions(&self, e: usize, inside: &[bool], before: &[bool]) -> Vec<Resting> {
        let held: Vec<usize> = self.rigid.held.iter().copied().chain([e]).collect();
        let closes = |contact: &Resting| inside[contact.penetration] && !before[contact.penetration];
        let mut found = self.resting_on(&held);
        found.retain(|contact| contact.opens_with(e) && closes(contact));
        found
    }

    /// Lets a held stop go; contacts that rested on it are open, if it moves them that way.
    pub(super) fn release(&mut self, e: usize, inside: &mut [bool]) {
        self.rigid.held.retain(|&held| held != e);
        let stops = self.rigid.stops.iter().filter(|(stop, _)| *stop == e);
        stops.for_each(|&(_, switch)| inside[switch] = false);
        let rested = std::mem::take(&mut self.rigid.resting);
        rested.iter().filter(|contact| contact.opens_with(e)).for_each(|contact| contact.open(inside));
        self.rigid.resting = self.resting_on(&self.rigid.held);
    }

    /// The contacts that rest where these stops are held.
    fn resting_on(&self, held: &[usize]) -> Vec<Resting> {
        let (mut first, mut found) = (0, Vec::new());
        if held.is_empty() {
            return found;
        }
        for (e, element) in self.system.elements().iter().enumerate() {
            if !element.law.contacts().is_empty() && !held.contains(&e) {
                self.add_resting((e, first), held, &mut found);
            }
            first += switches_of(element);
        }
        found
    }

    /// Adds the contacts of an element that rest, from the first of its switching functions on.
    fn add_resting(&self, (e, first): (usize, usize), held: &[usize], found: &mut Vec<Resting>) {
        let elements = self.system.elements();
        let Some(parts) = self.parts_of_held(&elements[e].shape, held) else { return };
        let sum = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            held.iter().zip(&parts).map(|(&stop, part)| part * of(stop)).collect()
        };
        let levels = sum(&|stop| self.laws[stop].contacts()[0].level);
        let ratios = |support: usize| sum(&|stop| elements[stop].support_ratios[support]);
        let mut own = elements[e].support_ratios.iter().enumerate();
        if !own.all(|(support, ratio)| is_sum(*ratio, &ratios(support))) {
            return;
        }
        let contacts = elements[e].law.contacts();
        let pressure = self.laws[e].pressure().map(|pressure| (first + contacts.len(), pressure.offset));
        for (k, contact) in contacts.iter().enumerate().filter(|(_, contact)| is_sum(contact.level, &levels))
        {
            let holders = held.iter().zip(&parts).filter(|(_, part)| part.abs() > SAME);
            let holders = holders.map(|(&stop, part)| (stop, contact.sign * part)).collect();
            found.push(Resting { element: e, penetration: first + k, pressure, holders });
        }
    }

    /// The `c_j` of a shape `sum_j c_j phi_j`, if it is one.
    fn parts_of_held(&self, shape: &[f64], held: &[usize]) -> Option<Vec<f64>> {
        let mut rest = shape.to_vec();
        let parts = self.constrain(held, &vec![0.0; held.len()], &mut rest);
        let size = |vector: &[f64]| dot(vector, vector).sqrt();
        let of_held =
            held.iter().zip(&parts).map(|(&e, part)| part.abs() * size(&self.system.elements()[e].shape));
        (size(&rest) <= SAME * (size(shape) + of_held.sum::<f64>())).then_some(parts)
    }
}

/// Whether a number is a sum of others, but for rounding.
fn is_sum(number: f64, parts: &[f64]) -> bool {
    let size = parts.iter().map(|part| part.abs()).sum::<f64>() + number.abs();
    (parts.iter().sum::<f64>() - number).abs() <= SAME * size
}
