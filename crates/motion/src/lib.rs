//! Motion of a linear structure with local stops and springs, with exact sensitivities.

pub mod exact;
pub mod general;
pub mod law;
mod load;
mod stretch;
mod system;

pub use law::{Contact, Force, Law, LawError};
pub use load::{Harmonic, HarmonicForce, Load};
pub use stretch::{Flow, Stretch};
pub use system::{LocalElement, ModalLoad, System, SystemError};
