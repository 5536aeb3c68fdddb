//! A virtual rig: a "measurement" made with another model than the one it is held against.
//!
//! The rig is a study of its own, made of a study by the changes of its table `[rig.changes]`: another
//! stiffness, a contact that loses energy, a shaker that does not keep its amplitude. Its motion is swept up
//! and down in steps; at each frequency it settles, is recorded through a measuring chain, and the record is
//! classified as a measured one would be. What the rig knows of itself (the state once in each period,
//! without noise) is kept beside it, to count how often that is right.
//!
//! * `build.rs`: the study of the rig.
//! * `sweep.rs`: stepped sweeps; a record at each frequency, and its point.
//! * `chaos.rs`: largest exponents of aperiodic motions, from record and motion.
//! * `decay.rs`: a free decay of the structure without its stops: eigenfrequencies and damping as they are
//!   measured.
//! * `modes.rs`: which modes these are.
//! * `filter.rs`: what low-pass filters leave of the maxima along the branches.
//! * `signals.rs`: measured and computed signals laid over one another.
//! * `whole.rs`: all of it.
//! * `tables.rs`, `document.rs`, `signal_document.rs`: its tables and its document.
//!
//! Everything follows from the study and the seed: noise has a seed for each frequency and direction, and
//! threads take whole sweeps, signals or solutions.

mod build;
mod chaos;
mod decay;
mod document;
mod error;
mod filter;
mod modes;
mod signal_document;
mod signals;
mod sweep;
mod tables;
mod whole;

pub use build::changed_study;
pub use chaos::MotionExponents;
pub use decay::MeasuredMode;
pub use error::RigError;
pub use filter::{
    Filtered, FilteredBranch, FilteredPoint, FilteredRatio, acceleration_curves, filtered_branches,
};
pub use modes::{RigMode, rig_modes};
pub use signal_document::signal_document;
pub use signals::{SignalPair, compare_signal};
pub use sweep::{RigPoint, SweepDirection, sweep};
pub use tables::{RigChaos, figure_name, write_rig_tables};
pub use whole::{RigReport, measure_rig};
