//! What a study asks for beside its branches in the frequency: branches in other parameters (`[[vary]]`) and
//! curves of bifurcations (`[[curve]]`).
//!
//! A *vary* finds all orbits of the study as it is at its frequency, and follows each that does not lie on a
//! branch already followed to both ends of the range. A *curve* starts at the event of a stored branch that
//! is nearest to its frequency, and is followed to both sides.
//!
//! Pieces do not depend on each other, and what is done of one follows from what is stored of it, so results
//! are the same for any number of threads. Branches are stored and taken up again as those over the frequency
//! are: stretch by stretch, with the checkpoints of their walks. A side of a curve is stored whole.
//!
//! | file | what it does |
//! |---|---|
//! | `solver.rs` | what is needed of the numerics |
//! | `vary.rs`, `curve.rs` | that, for branches and for curves |
//! | `piece.rs` | what is left to do of a piece |
//! | `pool.rs`, `watch.rs` | all pieces on many threads; what these report |

mod curve;
mod piece;
mod pool;
mod solver;
mod vary;
mod watch;

use hammerbeam_orbit::{LocatedEvent, PeriodicSolution};
use hammerbeam_results::store::{Piece, PieceKind, Store, StoreError};
use hammerbeam_study::{Model, Study, file::VariedParameter};

use crate::Observer;
use curve::CurveSolver;
use piece::PieceWork;
use solver::PieceSolver;
use vary::VarySolver;

/// What came of the pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariedOutcome {
    /// Everything is stored.
    Done,
    /// The observer said stop; the same run goes on where it was.
    Interrupted,
}

/// Where a curve starts, or why there is none.
type CurveStart = Result<(PeriodicSolution, LocatedEvent), String>;

/// Computes what is left of the varied branches and curves of a study, after its diagram, on so many threads.
///
/// # Errors
/// The store refuses.
pub fn run(
    store: &mut Store,
    model: &Model,
    study: &Study,
    threads: usize,
    observer: &mut dyn Observer,
) -> Result<VariedOutcome, StoreError> {
    let starts: Vec<CurveStart> =
        study.curves.iter().map(|curve| curve::start(store, curve)).collect::<Result<_, _>>()?;
    let wanted = pieces(study, &starts);
    store.keep_pieces(&wanted)?;
    let stored = store.all_pieces()?;
    let (varies, curves) = (study.varies.len(), study.curves.len());
    let mut solvers: Vec<Result<Box<dyn PieceSolver + '_>, String>> = Vec::with_capacity(varies + curves);
    for vary in &study.varies {
        solvers.push(VarySolver::new(model, study, vary).map(|solver| Box::new(solver) as _));
    }
    for (curve, start) in study.curves.iter().zip(starts) {
        let solver = start.and_then(|start| CurveSolver::new((model, study), curve, start));
        solvers.push(solver.map(|solver| Box::new(solver) as _));
    }
    let work = |record: hammerbeam_results::store::PieceRecord| {
        let solver = &solvers[record.place as usize - 1];
        PieceWork { record, solver: solver.as_deref().map_err(Clone::clone), is_running: false }
    };
    let count = stored.len();
    let mut left: Vec<PieceWork<'_>> =
        stored.into_iter().filter(|record| !record.finished).map(work).collect();
    let finished = count - left.len();
    let all = pool::compute_all(store, (&mut left, finished), threads, observer)?;
    Ok(if all { VariedOutcome::Done } else { VariedOutcome::Interrupted })
}

/// What the study asks for, in its order.
fn pieces(study: &Study, starts: &[CurveStart]) -> Vec<Piece> {
    let budget = study.continuation.budget_solutions;
    let varies =
        study.varies.iter().map(|vary| piece(PieceKind::Vary, "vary", &(vary, budget), &vary.parameter));
    let curves = study.curves.iter().zip(starts).map(|(curve, start)| {
        // It starts elsewhere when branches have gone on since.
        let from = start.as_ref().map(|start| start.0.frequency_hz).map_err(String::as_str);
        piece(PieceKind::Curve(curve.of), "curve", &(curve, budget, from), &curve.parameter)
    });
    varies.chain(curves).collect()
}

fn piece(
    kind: PieceKind,
    word: &str,
    definition: &impl serde::Serialize,
    parameter: &VariedParameter,
) -> Piece {
    let text = serde_json::to_string(definition).expect("a piece is plain data with text keys");
    Piece { definition: format!("{word} {text}"), kind, parameter: parameter.name.clone() }
}
