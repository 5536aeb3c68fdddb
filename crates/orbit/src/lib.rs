//! Periodic orbits by multiple shooting, their Floquet multipliers and their branches.
//!
//! An orbit of N excitation periods is a fixed point of the flow over N cycles. [`find_start`] and
//! [`find_orbits`] find orbits without a guess: from motion that settles, from near-returns of motion that
//! does not, and along branches. A [`BranchWalk`] follows a branch, one [`BranchRow`] at a time: the
//! solution, its multipliers, its maxima on the continuous motion, and what happens there. It is driven from
//! outside, so whoever drives it can show progress, stop, store it between two steps and take it up again
//! with the same bits.
//!
//! - `shooting.rs`, `shooting/`: the equations of multiple shooting, condensed to the first node; what the
//!   path crate asks of them, and of their judge
//! - `continuation_parameter.rs`, `state_scale.rs`, `size.rs`: what varies along a branch; in which units
//!   states are measured; the size of an orbit
//! - `eigenvalues.rs`: multipliers, the eigenvalues of the product of the segments
//! - `start.rs`, `reach.rs`, `neighbour.rs`: the first orbit of a branch, by simulation; from an orbit
//!   elsewhere; from the orbit of a slightly different system
//! - `find.rs`, `permitted_start.rs`, `catalogue.rs`, `sampling.rs`, `crossings.rs`: all orbits at one
//!   frequency: the search, states at which a motion can start, the orbits known, Newton's method from many
//!   states, where branches cross the frequency
//! - `solve.rs`: Newton's method at a fixed frequency, and what is stored of a converged orbit
//! - `recompute.rs`: the same point of a branch with other segments or tolerances
//! - `walk.rs`, `walk/`: walking, step by step: the path (`orbit_path.rs`), why it ends, the rows and
//!   those between them (`row.rs`, `density.rs`, `between.rs`), cutting orbits anew on the way
//!   (`resegment.rs`, `halves.rs`, `start_phase.rs`)
//! - `checkpoint.rs`: storing a walk
//! - `cut.rs`: phases at which an orbit may start
//! - `corner/`: grazing of a rigid stop as a corner of a branch: where it is, and orbits on both sides
//! - `stop.rs`, `stop_text.rs`, `reopening.rs`: why a walk ended; the reopening of a contact
//! - `spectrum.rs`: multipliers, and which of them are on the unit circle as well as they are known:
//!   stable, marginal, unstable
//! - `known_matrix.rs`, `floquet_vectors.rs`: what is known of a monodromy matrix, and how far that moves a
//!   multiplier; `by_rows.rs`: what they and others do with matrices
//! - `stability.rs`, `located.rs`: test functions of flips and Neimark-Sacker points; what is known of an
//!   event
//! - `switch.rs`: leaving a flip or branch point onto the other branch
//! - `survey.rs`, `matching.rs`: all orbits that simulation leads to at a frequency; whether two orbits
//!   are the same
//! - `off_impacts.rs`: orbits that start on an impact, started elsewhere
//! - `trials.rs`: orbits at a frequency by few trials of Newton's method
//! - `probe.rs`, `backbone.rs`, `linear_contact.rs`: attractors at a frequency, quickly; states of large
//!   amplitude from which motions start; frequencies at which the linear response reaches a contact
//! - `arrival.rs`: whether a motion has come to a stable orbit that is known
//! - `curve/`: curves of folds, flips, Neimark-Sacker points and grazing in two parameters
//! - `free.rs`: free motion of an undamped system: the amplitude is given, the frequency unknown
//! - `free_vibration.rs`: undamped modes whose free vibration repeats with an orbit, and may be added to it
//! - `output.rs`, `output/`: extrema, means and harmonics of motions and contact forces over an orbit
//! - `settings.rs`, `solution.rs`, `event_kind.rs`, `error.rs`: what goes in and what comes out
//!
//! # Stability
//! The multipliers are the eigenvalues of the monodromy matrix, the product of the fundamental matrices of
//! the segments, so they do not depend on how the orbit is cut. An orbit is stable if all of them lie inside
//! the unit circle, unstable if one lies outside, and marginal if neither is known ([`Stability`]). Folds,
//! branch points, flips, Neimark-Sacker points and grazing are located as rows of their own.
//!
//! # Contacts that lose energy
//! The same equations serve. Impact-speed-dependent laws need every node in free flight. Their orbits are cut
//! once, unless [`Segments::Fixed`] says otherwise, and start at a [`phase`](PeriodicSolution::phase) at
//! which no contact is closed: 0, or the middle of the longest time without contact. A walk moves the phase
//! when a contact comes near it; one of several segments does not, and stops with
//! [`StartsInContact`](hammerbeam_motion::exact::MotionError::StartsInContact). An orbit whose contact never
//! opens has no such phase ([`OrbitError::NeverOpens`]). [`states_at_phase`] gives the states of an orbit at
//! any phase, such as 0. Curves in two parameters keep the phase of their start. Motion is simulated over any
//! phases. Where a force begins with a jump, multipliers jump at grazing; the path has a corner there, which
//! is walked round like any other. So has it where an impact on a rigid stop comes or goes, with derivatives
//! that grow without bound on the side of the impact: that corner is computed from the orbit cut at its
//! touch, where the speed of the impact is a smooth coordinate (`corner/`; see
//! [`root_corner`](hammerbeam_path::Judge::root_corner)).
//!
//! # Example
//! A mass on a spring, driven at its undamped frequency: the amplitude is `F/(c w)`, and both multipliers
//! have the modulus `exp(-c T/(2 m))`.
//! ```
//! use hammerbeam_motion::{Harmonic, HarmonicForce, Load, System};
//! use hammerbeam_orbit::{OrbitSettings, Response, find_start};
//! use hammerbeam_structure::{Connection, Damping, GROUND, Lumped, LumpedMass, Reduction};
//!
//! let to_ground = |constant| Connection { between: ["mass".into(), GROUND.into()], constant };
//! let oscillator = Lumped {
//!     masses: vec![LumpedMass { name: "mass".into(), mass: 1.0 }],
//!     springs: vec![to_ground(1.0)],
//!     dampers: vec![to_ground(0.1)],
//! };
//! let model = oscillator.structure()?.reduce(&Reduction::None, &Damping::none(), &[])?.model;
//! let mass = model.point("mass").expect("every mass is a point").clone();
//! let force = HarmonicForce { shape: mass.shape.clone(), harmonic: Harmonic { order: 1, amplitude: 0.5,
//! phase: 0.0 } }; let system = System::new(model, &Load { support: vec![], forces: vec![force] },
//! vec![])?;
//!
//! let response = Response { shape: mass.shape, support_ratios: mass.support_ratios };
//! let frequency_hz = 1.0 / std::f64::consts::TAU;
//! let orbit = find_start(&system, &response, frequency_hz, 1, &OrbitSettings::default())?;
//! assert!((orbit.maxima.displacement - 5.0).abs() < 1e-8);
//! let [re, im] = orbit.floquet_multipliers[0];
//! assert!((re.hypot(im) - (-0.05 / frequency_hz).exp()).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arrival;
mod backbone;
mod by_rows;
mod catalogue;
mod checkpoint;
mod continuation_parameter;
mod corner;
mod crossings;
mod curve;
mod cut;
mod eigenvalues;
mod error;
mod event_kind;
mod find;
mod floquet_vectors;
mod free;
mod free_vibration;
mod known_matrix;
mod linear_contact;
mod located;
mod matching;
mod motion_search;
mod neighbour;
mod noise;
mod off_impacts;
mod output;
mod permitted_start;
mod probe;
mod reach;
mod recompute;
mod reopening;
mod repetition;
mod sampling;
mod settings;
mod shooting;
mod size;
mod solution;
mod solve;
mod spectrum;
mod stability;
mod start;
mod state_scale;
mod stop;
mod stop_text;
mod survey;
mod switch;
#[cfg(test)]
mod test_oscillator;
mod trials;
mod walk;

