//! MATLAB files of level 5 (`save -v6` and `-v7`, also what SciPy writes).
//!
//! Numeric arrays are read, compressed or not, also as fields of structures (`data.acc`). Cells, texts,
//! sparse matrices and objects are left out, with a finding. Files of version 7.3 are HDF5 and are refused.
//!
//! # Source
//! The MathWorks, "MAT-File Format", chapter 1, "Level 5 MAT-File Format".

mod element;

use super::{
    arrays::{Array, arrange},
    bytes::{ByteReader, NumberRoom},
};
use crate::{
    error::ReadError,
    finding::RecordFinding,
    limits::{LARGEST_FILE, LONGEST_NAME, MAX_DEPTH},
    raw::RawRecord,
};
use element::{Element, ElementType, next, numbers};

const STRUCTURE: u32 = 2;
const NUMERIC: std::ops::RangeInclusive<u32> = 6..=15;
const COMPLEX: u32 = 0x0800;

/// Whether a file is a MATLAB file of any level, or HDF5.
pub(super) fn is_matlab(bytes: &[u8]) -> bool {
    let text = &bytes[..bytes.len().min(116)];
    let level_5 = text.starts_with(b"MATLAB") && text.windows(8).any(|part| part == b"MAT-file");
    level_5 || bytes.starts_with(HDF) || is_level_4(bytes)
}

const HDF: &[u8] = b"\x89HDF";

/// Level 4 starts with five whole numbers: a type in decimal digits, rows, columns, whether it is complex,
/// and the length of the name with its terminating zero.
fn is_level_4(bytes: &[u8]) -> bool {
    let Some((header, rest)) = bytes.split_at_checked(20) else { return false };
    let number = |k: usize| u32::from_le_bytes([header[k], header[k + 1], header[k + 2], header[k + 3]]);
    let [kind, complex, name] = [0, 12, 16].map(number);
    let is_type = kind < 100 && kind / 10 <= 5 && kind % 10 <= 2;
    let ends = (name as usize).checked_sub(1).and_then(|end| rest.get(end)) == Some(&0);
    is_type && complex <= 1 && (2..=64).contains(&name) && ends
}

fn ensure_level_5(bytes: &[u8]) -> Result<(), ReadError> {
    let (what, instead) = if bytes.starts_with(b"MATLAB 7.3") {
        ("MATLAB 7.3 (HDF5)", "save with save(name, ..., '-v7') in MATLAB")
    } else if bytes.starts_with(HDF) {
        ("HDF5", "save with save(name, ..., '-v7') in MATLAB, or as CSV or NumPy")
    } else if is_level_4(bytes) {
        ("MATLAB level 4", "save with save(name, ..., '-v7') in MATLAB, or with SciPy's savemat(format='5')")
    } else {
        return Ok(());
    };
    Err(ReadError::Unsupported { what: what.to_owned(), instead })
}

pub(super) fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    ensure_level_5(bytes)?;
    let header = bytes.get(..128).ok_or_else(|| ReadError::Truncated { what: "the header".to_owned() })?;
    let big_endian = match &header[126..128] {
        b"IM" => false,
        b"MI" => true,
        _ => return Err(ReadError::Malformed { what: "the header names no byte order".to_owned() }),
    };
    let mut rest = ByteReader::new(&bytes[128..], big_endian);
    let mut content =
        MatContent { arrays: Vec::new(), findings: Vec::new(), room: NumberRoom::new(), depth: 0 };
    let mut room = LARGEST_FILE;
    while rest.len() >= 8 {
        match next(&mut rest)? {
            Element { kind: ElementType::Compressed, data } => {
                let inflated = element::inflate(data, &mut room)?;
                let inner = next(&mut ByteReader::new(&inflated, big_endian))?;
                content.take(&inner, big_endian, "")?;
            }
            plain => content.take(&plain, big_endian, "")?,
        }
    }
    arrange(content.arrays, content.findings)
}

/// Arrays and findings of a file.
struct MatContent {
    arrays: Vec<Array>,
    findings: Vec<RecordFinding>,
    room: NumberRoom,
    /// Structures around the present variable.
    depth: usize,
}

impl MatContent {
    /// Adds a variable.
    ///
    /// * `within`: name of the structure of which it is a field, with a point; else empty.
    fn take(&mut self, element: &Element, big_endian: bool, within: &str) -> Result<(), ReadError> {
        if element.kind != ElementType::Matrix || element.data.is_empty() {
            return Ok(());
        }
        let mut bytes = ByteReader::new(element.data, big_endian);
        let flags = numbers(&next(&mut bytes)?, big_endian)?.first().map_or(0, |flags| *flags as u32);
        let shape: Vec<usize> =
            numbers(&next(&mut bytes)?, big_endian)?.iter().map(|side| *side as usize).collect();
        let own = next(&mut bytes)?.data;
        let found = within.len() + own.len();
        if found > LONGEST_NAME {
            return Err(ReadError::LongName { found });
        }
        let own = String::from_utf8_lossy(own).into_owned();
        let name = format!("{within}{own}");
        match flags & 0xff {
            STRUCTURE if shape.iter().all(|side| *side == 1) => {
                if self.depth == MAX_DEPTH {
                    return Err(ReadError::TooDeep);
                }
                self.depth += 1;
                self.fields(&mut bytes, &name)?;
                self.depth -= 1;
                Ok(())
            }
            class if NUMERIC.contains(&class) => self.numeric(&mut bytes, name, shape, flags & COMPLEX != 0),
            class => {
                // Texts and empty auxiliary variables of MATLAB have no name.
                if !own.is_empty() || !within.is_empty() {
                    self.findings.push(RecordFinding::LeftOut { name, reason: reason(class).to_owned() });
                }
                Ok(())
            }
        }
    }

    fn numeric(
        &mut self,
        bytes: &mut ByteReader,
        name: String,
        shape: Vec<usize>,
        complex: bool,
    ) -> Result<(), ReadError> {
        let big_endian = bytes.is_big_endian();
        let count = shape.iter().fold(1, |count: usize, side| count.saturating_mul(*side));
        let mut part = || {
            let element = next(bytes)?;
            // Of `n` bytes no more than `n` numbers are made.
            self.room.take(count.min(element.data.len()))?;
            let values = numbers(&element, big_endian)?;
            if values.len() == count {
                return Ok(values);
            }
            Err(ReadError::Malformed {
                what: format!("{name} has {} values, its shape says {count}", values.len()),
            })
        };
        let real = part()?;
        let imaginary = if complex { Some(part()?) } else { None };
        if count > 0 {
            self.arrays.push(Array { name, shape, real, imaginary });
        }
        Ok(())
    }

    /// Fields of a single structure. Their names precede them; the names within are empty.
    fn fields(&mut self, bytes: &mut ByteReader, name: &str) -> Result<(), ReadError> {
        let big_endian = bytes.is_big_endian();
        let length = numbers(&next(bytes)?, big_endian)?.first().map_or(32, |length| *length as usize).max(1);
        let names = next(bytes)?.data;
        for field in names.chunks(length) {
            let field = field.split(|byte| *byte == 0).next().unwrap_or_default();
            if field.len() > LONGEST_NAME {
                return Err(ReadError::LongName { found: field.len() });
            }
            let field = String::from_utf8_lossy(field).into_owned();
            self.take(&next(bytes)?, big_endian, &format!("{name}.{field}"))?;
        }
        Ok(())
    }
}

const fn reason(class: u32) -> &'static str {
    match class {
        1 => "a cell array",
        STRUCTURE => "an array of structures",
        4 => "a text",
        5 => "a sparse matrix",
        _ => "no array of numbers",
    }
}
