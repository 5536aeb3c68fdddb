//! MAT files, version 5 (`save -v6` and `-v7` of MATLAB, `scipy.io.savemat`): matrices, sparse or full.
//!
//! Behind a header of 128 bytes follow elements, each with a tag: its type and its length. A matrix is an
//! element of elements: flags with its class, dimensions, name, then of a sparse matrix the rows `ir` and the
//! starts of columns `jc`, and the values. Values may stand as any type of number that holds them. `-v7`
//! compresses each matrix by itself. Other variables (structures, cells, texts) are passed over.
//!
//! # Source
//! The MathWorks, *MAT-File Format*, level 5.

use std::io::{self, ErrorKind, Read};

use flate2::read::ZlibDecoder;
use hammerbeam_structure::Entry;

use super::text::shown;
use crate::{
    error::{FilePlace, MatrixFault, PlacedFault},
    matrix::{FileMatrix, MOST_ROWS},
};

/// Length of the header, and where it has its version and the order of bytes.
const HEADER: usize = 128;
const ORDER: usize = 126;
/// Types of elements.
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
/// Classes of arrays: sparse, and numbers of any type.
const SPARSE: u8 = 5;
const NUMBERS: std::ops::RangeInclusive<u8> = 6..=15;
/// Flag of an array with imaginary parts.
const COMPLEX: u32 = 0x0800;
/// Entries of a matrix at most: what memory takes.
const MOST_ENTRIES: u64 = 1 << 25;
/// Longest name.
const LONGEST_NAME: u64 = 1000;

/// Whether bytes begin like such a file.
pub(crate) fn is_mat(first: &[u8]) -> bool {
    first.starts_with(b"MATLAB ") && first.len() >= HEADER && order(first).is_some()
}

/// Whether the order of bytes is the large end first.
fn order(first: &[u8]) -> Option<bool> {
    match first.get(ORDER..HEADER)? {
        b"IM" => Some(false),
        b"MI" => Some(true),
        _ => None,
    }
}

pub(crate) fn read<R: Read>(mut source: R) -> Result<Vec<FileMatrix>, PlacedFault> {
    let mut header = [0; HEADER];
    let short = |_| MatrixFault::Truncated { what: "the header" }.at(FilePlace::Whole);
    source.read_exact(&mut header).map_err(short)?;
    if header.starts_with(b"MATLAB 7.3") {
        let what = "a MAT file of version 7.3 (HDF5)".to_owned();
        let instead = "save it with -v7 or -v6";
        return Err(MatrixFault::Unsupported { what, instead }.at(FilePlace::Whole));
    }
    let big_endian = order(&header).ok_or_else(|| {
        let expected = "a MAT file, whose head ends with the order of its bytes";
        MatrixFault::Unexpected { expected, found: shown(&header) }.at(FilePlace::Whole)
    })?;
    let (mut at, mut matrices) = (HEADER as u64, Vec::new());
    loop {
        let place = FilePlace::Byte(at);
        let mut elements = Elements { source: &mut source, big_endian };
        let Some(tag) = elements.tag().map_err(|fault| fault.at(place))? else { return Ok(matrices) };
        if tag.kind == 0 {
            let (what, allowed) = ("the type of an element", "1 to 18".to_owned());
            return Err(MatrixFault::OutOfRange { what, found: 0, allowed }.at(place));
        }
        let mut content = (&mut source).take(u64::from(tag.length));
        let found = match tag.kind {
            COMPRESSED => compressed(ZlibDecoder::new(&mut content), big_endian, place),
            MATRIX => array(&mut Elements { source: &mut content, big_endian }, place),
            _ => Ok(None),
        };
        matrices.extend(found.map_err(|fault| fault.at(place))?);
        let padded = if tag.kind == COMPRESSED { 0 } else { tag.padding() };
        io::copy(&mut content, &mut io::sink())?;
        io::copy(&mut (&mut source).take(padded), &mut io::sink())?;
        at += 8 + u64::from(tag.length) + padded;
    }
}

/// The matrix in a compressed element.
fn compressed<R: Read>(
    source: R,
    big_endian: bool,
    place: FilePlace,
) -> Result<Option<FileMatrix>, MatrixFault> {
    let mut elements = Elements { source, big_endian };
    match elements.tag()? {
        Some(tag) if tag.kind == MATRIX => array(&mut elements, place),
        _ => Ok(None),
    }
}

