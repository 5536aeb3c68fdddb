//! The rows of branches over the frequency as records, packed as they are read: no column is held in between,
//! so a million rows cost little more than the memory that they are handed over in.
//!
//! The records are those of [`pack`](super::pack) for [`branch_array`](super::branch_array): the same
//! fields and the same bytes. A first look over the rows finds how many there are, and the longest words.

use hammerbeam_orbit::{EventSet, Stability};

use super::{
    Field, or_nan,
    records::{letters_of_words, put_word},
};
use crate::{
    columns::TableColumn,
    export::{BranchTable, TableOver},
    lines::{Branches, OwnedBranch},
    row::Row,
    store::{Store, StoreError},
};

/// Rows that are packed together, entry by entry, so that what is written stays in the cache.
const BLOCK: usize = 256;
/// Blocks that are handed over together.
const BLOCKS: usize = 16;

/// Rows of branches over the frequency that are about to be packed.
#[derive(Debug)]
pub struct RowRecords<'a> {
    store: &'a Store,
    table: &'static BranchTable,
    branches: Branches,
    wanted: Vec<u32>,
    entries: Vec<Entry>,
    rows: usize,
}

/// What a record has at a place.
#[derive(Debug, Clone, Copy)]
enum Entry {
    /// The same in all rows of a branch.
    Branch,
    PeriodMultiple,
    Number(TableColumn),
    Contacts,
    IsStable,
    /// Words, of so many characters at most.
    Stability(usize),
    Events(usize),
}

impl<'a> RowRecords<'a> {
    /// Looks which rows there are.
    ///
    /// * `branches`: numbers of the branches that are wanted; all if there are none.
    ///
    /// # Errors
    /// [`StoreError`]: solutions are missing or damaged.
    pub fn of(store: &'a Store, branches: &[u32]) -> Result<Self, StoreError> {
        let (all, wanted) = (Branches::of(store)?, branches.to_vec());
        let table = &BranchTable::ROWS;
        let mut records = Self { store, table, branches: all, wanted, entries: Vec::new(), rows: 0 };
        let (mut longest, mut rows) = (Longest::default(), 0);
        for branch in records.branches() {
            branch.each_block::<StoreError>(store, BLOCK, |block| {
                rows += block.len();
                block.iter().for_each(|row| longest.take(row));
                Ok(())
            })?;
        }
        records.entries = table.columns().flat_map(|column| longest.entries(column)).collect();
        records.rows = rows;
        Ok(records)
    }

    fn branches(&self) -> impl Iterator<Item = OwnedBranch<'_>> {
        let is_wanted =
            |branch: &OwnedBranch<'_>| self.wanted.is_empty() || self.wanted.contains(&branch.id());
        self.branches.over(TableOver::Frequency).into_iter().filter(is_wanted)
    }

    /// Name of the table.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.table.name
    }

    /// Number of records.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Bytes of a record.
    #[must_use]
    pub fn record(&self) -> usize {
        self.entries.iter().map(Entry::bytes).sum()
    }

    /// The fields of a record.
    #[must_use]
    pub fn fields(&self) -> Vec<Field> {
        self.entries.iter().map(Entry::field).collect()
    }

    /// Hands over all records, some thousands at a time.
    ///
    /// # Errors
    /// [`StoreError`]: solutions are missing or damaged, or `take` refuses.
    pub fn each_bytes<E: From<StoreError>>(
        &self,
        mut take: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let size = self.record();
        let mut bytes = Vec::with_capacity(size * BLOCK * BLOCKS);
        for branch in self.branches() {
            branch.each_block::<E>(self.store, BLOCK, |rows| {
                let first = bytes.len();
                bytes.resize(first + size * rows.len(), 0);
                self.put(&branch, rows, &mut bytes[first..]);
                if bytes.len() > size * BLOCK * (BLOCKS - 1) {
                    take(&bytes)?;
                    bytes.clear();
                }
                Ok(())
            })?;
        }
        take(&bytes)
    }

    /// * `bytes`: room for as many records, all zero.
    fn put(&self, branch: &OwnedBranch<'_>, rows: &[Row], bytes: &mut [u8]) {
        let (size, mut offset) = (self.record(), 0);
        for entry in &self.entries {
            let width = entry.bytes();
            let places = bytes.chunks_exact_mut(size).map(|record| &mut record[offset..offset + width]);
            entry.put(branch, rows.iter().zip(places));
            offset += width;
        }
    }
}

impl Entry {
    fn bytes(&self) -> usize {
        match self {
            Self::Branch | Self::PeriodMultiple | Self::Number(_) | Self::Contacts => 8,
            Self::IsStable => 1,
            Self::Stability(characters) | Self::Events(characters) => 4 * characters,
        }
    }

