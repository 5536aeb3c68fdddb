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
//! * residual: `max_k |Z_k - z_k| / (1 + |A_k|) <= tau`.
//! * multipliers: `|mu - mu'| <= tau k (1 + |A_m| + S)`, with the condition `k` of the eigenvalue.
//! * displacement: `|d - d'| <= max(tau, 1e-9) G max(d', L)`.
//! * acceleration: `|a - a'| <= max(tau, 1e-7) G max(g a', w)`.
//! * impact velocity: `|v - v'| <= tau G g_v v'`.
//! * impulse: `|J - J'| <= tau G sum_j g_j J'_j`.
//! * contact force: `|F - F'| <= max(tau, 1e-9) G g F'`.
//! * contacts: as many differ as contacts graze, are touched with `v' <= sqrt(2 W tau G L_r)` if one grazes,
//!   or are touched within `tau G L_r` of a node, at most.
//! * events: fold, flip, Neimark-Sacker: a multiplier within 1e-5 of +1, -1, the circle, or, if the event was
//!   bracketed only, of where its multiplier was said to lie, up to 1e-2 off; grazing: `|s| <= 1e-5 L_r`.
//!
//! A unit of the relative state moves the response point by `L` at most, with the acceleration `w`, and
//! elements by `L_r` with the velocity `V_r`; `W` bounds the acceleration with which they approach, by state,
//! loads and other elements. `g_v = 1 + V_r / v' + W L_r / v'^2`: the instant of a weak touch, and with it
//! its velocity, is known less well, be it one of a shallow contact or one of a deep contact that just opens.
//! `g_j = 1 + min(g_v - 1, L_r / p)` for each element, with its own largest impact velocity and deepest
//! penetration p: what a contact does depends on the velocity it begins with, which just behind grazing is
//! `sqrt(2 W p)`, so shallow contacts are known less well, however hard another stop is struck. `g` is that
//! of the element with the largest contact force, or, where none presses, of the one struck hardest. A rigid
//! stop that holds the structure has `W / (m F)` more, with the mobility m: its force is a difference of what
//! makes W; where nothing strikes it, it has that alone. A contact grazes where an extremum `s` of its
//! penetration has `|s| <= tau G L_r`; these are counted apart.
//!
//! `S = sqrt(2n) |A_m(z_0 + tau d) - A_m(z_0)| / tau`, with a unit vector d that holds all modes, the larger
//! one of both signs, is computed for multipliers that do not agree with `S = 0`: near grazing the monodromy
//! matrix changes within `tau` of an orbit. The multipliers then agree if they are those of a motion within
//! `tau` of the stored one.
//!
//! Hard contacts add `H / tau` to S: rounding of displacements of the size m leaves `H = w eps m / p L / V`
//! unknown of the matrix behind a contact of the depth p and the frequency w.
//!
//! Where a contact grazes whose force begins with a jump (a stop with a damper `c`), the monodromy matrix
//! itself jumps, by the factor `1 - c b n^T` at the touch, with the row n of the penetration and the state b
//! that a unit impulse gives: multipliers may differ there, and a fold, flip or Neimark-Sacker point on the
//! row of the grazing is that jump, without a multiplier at its place. So it is with rigid stops. Such a
//! touch may have a speed of up to `v_s = sqrt(2 W tau G L_r)` or not be there: speeds below it and forces
//! below `c v_s` agree, and accelerations to what the response gets from that. A touch at a node belongs to
//! either segment, or, by rounding, to none.
//!
//! Rows of curves are compared with `tau` of 1e-8 at least, to which curves are followed.
//!
//! Bounds of 1e-9 and 1e-7 above are what the stored maxima are good for. A force that is no larger than that
//! of a penetration of `T G L_r`, and of an element that comes no deeper, agrees with none.
//!
//! | file | idea |
//! |---|---|
//! | `settings.rs`, `quantity.rs` | what is asked for, what is compared |
//! | `stored.rs`, `sample.rs` | all stored rows, each with its system and what it claims; which of them |
//! | `claims.rs` | where the events of a row put a multiplier |
//! | `recompute.rs`, `spectrum.rs` | the motion over the orbit; multipliers and their conditions |
//! | `compare.rs`, `unknown.rs` | the table above, and what cannot be distinguished from nothing |
//! | `report.rs` | the worst of each quantity, and every disagreement |