/// A matrix; `None` if the array is something else.
fn array<R: Read>(elements: &mut Elements<R>, place: FilePlace) -> Result<Option<FileMatrix>, MatrixFault> {
    let flags = elements.numbers("the flags of an array", 2)?;
    let flags = flags.first().map_or(0, |flags| *flags as u32);
    let class = (flags & 0xff) as u8;
    if class != SPARSE && !NUMBERS.contains(&class) {
        return Ok(None);
    }
    let dimensions = elements.numbers("the dimensions of an array", 32)?;
    let name: String = elements
        .numbers("the name of an array", LONGEST_NAME)?
        .into_iter()
        .map(|letter| char::from(letter as u8))
        .filter(char::is_ascii_graphic)
        .collect();
    let [rows, columns] = dimensions[..] else { return Ok(None) };
    if flags & COMPLEX != 0 {
        let what = format!("the complex matrix {name}");
        return Err(MatrixFault::Unsupported { what, instead: "give real matrices" });
    }
    let (rows, columns) = (count(rows, "the number of rows")?, count(columns, "the number of columns")?);
    let entries =
        if class == SPARSE { sparse(elements, rows, columns)? } else { full(elements, rows, columns)? };
    Ok(Some(FileMatrix {
        name,
        rows,
        columns,
        entries,
        one_triangle: false,
        is_sized: true,
        precision: 0.5 * f64::EPSILON,
        labels: Vec::new(),
        place,
    }))
}

/// Entries by columns: rows from 0, where columns start, values.
fn sparse<R: Read>(
    elements: &mut Elements<R>,
    rows: usize,
    columns: usize,
) -> Result<Vec<Entry>, MatrixFault> {
    let places = elements.numbers("the rows of entries", MOST_ENTRIES)?;
    let starts = elements.numbers("the starts of columns", columns as u64 + 1)?;
    let values = elements.numbers("the entries", MOST_ENTRIES)?;
    wrong_count("starts of columns", starts.len(), columns + 1)?;
    let stored = starts.last().map_or(0, |end| *end as usize).min(places.len());
    wrong_count("entries", values.len().min(places.len()), starts.last().map_or(0, |end| *end as usize))?;
    let mut entries = Vec::with_capacity(stored);
    for (column, ends) in starts.windows(2).enumerate() {
        let is_whole = ends.iter().all(|end| end.fract() == 0.0);
        if !is_whole || ends[0] < 0.0 || ends[1] < ends[0] || ends[1] > stored as f64 {
            let allowed = format!("{} to {stored}", ends[0]);
            let (what, found) = ("the end of a column", ends[1] as i64);
            return Err(MatrixFault::OutOfRange { what, found, allowed });
        }
        for index in ends[0] as usize..ends[1] as usize {
            let (row, value) = (places[index], finite(values[index])?);
            if !(row >= 0.0 && row.fract() == 0.0) || row >= rows as f64 {
                let allowed = format!("0 to {}", rows.saturating_sub(1));
                return Err(MatrixFault::OutOfRange { what: "a row", found: row as i64, allowed });
            }
            entries.push(Entry { row: row as u32, column: column as u32, value });
        }
    }
    Ok(entries)
}

/// Entries other than 0 of a full matrix, column by column.
fn full<R: Read>(elements: &mut Elements<R>, rows: usize, columns: usize) -> Result<Vec<Entry>, MatrixFault> {
    let values = elements.numbers("the entries", MOST_ENTRIES)?;
    wrong_count("entries", values.len(), rows.saturating_mul(columns))?;
    let mut entries = Vec::new();
    for (index, value) in values.into_iter().enumerate().filter(|(_, value)| *value != 0.0) {
        let (row, column) = ((index % rows) as u32, (index / rows) as u32);
        entries.push(Entry { row, column, value: finite(value)? });
    }
    Ok(entries)
}

fn count(number: f64, what: &'static str) -> Result<usize, MatrixFault> {
    if (0.0..=MOST_ROWS as f64).contains(&number) {
        return Ok(number as usize);
    }
    Err(MatrixFault::OutOfRange { what, found: number as i64, allowed: format!("0 to {MOST_ROWS}") })
}

fn wrong_count(what: &'static str, found: usize, expected: usize) -> Result<(), MatrixFault> {
    let (found, expected) = (found as u64, expected as u64);
    if found == expected { Ok(()) } else { Err(MatrixFault::WrongCount { what, found, expected }) }
}

fn finite(found: f64) -> Result<f64, MatrixFault> {
    if found.is_finite() { Ok(found) } else { Err(MatrixFault::NotFinite { what: "an entry", found }) }
}

