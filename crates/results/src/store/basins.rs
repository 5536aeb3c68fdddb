//! Basins of attraction: the cells of a grid, and the attractors they lead to.
//!
//! A round of cells goes in as one transaction, with the attractors that it found. So after a kill whole
//! rounds are there, which is what the computation goes on from, to the same bits.

use hammerbeam_attractor::{Attractor, Round};
use rusqlite::{Connection, Row as SqlRow, Transaction, params, types::Value};

use super::{StoreError, blob, class::Kind, requests, values::whole};

/// Basins of a request: the attractor of each cell, from the first one on, and the attractors.
pub fn basins(connection: &Connection, request: i64) -> Result<(Vec<u32>, Vec<Attractor>), StoreError> {
    let mut statement =
        connection.prepare("SELECT attractor FROM cell WHERE request = ?1 ORDER BY number")?;
    let cells: Vec<u32> = statement.query_map([request], |row| row.get(0))?.collect::<Result<_, _>>()?;
    let select = "SELECT class, period, doubt, exponent_per_s, exponent_half_width_per_s, zero_one,
        state_length, states
        FROM attractor WHERE request = ?1 ORDER BY number";
    let mut statement = connection.prepare(select)?;
    let mut rows = statement.query([request])?;
    let mut attractors = Vec::new();
    while let Some(row) = rows.next()? {
        attractors.push(attractor(row)?);
    }
    let last = cells.iter().copied().max().unwrap_or(0);
    whole("attractor of a cell", last.into(), 0, attractors.len() as i64)?;
    Ok((cells, attractors))
}

/// Adds a round to the basins of a request.
pub fn append_round(
    transaction: Transaction<'_>,
    request: i64,
    round: &Round,
    known: usize,
) -> Result<(), StoreError> {
    let first = round.first as u64;
    requests::advance(&transaction, request, (first, first + round.cells.len() as u64))?;
    for (index, cell) in round.cells.iter().enumerate() {
        let values = params![request, (round.first + index) as i64, cell];
        transaction.execute("INSERT INTO cell (request, number, attractor) VALUES (?1, ?2, ?3)", values)?;
    }
    for (index, found) in round.found.iter().enumerate() {
        let kind =
            Kind { class: found.class, largest_exponent: found.largest_exponent, zero_one: found.zero_one };
        let mut values = vec![Value::Integer(request), Value::Integer((known + index + 1) as i64)];
        values.extend(kind.columns());
        values.push(Value::Integer(found.states.first().map_or(0, Vec::len) as i64));
        values.push(Value::Blob(blob::pack(found.states.iter().flatten())));
        let insert = "INSERT INTO attractor (request, number, class, period, doubt, exponent_per_s,
            exponent_half_width_per_s, zero_one, state_length, states)
            VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)";
        transaction.execute(insert, rusqlite::params_from_iter(values))?;
    }
    transaction.commit()?;
    Ok(())
}
fn attractor(row: &SqlRow<'_>) -> Result<Attractor, StoreError> {
    let Kind { class, largest_exponent, zero_one } = Kind::read(row, 0)?;
    let bytes: Vec<u8> = row.get(7)?;
    // Of one state at least.
    let length = whole("length of a state", row.get(6)?, 2, (bytes.len() / 8) as i64)? as usize;
    let states = blob::unpack("states of an attractor", &bytes, bytes.len() / (8 * length) * length)?;
    Ok(Attractor {
        class,
        states: states.chunks(length).map(<[f64]>::to_vec).collect(),
        largest_exponent,
        zero_one,
    })
}
