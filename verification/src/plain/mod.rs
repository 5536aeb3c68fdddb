//! Motion of lumped structures by an integrator that shares nothing with the library.
//!
//! The study file is read as a plain table, masses and springs are added up here, and the equations of motion
//! `M y'' + C y' + K y = f(t) + forces of the stops` are integrated in physical coordinates by the classical
//! method of Runge and Kutta with steps of one length. Nothing is exact, nothing is clever: a step in which a
//! stop is reached or left is halved until that is at its end. At a rigid stop an impact turns the relative
//! velocity round, and one that is too slow to be told from rest holds. It serves surveys, where what is
//! asked is whether an attractor is there, not its last digits.

mod equations;
mod motion;

pub use equations::Equations;
pub use motion::PlainMotion;
