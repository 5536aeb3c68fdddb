//! Columns packed as records in NumPy's layout.
//!
//! A record holds the entries of a row one after the other without gaps: `<f8` a number, `<i8` a whole
//! number, `|b1` a flag, `<U` words of equal width in UCS-4, `(w,)<f8` and `(w,)<c16` vectors. A file `.npy`
//! is these bytes behind a header that describes them (NumPy Enhancement Proposal 1).

use super::{ArrayColumn, ArrayTable, ArrayValues};

/// Rows that are packed together, so that what is written stays in the cache.
const BLOCK: usize = 256;
/// The header of a `.npy` file ends at a multiple of this.
const ALIGNED: usize = 64;

/// A field of records: its name, its type in NumPy's letters, and its length if it is a vector.
pub type Field = (String, String, Option<usize>);

/// Packed records.
#[derive(Debug, Clone, PartialEq)]
pub struct Records {
    /// The fields of a record.
    pub fields: Vec<Field>,
    /// Number of records.
    pub rows: usize,
    /// The records.
    pub bytes: Vec<u8>,
}

/// How a table is packed: columns of vectors that have no entry in any row are left out.
#[derive(Debug, Clone)]
pub struct Layout<'a> {
    /// Each column with the bytes of an entry.
    columns: Vec<(&'a ArrayColumn, usize)>,
    rows: usize,
}

impl<'a> Layout<'a> {
    /// The one layout of a table.
    #[must_use]
    pub fn of(table: &'a ArrayTable) -> Self {
        let columns = table.columns.iter().map(|column| (column, width(column)));
        Self { columns: columns.filter(|(_, width)| *width > 0).collect(), rows: table.rows() }
    }

    /// Bytes of a record.
    #[must_use]
    pub fn record(&self) -> usize {
        self.columns.iter().map(|(_, width)| width).sum()
    }

    /// Number of records.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The fields of a record.
    #[must_use]
    pub fn fields(&self) -> Vec<Field> {
        self.columns.iter().map(|(column, width)| field(column, *width)).collect()
    }

    /// Writes records, as many as there is room for.
    ///
    /// * `first`: number of the first one.
    pub fn fill(&self, first: usize, bytes: &mut [u8]) {
        let size = self.record();
        for (number, block) in bytes.chunks_mut((BLOCK * size).max(1)).enumerate() {
            let mut offset = 0;
            for (column, width) in &self.columns {
                for (row, record) in (first + number * BLOCK..).zip(block.chunks_exact_mut(size)) {
                    put(column, row, &mut record[offset..offset + width]);
                }
                offset += width;
            }
        }
    }
}

/// Packs a table.
#[must_use]
pub fn pack(table: &ArrayTable) -> Records {
    let layout = Layout::of(table);
    let mut bytes = vec![0; layout.rows * layout.record()];
    layout.fill(0, &mut bytes);
    Records { fields: layout.fields(), rows: layout.rows, bytes }
}

/// Bytes of an entry.
fn width(column: &ArrayColumn) -> usize {
    match &column.values {
        ArrayValues::Numbers(_) | ArrayValues::Whole(_) => 8,
        ArrayValues::Flags(_) => 1,
        ArrayValues::Words(words) => 4 * longest(words),
        ArrayValues::Vectors { width, .. } => 8 * width,
        ArrayValues::Complex { width, .. } => 16 * width,
    }
}

