//! Stored solutions, computed again by the general integrator, which shares nothing with the one that made
//! them but the laws.
//!
//! # Formulae
//! States are scaled: displacements with `V / max(w_i, 2 pi f)`, velocities with `V`, so that the orbit has
//! the size 1: the root mean square of the norms of its states at equal phases, eight or more in each
//! excitation period; `|.|` is the Euclidean norm, of matrices Frobenius'. From the first node `z_0` of a
//! solution the motion goes over the whole orbit period; `Z_k` is its state at the phase of node k, `A_k =
//! dZ_k/dz_0`, `k = 1..=m`, `z_m = z_0`. What is wrong with the first node by `e` is wrong by `|A_k| e`
//! later, so all errors are judged by `G = 1 + max_k |A_k|`. With the tolerance `tau`:
//!
//! | quantity | agrees if |
//! |---|---|
//! | residual | `max_k |Z_k - z_k| / (1 + |A_k|) <= tau` |
//! | multipliers | `|mu - mu'| <= tau k (1 + |A_m| + S)`, with the condition `k` of the eigenvalue |
//! | displacement | `|d - d'| <= max(tau, 1e-9) G max(d', L)` |
//! | acceleration | `|a - a'| <= max(tau, 1e-7) G max(g a', w)` |
//! | impact velocity | `|v - v'| <= tau G g_v v'` |
//! | impulse | `|J - J'| <= tau G sum_j g_j J'_j` |
//! | contact force | `|F - F'| <= max(tau, 1e-9) G g F'` |
//! | contacts | as many differ as contacts graze or are touched within `tau G L_r` of a node, at most |
//! | events | fold, flip, Neimark-Sacker: a multiplier within 1e-5 of +1, -1, the circle; grazing: `|s| <= 1e-5 L_r` |
//!
//! A unit of the relative state moves the response point by `L` at most, with the acceleration `w`, and
//! elements by `L_r` with the velocity `V_r`; `W` bounds the acceleration with which they approach, by state,
//! loads and other elements. `g_v = 1 + V_r / v' + W L_r / v'^2`: the instant of a weak touch, and with it
//! its velocity, is known less well, be it one of a shallow contact or one of a deep contact that just opens.
//! `g_j = 1 + min(g_v - 1, L_r / p)` for each element, with its own largest impact velocity and deepest
//! penetration p: what a contact does depends on the velocity it begins with, which just behind grazing is
//! `sqrt(2 W p)`, so shallow contacts are known less well, however hard another stop is struck. `g` is that
//! of the element with the largest contact force, or, where none presses, of the one struck hardest. A rigid
//! stop that holds the structure all the time has `1 + W / (m F)`, with the mobility m. A contact grazes
//! where an extremum `s` of its penetration has `|s| <= tau G L_r`; these are counted apart.
//!
//! `S = sqrt(2n) |A_m(z_0 + tau d) - A_m(z_0)| / tau`, with a unit vector d that holds all modes, the larger
//! one of both signs, is computed for multipliers that do not agree with `S = 0`: near grazing the monodromy
//! matrix changes within `tau` of an orbit. The multipliers then agree if they are those of a motion within
//! `tau` of the stored one.
//!
//! Where a contact grazes whose force begins with a jump (a stop with a damper `c`), the monodromy matrix
//! itself jumps, by the factor `1 - c b n^T` at the touch, with the row n of the penetration and the state b
//! that a unit impulse gives: multipliers may differ there, and a fold, flip or Neimark-Sacker point on the
//! row of the grazing is that jump, without a multiplier at its place. So it is with rigid stops. Such a
//! touch may have a speed of up to `v_s = sqrt(2 W tau G L_r)` or not be there: speeds below it and forces
//! below `c v_s` agree, and accelerations to what the response gets from that. A touch at a node belongs to
//! either segment, or, by rounding, to none.
//!
//! Bounds of 1e-9 and 1e-7 above are what the stored maxima are good for. A force that is no larger than that
//! of a penetration of `T G L_r`, and of an element that comes no deeper, agrees with none.
//!
//! | file | idea |
//! |---|---|
//! | `sample.rs` | which solutions |
//! | `recompute.rs`, `spectrum.rs` | the motion over the orbit; multipliers and their conditions |
//! | `compare.rs`, `unknown.rs` | the table above, and what cannot be told from nothing |
//! | `report.rs` | the worst of each quantity, and every disagreement |

mod compare;
mod document;
mod recompute;
mod report;
mod sample;
mod spectrum;
mod unknown;

use std::sync::atomic::AtomicBool;

use hammerbeam_motion::general::GeneralSettings;
use hammerbeam_orbit::{PeriodicSolution, Side};
use hammerbeam_results::{Store, StoreError, row::Row, store::BranchRecord};
use hammerbeam_study::Model;

use crate::{CountedProgress, Observer, PooledOrder};

pub use document::VerifyReport;
pub use report::{Disagreement, Quantity, Verification, Worst};

use compare::{Comparison, compare};
use recompute::{recompute, scales, sensitivity};

/// What to verify, and how closely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VerifySettings {
    /// Number of solutions; `None` for all.
    pub sample: Option<u64>,
    /// Which sample.
    pub seed: u64,
    /// The tolerance `tau` of all comparisons; see the module.
    pub tolerance: f64,
    /// Number of threads, at least 1; the result does not depend on it.
    pub jobs: usize,
}

