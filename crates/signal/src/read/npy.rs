//! NumPy arrays (`.npy`, versions 1 to 3): numbers of any size, real and complex, and tables with named
//! columns.
//!
//! The header is a Python dictionary with `descr`, `fortran_order` and `shape`. Objects and texts are
//! refused.
//!
//! # Source
//! NumPy Enhancement Proposal 1, "A simple file format for NumPy arrays", and the format's version 2 and 3.

use super::{
    arrays::{Array, arrange},
    bytes::{ByteReader, NumberFormat, NumberRoom},
};
use crate::{error::ReadError, raw::RawRecord};

pub(super) fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    arrange(arrays(bytes, "x", &mut NumberRoom::new())?, Vec::new())
}

/// One entry of an array: a number, or a part of a complex one.
#[derive(Debug, Clone, Copy)]
struct Entry {
    format: NumberFormat,
    big_endian: bool,
    complex: bool,
}

impl Entry {
    const fn size(self) -> usize {
        self.format.size() * if self.complex { 2 } else { 1 }
    }
}

/// The array of a file with a given name, or the columns of a table with their own names.
///
/// * `room`: numbers that the file may still have.
pub(super) fn arrays(bytes: &[u8], name: &str, room: &mut NumberRoom) -> Result<Vec<Array>, ReadError> {
    let mut bytes = ByteReader::new(bytes, false);
    let magic = bytes.take(8, "the start of the array")?;
    if !magic.starts_with(b"\x93NUMPY") {
        return Err(malformed(format!("{name} is no array")));
    }
    let length =
        if magic[6] == 1 { usize::from(bytes.u16("the header")?) } else { bytes.u32("the header")? as usize };
    let header = String::from_utf8_lossy(bytes.take(length, "the header")?).into_owned();
    let fortran = value_of(&header, "fortran_order")?.starts_with("True");
    let shape = shape(value_of(&header, "shape")?)?;
    let columns = columns(value_of(&header, "descr")?, name)?;
    let size: usize = columns.iter().map(|(_, entry)| entry.size()).sum();
    let expected = shape.iter().try_fold(size, |product, side| product.checked_mul(*side));
    let expected = expected
        .filter(|_| size > 0)
        .ok_or_else(|| malformed(format!("{name} has a shape that cannot be")))?;
    let data = bytes.take(expected, "the array")?;
    if expected == 0 {
        // Whatever its other side lengths.
        return Ok(Vec::new());
    }
    let numbers: usize = columns.iter().map(|(_, entry)| if entry.complex { 2 } else { 1 }).sum();
    room.take((expected / size).saturating_mul(numbers))?;
    let mut offset = 0;
    let mut arrays = Vec::new();
    for (name, entry) in columns {
        let gather = |shift: usize| {
            let part: Vec<u8> = data
                .chunks_exact(size)
                .flat_map(|row| &row[offset + shift..offset + shift + entry.format.size()])
                .copied()
                .collect();
            in_order(entry.format.values(&part, entry.big_endian), &shape, fortran)
        };
        let imaginary = entry.complex.then(|| gather(entry.format.size()));
        arrays.push(Array { name, shape: shape.clone(), real: gather(0), imaginary });
        offset += entry.size();
    }
    Ok(arrays)
}

fn malformed(what: String) -> ReadError {
    ReadError::Malformed { what }
}

/// Text after a key of the dictionary.
fn value_of<'a>(header: &'a str, key: &str) -> Result<&'a str, ReadError> {
    let quoted = format!("'{key}':");
    let at = header.find(&quoted).ok_or_else(|| malformed(format!("the header has no {key}")))?;
    Ok(header[at + quoted.len()..].trim_start())
}

fn shape(text: &str) -> Result<Vec<usize>, ReadError> {
    let inside = text.strip_prefix('(').and_then(|text| text.split_once(')')).map(|(inside, _)| inside);
    let sides = inside
        .into_iter()
        .flat_map(|inside| inside.split(','))
        .map(str::trim)
        .filter(|side| !side.is_empty());
    sides
        .map(|side| {
            side.trim_end_matches('L').parse().map_err(|_| malformed(format!("the shape has a side {side}")))
        })
        .collect()
}

/// Columns of a table, or the one array.
fn columns(text: &str, name: &str) -> Result<Vec<(String, Entry)>, ReadError> {
    if !text.starts_with('[') {
        return Ok(vec![(name.to_owned(), entry(quoted(text, 0)?)?)]);
    }
    let end = text.find(']').unwrap_or(text.len());
    text[1..end]
        .split('(')
        .skip(1)
        .map(|column| Ok((quoted(column, 0)?.to_owned(), entry(quoted(column, 1)?)?)))
        .collect()
}

/// The n-th text in quotation marks.
fn quoted(text: &str, n: usize) -> Result<&str, ReadError> {
    text.split('\'')
        .nth(2 * n + 1)
        .ok_or_else(|| malformed("the type of the entries cannot be read".to_owned()))
}

fn entry(text: &str) -> Result<Entry, ReadError> {
    let big_endian = text.starts_with('>');
    let (format, complex) = match text.trim_start_matches(['<', '>', '|', '=']) {
        "f8" => (NumberFormat::F64, false),
        "f4" => (NumberFormat::F32, false),
        "i1" => (NumberFormat::I8, false),
        "u1" | "b1" => (NumberFormat::U8, false),
        "i2" => (NumberFormat::I16, false),
        "u2" => (NumberFormat::U16, false),
        "i4" => (NumberFormat::I32, false),
        "u4" => (NumberFormat::U32, false),
        "i8" => (NumberFormat::I64, false),
        "u8" => (NumberFormat::U64, false),
        "c8" => (NumberFormat::F32, true),
        "c16" => (NumberFormat::F64, true),
        other => {
            return Err(ReadError::Unsupported {
                what: format!("an array of type {other}"),
                instead: "save numbers, as with x.astype(float)",
            });
        }
    };
    Ok(Entry { format, big_endian, complex })
}

/// Entries with the first index varying fastest.
fn in_order(values: Vec<f64>, shape: &[usize], fortran: bool) -> Vec<f64> {
    let sides: Vec<usize> = shape.iter().copied().filter(|side| *side != 1).collect();
    match sides[..] {
        [rows, columns] if !fortran => (0..columns)
            .flat_map(|c| (0..rows).map(move |r| r * columns + c))
            .map(|index| values[index])
            .collect(),
        _ => values,
    }
}
