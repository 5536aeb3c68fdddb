//! Forces of an element in a region where its contacts are held closed or open.

use crate::{Contact, Force, Law, LocalElement};

/// Switching functions of an element: its contacts, and the pressure of a law that has one, or the kink of
/// its force, beside one contact.
pub(in crate::general) fn switches_of(element: &LocalElement) -> usize {
    let law = &element.law;
    law.contacts().len() + usize::from(law.has_pressure()) + usize::from(law.has_kinks())
}

/// Force of an element whose contacts are held closed or open.
pub(in crate::general) fn force_in_region(law: &Law, (r, speed): (f64, f64), inside: &[bool]) -> Force {
    let contacts = law.contacts();
    if contacts.is_empty() {
        return law.force(r, speed);
    }
    if law.has_pressure() {
        let presses = inside.iter().all(|inside| *inside);
        return if presses { law.pressing_force(r, speed) } else { Force::ZERO };
    }
    if law.has_kinks() {
        let [is_closed, is_beyond] = [inside[0], inside[1]];
        return if is_closed { force_of_piece(law, (r, speed), is_beyond) } else { Force::ZERO };
    }
    let penetration = |contact: &Contact| contact.sign * (r - contact.level);
    let closed = contacts.iter().zip(inside).filter(|(_, inside)| **inside).map(|(contact, _)| contact);
    match closed.max_by(|a, b| penetration(a).total_cmp(&penetration(b))) {
        None => Force::ZERO,
        Some(contact) if penetration(contact) > 0.0 => law.force(r, speed),
        Some(contact) => continued_force(law, r, contact),
    }
}

/// Displacement at the kink of a force of two pieces.
pub(in crate::general) fn kink_of(law: &Law) -> f64 {
    let first = law.in_piece(law.contacts()[0].level);
    first.kinks()[1].expect("a law with kinks has one behind its first piece")
}

/// Force of a closed contact on one side of the kink, continued to the other one and below the level.
fn force_of_piece(law: &Law, (r, speed): (f64, f64), is_beyond: bool) -> Force {
    let (piece, contact) = (law.beyond_kink(is_beyond), &law.contacts()[0]);
    if !is_beyond && contact.sign * (r - contact.level) <= 0.0 {
        return continued_force(&piece, r, contact);
    }
    piece.force(r, speed)
}

/// The tangent of the law at the level of a contact, where the law itself has ended.
fn continued_force(law: &Law, r: f64, contact: &Contact) -> Force {
    if contact.onset_exponent > 1.0 {
        return Force::ZERO;
    }
    let beyond = contact.level + contact.sign * (1e-9 * contact.level.abs() + 1e-12);
    let slope = law.force(beyond, 0.0).slope;
    Force { value: slope * (r - contact.level), slope, damping: 0.0 }
}
