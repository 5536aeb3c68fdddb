//! What a study asks for beside its branches in the frequency: branches in other parameters (`[[vary]]`) and curves of bifurcations (`[[curve]]`).
//!
//! A *vary* finds all orbits of the study as it is at its frequency, and follows each that does not lie on a branch already followed to both ends of the
//! range. A *curve* begins at the event of a stored branch that is nearest to its frequency, and is followed to both sides. Pieces are done one
//! after the other and stored whole; what is stored is not done again.

mod branch;
mod curve;

use hammerbeam_orbit::OrbitError;

use crate::{
    Model, Study,
    run::Observer,
    store::{Piece, Store, StoreError, VariedBranch},
};

/// What came of the pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariedOutcome {
    /// Everything is stored.
    Done,
    /// The observer said stop; the same run goes on with the piece at which it was.
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
    Store(StoreError),
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

impl From<StoreError> for Failed {
    fn from(error: StoreError) -> Self {
        Self::Store(error)
    }
}

/// Computes what is left of the varied branches and curves of a study, after its diagram.
///
/// # Errors
/// The store refuses.
pub fn run(
    store: &mut Store,
    model: &Model,
    study: &Study,
    observer: &mut dyn Observer,
) -> Result<VariedOutcome, StoreError> {
    let varies =
        study.varies.iter().map(|vary| (piece("vary", vary, &vary.parameter.name), None, Some(vary)));
    let curves =
        study.curves.iter().map(|curve| (piece("curve", curve, &curve.parameter.name), Some(curve), None));
    let pieces: Vec<_> = varies.chain(curves).collect();
    let wanted: Vec<Piece> = pieces.iter().map(|(piece, ..)| piece.clone()).collect();
    store.keep_pieces(&wanted)?;
    for (piece, curve, vary) in pieces {
        if store.has_piece(&piece)? {
            continue;
        }
        let found = match (curve, vary) {
            (Some(curve), _) => curve::follow(store, model, study, curve, observer),
            (None, Some(vary)) => branch::follow(model, study, vary, observer),
            (None, None) => continue,
        };
        match found {
            Ok(found) => store.store_piece(&piece, &found.branches, found.message.as_deref())?,
            Err(Failed::Message(message)) => store.store_piece(&piece, &[], Some(&message))?,
            Err(Failed::Interrupted) => return Ok(VariedOutcome::Interrupted),
            Err(Failed::Store(error)) => return Err(error),
        }
    }
    Ok(VariedOutcome::Done)
}

fn piece(kind: &str, definition: &impl serde::Serialize, parameter: &str) -> Piece {
    let text = serde_json::to_string(definition).expect("a piece is plain data with text keys");
    Piece { definition: format!("{kind} {text}"), is_curve: kind == "curve", parameter: parameter.to_owned() }
}