    fn field(&self) -> Field {
        let (name, letters) = match self {
            Self::Branch => (TableColumn::Branch.name(), "<i8".to_owned()),
            Self::PeriodMultiple => (TableColumn::PeriodMultiple.name(), "<i8".to_owned()),
            Self::Number(column) => (column.name(), "<f8".to_owned()),
            Self::Contacts => (TableColumn::Contacts.name(), "<i8".to_owned()),
            Self::IsStable => (TableColumn::Stable.name(), "|b1".to_owned()),
            Self::Stability(_) => ("stability", letters_of_words(self.bytes())),
            Self::Events(_) => (TableColumn::Event.name(), letters_of_words(self.bytes())),
        };
        (name.to_owned(), letters, None)
    }

    fn put<'a>(self, branch: &OwnedBranch<'_>, rows: impl Iterator<Item = (&'a Row, &'a mut [u8])>) {
        match self {
            Self::Branch => same(branch.id().into(), rows),
            Self::PeriodMultiple => same(branch.period_multiple().into(), rows),
            Self::Number(column) => rows.for_each(|(row, place)| {
                place.copy_from_slice(&or_nan(row.number(column)).to_le_bytes());
            }),
            Self::Contacts => rows.for_each(|(row, place)| {
                place.copy_from_slice(&i64::from(row.maxima.contacts).to_le_bytes());
            }),
            Self::IsStable => {
                rows.for_each(|(row, place)| place[0] = u8::from(row.stability == Stability::Stable));
            }
            Self::Stability(_) => rows.for_each(|(row, place)| put_word(row.stability.word(), place)),
            Self::Events(_) => rows
                .filter(|(row, _)| row.events != EventSet::default())
                .for_each(|(row, place)| put_word(&row.events.label(), place)),
        }
    }
}

fn same<'a>(value: i64, rows: impl Iterator<Item = (&'a Row, &'a mut [u8])>) {
    rows.for_each(|(_, place)| place.copy_from_slice(&value.to_le_bytes()));
}

/// The most characters of words in rows.
#[derive(Debug, Default)]
struct Longest {
    stability: usize,
    events: usize,
}

impl Longest {
    fn take(&mut self, row: &Row) {
        self.stability = self.stability.max(row.stability.word().len());
        if row.events != EventSet::default() {
            self.events = self.events.max(row.events.label().len());
        }
    }

    /// What a column becomes; an entry of words has one character at least.
    fn entries(&self, column: TableColumn) -> Vec<Entry> {
        match column {
            TableColumn::Branch => vec![Entry::Branch],
            TableColumn::PeriodMultiple => vec![Entry::PeriodMultiple],
            TableColumn::Contacts => vec![Entry::Contacts],
            TableColumn::Stable => vec![Entry::IsStable, Entry::Stability(self.stability.max(1))],
            TableColumn::Event => vec![Entry::Events(self.events.max(1))],
            number => vec![Entry::Number(number)],
        }
    }
}

#[cfg(test)]
mod tests {
    use hammerbeam_orbit::Side;
    use tempfile::tempdir;

    use super::*;
    use crate::{
        arrays::{branch_array, pack},
        export::TableLines,
        store::tests::{STUDY, append, study, walked_folder},
    };

    /// Byte for byte the records of the table by columns, though they are handed over in several parts.
    #[test]
    fn rows_are_packed_as_their_columns_are() {
        let folder = tempdir().unwrap();
        walked_folder(folder.path());
        let mut run = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
        let frequencies: Vec<f64> = (0..2 * BLOCK * BLOCKS).map(|k| 0.2 - 1e-6 * k as f64).collect();
        append(&mut run, Side::Down, &frequencies);
        run.finish().unwrap();
        for open in [Store::open, Store::open_with_rows] {
            let store = open(folder.path()).unwrap();
            for (branches, rows) in
                [(&[][..], 61 + frequencies.len()), (&[1], 61 + frequencies.len()), (&[7], 0)]
            {
                let expected = pack(&branch_array(&store, TableLines::Rows, branches).unwrap()[0]);
                let records = RowRecords::of(&store, branches).unwrap();
                let (mut bytes, mut parts) = (Vec::new(), 0);
                let take = |part: &[u8]| {
                    bytes.extend_from_slice(part);
                    parts += 1;
                    Ok(())
                };
                records.each_bytes::<StoreError>(take).unwrap();
                assert_eq!((records.rows(), rows), (expected.rows, expected.rows));
                assert_eq!(records.fields(), expected.fields);
                assert!(bytes == expected.bytes);
                assert_eq!(parts, rows.div_ceil(BLOCK * BLOCKS).max(1));
            }
        }
    }
}
