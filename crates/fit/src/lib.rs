//! Parameters of a model fitted to data: weighted least squares, intervals, undetermined directions.
//!
//! # Mathematics
//! A model gives `m` numbers `y_i(p)` for `n` parameters `p`. Data `d_i` have standard deviations `s_i`. With
//! the residuals `r_i = (y_i - d_i)/s_i` the best parameters minimise
//!
//! `chi^2(p) = sum_i r_i(p)^2`,
//!
//! which is maximum likelihood if errors are independent and normal. [`fit`] uses the method of Levenberg and
//! Marquardt within bounds, with the Jacobian `J = dr/dp` (m x n).
//!
//! **Uncertainty** (`inference.rs`). To first order the parameters are normal with the covariance `S = v (J^T
//! J)^-1`. If the standard deviations are known, `v = 1` and intervals use the quantile of the normal
//! distribution; `chi^2` itself is then tested against its distribution with `m - n` degrees of freedom. If
//! they are known up to a common factor, `v = chi^2/(m - n)` and intervals use Student's distribution with
//! `m - n` degrees of freedom; a test is then impossible.
//!
//! **Profiles** (`profile.rs`). If the model is nonlinear within the interval, the first order is not
//! accurate. The profile of a parameter is `chi^2` minimised over all others. Its interval contains the
//! values at which the profile exceeds its minimum by at most `v q^2`, with the same quantile `q`. It is
//! invariant under transformations of a parameter (a stiffness, its logarithm).
//!
//! **Undetermined directions** (`identifiability.rs`). In relative parameters `x_j`, `p_j = p_j* (1 + x_j)`,
//! the singular value decomposition of `J diag(p*)` gives directions of unit length and the standard
//! deviation `sqrt(v)/s_k` of each. A direction in which even a large relative change cannot be excluded is
//! undetermined: a single parameter that the data do not determine, or several that they do not distinguish.
//! Collinearity expresses the same without the precision of the data: with the columns of J scaled to length
//! one, `1/s_k` is the factor by which the parameters compensate each other in this direction.
//!
//! | file | idea |
//! |---|---|
//! | `problem.rs` | the interface of a model; bounds |
//! | `outcome.rs` | settings of a fit, its result |
//! | `least_squares.rs`, `search.rs` | the method of Levenberg and Marquardt; its state |
//! | `jacobian.rs` | its linear algebra: a Jacobian with scaled columns and its singular values |
//! | `inference.rs`, `profile.rs` | standard errors, intervals, correlation, the chi-squared test |
//! | `identifiability.rs` | directions that the data do not determine |
//! | `distribution.rs` | normal, Student's and the chi-squared distribution |
//!
//! # Source
//! Bates and Watts, *Nonlinear Regression Analysis and Its Applications* (1988), chapters 2 and 6; Nocedal
//! and Wright, *Numerical Optimization* (2006), chapter 10.
//!
//! # Example
//! A straight line through three points with standard deviations of 0.1.
//! ```
//! use std::convert::Infallible;
//! use faer::Mat;
//! use hammerbeam_fit::{Bounds, Deviations, FitProblem, Inference, LeastSquaresSettings, fit};
//!
//! struct Line;
//! impl FitProblem for Line {
//!     type Error = Infallible;
//!     fn residuals(&mut self, p: &[f64]) -> Result<Vec<f64>, Infallible> {
//!         let data = [1.0, 3.1, 4.9];
//!         Ok((0..3).map(|i| (p[0] + p[1] * i as f64 - data[i]) / 0.1).collect())
//!     }
//!     fn jacobian(&mut self, _: &[f64]) -> Result<Mat<f64>, Infallible> {
//!         Ok(Mat::from_fn(3, 2, |i, j| if j == 0 { 10.0 } else { 10.0 * i as f64 }))
//!     }
//! }
//! let settings = LeastSquaresSettings::new(Deviations::Known);
//! let found = fit(&mut Line, &[0.5, 0.5], &[Bounds::NONE; 2], &settings)?;
//! assert!(found.end.converged());
//! let inference = Inference::of(&found, Deviations::Known, 0.95);
//! assert!((found.parameters[1] - 1.95).abs() < 1e-9);
//! assert!((inference.standard_errors[1].unwrap_or(0.0) - 0.1 / 2.0_f64.sqrt()).abs() < 1e-9);
//! # Ok::<(), hammerbeam_fit::FitError<Infallible>>(())
//! ```

pub mod distribution;
mod identifiability;
mod inference;
mod jacobian;
mod least_squares;
mod outcome;
mod problem;
mod profile;
mod search;

pub use identifiability::{COLLINEAR, Identifiability, ParameterDirection, UNDETERMINED};
pub use inference::{ChiSquared, Inference, Interval};
pub use least_squares::fit;
pub use outcome::{FitEnd, FitError, LeastSquaresFit, LeastSquaresSettings};
pub use problem::{Bounds, Deviations, FitProblem};
pub use profile::{ProfileInterval, profile};
