//! Rows and ends of branches as values of the database.

use hammerbeam_orbit::EventSet;
use rusqlite::{Row as SqlRow, types::Value};

use super::{StoreError, blob, stability};
use crate::{
    columns::{ColumnKind, RowValue, TableColumn},
    end::{BranchEnd, StoredEnd},
    row::Row,
};

/// Names of the stored columns of a row, separated by commas.
pub(super) fn row_columns() -> String {
    TableColumn::STORED.map(TableColumn::name).join(", ")
}

/// What a row has in them.
pub(super) fn values_of_row(row: &Row) -> Vec<Value> {
    let value = |column| match row.value(column)? {
        RowValue::Number(number) => Some(Value::Real(number)),
        RowValue::Count(count) => Some(Value::Integer(count.into())),
        RowValue::Stability(known) => Some(Value::Integer(stability::number(known))),
        RowValue::Events(events) => Some(Value::Integer(events.bits().into())),
    };
    TableColumn::STORED.into_iter().filter_map(value).collect()
}

/// The row in the columns of a selection from one on.
pub(super) fn read_row(found: &SqlRow<'_>, first: usize) -> Result<Row, StoreError> {
    let mut row = Row::default();
    for (place, column) in (first..).zip(TableColumn::STORED) {
        let value = match column.kind() {
            ColumnKind::Whole => RowValue::Count(found.get(place)?),
            ColumnKind::Stability => RowValue::Stability(found.get::<_, stability::Stored>(place)?.0),
            ColumnKind::Events => {
                let bits: u32 = found.get(place)?;
                let unknown = || StoreError::Unknown { what: "event", found: bits.to_string() };
                RowValue::Events(EventSet::of_bits(bits).ok_or_else(unknown)?)
            }
            _ => RowValue::Number(found.get(place)?),
        };
        debug_assert!(row.value(column).is_some(), "{column:?} is one of a row");
        row.set(column, value);
    }
    Ok(row)
}

/// A whole number between two others, both included.
pub(super) fn whole(what: &'static str, found: i64, low: i64, high: i64) -> Result<i64, StoreError> {
    if (low..=high).contains(&found) {
        return Ok(found);
    }
    Err(StoreError::Impossible { what, found: found as f64 })
}

/// A finite number.
pub(super) fn finite(what: &'static str, found: f64) -> Result<f64, StoreError> {
    if found.is_finite() { Ok(found) } else { Err(StoreError::Impossible { what, found }) }
}

/// Excitation periods of an orbit: at most the largest multiple, doubled as often as is allowed.
pub(super) fn period_multiple(found: i64) -> Result<u32, StoreError> {
    whole("multiple of the period", found, 1, 64 << 10).map(|multiple| multiple as u32)
}

/// Columns of an end.
pub(super) const END_COLUMNS: &str = "end_kind, end_place, end_numbers, end_text";

/// What a walk has in them.
pub(super) fn values_of_end(end: Option<&BranchEnd>) -> [Value; 4] {
    let Some(StoredEnd { kind, place, numbers, text }) = end.map(BranchEnd::stored) else {
        return [Value::Null, Value::Null, Value::Null, Value::Null];
    };
    [
        Value::Text(kind.to_owned()),
        place.map_or(Value::Null, Value::Real),
        Value::Blob(blob::pack(&numbers)),
        text.map_or(Value::Null, |text| Value::Text(text.to_owned())),
    ]
}

/// The end in four columns from one on.
pub(super) fn read_end(found: &SqlRow<'_>, first: usize) -> Result<Option<BranchEnd>, StoreError> {
    let Some(kind) = found.get::<_, Option<String>>(first)? else { return Ok(None) };
    let numbers: Vec<u8> = found.get(first + 2)?;
    let text: Option<String> = found.get(first + 3)?;
    let stored = StoredEnd {
        kind: &kind,
        place: found.get(first + 1)?,
        numbers: blob::unpack("numbers of an end", &numbers, numbers.len() / 8)?,
        text: text.as_deref(),
    };
    let unknown = || StoreError::Unknown { what: "end of a branch", found: kind.clone() };
    BranchEnd::of_stored(&stored).ok_or_else(unknown).map(Some)
}
