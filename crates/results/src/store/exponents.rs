//! Spectra of Lyapunov exponents.

use hammerbeam_attractor::{Convergence, Estimate, Spectrum};
use rusqlite::{Connection, Row as SqlRow, Transaction, params};

use super::{StoreError, blob, requests};

/// The exponents of a motion at a frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct ExponentRecord {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Orthonormalisations in an excitation period.
    pub sections_per_period: u64,
    /// Exponents, their sum, and how they came about; times in s, exponents in 1/s.
    pub spectrum: Spectrum,
    /// `-tr(M^-1 C)` [1/s], what the sum is while no contact loses energy.
    pub divergence: f64,
    /// K of the 0-1 test.
    pub zero_one: Option<f64>,
    /// Displacement [m] and velocity [m/s] of the response point at phase 0 of the periods averaged over, the
    /// first ones of very many.
    pub section: Vec<[f64; 2]>,
}

/// Spectra of a request, in their order.
pub fn exponents(connection: &Connection, request: i64) -> Result<Vec<ExponentRecord>, StoreError> {
    let select = "SELECT frequency_hz, sections_per_period, time_s, sum_per_s, divergence_per_s,
        kaplan_yorke_dimension, block_correlation, zero_one, exponents, convergence, section,
        expected_sum_per_s FROM exponents WHERE request = ?1 ORDER BY number";
    let mut statement = connection.prepare(select)?;
    let mut rows = statement.query([request])?;
    let mut records = Vec::new();
    while let Some(row) = rows.next()? {
        records.push(record(row)?);
    }
    Ok(records)
}

/// Adds a spectrum to a request.
pub fn append_exponents(
    transaction: Transaction<'_>,
    request: i64,
    piece: u64,
    record: &ExponentRecord,
) -> Result<(), StoreError> {
    requests::advance(&transaction, request, (piece, piece + 1))?;
    let spectrum = &record.spectrum;
    let pairs: Vec<f64> =
        spectrum.exponents.iter().flat_map(|exponent| [exponent.value, exponent.half_width]).collect();
    let curve: Vec<f64> = spectrum
        .convergence
        .iter()
        .flat_map(|place| std::iter::once(place.time).chain(place.exponents.iter().copied()))
        .collect();
    let insert = "INSERT INTO exponents (request, number, frequency_hz, sections_per_period, time_s,
        sum_per_s, divergence_per_s, kaplan_yorke_dimension, block_correlation, zero_one, exponents,
        convergence, section, expected_sum_per_s)
        VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)";
    let values = params![
        request,
        piece as i64,
        record.frequency_hz,
        record.sections_per_period as i64,
        spectrum.time,
        spectrum.sum,
        record.divergence,
        spectrum.kaplan_yorke_dimension,
        spectrum.block_correlation,
        record.zero_one,
        blob::pack(&pairs),
        blob::pack(&curve),
        blob::pack(record.section.iter().flatten()),
        spectrum.expected_sum,
    ];
    transaction.execute(insert, values)?;
    transaction.commit()?;
    Ok(())
}
fn record(row: &SqlRow<'_>) -> Result<ExponentRecord, StoreError> {
    let numbers = |place: usize, what: &'static str| -> Result<Vec<f64>, StoreError> {
        let bytes: Vec<u8> = row.get(place)?;
        blob::unpack(what, &bytes, bytes.len() / 8)
    };
    let pairs = numbers(8, "exponents")?;
    let curve = numbers(9, "convergence of exponents")?;
    let section = numbers(10, "section of a motion")?;
    let exponents: Vec<Estimate> = pairs
        .as_chunks()
        .0
        .iter()
        .map(|[value, half_width]| Estimate { value: *value, half_width: *half_width })
        .collect();
    let places = curve.chunks_exact(1 + exponents.len());
    Ok(ExponentRecord {
        frequency_hz: row.get(0)?,
        sections_per_period: row.get::<_, i64>(1)? as u64,
        spectrum: Spectrum {
            exponents,
            sum: row.get(3)?,
            kaplan_yorke_dimension: row.get(5)?,
            // What is not a number is stored as nothing.
            block_correlation: row.get::<_, Option<f64>>(6)?.unwrap_or(f64::NAN),
            convergence: places
                .map(|place| Convergence { time: place[0], exponents: place[1..].to_vec() })
                .collect(),
            time: row.get(2)?,
            expected_sum: row.get(11)?,
        },
        divergence: row.get(4)?,
        zero_one: row.get(7)?,
        section: section.as_chunks().0.to_vec(),
    })
}
