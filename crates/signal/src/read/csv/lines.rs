//! The lines of a text file.

use crate::{error::ReadError, finding::RecordFinding};

/// A line of text with its number, from 1 on.
pub(crate) type NumberedLine<'a> = (usize, &'a str);

/// Characters of a field that a message shows.
const MAX_EXCERPT: usize = 60;

/// Text of the file: UTF-8, UTF-16 with its byte order mark, or else Latin-1.
pub(crate) fn decode(bytes: &[u8], findings: &mut Vec<RecordFinding>) -> Result<String, ReadError> {
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
        findings.push(RecordFinding::Latin1);
        bytes.iter().map(|&byte| char::from(byte)).collect()
    }))
}

/// All lines with their numbers.
pub(super) fn numbered(text: &str) -> impl Iterator<Item = NumberedLine<'_>> {
    text.lines().enumerate().map(|(k, line)| (k + 1, line))
}

/// Lines that are neither empty nor comments.
pub(crate) fn content_lines(text: &str) -> impl Iterator<Item = NumberedLine<'_>> {
    numbered(text).filter(|(_, line)| !line.trim().is_empty() && !is_comment(line))
}

pub(super) fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    line.starts_with(['#', '%', '!']) || line.starts_with("//")
}

/// The first characters of a field, for a message: a damaged file may be a single line.
pub(crate) fn excerpt(field: &str) -> String {
    match field.char_indices().nth(MAX_EXCERPT) {
        Some((end, _)) => format!("{}...", &field[..end]),
        None => field.to_owned(),
    }
}
