//! Forces of an element in a region where its contacts are held closed or open.

use crate::{Contact, Force, Law};

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
    let penetration = |contact: &Contact| contact.sign * (r - contact.level);
    let closed = contacts.iter().zip(inside).filter(|(_, inside)| **inside).map(|(contact, _)| contact);
    match closed.max_by(|a, b| penetration(a).total_cmp(&penetration(b))) {
        None => Force::ZERO,
        Some(contact) if penetration(contact) > 0.0 => law.force(r, speed),
        Some(contact) => continued_force(law, r, contact),
    }
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
