//! Outputs: numbers that are read off stored orbits in a pass of their own.
//!
//! A solution has one row, with the numbers of all outputs in their order. They belong to the definitions
//! that are noted with them: when a study defines other outputs, all rows go, and the next pass computes them
//! anew. A solution whose motion cannot be gone over again has a row without numbers.

use std::collections::HashSet;

use hammerbeam_orbit::SignalStatistics;
use hammerbeam_study::file::OutputEntry;
use rusqlite::{OptionalExtension, Transaction, params};

use super::{Store, StoreError, blob, schema};

/// Under which word the definitions are noted.
const DEFINITIONS: &str = "outputs";
/// Numbers of an output without its harmonics.
const PLAIN: usize = 4;

/// The stored numbers of outputs.
#[derive(Debug)]
pub struct StoredOutputs<'a> {
    store: &'a Store,
    outputs: Vec<OutputEntry>,
}

impl<'a> StoredOutputs<'a> {
    /// Those of a folder.
    ///
    /// # Errors
    /// The database refuses, or what is noted is damaged.
    pub fn of(store: &'a Store) -> Result<Self, StoreError> {
        let text = store.about(DEFINITIONS)?;
        let damaged = |error: serde_json::Error| StoreError::DamagedFile { what: error.to_string() };
        let outputs =
            if text.is_empty() { Vec::new() } else { serde_json::from_str(&text).map_err(damaged)? };
        Ok(Self { store, outputs })
    }

    /// The outputs to which the numbers belong.
    #[must_use]
    pub fn outputs(&self) -> &[OutputEntry] {
        &self.outputs
    }

    /// Keys of the solutions that have their numbers.
    ///
    /// # Errors
    /// The database refuses.
    pub fn keys(&self) -> Result<HashSet<i64>, StoreError> {
        let mut statement = self.store.connection.prepare("SELECT solution FROM output_value")?;
        let keys = statement.query_map([], |row| row.get(0))?;
        Ok(keys.collect::<Result<_, _>>()?)
    }

    /// The numbers of a solution, one entry for each output; `None` where there are none.
    ///
    /// * `period_multiple`: excitation periods of its orbit.
    ///
    /// # Errors
    /// The database refuses, or they are damaged.
    pub fn values(
        &self,
        key: i64,
        period_multiple: u32,
    ) -> Result<Option<Vec<SignalStatistics>>, StoreError> {
        let select = "SELECT numbers FROM output_value WHERE solution = ?1";
        let mut statement = self.store.connection.prepare_cached(select)?;
        let bytes: Option<Vec<u8>> = statement.query_row([key], |row| row.get(0)).optional()?;
        let Some(bytes) = bytes.filter(|bytes| !bytes.is_empty()) else { return Ok(None) };
        let count = |output: &OutputEntry| PLAIN + 2 * (output.harmonics * period_multiple) as usize;
        let expected = self.outputs.iter().map(count).sum();
        let numbers = blob::unpack("numbers of outputs", &bytes, expected)?;
        let mut rest = numbers.as_slice();
        let read = self.outputs.iter().map(|output| {
            let (own, behind) = rest.split_at(count(output));
            rest = behind;
            SignalStatistics {
                maximum: own[0],
                minimum: own[1],
                mean: own[2],
                root_mean_square: own[3],
                harmonics: own[PLAIN..].as_chunks::<2>().0.to_vec(),
            }
        });
        Ok(Some(read.collect()))
    }
}

/// Notes the outputs of a study; if they were others, throws their numbers away.
///
/// # Errors
/// The database refuses; nothing is changed then.
pub fn keep_outputs(store: &mut Store, outputs: &[OutputEntry]) -> Result<(), StoreError> {
    let wanted = match outputs {
        [] => String::new(),
        _ => serde_json::to_string(outputs).expect("outputs are plain data with text keys"),
    };
    if store.about(DEFINITIONS)? == wanted {
        return Ok(());
    }
    let transaction = store.write()?;
    transaction.execute("DELETE FROM output_value", [])?;
    schema::note(&transaction, DEFINITIONS, &wanted)?;
    transaction.commit()?;
    Ok(())
}

/// Stores the numbers of solutions, by their keys; `None` of one that cannot be computed again.
///
/// # Errors
/// The database refuses; nothing is stored then.
pub fn put_outputs(
    store: &mut Store,
    rows: &[(i64, Option<Vec<SignalStatistics>>)],
) -> Result<(), StoreError> {
    let transaction = store.write()?;
    for (key, statistics) in rows {
        let numbers: Vec<f64> = statistics.iter().flatten().flat_map(flattened).collect();
        let insert = "INSERT OR REPLACE INTO output_value (solution, numbers) VALUES (?1, ?2)";
        transaction.prepare_cached(insert)?.execute(params![key, blob::pack(&numbers)])?;
    }
    transaction.commit()?;
    Ok(())
}

fn flattened(statistics: &SignalStatistics) -> impl Iterator<Item = f64> {
    let SignalStatistics { maximum, minimum, mean, root_mean_square, harmonics } = statistics;
    [*maximum, *minimum, *mean, *root_mean_square].into_iter().chain(harmonics.iter().flatten().copied())
}

/// Deletes the numbers of solutions from one key to before another.
pub(super) fn forget_outputs(transaction: &Transaction<'_>, keys: [i64; 2]) -> Result<(), StoreError> {
    transaction.execute("DELETE FROM output_value WHERE solution >= ?1 AND solution < ?2", keys)?;
    Ok(())
}
