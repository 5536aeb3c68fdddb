//! Separated values with a header.
//!
//! Nothing about the dialect has to be said: separator and decimal sign are those with which the most lines
//! are rows of numbers (`dialect.rs`). The first row of numbers as wide as most is the beginning of the
//! table; no line behind it is passed over. What stands before it is the header (`header.rs`): titles with
//! units, a row of units, comments, a sampling rate. Lines that begin with `#`, `%` or `//` are comments
//! anywhere. Empty fields and words like `NaN` are missing samples. A field that ends rows of a file from
//! some row on is the end of a shorter channel.

mod dialect;
mod header;
mod number;

use std::collections::{HashMap, HashSet};

use dialect::Dialect;

use crate::{
    finding::Finding,
    raw::{Axis, RawChannel, RawRecord, TimeColumn},
    read::{
        ReadError,
        time::{compare_rates, rises_evenly, time_column},
    },
};

/// A line of text with its number, from 1 on.
pub(crate) type Line<'a> = (usize, &'a str);

/// Characters of a field that a message shows.
const LONGEST_EXCERPT: usize = 60;

/// How the fields of a table with words in it are separated.
pub(crate) struct TextTable(Dialect);

impl TextTable {
    /// By its line of titles.
    pub(crate) fn of_titles(titles: &str) -> Self {
        Self(Dialect::of_titles(titles))
    }

    /// Fields of a line.
    pub(crate) fn fields(&self, line: &str) -> Vec<String> {
        self.0.split(line).iter().map(|field| field.to_string()).collect()
    }

    /// Value of a field: NaN if it is empty or says that there is nothing, `None` if it is no number.
    pub(crate) fn number(&self, field: &str) -> Option<f64> {
        number::parse(field, self.0.decimal_comma)
    }
}

/// Lines that are neither empty nor comments.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let numbered = text.lines().enumerate().map(|(k, line)| (k + 1, line));
    numbered.filter(|(_, line)| !line.trim().is_empty() && !is_comment(line))
}

/// Reads separated values.
///
/// # Errors
/// See [`ReadError`].
pub fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    let mut findings = Vec::new();
    let mut text = decode(bytes, &mut findings)?;
    // As programs of the old Macintosh end lines.
    if !text.contains('\n') {
        text = text.replace('\r', "\n");
    }
    let lines: Vec<Line> = text.lines().enumerate().map(|(k, line)| (k + 1, line)).collect();
    let rows: Vec<Line> =
        lines.iter().copied().filter(|(_, line)| !line.trim().is_empty() && !is_comment(line)).collect();
    let (dialect, first, width) = dialect::detect(&rows).ok_or(ReadError::NoNumbers)?;
    let first_line = rows[first].0;
    ensure_no_rows(&rows[..first], dialect, width)?;
    let before: Vec<Line> =
        lines.iter().copied().filter(|(line, text)| *line < first_line && !text.trim().is_empty()).collect();
    let header = header::read(&before, dialect, width);
    let values = columns(&rows[first..], dialect, width)?;
    let titled = header.titled;
    let columns = values.into_iter().zip(header.titles).map(|(samples, (name, unit))| RawChannel {
        name,
        unit,
        samples,
    });
    // A separator at the end of each line makes a column of nothing.
    let columns: Vec<RawChannel> = columns.filter(|column| !column.samples.is_empty()).collect();
    if !titled && !rises_evenly(&columns[0].samples) && dialect.may_be_decimal(&rows[first..]) {
        findings.push(Finding::CommasSeparate);
    }
    arrange(columns, titled, header.rate_hz, findings)
}

/// Text of the file: UTF-8, UTF-16 with its mark, or else Latin-1.
pub(crate) fn decode(bytes: &[u8], findings: &mut Vec<Finding>) -> Result<String, ReadError> {
    let wide = |order: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes[2..].chunks_exact(2).map(|pair| order([pair[0], pair[1]])).collect();
        String::from_utf16_lossy(&units)
    };
    if bytes.starts_with(&[0xff, 0xfe]) {
        return Ok(wide(u16::from_le_bytes));
    }
    if bytes.starts_with(&[0xfe, 0xff]) {
        return Ok(wide(u16::from_be_bytes));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.contains(&0) {
        return Err(ReadError::UnknownFormat);
    }
    Ok(str::from_utf8(bytes).map(str::to_owned).unwrap_or_else(|_| {
        findings.push(Finding::Latin1);
        bytes.iter().map(|&byte| char::from(byte)).collect()
    }))
}

fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    line.starts_with(['#', '%', '!']) || line.starts_with("//")
}

/// Refuses rows of numbers before the first row of the table. A single number above the titles of several
/// columns is no row: a count, a time of day.
fn ensure_no_rows(before: &[Line], dialect: Dialect, width: usize) -> Result<(), ReadError> {
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

/// The beginning of a field, for a message: a damaged file may be one line.
pub(crate) fn excerpt(field: &str) -> String {
    match field.char_indices().nth(LONGEST_EXCERPT) {
        Some((end, _)) => format!("{}...", &field[..end]),
        None => field.to_owned(),
    }
}

/// Values by columns. Empty ends of columns are cut off.
fn columns(rows: &[Line], dialect: Dialect, width: usize) -> Result<Vec<Vec<f64>>, ReadError> {
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

/// Which column is the time, and the others.
fn arrange(
    mut columns: Vec<RawChannel>,
    titled: bool,
    rate_hz: Option<f64>,
    mut findings: Vec<Finding>,
) -> Result<RawRecord, ReadError> {
    unique(&mut columns);
    let kinds: Vec<(&str, Option<&str>)> =
        columns.iter().map(|column| (column.name.as_str(), column.unit.as_deref())).collect();
    let assumed = !titled && columns.len() > 1 && rises_evenly(&columns[0].samples);
    let place = time_column(&kinds).or(assumed.then_some(0));
    let time = place.map(|place| TimeColumn { channel: columns.remove(place), place });
    let axis = match &time {
        Some(TimeColumn { channel, .. }) => {
            let (times, told) = channel.times();
            findings.extend(told.map(|told| if titled { told } else { Finding::TimeAssumed }));
            compare_rates(rate_hz, &times, &mut findings);
            Axis::Times(times)
        }
        None => rate_hz.map_or(Axis::Unknown, |rate| Axis::Even { step_s: 1.0 / rate, start_s: 0.0 }),
    };
    if columns.is_empty() {
        return Err(ReadError::NoNumbers);
    }
    Ok(RawRecord { time, ..RawRecord::single(axis, columns, findings) })
}

/// Names that stand twice get a number.
pub(crate) fn unique(channels: &mut [RawChannel]) {
    let mut taken = HashSet::new();
    // The next number of each name: all below are taken.
    let mut next: HashMap<String, usize> = HashMap::new();
    for channel in channels {
        if !taken.insert(channel.name.clone()) {
            let number = next.entry(channel.name.clone()).or_insert(2);
            let mut name = format!("{} ({number})", channel.name);
            while !taken.insert(name.clone()) {
                *number += 1;
                name = format!("{} ({number})", channel.name);
            }
            *number += 1;
            channel.name = name;
        }
    }
}

#[cfg(test)]
mod tests;
