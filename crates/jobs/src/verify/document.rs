//! A verification as a document.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{
    report::{Disagreement, Verification, VerifiedPlace, Worst},
    settings::VerifySettings,
};

/// What came of a verification, and how close it was.
#[derive(Debug)]
pub struct VerifyReport {
    /// What came of it.
    pub verification: Verification,
    /// What was verified, and how closely.
    pub settings: VerifySettings,
}

impl Serialize for VerifyReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { verification, settings } = self;
        let document = json!({
        "stored": verification.stored,
        "sampled": verification.sampled,
        "seed": settings.seed,
        "tolerance": settings.tolerance,
        "agree": verification.disagreements.is_empty(),
        "solutions_disagreeing": verification.disagreeing(),
        "solutions_grazing": verification.grazing,
        "quantities": verification.worst.iter().map(of_quantity).collect::<Vec<_>>(),
        "disagreements": verification.disagreements.iter().map(of_disagreement).collect::<Vec<_>>(),
        });
        document.serialize(serializer)
    }
}

fn of_quantity(worst: &Worst) -> Value {
    let mut document = json!({
        "quantity": worst.quantity.name(),
        "worst_difference": number(worst.difference),
        "bound": worst.bound,
        "branch": worst.place.map(|place| place.branch),
        "frequency_hz": worst.place.map(|place| place.frequency_hz),
        "compared": worst.compared,
        "disagree": worst.disagree,
        "grazing": worst.grazing,
    });
    add_piece(&mut document, worst.place);
    document
}

fn of_disagreement(found: &Disagreement) -> Value {
    let mut document = json!({
        "branch": found.place.branch,
        "frequency_hz": found.place.frequency_hz,
        "quantity": found.quantity.name(),
        "stored": number(found.stored),
        "recomputed": number(found.recomputed),
        "difference": number(found.difference),
        "bound": found.bound,
        "message": found.message,
    });
    add_piece(&mut document, Some(found.place));
    document
}

/// Adds the piece of a solution that is of one, with the value of its parameter.
fn add_piece(document: &mut Value, place: Option<VerifiedPlace>) {
    if let Some((piece, parameter)) = place.and_then(|place| place.piece) {
        document["piece"] = json!(piece);
        document["parameter"] = json!(parameter);
    }
}

/// JSON has no infinity: null.
fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { Value::Null }
}
