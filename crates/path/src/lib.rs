//! Following the solutions of `R(x, λ) = 0`.

mod checkpoint;
mod corrector;
mod dense_lu;
mod dense_problem;
mod error;
mod follower;
mod memory;
mod point;
mod predictor;
mod problem;
mod product;
mod settings;

pub use checkpoint::Checkpoint;
pub use corrector::CorrectorError;
pub use dense_lu::DenseLu;
pub use dense_problem::DenseProblem;
pub use error::{Doubt, PathError, StopReason};
pub use follower::{Branch, Direction, Follower, StepOutcome, TwoSidedBranch, follow, follow_both};
pub use memory::PathMemory;
pub use point::{ContinuationPoint, Counters, Events};
pub use predictor::{History, Node};
pub use problem::{Determinant, EvaluationError, PathProblem, SingularJacobian};
pub use settings::{ParameterRange, Settings};
