//! Universal files: functions at nodal degrees of freedom, dataset 58 (text) and 58b (binary).
//!
//! A file is a row of datasets, each between two lines with `-1`. Functions over time become channels; other
//! functions (over frequency, say) and other datasets are left out, the former told. Values are text in
//! columns of 13 or 20 characters, or binary of 4 or 8 bytes:
//!
//! | ordinate | even abscissa | uneven abscissa |
//! |---|---|---|
//! | real | `y` | `x, y` |
//! | complex | `re, im` | `x, re, im` |
//!
//! In binary data of 8 bytes the abscissa has 8 bytes too, as the programs write it; whether it has 4 instead
//! (as the text form suggests) is told by the number of bytes.
//!
//! # Source
//! Structural Dynamics Research Laboratory, University of Cincinnati, "Universal file format, dataset 58",
//! and its binary variant.

mod data;
mod header;

use super::{ReadError, csv::unique};
use crate::{finding::Finding, raw::RawRecord};
use header::{Binary, Header};

/// Lines between the type of a dataset and its values.
const HEADER_LINES: usize = 11;

/// Whether a file begins with a line of nothing but -1, and a line with the number of a dataset below. The -1
/// has blanks before it, as in its columns 5 and 6; at the very edge, where it may be a number of a table,
/// the dataset has to be 58.
pub(super) fn begins(bytes: &[u8]) -> bool {
    let mut lines =
        bytes.split(|byte| *byte == b'\n').map(|line| line.trim_ascii_end()).filter(|line| !line.is_empty());
    let (first, second) = (lines.next().unwrap_or_default(), lines.next().unwrap_or_default().trim_ascii());
    let number = second.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let is_number = number > 0 && matches!(second.get(number), None | Some(b'b' | b'B'));
    first.trim_ascii() == b"-1" && is_number && (first.starts_with(b" ") || second.starts_with(b"58"))
}

pub(super) fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    let mut file = Lines { rest: bytes };
    let mut raw = RawRecord::default();
    let mut functions = 0;
    while let Some(line) = file.next() {
        if line.trim() != "-1" {
            continue;
        }
        let Some(kind) = file.next() else { break };
        if kind.trim() == "58" || kind.trim_start().starts_with("58b") || kind.trim_start().starts_with("58B")
        {
            functions += 1;
            function(&mut file, &kind, functions, &mut raw)?;
        } else {
            file.skip_dataset();
        }
    }
    if raw.groups.is_empty() {
        let what = format!("{functions} functions, none over time, are in it (dataset 58)");
        return Err(ReadError::Malformed { what });
    }
    raw.groups.iter_mut().for_each(|group| unique(&mut group.channels));
    Ok(raw)
}

/// Lines, of any ending, with bytes in between.
struct Lines<'a> {
    rest: &'a [u8],
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Option<String> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|byte| *byte == b'\n').unwrap_or(self.rest.len());
        let line = String::from_utf8_lossy(&self.rest[..end]).trim_end_matches('\r').to_owned();
        self.rest = self.rest.get(end + 1..).unwrap_or_default();
        Some(line)
    }

    /// Goes behind the line that ends a dataset.
    ///
    /// # Returns
    /// Whether there is one.
    fn skip_dataset(&mut self) -> bool {
        std::iter::from_fn(|| self.next()).any(|line| line.trim() == "-1")
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (bytes, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(bytes)
    }
}

fn function(file: &mut Lines, kind: &str, number: usize, raw: &mut RawRecord) -> Result<(), ReadError> {
    let binary = Binary::of(kind, number)?;
    let lines: Vec<String> = (0..HEADER_LINES).map_while(|_| file.next()).collect();
    if lines.len() < HEADER_LINES {
        return Err(ReadError::Truncated { what: format!("the header of function {number}") });
    }
    let header = Header::of(&lines, number)?;
    let values = match &binary {
        Some(binary) => {
            let length = header.bytes(binary);
            let truncated = || ReadError::Truncated {
                what: format!("function {number} should have {length} bytes, {} are left", file.rest.len()),
            };
            let bytes = file.rest.get(..length).ok_or_else(truncated)?;
            let values = data::of_bytes(bytes, &header, binary);
            file.take(length);
            values
        }
        None => data::of_text(file, &header, number)?,
    };
    if !file.skip_dataset() {
        return Err(ReadError::Truncated { what: format!("function {number} has no end") });
    }
    if !header.is_over_time() {
        let reason = format!("its abscissa is {}, not time", header.abscissa_word());
        raw.findings.push(Finding::LeftOut { name: header.name, reason });
        return Ok(());
    }
    data::add(values, header, raw);
    Ok(())
}
