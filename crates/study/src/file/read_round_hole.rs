//! The law of a round hole: that of a one-sided stop, along its radius.

use hammerbeam_motion::law::{LawDescription, LawSides, LawValue};

use super::{
    read_stop_law::{ReadLaw, read_values},
    stop_law::{StopLaw, StopRest},
};
use crate::document::{TomlTable, Value, quantity};

/// The laws that a hole may have, by their words.
const LAWS: [&str; 2] = ["hertz", "linear"];

/// Reads the law of a hole: of the radius, with the clearance as its gap.
pub(super) fn read(table: &TomlTable<'_>, description: &'static LawDescription) -> Option<ReadLaw> {
    let is_one_sided = matches!(description.sides, LawSides::One { .. });
    if !is_one_sided || !LAWS.contains(&description.name) {
        let message = format!("`law` is \"{}\", but `at` names two points, a round hole", description.name);
        table.refuse(
            "law",
            message,
            vec![format!("allowed: \"{}\", which lose no energy", LAWS.join("\", \""))],
        );
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
    if description.keys.iter().zip(&values).any(|(key, value)| is_loss(key.name, value)) {
        let help = vec!["allowed: none; damp the structure instead".to_owned()];
        table.problem("damping_n_s_m", "`damping_n_s_m` is given for a round hole".to_owned(), help);
        return None;
    }
    side?;
    Some(ReadLaw::One(StopLaw::new(description, values, StopRest::Around { gap_m: gap? })))
}

fn is_loss(key: &str, value: &LawValue) -> bool {
    key == "damping_n_s_m" && *value != LawValue::Number(0.0)
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
