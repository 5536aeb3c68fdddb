//! Published and closed-form results that Hammerbeam reproduces; see `tests/`.
//!
//! | file | what it gives the tests |
//! |---|---|
//! | `results.rs` | whole runs of a study, and where their branches cross a frequency |
//! | `attractors.rs` | periodic attractors by plain simulation from random states |
//! | `completeness.rs` | whether computed branches hold all of these |

pub mod attractors;
pub mod completeness;
pub mod results;
