//! Published and closed-form results that Hammerbeam reproduces; see `tests/`.
//!
//! | file | what it gives the tests |
//! |---|---|
//! | `results.rs` | whole runs of a study, and where their branches cross a frequency |
//! | `attractors.rs` | periodic attractors by plain simulation from random states |
//! | `completeness.rs` | whether computed branches hold all of these |
//! | `plain/` | motion by an integrator that shares nothing with the library |
//! | `mutations.rs` | damaged inputs of every reader |
//! | `random_study.rs` | random studies |
//! | `relations/` | the same physics written another way, and whether a run gives the same answers |

pub mod attractors;
pub mod completeness;
pub mod mutations;
pub mod plain;
pub mod random_study;
pub mod relations;
pub mod results;
