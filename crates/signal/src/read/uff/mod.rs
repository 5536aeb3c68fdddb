//! Universal files: functions at nodal degrees of freedom, dataset 58 (text) and 58b (binary).
//!
//! A file is a sequence of datasets, each between two lines with `-1`. Functions of time become channels.
//! Other functions (of frequency, say) are left out with a finding, other datasets without. Values are text
//! in columns of 13 or 20 characters, or binary numbers of 4 or 8 bytes:
//!
//! | ordinate | even abscissa | uneven abscissa |
//! |---|---|---|
//! | real | `y` | `x, y` |
//! | complex | `re, im` | `x, re, im` |
//!
//! In binary data of 8 bytes the abscissa has 8 bytes too, as programs write it. The declared number of bytes
//! shows whether it has 4 instead, as the text form suggests.
//!
//! # Source
//! Structural Dynamics Research Laboratory, University of Cincinnati, "Universal file format, dataset 58",
//! and its binary variant.

mod data;
mod header;
mod lines;

use crate::{
    error::ReadError,
    finding::RecordFinding,
    limits::MAX_COLUMNS,
    raw::{RawRecord, number_repeated_names},
    read::bytes::NumberRoom,
};
use header::{BinaryLayout, FunctionHeader, HEADER_LINES};
use lines::DatasetLines;

/// Whether a file starts with a line that holds only -1, followed by a line with the number of a dataset.
///
/// Blanks precede the -1, which is in columns 5 and 6. In column 1 it may be a number of a table; then the
/// dataset has to be 58.
pub(super) fn is_universal(bytes: &[u8]) -> bool {
    let mut lines =
        bytes.split(|byte| *byte == b'\n').map(|line| line.trim_ascii_end()).filter(|line| !line.is_empty());
    let (first, second) = (lines.next().unwrap_or_default(), lines.next().unwrap_or_default().trim_ascii());
    let number = second.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let is_number = number > 0 && matches!(second.get(number), None | Some(b'b' | b'B'));
    first.trim_ascii() == b"-1" && is_number && (first.starts_with(b" ") || second.starts_with(b"58"))
}

pub(super) fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    let mut file = DatasetLines::new(bytes);
    let mut raw = RawRecord::default();
    let mut functions = 0;
    let mut room = NumberRoom::new();
    while let Some(line) = file.next() {
        if line.trim() != "-1" {
            continue;
        }
        let Some(kind) = file.next() else { break };
        if kind.trim() == "58" || kind.trim_start().starts_with("58b") || kind.trim_start().starts_with("58B")
        {
            functions += 1;
            if functions > MAX_COLUMNS {
                return Err(ReadError::TooManyColumns { found: functions });
            }
            function(&mut file, &kind, functions, &mut raw, &mut room)?;
        } else {
            file.skip_dataset();
        }
    }
    if raw.groups.is_empty() {
        let what = format!("{functions} functions, none over time, are in it (dataset 58)");
        return Err(ReadError::Malformed { what });
    }
    raw.groups.iter_mut().for_each(|group| number_repeated_names(&mut group.channels));
    Ok(raw)
}

fn function(
    file: &mut DatasetLines,
    kind: &str,
    number: usize,
    raw: &mut RawRecord,
    room: &mut NumberRoom,
) -> Result<(), ReadError> {
    let binary = BinaryLayout::of(kind, number)?;
    let lines: Vec<String> = (0..HEADER_LINES).map_while(|_| file.next()).collect();
    if lines.len() < HEADER_LINES {
        return Err(ReadError::Truncated { what: format!("the header of function {number}") });
    }
    let header = FunctionHeader::of(&lines, number)?;
    room.take(header.points.saturating_mul(header.values_per_point()))?;
    let values = match &binary {
        Some(binary) => {
            let length = header.bytes(binary);
            let truncated = || ReadError::Truncated {
                what: format!("function {number} should have {length} bytes, {} are left", file.rest().len()),
            };
            let bytes = file.rest().get(..length).ok_or_else(truncated)?;
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
        let reason = format!("its abscissa is {}, not time", header.abscissa_name());
        raw.findings.push(RecordFinding::LeftOut { name: header.name, reason });
        return Ok(());
    }
    data::add(values, header, raw);
    Ok(())
}
