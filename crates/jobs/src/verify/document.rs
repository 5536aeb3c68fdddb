//! A verification as a document.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{Disagreement, Verification, VerifySettings, Worst};

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
    json!({
        "quantity": worst.quantity.name(),
        "worst_difference": number(worst.difference),
        "bound": worst.bound,
        "branch": worst.place.map(|(branch, _)| branch),
        "frequency_hz": worst.place.map(|(_, frequency_hz)| frequency_hz),
        "compared": worst.compared,
        "disagree": worst.disagree,
        "grazing": worst.grazing,
    })
}

fn of_disagreement(found: &Disagreement) -> Value {
    json!({
        "branch": found.branch,
        "frequency_hz": found.frequency_hz,
        "quantity": found.quantity.name(),
        "stored": number(found.stored),
        "recomputed": number(found.recomputed),
        "difference": number(found.difference),
        "bound": found.bound,
        "message": found.message,
    })
}

/// JSON has no infinity: null.
fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { Value::Null }
}
