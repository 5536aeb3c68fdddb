//! Separated values with a header.
//!
//! The dialect is found automatically: the separator and the decimal sign with which the most lines are rows
//! of numbers. The table starts at the first row of numbers with the width of most rows; no line after it is
//! skipped. The lines before it are the header: titles with units, a row of units, comments, a sampling rate.
//! Lines that start with `#`, `%`, `!` or `//` are comments anywhere. Empty fields and words like `NaN` are
//! missing samples. A column that is empty from some row to the end of the file is a shorter channel.
//!
//! | file | what |
//! |---|---|
//! | `lines.rs` | decoding, numbered lines, comments |
//! | `number.rs` | numbers, clock times and missing values in a field |
//! | `dialect.rs` | separator and decimal sign |
//! | `header.rs` | titles, units, a sampling rate |
//! | `table.rs` | tables with words, for other readers |

mod dialect;
mod header;
mod lines;
mod number;
mod table;

pub(crate) use lines::{NumberedLine, content_lines, decode, excerpt};
pub(crate) use table::TextTable;

use dialect::Dialect;
use lines::numbered;

use crate::{
    error::ReadError,
    finding::RecordFinding,
    limits::{MAX_COLUMNS, MAX_SAMPLES},
    raw::{RawChannel, RawRecord, TimeAxis, TimeColumn, number_repeated_names},
    read::bytes::NumberRoom,
    read::time::{compare_rates, rises_evenly, time_column},
};

/// Reads separated values.
///
/// # Errors
/// See [`ReadError`].
pub fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    let mut findings = Vec::new();
    let mut text = decode(bytes, &mut findings)?;
    // Line endings of the classic Mac OS.
    if !text.contains('\n') {
        text = text.replace('\r', "\n");
    }
    if text.bytes().filter(|byte| *byte == b'\n').count() > MAX_SAMPLES {
        return Err(ReadError::TooManyNumbers);
    }
    let rows: Vec<NumberedLine> = content_lines(&text).collect();
    let (dialect, first, width) = dialect::detect(&rows).ok_or(ReadError::NoNumbers)?;
    if width > MAX_COLUMNS {
        return Err(ReadError::TooManyColumns { found: width });
    }
    NumberRoom::new().take(width.saturating_mul(rows.len() - first))?;
    let first_line = rows[first].0;
    ensure_no_rows(&rows[..first], dialect, width)?;
    let before: Vec<NumberedLine> =
        numbered(&text).filter(|(line, text)| *line < first_line && !text.trim().is_empty()).collect();
    let header = header::read(&before, dialect, width);
    let values = columns(&rows[first..], dialect, width)?;
    let titled = header.titled;
    let columns = values.into_iter().zip(header.titles).map(|(samples, (name, unit))| RawChannel {
        name,
        unit,
        samples,
    });
    // A separator at the end of each line gives an empty column.
    let columns: Vec<RawChannel> = columns.filter(|column| !column.samples.is_empty()).collect();
    if !titled && !rises_evenly(&columns[0].samples) && dialect.may_be_decimal(&rows[first..]) {
        findings.push(RecordFinding::CommasSeparate);
    }
    arrange(columns, titled, header.rate_hz, findings)
}

/// Refuses rows of numbers before the first row of the table. A single number above the titles of several
/// columns is not a row, but a count or a time of day.
fn ensure_no_rows(before: &[NumberedLine], dialect: Dialect, width: usize) -> Result<(), ReadError> {
    let mut titles = false;
    for &(line, text) in before {
        match dialect.width_of_row(text) {
            Some(found) if found > 1 || titles => {
                return Err(ReadError::RaggedRow { line, found, expected: width });
            }
            Some(_) => {}
            None => titles |= dialect.split(text).len() == width,
        }
    }
    Ok(())
}

/// Values by columns, without empty ends.
fn columns(rows: &[NumberedLine], dialect: Dialect, width: usize) -> Result<Vec<Vec<f64>>, ReadError> {
    let mut columns = vec![Vec::with_capacity(rows.len()); width];
    for &(line, text) in rows {
        let mut found = 0;
        for (index, field) in dialect.split(text).iter().enumerate() {
            let value = number::parse(field, dialect.decimal_comma).ok_or_else(|| ReadError::NotANumber {
                line,
                column: index + 1,
                text: excerpt(field),
            })?;
            if let Some(column) = columns.get_mut(index) {
                column.push(value);
                found = index + 1;
            } else if !value.is_nan() {
                return Err(ReadError::RaggedRow { line, found: index + 1, expected: width });
            }
        }
        if found < width {
            return Err(ReadError::RaggedRow { line, found, expected: width });
        }
    }
    for column in &mut columns {
        let end = column.iter().rposition(|value| !value.is_nan()).map_or(0, |last| last + 1);
        column.truncate(end);
    }
    Ok(columns)
}

/// A record from columns, of which one may be the time.
fn arrange(
    mut columns: Vec<RawChannel>,
    titled: bool,
    rate_hz: Option<f64>,
    mut findings: Vec<RecordFinding>,
) -> Result<RawRecord, ReadError> {
    number_repeated_names(&mut columns);
    let titles: Vec<(&str, Option<&str>)> =
        columns.iter().map(|column| (column.name.as_str(), column.unit.as_deref())).collect();
    let assumed = !titled && columns.len() > 1 && rises_evenly(&columns[0].samples);
    let index = time_column(&titles).or(assumed.then_some(0));
    let time = index.map(|index| TimeColumn { channel: columns.remove(index), index });
    let axis = match &time {
        Some(TimeColumn { channel, .. }) => {
            let (times, finding) = channel.times();
            findings.extend(finding.map(|finding| if titled { finding } else { RecordFinding::TimeAssumed }));
            compare_rates(rate_hz, &times, &mut findings);
            TimeAxis::Times(times)
        }
        None => rate_hz.map_or(TimeAxis::Unknown, |rate| TimeAxis::Even { step_s: 1.0 / rate, start_s: 0.0 }),
    };
    if columns.is_empty() {
        return Err(ReadError::NoNumbers);
    }
    Ok(RawRecord { time, ..RawRecord::single(axis, columns, findings) })
}

#[cfg(test)]
mod tests;
