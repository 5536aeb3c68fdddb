//! Motion by an integrator that shares nothing with the library.
//!
//! The study file is read as a plain table, masses and springs are added up here, and the equations of motion
//! `M y'' + C y' + K y = f(t) + forces of the stops` are integrated by the classical method of Runge and
//! Kutta with steps of one length, in physical coordinates; those of a beam in its modes. Nothing is exact,
//! nothing is clever: a step in which a stop is reached or left is halved until that is at its end. At a
//! rigid stop an impact turns the relative velocity round, and one that cannot be
//! distinguished from rest holds. It serves surveys, which ask whether an attractor is there, not for its
//! last digits.

mod coordinates;
mod equations;
mod keys;
mod motion;
mod reading;
mod stops;

pub use coordinates::Coordinates;
pub use equations::Equations;
pub use motion::PlainMotion;
