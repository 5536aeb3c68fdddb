//! Which column of a table is what.

use super::PointsError;
use crate::{
    finding::Finding,
    unit::{Quantity, Unit, split_title, unit},
};

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Role {
    Frequency(f64),
    Maximum(Unit),
    Excitation(Unit),
    Kind,
    Period,
    Other,
}

/// A column with its title.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Column {
    pub title: String,
    pub role: Role,
}

const KIND: &[&str] = &["kind", "motion", "class"];
const PERIOD: &[&str] = &["period", "multiple", "period multiple", "period_multiple"];
const EXCITATION: &[&str] = &["excitation", "table", "shaker", "support", "drive"];
/// Beginnings of words for quantities, with a unit for the message.
const QUANTITIES: &[(&str, &str)] =
    &[("freq", "Hz"), ("disp", "mm"), ("vel", "m/s"), ("acc", "m/s^2"), ("force", "N")];

/// Roles of the columns of a table.
pub(super) fn roles(titles: &[String], findings: &mut Vec<Finding>) -> Result<Vec<Column>, PointsError> {
    let columns = titles.iter().map(|title| column(title)).collect::<Result<Vec<_>, _>>()?;
    for column in columns.iter().filter(|column| column.role == Role::Other) {
        let reason = "it is neither a frequency, a maximum, an excitation, a kind nor a period".to_owned();
        findings.push(Finding::LeftOut { name: column.title.clone(), reason });
    }
    let all = || titles.iter().map(|title| format!("\"{title}\"")).collect::<Vec<_>>().join(", ");
    if !columns.iter().any(|column| matches!(column.role, Role::Frequency(_))) {
        return Err(PointsError::NoFrequency { titles: all() });
    }
    refuse_doubles(&columns)?;
    if !columns.iter().any(|column| matches!(column.role, Role::Maximum(_))) {
        return Err(PointsError::NoMaximum { titles: all() });
    }
    Ok(columns)
}

fn column(title: &str) -> Result<Column, PointsError> {
    let (name, text) = split_title(title);
    let lower = name.trim().to_lowercase();
    let shakes = EXCITATION.iter().any(|word| lower.starts_with(word));
    let role = match (text.as_deref(), text.as_deref().and_then(unit)) {
        _ if KIND.contains(&lower.as_str()) => Role::Kind,
        _ if PERIOD.contains(&lower.as_str()) && text.is_none() => Role::Period,
        (_, Some(Unit { quantity: Quantity::Frequency, factor })) => Role::Frequency(factor),
        (_, Some(known)) if is_measured(known.quantity) && shakes => Role::Excitation(known),
        (_, Some(known)) if is_measured(known.quantity) => Role::Maximum(known),
        (_, Some(_)) => Role::Other,
        (text, None) => match quantity_word(&lower, shakes) {
            Some(_) if text.is_some() => {
                let unit = text.unwrap_or_default().to_owned();
                return Err(PointsError::UnknownUnit { column: name, unit });
            }
            Some(example) => return Err(PointsError::NoUnit { column: name, example }),
            None => Role::Other,
        },
    };
    Ok(Column { title: title.to_owned(), role })
}

const fn is_measured(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::Displacement | Quantity::Velocity | Quantity::Acceleration | Quantity::Force)
}

/// A unit that a column of this name could have, if it sounds like a quantity.
fn quantity_word(name: &str, shakes: bool) -> Option<&'static str> {
    let words = || name.split(|c: char| !c.is_alphanumeric());
    let of = |&(start, example): &(&str, &'static str)| {
        words().any(|word| word.starts_with(start)).then_some(example)
    };
    QUANTITIES.iter().find_map(of).or_else(|| shakes.then_some("mm"))
}

fn refuse_doubles(columns: &[Column]) -> Result<(), PointsError> {
    let what = |role: Role| match role {
        Role::Frequency(_) => "the excitation frequency",
        Role::Maximum(Unit { quantity, .. }) => quantity.word(),
        Role::Excitation(_) => "the amplitude of the excitation",
        Role::Kind => "the kind of motion",
        Role::Period => "the period",
        Role::Other => "",
    };
    for (index, second) in columns.iter().enumerate() {
        let what_second = what(second.role);
        let same = |first: &&Column| !what_second.is_empty() && what(first.role) == what_second;
        if let Some(first) = columns[..index].iter().find(same) {
            let (first, second) = (first.title.clone(), second.title.clone());
            return Err(PointsError::TwoColumns { first, second, what: what_second });
        }
    }
    Ok(())
}
