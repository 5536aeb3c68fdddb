//! Roles of the columns of a table.

use crate::{
    error::PointsError,
    finding::RecordFinding,
    title::split_title,
    unit::{MeasuredQuantity, Unit, unit},
};

/// Content of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum ColumnRole {
    Frequency(f64),
    Maximum(Unit),
    Excitation(Unit),
    Kind,
    Period,
    Other,
}

/// A column with its title.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TitledColumn {
    pub title: String,
    pub role: ColumnRole,
}

const KIND: &[&str] = &["kind", "motion", "class"];
const PERIOD: &[&str] = &["period", "multiple", "period multiple", "period_multiple"];
const EXCITATION: &[&str] = &["excitation", "table", "shaker", "support", "drive"];
/// First letters of words for quantities, with an example of a unit for the message.
const QUANTITIES: &[(&str, &str)] =
    &[("freq", "Hz"), ("disp", "mm"), ("vel", "m/s"), ("acc", "m/s^2"), ("force", "N")];

/// Titles that a message names.
const MOST_SHOWN: usize = 20;

/// Roles of the columns of a table.
pub(super) fn roles(
    titles: &[String],
    findings: &mut Vec<RecordFinding>,
) -> Result<Vec<TitledColumn>, PointsError> {
    let columns = titles.iter().map(|title| column(title)).collect::<Result<Vec<_>, _>>()?;
    for column in columns.iter().filter(|column| column.role == ColumnRole::Other) {
        let reason = "it is neither a frequency, a maximum, an excitation, a kind nor a period".to_owned();
        findings.push(RecordFinding::LeftOut { name: column.title.clone(), reason });
    }
    let all = || {
        let shown = titles.iter().take(MOST_SHOWN).map(|title| format!("\"{title}\""));
        let more = titles.len().saturating_sub(MOST_SHOWN);
        let more = (more > 0).then(|| format!("and {more} more"));
        shown.chain(more).collect::<Vec<_>>().join(", ")
    };
    if !columns.iter().any(|column| matches!(column.role, ColumnRole::Frequency(_))) {
        return Err(PointsError::NoFrequency { titles: all() });
    }
    refuse_repeated_roles(&columns)?;
    if !columns.iter().any(|column| matches!(column.role, ColumnRole::Maximum(_))) {
        return Err(PointsError::NoMaximum { titles: all() });
    }
    Ok(columns)
}

fn column(title: &str) -> Result<TitledColumn, PointsError> {
    let (name, text) = split_title(title);
    let lower = name.trim().to_lowercase();
    let is_excitation = EXCITATION.iter().any(|word| lower.starts_with(word));
    let role = match (text.as_deref(), text.as_deref().and_then(unit)) {
        _ if KIND.contains(&lower.as_str()) => ColumnRole::Kind,
        _ if PERIOD.contains(&lower.as_str()) && text.is_none() => ColumnRole::Period,
        (_, Some(Unit { quantity: MeasuredQuantity::Frequency, factor })) => ColumnRole::Frequency(factor),
        (_, Some(known)) if is_measured(known.quantity) && is_excitation => ColumnRole::Excitation(known),
        (_, Some(known)) if is_measured(known.quantity) => ColumnRole::Maximum(known),
        (_, Some(_)) => ColumnRole::Other,
        (text, None) => match example_unit(&lower, is_excitation) {
            Some(_) if text.is_some() => {
                let unit = text.unwrap_or_default().to_owned();
                return Err(PointsError::UnknownUnit { column: name, unit });
            }
            Some(example) => return Err(PointsError::NoUnit { column: name, example }),
            None => ColumnRole::Other,
        },
    };
    Ok(TitledColumn { title: title.to_owned(), role })
}

const fn is_measured(quantity: MeasuredQuantity) -> bool {
    matches!(
        quantity,
        MeasuredQuantity::Displacement
            | MeasuredQuantity::Velocity
            | MeasuredQuantity::Acceleration
            | MeasuredQuantity::Force
    )
}

/// A unit that a column of this name could have, if the name suggests a quantity.
fn example_unit(name: &str, is_excitation: bool) -> Option<&'static str> {
    let words = || name.split(|c: char| !c.is_alphanumeric());
    let of = |&(start, example): &(&str, &'static str)| {
        words().any(|word| word.starts_with(start)).then_some(example)
    };
    QUANTITIES.iter().find_map(of).or_else(|| is_excitation.then_some("mm"))
}

fn refuse_repeated_roles(columns: &[TitledColumn]) -> Result<(), PointsError> {
    let what = |role: ColumnRole| match role {
        ColumnRole::Frequency(_) => "the excitation frequency",
        ColumnRole::Maximum(Unit { quantity, .. }) => quantity.word(),
        ColumnRole::Excitation(_) => "the amplitude of the excitation",
        ColumnRole::Kind => "the kind of motion",
        ColumnRole::Period => "the period",
        ColumnRole::Other => "",
    };
    for (index, second) in columns.iter().enumerate() {
        let what_second = what(second.role);
        let same = |first: &&TitledColumn| !what_second.is_empty() && what(first.role) == what_second;
        if let Some(first) = columns[..index].iter().find(same) {
            let (first, second) = (first.title.clone(), second.title.clone());
            return Err(PointsError::TwoColumns { first, second, what: what_second });
        }
    }
    Ok(())
}