mod claims;
mod compare;
mod document;
mod quantity;
mod recompute;
mod report;
mod sample;
mod settings;
mod spectrum;
mod stored;
mod unknown;

use std::sync::atomic::AtomicBool;

use hammerbeam_motion::{System, general::GeneralSettings};
use hammerbeam_orbit::Response;
use hammerbeam_results::{Store, StoreError};

use crate::{CountedProgress, Observer, PooledOrder, PreparedStudy};

pub use document::VerifyReport;
pub use quantity::VerifiedQuantity;
pub use report::{Disagreement, Verification, VerifiedPlace, Worst};
pub use settings::{TOLERANCE, VerifySettings};

use compare::{Comparison, compare};
use recompute::{recompute, scales, sensitivity};
use stored::{StoredRow, StoredRows};

/// The general integrator is not asked for more, see [`GeneralSettings::tolerance`].
const FINEST_MOTION: f64 = 3e-13;

/// Tolerance of the steps of the general integrator: a hundredth of that of the comparisons, since steps add
/// up and contacts amplify.
fn motion_tolerance(tolerance: f64) -> f64 {
    (0.01 * tolerance).clamp(FINEST_MOTION, 1e-6)
}

/// Solutions that are in memory at once.
const BATCH: usize = 1024;

/// Computes stored solutions again and compares: of branches over the frequency, over other parameters, and
/// of curves, each with the system that it is of.
///
/// # Returns
/// `None` if the observer said stop.
///
/// # Errors
/// The store refuses.
pub fn verify(
    store: &Store,
    study: &PreparedStudy,
    settings: &VerifySettings,
    observer: &mut dyn Observer,
) -> Result<Option<Verification>, StoreError> {
    let _snapshot = store.snapshot()?;
    let rows = StoredRows::of(store, study)?;
    let count = rows.count();
    let chosen =
        rows.places(store, &sample::sample(count, settings.sample.unwrap_or(count), settings.seed))?;
    let mut verification = Verification::new(count, settings);
    for batch in chosen.chunks(BATCH) {
        let solutions: Vec<StoredRow<'_>> =
            batch.iter().map(|place| rows.read(store, place)).collect::<Result<_, _>>()?;
        let done = verification.sampled;
        let counted = |observer: &mut dyn Observer, more: usize| {
            observer.counted(&CountedProgress {
                done: done + more as u64,
                total: Some(chosen.len() as u64),
                things: "solutions",
                place: &"",
            });
        };
        let compare = |(): &mut (), stored: &StoredRow<'_>, _: &AtomicBool| compare_one(stored, settings);
        let mut threads = PooledOrder::new(settings.jobs, observer);
        let Some(results) = threads.each(&solutions, &|| (), &compare, counted) else { return Ok(None) };
        for (stored, result) in solutions.iter().zip(results) {
            verification.add(stored.place, stored.tolerance(settings.tolerance), result);
        }
    }
    Ok(Some(verification))
}

type Compared = Result<Vec<Comparison>, String>;

fn compare_one(stored: &StoredRow<'_>, settings: &VerifySettings) -> Compared {
    let (system, response) = stored.system()?;
    compare_with((&system, &response), stored, settings)
}

fn compare_with(
    (system, response): (&System, &Response),
    stored: &StoredRow<'_>,
    settings: &VerifySettings,
) -> Compared {
    let (solution, tolerance) = (&stored.solution, stored.tolerance(settings.tolerance));
    let scales = scales(system, solution).map_err(|failed| failed.to_string())?;
    let motion = GeneralSettings::with_tolerance(motion_tolerance(tolerance));
    let found =
        recompute((system, response), solution, &scales, &motion).map_err(|failed| failed.to_string())?;
    let with = |sensitivity| {
        let claimed = (&stored.row, stored.claims, solution);
        compare((system, response.shape.as_slice()), claimed, &scales, &found, (tolerance, sensitivity))
    };
    let comparisons = with(0.0);
    let doubtful = |comparison: &Comparison| {
        comparison.quantity == VerifiedQuantity::Multipliers && comparison.difference > tolerance
    };
    if !comparisons.iter().any(doubtful) {
        return Ok(comparisons);
    }
    let sensitivity = sensitivity((system, response), solution, &scales, (&found, tolerance), &motion);
    Ok(with(sensitivity.map_err(|failed| failed.to_string())?))
}
