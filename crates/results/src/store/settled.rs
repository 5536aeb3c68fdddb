//! Settled motions of sweeps, and of diagrams from several states.

use std::fmt;

use hammerbeam_attractor::SweepPoint;
use rusqlite::{Connection, Row as SqlRow, Transaction, types::Value};

use super::{StoreError, blob, class::Kind, requests};

/// Where a settled motion comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SettledOrigin {
    /// A sweep over rising frequencies.
    Up,
    /// A sweep over falling frequencies.
    Down,
    /// A state of its own, of several at the same frequency: its number, from 1.
    Start(u32),
}

impl fmt::Display for SettledOrigin {
    /// `up`, `down`, or the number.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Up => f.pad("up"),
            Self::Down => f.pad("down"),
            Self::Start(number) => fmt::Display::fmt(number, f),
        }
    }
}

impl SettledOrigin {
    /// Its word in the table, and the number of the state.
    fn columns(self) -> [Value; 2] {
        let (word, number) = match self {
            Self::Up => ("up", Value::Null),
            Self::Down => ("down", Value::Null),
            Self::Start(number) => ("start", Value::Integer(number.into())),
        };
        [Value::Text(word.to_owned()), number]
    }

    /// Of the column with the word and the one behind it.
    fn read(row: &SqlRow<'_>, column: usize) -> Result<Self, StoreError> {
        let (word, number): (String, Option<u32>) = (row.get(column)?, row.get(column + 1)?);
        match (word.as_str(), number) {
            ("up", None) => Ok(Self::Up),
            ("down", None) => Ok(Self::Down),
            ("start", Some(number)) => Ok(Self::Start(number)),
            _ => Err(StoreError::Unknown { what: "origin of a motion", found: word }),
        }
    }
}

/// A settled motion, and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct SettledMotion {
    /// Where it comes from.
    pub origin: SettledOrigin,
    /// What it does.
    pub point: SweepPoint,
}

/// Motions of a request, in their order.
pub fn settled(connection: &Connection, request: i64) -> Result<Vec<SettledMotion>, StoreError> {
    let select = "SELECT origin, start, frequency_hz, class, period, doubt, exponent_per_s,
        exponent_half_width_per_s, zero_one, max_abs_displacement_m, contacts_per_period, samples, state
        FROM settled WHERE request = ?1 ORDER BY number";
    let mut statement = connection.prepare(select)?;
    let mut rows = statement.query([request])?;
    let mut motions = Vec::new();
    while let Some(row) = rows.next()? {
        let kind = Kind::read(row, 3)?;
        let (samples, state): (Vec<u8>, Vec<u8>) = (row.get(11)?, row.get(12)?);
        let point = SweepPoint {
            frequency_hz: row.get(2)?,
            class: kind.class,
            largest_exponent: kind.largest_exponent,
            zero_one: kind.zero_one,
            samples: blob::unpack("samples of a motion", &samples, samples.len() / 8)?,
            max_abs_displacement: row.get(9)?,
            contacts_per_period: row.get(10)?,
            state: blob::unpack("state of a motion", &state, state.len() / 8)?,
        };
        motions.push(SettledMotion { origin: SettledOrigin::read(row, 0)?, point });
    }
    Ok(motions)
}

/// Adds the motions of a piece of a request.
pub fn append_settled(
    transaction: Transaction<'_>,
    request: i64,
    piece: u64,
    motions: &[SettledMotion],
) -> Result<(), StoreError> {
    requests::advance(&transaction, request, (piece, piece + 1))?;
    let count = "SELECT count(*) FROM settled WHERE request = ?1";
    let known: i64 = transaction.query_row(count, [request], |row| row.get(0))?;
    for (number, SettledMotion { origin, point }) in (known..).zip(motions) {
        let kind =
            Kind { class: point.class, largest_exponent: point.largest_exponent, zero_one: point.zero_one };
        let mut values = vec![Value::Integer(request), Value::Integer(number)];
        values.extend(origin.columns());
        values.push(Value::Real(point.frequency_hz));
        values.extend(kind.columns());
        values.extend([
            Value::Real(point.max_abs_displacement),
            Value::Real(point.contacts_per_period),
            Value::Blob(blob::pack(&point.samples)),
            Value::Blob(blob::pack(&point.state)),
        ]);
        let insert =
            "INSERT INTO settled (request, number, origin, start, frequency_hz, class, period, doubt,
            exponent_per_s, exponent_half_width_per_s, zero_one, max_abs_displacement_m,
            contacts_per_period, samples, state)
            VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15)";
        transaction.execute(insert, rusqlite::params_from_iter(values))?;
    }
    transaction.commit()?;
    Ok(())
}