/// The tag of an element.
#[derive(Clone, Copy)]
struct Tag {
    kind: u32,
    length: u32,
    /// The content of a short element, which stands within the tag.
    within: Option<[u8; 4]>,
}

impl Tag {
    /// Bytes behind the content up to the next multiple of 8.
    fn padding(self) -> u64 {
        u64::from(self.length.wrapping_neg() % 8)
    }
}

struct Elements<R> {
    source: R,
    big_endian: bool,
}

impl<R: Read> Elements<R> {
    /// The next tag; `None` at the end.
    fn tag(&mut self) -> Result<Option<Tag>, MatrixFault> {
        let mut bytes = [0; 8];
        let mut filled = 0;
        while filled < 8 {
            match self.source.read(&mut bytes[filled..]) {
                Ok(0) if filled == 0 => return Ok(None),
                Ok(0) => return Err(MatrixFault::Truncated { what: "the tag of an element" }),
                Ok(count) => filled += count,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(unreadable(error, "the tag of an element")),
            }
        }
        let [first, second] = [self.word(&bytes[..4]), self.word(&bytes[4..])];
        if first >> 16 == 0 {
            return Ok(Some(Tag { kind: first, length: second, within: None }));
        }
        let within = [bytes[4], bytes[5], bytes[6], bytes[7]];
        Ok(Some(Tag { kind: first & 0xffff, length: (first >> 16).min(4), within: Some(within) }))
    }

    fn word(&self, bytes: &[u8]) -> u32 {
        let mut word = [0; 4];
        word.copy_from_slice(bytes);
        if self.big_endian { u32::from_be_bytes(word) } else { u32::from_le_bytes(word) }
    }

    /// The numbers of the next element, at most so many.
    fn numbers(&mut self, what: &'static str, most: u64) -> Result<Vec<f64>, MatrixFault> {
        let Some(tag) = self.tag()? else { return Err(MatrixFault::Truncated { what }) };
        let Some(size) = size_of(tag.kind) else {
            let (found, allowed) = (i64::from(tag.kind), "a type of numbers".to_owned());
            return Err(MatrixFault::OutOfRange { what: "the type of an element", found, allowed });
        };
        let found = u64::from(tag.length) / size as u64;
        if found > most {
            return Err(MatrixFault::OutOfRange {
                what,
                found: found as i64,
                allowed: format!("at most {most}"),
            });
        }
        if let Some(within) = tag.within {
            let whole = within[..tag.length as usize].chunks_exact(size);
            return Ok(whole.map(|bytes| self.number(tag.kind, bytes)).collect());
        }
        let mut numbers = Vec::new();
        let mut bytes = [0; 8];
        for _ in 0..found {
            self.source.read_exact(&mut bytes[..size]).map_err(|error| unreadable(error, what))?;
            numbers.push(self.number(tag.kind, &bytes[..size]));
        }
        let rest = u64::from(tag.length) - found * size as u64 + tag.padding();
        // The last element may end without its padding.
        io::copy(&mut (&mut self.source).take(rest), &mut io::sink())
            .map_err(|error| unreadable(error, what))?;
        Ok(numbers)
    }

    /// A number of a type, from as many bytes as it has.
    fn number(&self, kind: u32, bytes: &[u8]) -> f64 {
        let mut own = [0_u8; 8];
        own[..bytes.len()].copy_from_slice(bytes);
        if self.big_endian {
            own[..bytes.len()].reverse();
        }
        let low = u64::from_le_bytes(own);
        match kind {
            1 => f64::from(low as i8),
            3 => f64::from(low as i16),
            5 => f64::from(low as i32),
            7 => f64::from(f32::from_bits(low as u32)),
            9 => f64::from_bits(low),
            12 => low as i64 as f64,
            _ => low as f64,
        }
    }
}

/// Bytes of a number of a type of elements.
fn size_of(kind: u32) -> Option<usize> {
    match kind {
        1 | 2 | 16 => Some(1),
        3 | 4 => Some(2),
        5..=7 => Some(4),
        9 | 12 | 13 => Some(8),
        _ => None,
    }
}

/// What ended a read: the end of the data, or the machine.
fn unreadable(error: io::Error, what: &'static str) -> MatrixFault {
    match error.kind() {
        ErrorKind::UnexpectedEof | ErrorKind::InvalidData | ErrorKind::InvalidInput => {
            MatrixFault::Truncated { what }
        }
        _ => MatrixFault::Unreadable(error),
    }
}
