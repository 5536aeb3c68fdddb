//! The study file: what a study says, and how it is read from TOML.
//!
//! One file per table of the study file. Each holds plain data, in SI units, and the reader that asks the
//! table for its keys; `docs/reference/study-file.md` lists them all. What needs the assembled model (a
//! cut-off below the first mode, the number of modal damping ratios) is checked when the model is built, see
//! [`crate::Model`].

mod amplitude;
mod beam;
mod beam_end;
mod beam_point;
mod beam_section;
mod beam_span;
#[cfg(test)]
mod book;
mod continuation;
mod damping;
mod excitation;
mod figures;
mod file_checksum;
mod force;
mod harmonic;
mod keys;
mod load;
mod lumped;
mod matrices;
mod names;
mod output;
mod output_value;
mod parameter;
mod parameter_kind;
mod read_formula;
mod read_round_hole;
mod read_stop_law;
mod reduction;
mod response;
mod rig;
mod search;
mod stop;
mod stop_keys;
mod stop_law;
mod stop_place;
mod structure;
mod study;
mod support_motion;
mod vary;

pub use amplitude::Amplitude;
pub use beam::BeamTable;
pub use beam_end::EndSupport;
pub use beam_point::BeamPointTable;
pub use beam_section::SectionKeys;
pub use beam_span::{BeamProfile, BeamSpanEntry};
pub use continuation::{ContinuationTable, SegmentChoice};
pub use damping::{DampingTable, ModalRatio};
pub use excitation::{Excitation, ExcitationKind, HarmonicExcitation};
pub use figures::{DrawnOrbit, Figures};
pub use force::{ActingForce, ForcePlace, ForceSize};
pub use keys::{KeyTable, key_tables};
pub use load::LoadTable;

pub use lumped::{Damper, LumpedTable, Mass, Spring};
pub(crate) use matrices::MatrixProblem;
pub use matrices::{
    DirectionEntry, InputFile, MatricesTable, MatrixEntry, MatrixFiles, MatrixPointEntry, MatrixSupportEntry,
    PointPlaceEntry, RowSetEntry,
};
pub use output::{OutputEntry, OutputPlace, OutputSource};
pub use output_value::{OutputQuantity, OutputValue};
pub use parameter::VariedParameter;
pub use parameter_kind::{DampingKey, ParameterKind};
pub use reduction::{ReductionMethod, ReductionTable};
pub use response::ResponseTable;
pub use rig::Rig;
pub use search::Search;
pub use stop::{Stop, StopEntry};
pub use stop_law::{Approach, GapMeasured, StopLaw, StopRest, StopSide};
pub use stop_place::{FixedTo, Place};
pub use structure::StructureTable;
pub use study::{Study, StudyError, StudyFile};
pub use support_motion::{MovingSupport, SupportDrive};
pub use vary::{Curve, CurveOf, Vary};

#[cfg(test)]
mod defaults;
#[cfg(test)]
mod documentation;
#[cfg(test)]
mod known_keys;
#[cfg(test)]
mod tests;
