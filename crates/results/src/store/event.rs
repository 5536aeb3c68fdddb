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
    contact_changes BLOB NOT NULL,
    breaks_symmetry INTEGER NOT NULL";

/// Their names.
const NAMES: &str =
    "located, uncertainty, multiplier_re, multiplier_im, direction, contact_changes, breaks_symmetry";

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
    // The number from 1 of a contact that appears, negative of one that vanishes.
    let signed = |change: &ContactChange| {
        let number = (change.contact + 1) as f64;
        if change.appears { number } else { -number }
    };
    let contacts: Vec<f64> = event.contacts.iter().map(signed).collect();
    let of_event = [
        Value::from(event.status == EventStatus::Located),
        Value::from(event.uncertainty),
        number(event.multiplier.map(|[re, _]| re)),
        number(event.multiplier.map(|[_, im]| im)),
        Value::from(blob::pack(&event.direction)),
        Value::from(blob::pack(&contacts)),
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

/// Multipliers end to end, as pairs.
pub(super) fn pairs(bytes: &[u8]) -> Result<Vec<[f64; 2]>, StoreError> {
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
        self.check_solution(key).map_err(|error| self.damaged(key, error))?;
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
                row: row.get(7)?,
                parameter: row.get(8)?,
                frequency_hz: row.get(9)?,
                event: row.get(10)?,
                located: read_event(row)?,
                multipliers: pairs(&row.get::<_, Vec<u8>>(11)?)?,
            });
        }
        Ok(events)
    }
}
