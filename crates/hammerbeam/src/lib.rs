//! Steady-state vibration of structures with impacts: the one crate to use from Rust.
//!
//! A [`Study`] is read from a file or a text, with the model that it describes. From there
//!
//! * everything the study asks for, in a results folder: [`Study::run`], with progress and cancelling
//!   [`run::run_study`].
//! * what such a folder holds: [`Store`], [`results`].
//! * all periodic solutions at a frequency, with their multipliers: [`Study::orbits`].
//! * a branch, row by row, from one of them: [`Study::follow`].
//! * motions in time: [`Study::simulate`].
//! * settled motions over the frequency: [`Study::sweep`].
//! * Lyapunov exponents: [`Study::exponents`].
//! * basins of attraction: [`Study::basins`].
//! * stored orbits by branch, frequency or event: [`chosen_orbits`].
//! * the motion of an orbit over its period: [`orbit_waveform`].
//! * everything in a results folder as columns of numbers, NPZ, JSON: [`results::arrays`].
//! * figures of a results folder, and its page: [`drawing`].
//!
//! Each of these has a function in the module of its name that takes a results folder, a number of threads
//! and an [`Observer`] as well: it reports how far the work is, and stops it. What is stored goes on from
//! there with the same bits.
//!
//! # Units
//! SI everywhere: metres, seconds, kilograms, newtons; frequencies in hertz where a name ends in `_hz`.
//!
//! # Below
//! What the studies are made of can be put together by hand as well: [`structure`] (beams, masses, modes),
//! [`motion`] (loads, laws of contact, integrators), [`orbit`] (periodic solutions and their branches) and
//! [`attractor`] (motions that need not repeat).
//!
//! # Example
//! A mass on a spring, driven at its undamped frequency: the amplitude is `F/(c w)`.
//! ```
//! use hammerbeam::Study;
//!
//! let study = Study::parse(
//!     "oscillator",
//!     r#"
//!     [structure]
//!     kind = "lumped"
//!     mass = [{ name = "mass", mass_kg = 1.0 }]
//!     spring = [{ between = ["mass", "ground"], stiffness_n_m = 1.0 }]
//!     damper = [{ between = ["mass", "ground"], damping_n_s_m = 0.1 }]
//!
//!     [excitation]
//!     kind = "force"
//!     at = "mass"
//!     amplitude_n = 0.5
//!     frequency_hz = [0.1, 0.2]
//!
//!     [response]
//!     point = "mass"
//!     "#,
//! )?;
//! let orbits = study.orbits(1.0 / std::f64::consts::TAU, 1)?;
//! assert!((orbits[0].maxima.displacement - 5.0).abs() < 1e-8);
//! # Ok::<(), hammerbeam::Error>(())
//! ```

pub use hammerbeam_jobs::{
    BranchRows, CountedProgress, FailureKind, FrequencySeries, InitialState, InitialStateError,
    InitialWordsError, JobError as Error, JobFolders, JobPart, JobPartError, JobPartReport, MirrorImage,
    Observer, OrbitWaveform, PreparedStudy as Study, Progress, Quiet, StoredBranches, VariedProgress, basins,
    basins_part, check, chosen_orbits, comparison, exponents, modes_document, orbit_waveform, orbits, pool,
    rig, run, simulate, sweep, update, verify,
};
pub use hammerbeam_orbit::{
    BranchEventKind, BranchRow, Events, OrbitMaxima, PeriodicSolution, Side, Stability, StopReason,
};
pub use hammerbeam_results::{self as results, Store};
pub use hammerbeam_study::{self as study_file, StudyError, StudyFile};

pub use hammerbeam_attractor as attractor;
pub use hammerbeam_drawing as drawing;
pub use hammerbeam_figure as figure;
pub use hammerbeam_motion as motion;
pub use hammerbeam_orbit as orbit;
pub use hammerbeam_signal as signal;
pub use hammerbeam_structure as structure;
