//! Model updating: parameters of a study fitted to what was measured.
//!
//! The data are eigenfrequencies, modal damping ratios, and maxima of stable periodic responses, each with a
//! standard deviation. The parameters are numbers of the study file, named by their key paths. [`UpdateData`]
//! is read from a file of its own, [`UpdateProblem`] evaluates the model, `hammerbeam-fit` fits it, and
//! [`Update`] is what comes out: values, intervals, and what the data leave open ([`Finding`]).
//! `docs/how-to/fit-to-measurements.md` has the whole of it.
//!
//! **A candidate is a study.** A number is replaced in the text of the study file, and the text is read and
//! built like any other: whatever the file may say can be fitted, every range is kept, and the updated study
//! is the file with some numbers changed, comments and all.
//!
//! **Derivatives.** Those of the eigenfrequencies of an unreduced beam, supported and with its moving support
//! let go, are exact: `dw_i/dp = (phi_i^T dK phi_i - w_i^2 phi_i^T dM phi_i)/(2 w_i)` on a mesh that moves
//! with the parameter. Everything else is taken by central differences with steps of 3e-4 of the parameter:
//! reduced eigenfrequencies, since their basis moves too; damping ratios; and maxima of responses, whose
//! truncation error is below 1e-6 where they are smooth over a thousandth of the parameter.
//!
//! **Responses.** At the start every stable orbit of the period multiple is sought at the frequency of a
//! response, and the one nearest to the data is taken. From then on it is followed by Newton's method as the
//! parameters change, in smaller and smaller steps if need be. A trial for which it is lost is refused, and
//! the fit turns back.
//!
//! | file | idea |
//! |---|---|
//! | `data.rs`; `reading.rs`, `measured.rs` | the data file; parameters, measured numbers |
//! | `candidate.rs` | the study with other numbers, built |
//! | `observe.rs` | what the model says to each of the data |
//! | `response.rs` | orbits that are followed as parameters change |
//! | `exact.rs` | exact derivatives of eigenfrequencies |
//! | `problem.rs` | residuals and derivatives for the fit |
//! | `starts.rs` | the best of fits from several starts |
//! | `outcome.rs`, `finding.rs` | what comes out, in numbers and in words |
//! | `document.rs` | the document and the files of an update |

mod candidate;
mod data;
mod document;
mod exact;
mod finding;
mod measured;
mod observe;
mod outcome;
mod problem;
mod reading;
mod response;
mod starts;

pub use candidate::CandidateError;
pub use data::{
    DampingDatum, DataError, Datum, EigenfrequencyDatum, FittedKey, FrequencyTable, Maximum, MeasuredDatum,
    MeasuredOrbit, ResponseDatum, UpdateData,
};
pub use document::{UpdateReport, write_update};
pub use finding::Finding;
pub use outcome::{
    FURTHER_STARTS, FittedDatum, FittedParameter, Update, UpdateError, UpdateSettings, update,
};
pub use problem::UpdateProblem;
pub use starts::Starts;
