//! Nastran OUTPUT4 in binary: see [`super::output4`].
//!
//! Fortran records: a length of 4 bytes, the bytes, the length again. The order of bytes and the size of
//! words (4 or 8 bytes) follow from the first record, the header: 24 or 48 bytes long.

use std::io::{ErrorKind, Read};

use super::output4::Output4Matrix;
use crate::{
    error::{FilePlace, MatrixFault, PlacedFault},
    matrix::FileMatrix,
};

/// Records are read in pieces of this size: a length that is garbage allocates no more than there is.
const PIECE: usize = 1 << 16;
/// The strings of one column of the largest matrix fit.
const LONGEST_RECORD: u32 = 1 << 30;

/// How numbers stand in a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Encoding {
    big_endian: bool,
    /// Bytes of a word: 4 or 8.
    word: usize,
}

/// How the numbers of a file stand, by its first bytes; `None` if it is not such a file.
pub(crate) fn encoding(first: &[u8]) -> Option<Encoding> {
    let marker: [u8; 4] = first.get(..4)?.try_into().ok()?;
    [(false, u32::from_le_bytes(marker)), (true, u32::from_be_bytes(marker))].into_iter().find_map(
        |(big_endian, length)| match length {
            24 => Some(Encoding { big_endian, word: 4 }),
            48 => Some(Encoding { big_endian, word: 8 }),
            _ => None,
        },
    )
}

pub(crate) fn read<R: Read>(source: R, encoding: Encoding) -> Result<Vec<FileMatrix>, PlacedFault> {
    let mut records = Records { source, encoding, at: 0, bytes: Vec::new() };
    let mut matrices = Vec::new();
    while records.next()? {
        let place = records.place();
        let mut matrix = header(&records).map_err(|fault| fault.at(place))?;
        loop {
            if !records.next()? {
                return Err(MatrixFault::Truncated { what: "the columns of a matrix" }.at(records.place()));
            }
            if !column(&records, &mut matrix).map_err(|fault| fault.at(records.place()))? {
                break;
            }
        }
        matrices.extend(matrix.finished(0.5 * f64::EPSILON));
    }
    Ok(matrices)
}

struct Records<R> {
    source: R,
    encoding: Encoding,
    /// Bytes before the present record.
    at: u64,
    bytes: Vec<u8>,
}

impl<R: Read> Records<R> {
    /// Reads the next record; false at the end of the file.
    fn next(&mut self) -> Result<bool, PlacedFault> {
        self.at += if self.bytes.is_empty() { 0 } else { self.bytes.len() as u64 + 8 };
        let Some(length) = self.marker(true)? else { return Ok(false) };
        if length == 0 || length > LONGEST_RECORD {
            let (found, allowed) = (i64::from(length), format!("1 to {LONGEST_RECORD}"));
            return Err(
                MatrixFault::OutOfRange { what: "the length of a record", found, allowed }.at(self.place())
            );
        }
        self.bytes.clear();
        let mut left = length as usize;
        let mut piece = vec![0; PIECE.min(left)];
        while left > 0 {
            let now = left.min(PIECE);
            self.fill(&mut piece[..now])?;
            self.bytes.extend_from_slice(&piece[..now]);
            left -= now;
        }
        match self.marker(false)? {
            Some(again) if again == length => Ok(true),
            again => {
                let (what, found) = ("the length after a record", i64::from(again.unwrap_or_default()));
                Err(MatrixFault::OutOfRange { what, found, allowed: length.to_string() }.at(self.place()))
            }
        }
    }

    /// A length; `None` at the end of the file, where that may be.
    fn marker(&mut self, may_end: bool) -> Result<Option<u32>, PlacedFault> {
        let mut marker = [0; 4];
        let mut filled = 0;
        while filled < 4 {
            match self.source.read(&mut marker[filled..]) {
                Ok(0) if filled == 0 && may_end => return Ok(None),
                Ok(0) => {
                    return Err(MatrixFault::Truncated { what: "the length of a record" }.at(self.place()));
                }
                Ok(count) => filled += count,
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        }
        let big_endian = self.encoding.big_endian;
        Ok(Some(if big_endian { u32::from_be_bytes(marker) } else { u32::from_le_bytes(marker) }))
    }

    fn fill(&mut self, piece: &mut [u8]) -> Result<(), PlacedFault> {
        self.source.read_exact(piece).map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => MatrixFault::Truncated { what: "a record" }.at(self.place()),
            _ => error.into(),
        })
    }

    fn place(&self) -> FilePlace {
        FilePlace::Byte(self.at)
    }
}

