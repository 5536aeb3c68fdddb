//! What a study asks for beside its branches in the frequency: branches in other parameters (`[[vary]]`) and
//! curves of bifurcations (`[[curve]]`).
//!
//! A *vary* finds all orbits of the study as it is at its frequency, and follows each that does not lie on a
//! branch already followed to both ends of the range. A *curve* begins at the event of a stored branch that
//! is nearest to its frequency, and is followed to both sides. Pieces do not depend on each other: each is
//! computed by one thread and stored whole under its place in the study, so results are the same for any
//! number of threads. What is stored is not done again; of an interrupted run all pieces are kept that were
//! finished.

mod branch;
mod curve;
mod pool;
mod watch;

use hammerbeam_orbit::{LocatedEvent, OrbitError, PeriodicSolution};
use hammerbeam_results::store::{Piece, Store, StoreError, VariedBranch};
use hammerbeam_study::{
    Model, Study,
    file::{Curve, Vary},
};

use crate::Observer;

/// What came of the pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariedOutcome {
    /// Everything is stored.
    Done,
    /// The observer said stop; the same run goes on with the pieces at which it was.
    Interrupted,
}

/// What came of one piece.
struct Found {
    branches: Vec<VariedBranch>,
    message: Option<String>,
}

/// Why a piece has no result.
enum Failed {
    Interrupted,
    /// In words; it is stored as what came of the piece.
    Message(String),
}

impl From<OrbitError> for Failed {
    fn from(error: OrbitError) -> Self {
        match error {
            OrbitError::Interrupted => Self::Interrupted,
            error => Self::Message(error.to_string()),
        }
    }
}

/// What a piece is computed from.
enum Work<'a> {
    Vary(&'a Vary),
    /// With the event at which it begins, or why there is none.
    Curve(&'a Curve, Result<Box<(PeriodicSolution, LocatedEvent)>, String>),
}

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
    let budget = study.continuation.budget_solutions;
    let mut asked: Vec<(Piece, Work<'_>)> = Vec::new();
    for vary in &study.varies {
        let definition = (vary, budget);
        asked.push((piece("vary", &definition, &vary.parameter.name), Work::Vary(vary)));
    }
    for curve in &study.curves {
        let start = curve::start(store, curve)?.map(Box::new);
        // It begins elsewhere when branches have gone on since.
        let from = start.as_ref().map(|start| start.0.frequency_hz).map_err(String::as_str);
        let definition = (curve, budget, from);
        asked.push((piece("curve", &definition, &curve.parameter.name), Work::Curve(curve, start)));
    }
    let wanted: Vec<Piece> = asked.iter().map(|(piece, _)| piece.clone()).collect();
    store.keep_pieces(&wanted)?;
    let (mut pieces, mut works) = (Vec::new(), Vec::new());
    for (place, (piece, work)) in asked.into_iter().enumerate() {
        if !store.has_piece(&piece)? && wanted.iter().position(|other| *other == piece) == Some(place) {
            works.push(work);
            pieces.push((place as u32 + 1, piece));
        }
    }
    let names: Vec<&str> = pieces.iter().map(|(_, piece)| piece.parameter.as_str()).collect();
    let compute = |number: usize, watch: &watch::Watch<'_>| match &works[number] {
        Work::Vary(vary) => branch::follow(model, study, vary, watch),
        Work::Curve(curve, Ok(start)) => curve::follow(model, study, (curve, start), watch),
        Work::Curve(_, Err(message)) => Err(Failed::Message(message.clone())),
    };
    let keep = |number: usize, found: Result<Found, Failed>| {
        let (place, piece) = &pieces[number];
        match found {
            Ok(found) => store.store_piece(*place, piece, &found.branches, found.message.as_deref()),
            Err(Failed::Message(message)) => store.store_piece(*place, piece, &[], Some(&message)),
            Err(Failed::Interrupted) => Ok(()),
        }
    };
    let all = pool::compute_all(&names, threads, observer, compute, keep)?;
    Ok(if all { VariedOutcome::Done } else { VariedOutcome::Interrupted })
}

fn piece(kind: &str, definition: &impl serde::Serialize, parameter: &str) -> Piece {
    let text = serde_json::to_string(definition).expect("a piece is plain data with text keys");
    Piece { definition: format!("{kind} {text}"), is_curve: kind == "curve", parameter: parameter.to_owned() }
}