impl Default for VerifySettings {
    /// A thousand solutions on one thread.
    fn default() -> Self {
        Self { sample: Some(1000), seed: 0, tolerance: TOLERANCE, jobs: 1 }
    }
}

/// Default of [`VerifySettings::tolerance`].
pub const TOLERANCE: f64 = 1e-9;

/// The general integrator is not asked for more, see [`GeneralSettings::tolerance`].
const FINEST_MOTION: f64 = 3e-13;

/// Tolerance of the steps of the general integrator: a hundredth of that of the comparisons, since steps add
/// up and contacts amplify.
fn motion_tolerance(tolerance: f64) -> f64 {
    (0.01 * tolerance).clamp(FINEST_MOTION, 1e-6)
}

/// Solutions that are in memory at once.
const BATCH: usize = 1024;

/// A stored solution and where it stands.
#[derive(Debug)]
struct Stored {
    branch: u32,
    row: Row,
    solution: PeriodicSolution,
}

/// Computes stored solutions again and compares.
///
/// # Returns
/// `None` if the observer said stop.
///
/// # Errors
/// The store refuses.
pub fn verify(
    store: &Store,
    model: &Model,
    settings: &VerifySettings,
    observer: &mut dyn Observer,
) -> Result<Option<Verification>, StoreError> {
    let _snapshot = store.snapshot()?;
    let branches = store.branches()?;
    let stored: u64 = branches.iter().map(|branch| branch.up.solutions + branch.down.solutions).sum();
    let chosen = sample::sample(stored, settings.sample.unwrap_or(stored), settings.seed);
    let places = places(store, &branches, &chosen)?;
    let mut verification = Verification::new(stored, settings);
    for batch in places.chunks(BATCH) {
        let solutions: Vec<Stored> = batch.iter().map(|place| place.read(store)).collect::<Result<_, _>>()?;
        let done = verification.sampled;
        let counted = |observer: &mut dyn Observer, more: usize| {
            observer.counted(&CountedProgress {
                done: done + more as u64,
                total: Some(places.len() as u64),
                things: "solutions",
                place: &"",
            });
        };
        let compare = |(): &mut (), stored: &Stored, _: &AtomicBool| compare_one(model, stored, settings);
        let mut threads = PooledOrder::new(settings.jobs, observer);
        let Some(results) = threads.each(&solutions, &|| (), &compare, counted) else { return Ok(None) };
        for (stored, result) in solutions.iter().zip(results) {
            verification.add(stored.branch, stored.solution.frequency_hz, result);
        }
    }
    Ok(Some(verification))
}

/// Where a chosen solution stands.
#[derive(Debug)]
struct Place {
    branch: u32,
    start: u32,
    side: Side,
    number: u32,
    row: Row,
}

impl Place {
    fn read(&self, store: &Store) -> Result<Stored, StoreError> {
        let solution = store.solution(self.start, self.side, self.number)?;
        Ok(Stored { branch: self.branch, row: self.row, solution })
    }
}

/// Places of the chosen solutions, counted end to end along one branch after the other.
fn places(store: &Store, branches: &[BranchRecord], chosen: &[u64]) -> Result<Vec<Place>, StoreError> {
    let mut wanted = chosen.iter().copied().peekable();
    let mut places = Vec::with_capacity(chosen.len());
    let mut first = 0;
    for branch in branches {
        let (down, up) = (branch.down.solutions, branch.up.solutions);
        let mut index = 0;
        store.each_row::<StoreError>(branch, |row| {
            if wanted.next_if_eq(&(first + index)).is_some() {
                // The down side is read from its end.
                let (side, number) =
                    if index < down { (Side::Down, down - 1 - index) } else { (Side::Up, index - down) };
                places.push(Place {
                    branch: branch.id,
                    start: branch.start,
                    side,
                    number: number as u32,
                    row,
                });
            }
            index += 1;
            Ok(())
        })?;
        first += down + up;
    }
    Ok(places)
}

type Compared = Result<Vec<Comparison>, String>;

fn compare_one(model: &Model, stored: &Stored, settings: &VerifySettings) -> Compared {
    let (solution, tolerance) = (&stored.solution, settings.tolerance);
    let scales = scales(&model.system, solution).map_err(|failed| failed.to_string())?;
    let motion = GeneralSettings::with_tolerance(motion_tolerance(tolerance));
    let found = recompute(model, solution, &scales, &motion).map_err(|failed| failed.to_string())?;
    let observed = (&model.system, model.response.shape.as_slice());
    let with =
        |sensitivity| compare(observed, (&stored.row, solution), &scales, &found, (tolerance, sensitivity));
    let comparisons = with(0.0);
    let doubtful = |comparison: &Comparison| {
        comparison.quantity == Quantity::Multipliers && comparison.difference > tolerance
    };
    if !comparisons.iter().any(doubtful) {
        return Ok(comparisons);
    }
    let sensitivity = sensitivity(model, solution, &scales, (&found, tolerance), &motion);
    Ok(with(sensitivity.map_err(|failed| failed.to_string())?))
}