impl<R> Records<R> {
    /// The bytes of a number, in the order of this machine's little-endian reading.
    fn raw<const N: usize>(&self, start: usize) -> Result<[u8; N], MatrixFault> {
        let bytes = self.bytes.get(start..start + N);
        let bytes = bytes.ok_or(MatrixFault::Truncated { what: "a number of a record" })?;
        let mut raw = [0; N];
        raw.copy_from_slice(bytes);
        if self.encoding.big_endian {
            raw.reverse();
        }
        Ok(raw)
    }

    /// The whole number in a word.
    fn whole(&self, word: usize) -> Result<i64, MatrixFault> {
        let start = word * self.encoding.word;
        Ok(match self.encoding.word {
            4 => i64::from(i32::from_le_bytes(self.raw(start)?)),
            _ => i64::from_le_bytes(self.raw(start)?),
        })
    }

    /// The real number that begins at a word.
    fn real(&self, word: usize, is_double: bool) -> Result<f64, MatrixFault> {
        let start = word * self.encoding.word;
        match (self.encoding.word, is_double) {
            (4, false) => Ok(f64::from(f32::from_le_bytes(self.raw(start)?))),
            _ => Ok(f64::from_le_bytes(self.raw(start)?)),
        }
    }
}

fn header<R>(records: &Records<R>) -> Result<Output4Matrix, MatrixFault> {
    let word = records.encoding.word;
    if records.bytes.len() != 6 * word {
        let (found, allowed) = (records.bytes.len() as i64, (6 * word).to_string());
        return Err(MatrixFault::OutOfRange { what: "the length of a header", found, allowed });
    }
    let numbers = [records.whole(0)?, records.whole(1)?, records.whole(2)?, records.whole(3)?];
    let name: Vec<u8> = records.bytes[4 * word..].iter().copied().filter(u8::is_ascii_graphic).collect();
    Output4Matrix::new(&String::from_utf8_lossy(&name), numbers, FilePlace::Byte(records.at))
}

/// Takes a column; false for the one that ends the matrix.
fn column<R>(records: &Records<R>, matrix: &mut Output4Matrix) -> Result<bool, MatrixFault> {
    let [number, row, words] = [records.whole(0)?, records.whole(1)?, records.whole(2)?];
    let Some(column) = matrix.column(number)? else { return Ok(false) };
    let words_of_number = if matrix.is_double() { (8 / records.encoding.word) as i64 } else { 1 };
    let words_of_value = words_of_number * matrix.parts() as i64;
    let (big, is_double) = (matrix.big, matrix.is_double() || records.encoding.word == 8);
    let mut take = |first: usize, row: i64, length: i64| -> Result<(), MatrixFault> {
        let values = length / words_of_value;
        let first_row = matrix.string(row, values)?;
        for value in 0..values as usize {
            let word = first + value * words_of_value as usize;
            matrix.push(first_row + value as u32, column, records.real(word, is_double)?)?;
        }
        Ok(())
    };
    if row > 0 {
        return take(3, row, words).map(|()| true);
    }
    let (mut at, end) = (3_i64, 3_i64.saturating_add(words.max(0)));
    while at < end {
        let (head, length, row) = if big {
            (2, records.whole(at as usize)?.saturating_sub(1), records.whole(at as usize + 1)?)
        } else {
            let packed = records.whole(at as usize)?;
            (1, packed / 65536 - 1, packed % 65536)
        };
        if length < 0 || length > end - at - head {
            let allowed = format!("1 to {}", end - at - head + 1);
            return Err(MatrixFault::OutOfRange {
                what: "the length of a string",
                found: length.saturating_add(1),
                allowed,
            });
        }
        take((at + head) as usize, row, length)?;
        at += head + length;
    }
    Ok(true)
}
