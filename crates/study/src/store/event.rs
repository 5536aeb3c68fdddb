//! What is known of events: of solutions in the frequency and of rows of pieces.

use hammerbeam_orbit::{ContactChange, EventStatus, LocatedEvent};
use rusqlite::{Row, Transaction, params_from_iter, types::Value};

use super::{Store, StoreError, blob};

/// Columns of an event, as tables have them.
pub(super) const COLUMNS: &str = "
    located INTEGER NOT NULL,
    uncertainty REAL NOT NULL,
    multiplier_re REAL,
    multiplier_im REAL,
    direction BLOB NOT NULL,
    contact INTEGER,
    appears INTEGER,
    breaks_symmetry INTEGER NOT NULL";

/// Their names.
const NAMES: &str =
    "located, uncertainty, multiplier_re, multiplier_im, direction, contact, appears, breaks_symmetry";

/// An event of a row of a branch in a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedEvent {
    /// Number of the row within its branch, from 0.
    pub row: u32,
    /// Value of the parameter, in the unit of its name.
    pub parameter: f64,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Events joined by `+`.
    pub event: String,
    /// What is known of it; uncertainty and direction in the unit of the parameter's name.
    pub located: LocatedEvent,
    /// All multipliers.
    pub multipliers: Vec<[f64; 2]>,
}

/// Stores an event under a key: one number of a solution, or piece, branch and place of a row.
pub(super) fn insert_event(
    transaction: &Transaction<'_>,
    (table, key): (&str, &[i64]),
    event: &LocatedEvent,
) -> Result<(), StoreError> {
    let number = |value: Option<f64>| value.map_or(Value::Null, Value::Real);
    let whole = |value: Option<i64>| value.map_or(Value::Null, Value::Integer);
    let of_event = [
        Value::from(event.status == EventStatus::Located),
        Value::from(event.uncertainty),
        number(event.multiplier.map(|[re, _]| re)),
        number(event.multiplier.map(|[_, im]| im)),
        Value::from(blob::pack(&event.direction)),
        whole(event.contact.map(|change| change.contact as i64)),
        whole(event.contact.map(|change| i64::from(change.appears))),
        Value::from(event.breaks_symmetry),
    ];
    let values: Vec<Value> = key.iter().map(|key| Value::from(*key)).chain(of_event).collect();
    let insert = format!("INSERT INTO {table} VALUES ({})", vec!["?"; values.len()].join(", "));
    transaction.prepare_cached(&insert)?.execute(params_from_iter(values))?;
    Ok(())
}

/// Of the columns from the first on.
fn read_event(row: &Row<'_>) -> Result<LocatedEvent, StoreError> {
    let multiplier: (Option<f64>, Option<f64>) = (row.get(2)?, row.get(3)?);
    let bytes: Vec<u8> = row.get(4)?;
    let change: (Option<u32>, Option<bool>) = (row.get(5)?, row.get(6)?);
    let contact = change.0.zip(change.1);
    Ok(LocatedEvent {
        status: if row.get(0)? { EventStatus::Located } else { EventStatus::Bracketed },
        uncertainty: row.get(1)?,
        multiplier: multiplier.0.zip(multiplier.1).map(|(re, im)| [re, im]),
        direction: blob::unpack("direction", &bytes, bytes.len() / 8)?,
        contact: contact.map(|(contact, appears)| ContactChange { contact: contact as usize, appears }),
        breaks_symmetry: row.get(7)?,
    })
}

/// Multipliers end to end, as pairs.
fn pairs(bytes: &[u8]) -> Result<Vec<[f64; 2]>, StoreError> {
    let numbers = blob::unpack("multipliers", bytes, bytes.len() / 8)?;
    Ok(numbers.as_chunks::<2>().0.to_vec())
}

impl Store {
    /// What is known of the event at a solution, if there is one.
    ///
    /// # Errors
    /// The database refuses, or the event is damaged.
    pub fn event(&self, key: i64) -> Result<Option<LocatedEvent>, StoreError> {
        let select = format!("SELECT {NAMES} FROM event WHERE solution = ?1");
        let mut statement = self.connection.prepare_cached(&select)?;
        let mut rows = statement.query([key])?;
        rows.next()?.map(read_event).transpose()
    }

    /// All Floquet multipliers of a stored solution.
    ///
    /// # Errors
    /// The database refuses, or they are damaged.
    pub fn multipliers(&self, key: i64) -> Result<Vec<[f64; 2]>, StoreError> {
        let select = "SELECT multipliers FROM solution WHERE id = ?1";
        let bytes: Vec<u8> = self.connection.prepare_cached(select)?.query_row([key], |row| row.get(0))?;
        pairs(&bytes)
    }

    /// Events of a branch of a piece, along it.
    ///
    /// # Errors
    /// The database refuses, or an event is damaged.
    pub fn varied_events(&self, (piece, branch): (u32, u32)) -> Result<Vec<VariedEvent>, StoreError> {
        let select = format!(
            "SELECT {NAMES}, e.place, parameter, frequency_hz, event, multipliers FROM piece_event e
            JOIN piece_row USING (piece, branch, place) WHERE piece = ?1 AND branch = ?2 ORDER BY e.place"
        );
        let mut statement = self.connection.prepare_cached(&select)?;
        let mut rows = statement.query([piece, branch])?;
        let mut events = Vec::new();
        while let Some(row) = rows.next()? {
            events.push(VariedEvent {
                row: row.get(8)?,
                parameter: row.get(9)?,
                frequency_hz: row.get(10)?,
                event: row.get(11)?,
                located: read_event(row)?,
                multipliers: pairs(&row.get::<_, Vec<u8>>(12)?)?,
            });
        }
        Ok(events)
    }
}
