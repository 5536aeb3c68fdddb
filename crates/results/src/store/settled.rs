//! Settled motions of sweeps, and of diagrams from several states.

use hammerbeam_attractor::SweepPoint;
use rusqlite::types::Value;

use super::{Store, StoreError, blob, class::Kind, requests};

/// A settled motion, and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct SettledMotion {
    /// `up`, `down`, or the number of the state it began at.
    pub origin: String,
    /// What it does.
    pub point: SweepPoint,
}

impl Store {
    /// Motions of a request, in their order.
    ///
    /// # Errors
    /// The database refuses, or something in it is damaged.
    pub fn settled(&self, request: i64) -> Result<Vec<SettledMotion>, StoreError> {
        let select = "SELECT origin, frequency_hz, class, period, doubt, exponent_per_s,
            exponent_half_width_per_s, zero_one, max_abs_displacement_m, contacts_per_period, samples, state
            FROM settled WHERE request = ?1 ORDER BY number";
        let mut statement = self.connection.prepare(select)?;
        let mut rows = statement.query([request])?;
        let mut motions = Vec::new();
        while let Some(row) = rows.next()? {
            let kind = Kind::read(row, 2)?;
            let (samples, state): (Vec<u8>, Vec<u8>) = (row.get(10)?, row.get(11)?);
            let point = SweepPoint {
                frequency_hz: row.get(1)?,
                class: kind.class,
                largest_exponent: kind.largest_exponent,
                zero_one: kind.zero_one,
                samples: blob::unpack("samples of a motion", &samples, samples.len() / 8)?,
                max_abs_displacement: row.get(8)?,
                contacts_per_period: row.get(9)?,
                state: blob::unpack("state of a motion", &state, state.len() / 8)?,
            };
            motions.push(SettledMotion { origin: row.get(0)?, point });
        }
        Ok(motions)
    }

    /// Adds the motions of a piece of a request.
    ///
    /// * `piece`: its number, counted from 0; those before it are done.
    ///
    /// # Errors
    /// The database refuses, or the pieces before it are not done; nothing of it is there then.
    pub fn append_settled(
        &mut self,
        request: i64,
        piece: u64,
        motions: &[SettledMotion],
    ) -> Result<(), StoreError> {
        let transaction = self.write()?;
        requests::advance(&transaction, request, (piece, piece + 1))?;
        let count = "SELECT count(*) FROM settled WHERE request = ?1";
        let known: i64 = transaction.query_row(count, [request], |row| row.get(0))?;
        for (number, SettledMotion { origin, point }) in (known..).zip(motions) {
            let kind = Kind {
                class: point.class,
                largest_exponent: point.largest_exponent,
                zero_one: point.zero_one,
            };
            let mut values: Vec<Value> = vec![
                Value::Integer(request),
                Value::Integer(number),
                Value::Text(origin.clone()),
                Value::Real(point.frequency_hz),
            ];
            values.extend(kind.columns());
            values.extend([
                Value::Real(point.max_abs_displacement),
                Value::Real(point.contacts_per_period),
                Value::Blob(blob::pack(&point.samples)),
                Value::Blob(blob::pack(&point.state)),
            ]);
            let insert = "INSERT INTO settled (request, number, origin, frequency_hz, class, period, doubt,
                exponent_per_s, exponent_half_width_per_s, zero_one, max_abs_displacement_m,
                contacts_per_period, samples, state)
                VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)";
            transaction.execute(insert, rusqlite::params_from_iter(values))?;
        }
        transaction.commit()?;
        Ok(())
    }
}
