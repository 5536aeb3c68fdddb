//! Phase and order of a harmonic: of the excitation, of its forces and supports, and of further loads.

use crate::document::{Key, Quantity, key::Whole, quantity};

/// The phase.
pub(super) const PHASE: Key<Quantity> = Key::new("phase_rad", quantity::PHASE, "phase").or(0.0);
/// Orders start here; 0 is a constant.
pub(super) const ORDERS: Whole = Whole(1, 1000);
