//! What is known of the event at a solution.

use hammerbeam_orbit::{ContactChange, EventStatus, LocatedEvent};
use rusqlite::{Connection, Row, Transaction, params_from_iter, types::Value};

use super::{StoreError, blob};

/// Names of the columns of an event.
const NAMES: &str =
    "located, uncertainty, multiplier_re, multiplier_im, direction, contact_changes, breaks_symmetry";

/// Stores what is known of the event at a solution.
pub(super) fn insert_event(
    transaction: &Transaction<'_>,
    key: i64,
    event: &LocatedEvent,
) -> Result<(), StoreError> {
    let number = |value: Option<f64>| value.map_or(Value::Null, Value::Real);
    // The number from 1 of a contact that appears, negative of one that vanishes.
    let signed = |change: &ContactChange| {
        let number = (change.contact + 1) as f64;
        if change.appears { number } else { -number }
    };
    let contacts: Vec<f64> = event.contacts.iter().map(signed).collect();
    let values = [
        Value::from(key),
        Value::from(event.status == EventStatus::Located),
        Value::from(event.uncertainty),
        number(event.multiplier.map(|[re, _]| re)),
        number(event.multiplier.map(|[_, im]| im)),
        Value::from(blob::pack(&event.direction)),
        Value::from(blob::pack(&contacts)),
        Value::from(event.breaks_symmetry),
    ];
    let insert = "INSERT INTO event VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
    transaction.prepare_cached(insert)?.execute(params_from_iter(values))?;
    Ok(())
}

/// Of the columns from the first on.
fn read_event(row: &Row<'_>) -> Result<LocatedEvent, StoreError> {
    let multiplier: (Option<f64>, Option<f64>) = (row.get(2)?, row.get(3)?);
    let bytes: Vec<u8> = row.get(4)?;
    let contacts: Vec<u8> = row.get(5)?;
    let contacts = blob::unpack("contacts", &contacts, contacts.len() / 8)?;
    if contacts.iter().any(|number| !(1.0..1e9).contains(&number.abs())) {
        return Err(StoreError::Damaged { what: "contacts", found: 0, expected: contacts.len() });
    }
    let of_number =
        |number: &f64| ContactChange { contact: number.abs() as usize - 1, appears: *number > 0.0 };
    Ok(LocatedEvent {
        status: if row.get(0)? { EventStatus::Located } else { EventStatus::Bracketed },
        uncertainty: row.get(1)?,
        multiplier: multiplier.0.zip(multiplier.1).map(|(re, im)| [re, im]),
        direction: blob::unpack("direction", &bytes, bytes.len() / 8)?,
        contacts: contacts.iter().map(of_number).collect(),
        breaks_symmetry: row.get(6)?,
    })
}

/// What is known of the event at a solution, if there is one.
pub(super) fn event(connection: &Connection, key: i64) -> Result<Option<LocatedEvent>, StoreError> {
    let select = format!("SELECT {NAMES} FROM event WHERE solution = ?1");
    let mut statement = connection.prepare_cached(&select)?;
    let mut rows = statement.query([key])?;
    rows.next()?.map(read_event).transpose()
}
