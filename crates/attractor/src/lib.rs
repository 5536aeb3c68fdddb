//! Attractors of a motion: simulation in time, sweeps, Poincare sections, Lyapunov exponents and basins of
//! attraction.
//!
//! # Mathematics
//! A motion is seen section by section ([`SectionMap`]): `z(k + 1) = P(z(k))`, with the fundamental matrix
//! `dP/dz` where tangent vectors are wanted. Of a [`System`](hammerbeam_motion::System) a section is an
//! excitation period or a part of it, by the exact integrator; any vector field serves as well, by the
//! general one, and so does any map.
//!
//! - does it repeat, after how many periods?: distance of states, `settle.rs`
//! - do neighbouring motions part, and how fast?: Lyapunov exponents, by QR, with confidence from block
//!   averages, `tangents.rs`, `lyapunov.rs`
//! - the same, from a series alone: the 0-1 test, `zero_one.rs`
//! - does it come back as on a torus?: shifts that are tripled, `returns.rs`
//! - which kind is it?: all of these; doubtful where they disagree, `classify.rs`
//!
//! - `section.rs`, `part.rs`: motions, advanced section by section; parts of sections
//! - `simulate.rs`, `poincare.rs`: motion in time with every contact, and what it needs to go on; sections
//!   at a phase and at touches
//! - `sweep.rs`: stepped sweeps with the state carried over, diagrams from many states
//! - `grid.rs`, `basins.rs`: where the motions from a grid of states lead
//! - `parallel.rs`, `random.rs`: the same work for many items, on threads or one by one; numbers from a seed
//!
//! Nothing here prints, reads files or looks at the clock. Whoever drives a sweep, an average or a round of
//! cells does so step by step, and can show progress and stop in between.
//!
//! # Example
//! The exponents of Henon's map `x' = 1 - 1.4 x^2 + y`, `y' = 0.3 x`: 0.419 and, since areas shrink by 0.3,
//! `ln 0.3` less that.
//! ```
//! use hammerbeam_attractor::{LyapunovSettings, StepMap, lyapunov};
//!
//! let mut henon = StepMap::new(2, |z: &[f64]| {
//!     let derivative = faer::mat![[-2.8 * z[0], 1.0], [0.3, 0.0]];
//!     (vec![1.0 - 1.4 * z[0] * z[0] + z[1], 0.3 * z[0]], derivative)
//! });
//! let settings = LyapunovSettings { aligning: 100, averaged: 20_000 };
//! let spectrum = lyapunov(&mut henon, &[0.1, 0.1], settings)?;
//! let largest = spectrum.exponents[0];
//! assert!((largest.value - 0.419).abs() < 0.001 + largest.half_width);
//! assert!((spectrum.sum - 0.3f64.ln()).abs() < 1e-9);
//! # Ok::<(), hammerbeam_attractor::AttractorError>(())
//! ```

mod basins;
mod classify;
mod error;
mod grid;
mod lyapunov;
mod parallel;
mod part;
mod poincare;
mod random;
mod returns;
mod section;
mod settle;
mod simulate;
mod sweep;
mod tangents;
mod zero_one;

pub use basins::{Attractor, Basins, Round, SHARED_CELLS, behind_rigid_stops, fractions, rounds};
pub use classify::{Class, Classified, Effort, MotionDoubt, classify, examine};
pub use error::AttractorError;
pub use grid::{Axis, Grid};
pub use lyapunov::{BLOCKS, Convergence, Estimate, Lyapunov, LyapunovSettings, Spectrum, lyapunov};
pub use parallel::{InOrder, OneByOne};
pub use part::Part;
pub use poincare::{PoincareSection, SectionPoint, poincare};
pub use section::{FieldMap, SectionMap, StepMap, SystemMap, WATCHED_PERIODS, state_scales};
pub use settle::{Patience, Settled, distance, settle};
pub use simulate::{ContactRecord, Sample, Simulation, SimulationCheckpoint};
pub use sweep::{Observable, SweepPoint, SweepSettings, Sweeper, frequencies};
pub use tangents::Tangents;
pub use zero_one::zero_one;