/// Characters of the longest word, one at least.
fn longest(words: &[std::borrow::Cow<'static, str>]) -> usize {
    words.iter().map(|word| word.chars().count()).max().unwrap_or(0).max(1)
}

fn field(column: &ArrayColumn, bytes: usize) -> Field {
    let (letters, length) = match &column.values {
        ArrayValues::Numbers(_) => ("<f8".to_owned(), None),
        ArrayValues::Whole(_) => ("<i8".to_owned(), None),
        ArrayValues::Flags(_) => ("|b1".to_owned(), None),
        ArrayValues::Words(_) => (letters_of_words(bytes), None),
        ArrayValues::Vectors { width, .. } => ("<f8".to_owned(), Some(*width)),
        ArrayValues::Complex { width, .. } => ("<c16".to_owned(), Some(*width)),
    };
    (column.name.clone(), letters, length)
}

fn put(column: &ArrayColumn, row: usize, place: &mut [u8]) {
    match &column.values {
        ArrayValues::Numbers(values) => place.copy_from_slice(&values[row].to_le_bytes()),
        ArrayValues::Whole(values) => place.copy_from_slice(&values[row].to_le_bytes()),
        ArrayValues::Flags(values) => place[0] = u8::from(values[row]),
        ArrayValues::Words(words) => {
            place.fill(0);
            put_word(&words[row], place);
        }
        ArrayValues::Vectors { width, values } => {
            numbers(&values[row * width..(row + 1) * width], place);
        }
        ArrayValues::Complex { width, values } => {
            numbers(values[row * width..(row + 1) * width].as_flattened(), place);
        }
    }
}

/// The type of words whose entries have so many bytes.
pub(super) fn letters_of_words(bytes: usize) -> String {
    format!("<U{}", bytes / 4)
}

/// * `place`: all zero, long enough.
pub(super) fn put_word(word: &str, place: &mut [u8]) {
    for (letter, place) in word.chars().zip(place.chunks_exact_mut(4)) {
        place.copy_from_slice(&u32::from(letter).to_le_bytes());
    }
}

fn numbers(values: &[f64], place: &mut [u8]) {
    for (value, place) in values.iter().zip(place.chunks_exact_mut(8)) {
        place.copy_from_slice(&value.to_le_bytes());
    }
}

impl Records {
    /// The bytes of a `.npy` file in front of the records.
    #[must_use]
    pub fn npy_header(&self) -> Vec<u8> {
        let field = |(name, letters, length): &Field| {
            let name = name.replace('\\', "\\\\").replace('\'', "\\'");
            match length {
                None => format!("('{name}', '{letters}'), "),
                Some(length) => format!("('{name}', '{letters}', ({length},)), "),
            }
        };
        let fields: String = self.fields.iter().map(field).collect();
        let shape = self.rows;
        let mut text = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({shape},), }}");
        // Version 3 has its header in UTF-8, the versions before it in Latin-1.
        let front = b"\x93NUMPY\x03\x00".len() + 4;
        let length = (front + text.len() + 1).next_multiple_of(ALIGNED);
        text.extend(std::iter::repeat_n(' ', length - front - text.len() - 1));
        text.push('\n');
        let mut header = b"\x93NUMPY\x03\x00".to_vec();
        header.extend((text.len() as u32).to_le_bytes());
        header.extend(text.as_bytes());
        header
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrays::named;

    fn table() -> ArrayTable {
        let words = vec!["".into(), "fold".into()];
        ArrayTable::new(
            "table",
            named([
                ("n", ArrayValues::Whole(vec![1, -1])),
                ("x", ArrayValues::Numbers(vec![0.5, f64::NAN])),
                ("ok", ArrayValues::Flags(vec![true, false])),
                ("word", ArrayValues::Words(words)),
                ("z", ArrayValues::complex(&[vec![[1.0, 2.0]], vec![]])),
                ("none", ArrayValues::vectors(&[vec![], vec![]])),
            ]),
        )
    }

    #[test]
    fn records_hold_their_entries_one_after_the_other() {
        let records = pack(&table());
        let size = 8 + 8 + 1 + 4 * 4 + 16;
        assert_eq!((records.rows, records.bytes.len()), (2, 2 * size));
        let letters: Vec<&str> = records.fields.iter().map(|(_, letters, _)| letters.as_str()).collect();
        assert_eq!(letters, ["<i8", "<f8", "|b1", "<U4", "<c16"]);
        let number = |at: usize| f64::from_le_bytes(records.bytes[at..at + 8].try_into().unwrap());
        assert_eq!([number(8), number(33), number(41)], [0.5, 1.0, 2.0]);
        assert_eq!(&records.bytes[size..size + 8], &(-1_i64).to_le_bytes());
        assert_eq!(records.bytes[size + 17..size + 21], u32::from('f').to_le_bytes());
        assert!(number(size + 33).is_nan());
    }

    #[test]
    fn the_header_ends_at_a_multiple_of_64_and_says_its_length() {
        let header = pack(&table()).npy_header();
        assert_eq!(header.len() % 64, 0);
        let length = u32::from_le_bytes(header[8..12].try_into().unwrap()) as usize;
        assert_eq!((length + 12, header[header.len() - 1]), (header.len(), b'\n'));
    }
}
