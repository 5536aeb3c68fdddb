//! The law of a round hole: that of a one-sided stop, along its radius.

use hammerbeam_motion::law::{DESCRIPTIONS, LawDescription, LawValue};

use super::{
    read_stop_law::{ReadLaw, read_values},
    stop_law::{StopLaw, StopRest},
};
use crate::document::{TomlTable, Value, quantity};

/// Reads the law of a hole: of the radius, with the clearance as its gap.
pub(super) fn read(table: &TomlTable<'_>, description: &'static LawDescription) -> Option<ReadLaw> {
    if !description.fits_round_hole() {
        let message = format!("`law` is \"{}\", but `at` names two points, a round hole", description.name);
        let allowed = DESCRIPTIONS.iter().filter(|law| law.fits_round_hole()).map(|law| law.name);
        let allowed = allowed.collect::<Vec<_>>().join("\", \"");
        table.refuse("law", message, vec![format!("allowed: \"{allowed}\", which lose no energy")]);
        ["side", "gap_m", "preload_n", "gap_measured"].iter().for_each(|key| drop(table.optional(key)));
        description.keys.iter().for_each(|key| drop(table.optional(key.name)));
        return None;
    }
    let side = table.required("side").and_then(|value| value.choice(&[("around", ())]));
    for key in ["preload_n", "gap_measured"] {
        if let Some(value) = table.optional(key) {
            let help = vec!["allowed: `gap_m`, the clearance all around the undeformed structure".to_owned()];
            value.problem(format!("`{key}` is given for a round hole"), help);
        }
    }
    let gap = table.required("gap_m").and_then(|value| read_clearance(&value));
    let values = read_values(table, description)?;
    let mut keys = description.keys.iter().zip(&values);
    let is_given = |value: &LawValue| *value != LawValue::Number(0.0);
    if let Some((key, _)) = keys.find(|(key, value)| key.is_damper() && is_given(value)) {
        let help = vec!["allowed: none; damp the structure instead".to_owned()];
        table.problem(key.name, format!("`{}` is given for a round hole", key.name), help);
        return None;
    }
    side?;
    Some(ReadLaw::One(StopLaw::new(description, values, StopRest::Around { gap_m: gap? })))
}

fn read_clearance(value: &Value<'_>) -> Option<f64> {
    let gap = value.number(&quantity::GAP)?;
    if gap > 0.0 {
        return Some(gap);
    }
    let help =
        vec!["allowed: more than 0; a point without clearance has springs in both directions".to_owned()];
    value.problem("`gap_m` of a round hole is 0 m".to_owned(), help);
    None
}