pub use catalogue::FoundOrbits;
pub use continuation_parameter::ContinuationParameter;
pub use curve::{CurveEnd, CurveEvents, CurveKind, CurveRow, CurveSettings, CurveWalk};
pub use eigenvalues::{NoEigenvalues, eigenvalues};
pub use error::OrbitError;
pub use event_kind::{BranchEventKind, EventSet};
pub use find::find_orbits;
pub use free::{FreeOrbit, free_orbit};
pub use free_vibration::free_vibration;
pub use hammerbeam_path::PathError;
pub use linear_contact::linear_contact_ranges;
pub use located::{ContactChange, EventStatus, LocatedEvent};
pub use matching::{Matcher, mirror_image, states_at_phase};
pub use neighbour::neighbouring_orbit;
pub use output::{OrbitSignal, SignalStatistics, TimeDerivative, read_orbit};
pub use probe::{ProbeStarts, probe};
pub use reach::reach_orbit;
pub use recompute::recompute;
pub use settings::{OrbitSettings, Response, Segments};
pub use solution::{BranchRow, Events, OrbitMaxima, PeriodicSolution, Side};
pub use solve::Wanted;
pub use spectrum::Stability;
pub use start::{Interruption, find_start, find_start_unless, settled_orbit};
pub use stop::{ResonantMode, StopReason};
pub use survey::{SurveyEffort, SurveyedMotions, survey};
pub use switch::Crossing;
pub use trials::{TrialEffort, newton_trials};
pub use walk::BranchWalk;
