//! Events as CSV: along branches in the frequency, and along branches in parameters.

use std::{
    io::{self, Write},
    path::Path,
};

use hammerbeam_orbit::{ContactChange, EventStatus, Events, LocatedEvent, Side};

use super::{ExportError, varied::branches};
use crate::{
    store::{PieceRecord, Store, solution_key},
    whole_file::WriteError,
};

/// Columns of `events.csv`.
pub const EVENT_COLUMNS: [&str; 13] = [
    "branch",
    "period_multiple",
    "row",
    "event",
    "frequency_hz",
    "status",
    "uncertainty_hz",
    "multiplier_re",
    "multiplier_im",
    "contact_change",
    "direction",
    "symmetry_breaking",
    "multipliers",
];

/// Columns of `parameter_events.csv`.
pub const PARAMETER_EVENT_COLUMNS: [&str; 16] = [
    "piece",
    "branch",
    "period_multiple",
    "parameter_name",
    "row",
    "event",
    "parameter",
    "frequency_hz",
    "status",
    "uncertainty",
    "multiplier_re",
    "multiplier_im",
    "contact_change",
    "direction",
    "symmetry_breaking",
    "multipliers",
];

/// One row per event of the branches in the frequency.
pub(super) fn write_events(store: &Store, writer: &mut impl Write, path: &Path) -> Result<(), ExportError> {
    let failed = |source| ExportError::from(WriteError { path: path.to_owned(), source });
    writeln!(writer, "{}", EVENT_COLUMNS.join(",")).map_err(failed)?;
    for branch in store.branches()? {
        let (down, mut number) = (branch.down.solutions, 0);
        store.each_row::<ExportError>(&branch, |row| {
            let place = number;
            number += 1;
            let (side, of_side) =
                if place < down { (Side::Down, down - 1 - place) } else { (Side::Up, place - down) };
            let key = solution_key(branch.start, side, of_side as u32);
            let Some(event) = store.event(key)? else { return Ok(()) };
            // It was walked the other way than rows are counted.
            let event = if side == Side::Down { event.backwards() } else { event };
            let multipliers = store.multipliers(key)?;
            let name = Events { start: false, end: false, ..row.events }.label();
            let (id, multiple, frequency_hz) = (branch.id, branch.period_multiple, row.frequency_hz);
            write!(writer, "{id},{multiple},{place},{name},{frequency_hz:?},").map_err(failed)?;
            write_event(writer, &event, &multipliers).map_err(failed)
        })?;
    }
    Ok(())
}

/// One row per event of the branches in parameters.
pub(super) fn write_parameter_events(
    store: &Store,
    pieces: &[&PieceRecord],
    writer: &mut impl Write,
    path: &Path,
) -> Result<(), ExportError> {
    let failed = |source| ExportError::from(WriteError { path: path.to_owned(), source });
    writeln!(writer, "{}", PARAMETER_EVENT_COLUMNS.join(",")).map_err(failed)?;
    for (piece, branch, start) in branches(pieces) {
        for found in store.varied_events((piece.id, branch.branch))? {
            let (row, value, frequency_hz) = (found.row, found.parameter, found.frequency_hz);
            write!(writer, "{start},{row},{},{value:?},{frequency_hz:?},", found.event).map_err(failed)?;
            write_event(writer, &found.located, &found.multipliers).map_err(failed)?;
        }
    }
    Ok(())
}

/// The rest of a row: what is known of an event.
fn write_event(writer: &mut impl Write, event: &LocatedEvent, multipliers: &[[f64; 2]]) -> io::Result<()> {
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
    let status = match event.status {
        EventStatus::Located => "located",
        EventStatus::Bracketed => "bracketed",
    };
    let change =
        |change: &ContactChange| format!("{}{}", if change.appears { "+" } else { "-" }, change.contact + 1);
    let changes: Vec<String> = event.contacts.iter().map(change).collect();
    let direction: Vec<String> = event.direction.iter().map(|entry| format!("{entry:?}")).collect();
    writeln!(
        writer,
        "{status},{:?},{},{},{},{},{},{}",
        event.uncertainty,
        number(event.multiplier.map(|[re, _]| re)),
        number(event.multiplier.map(|[_, im]| im)),
        changes.join(" "),
        direction.join(" "),
        event.breaks_symmetry,
        complex_numbers(multipliers),
    )
}

/// `re+imi`, with blanks between them.
pub(crate) fn complex_numbers(numbers: &[[f64; 2]]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|[re, im]| format!("{re:?}{im:+?}i")).collect();
    numbers.join(" ")
}
