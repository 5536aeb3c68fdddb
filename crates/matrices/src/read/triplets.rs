//! Lines of a row, a column and a value: CalculiX `.sti`, `.mas`, `.dam`, and Abaqus' coordinate format.
//!
//! Rows and columns count from 1. CalculiX writes the upper triangle, with explicit zeros; Abaqus both
//! triangles, or in its matrix input format, whose numbers stand between commas, lines
//! `node, direction, node, direction, value`.

use std::{collections::BTreeMap, io::BufRead};

use hammerbeam_structure::{Direction, Entry, RowLabel};

use super::text::{Digits, Lines, index, number, shown, whole, words};
use crate::{
    error::{MatrixFault, PlacedFault},
    matrix::{FileMatrix, MOST_ROWS},
};

/// Most words of a line.
const FIELDS: usize = 5;

pub(crate) fn read<R: BufRead>(source: R) -> Result<FileMatrix, PlacedFault> {
    let mut lines = Lines::new(source);
    let mut triplets = Triplets::default();
    while let Some(line) = lines.next()? {
        let mut fields = [&line[..0]; FIELDS + 1];
        let mut count = 0;
        for word in words(line) {
            fields[count.min(FIELDS)] = word;
            count += 1;
        }
        let comment = matches!(fields[0].first(), Some(b'*' | b'%' | b'#'));
        let taken = match count {
            _ if comment && is_head(line) => {
                let expected = "rows, columns and values without the head of another format";
                Err(MatrixFault::Unexpected { expected, found: shown(line) })
            }
            _ if comment => Ok(()),
            0 => Ok(()),
            3 => triplets.take(&fields),
            5 => triplets.take_labelled(&fields),
            _ => {
                let expected = "a row, a column and a value";
                Err(MatrixFault::Unexpected { expected, found: shown(line) })
            }
        };
        taken.map_err(|fault| fault.at(lines.place()))?;
    }
    if triplets.entries.is_empty() {
        return Err(MatrixFault::Truncated { what: "the entries" }.at(lines.end()));
    }
    Ok(triplets.finish())
}

/// Whether a line says that the file is of another format: below it numbers mean something else.
fn is_head(line: &[u8]) -> bool {
    let text = String::from_utf8_lossy(line).to_ascii_uppercase().replace(' ', "");
    ["%%MATRIXMARKET", "*USERELEMENT", "*MATRIX,TYPE="].iter().any(|head| text.starts_with(head))
}

#[derive(Default)]
struct Triplets {
    entries: Vec<Entry>,
    digits: Digits,
    size: usize,
    /// Rows of the labels, in the order in which they come.
    labels: BTreeMap<(i64, i64), u32>,
}

impl Triplets {
    fn take(&mut self, fields: &[&[u8]]) -> Result<(), MatrixFault> {
        self.refuse_mixture(!self.labels.is_empty(), fields[0])?;
        let (row, column) = (index(fields[0], "a row", MOST_ROWS)?, index(fields[1], "a column", MOST_ROWS)?);
        self.push(row, column, fields[2])
    }

    fn take_labelled(&mut self, fields: &[&[u8]]) -> Result<(), MatrixFault> {
        self.refuse_mixture(self.labels.is_empty() && !self.entries.is_empty(), fields[0])?;
        let (row, column) = (self.labelled(fields[0], fields[1])?, self.labelled(fields[2], fields[3])?);
        self.push(row, column, fields[4])
    }

    /// Lines with labels and lines without cannot be of one matrix.
    fn refuse_mixture(&self, mixed: bool, found: &[u8]) -> Result<(), MatrixFault> {
        let expected = "as many numbers as on the lines before";
        if mixed { Err(MatrixFault::Unexpected { expected, found: shown(found) }) } else { Ok(()) }
    }

    fn labelled(&mut self, node: &[u8], direction: &[u8]) -> Result<u32, MatrixFault> {
        let label = (whole(node, "a node")?, whole(direction, "a direction")?);
        let next = self.labels.len() as u32;
        Ok(*self.labels.entry(label).or_insert(next))
    }

    fn push(&mut self, row: u32, column: u32, value: &[u8]) -> Result<(), MatrixFault> {
        self.digits.see(value);
        self.size = self.size.max(1 + row.max(column) as usize);
        self.entries.push(Entry { row, column, value: number(value, "an entry")? });
        Ok(())
    }

    /// Rows with labels in the order of their nodes and directions.
    fn finish(mut self) -> FileMatrix {
        let mut labels = Vec::new();
        if !self.labels.is_empty() {
            let mut place = vec![0_u32; self.labels.len()];
            for (row, (&(node, direction), &first)) in self.labels.iter().enumerate() {
                place[first as usize] = row as u32;
                labels.push(RowLabel::physical(node, Direction::numbered(direction)));
            }
            for entry in &mut self.entries {
                (entry.row, entry.column) = (place[entry.row as usize], place[entry.column as usize]);
            }
        }
        FileMatrix {
            name: String::new(),
            rows: self.size,
            columns: self.size,
            entries: self.entries,
            one_triangle: false,
            is_sized: false,
            precision: self.digits.precision(),
            labels,
            place: crate::FilePlace::Whole,
        }
    }
}
