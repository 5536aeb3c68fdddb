//! Substructures of Abaqus and CalculiX: `*USER ELEMENT` with `*MATRIX, TYPE=STIFFNESS` and `TYPE=MASS`.
//!
//! A comment after `** ELEMENT NODES` names the nodes; lines of the element the directions of the first node,
//! and, of later nodes, their place and their directions, which hold until they change. Of a matrix the lower
//! triangle follows, row by row, some values on each line.
//!
//! # Source
//! Abaqus Analysis User's Guide, "*USER ELEMENT", "*MATRIX".

use std::io::BufRead;

use hammerbeam_structure::{Direction, Entry, RowLabel};

use super::text::{Digits, Lines, number, shown, whole, words};
use crate::{
    error::{MatrixFault, PlacedFault},
    matrix::{FileMatrix, MOST_ROWS},
};

enum Section {
    Outside,
    Element,
    Matrix,
}

#[derive(Default)]
struct Substructure {
    nodes: Vec<i64>,
    declared: usize,
    /// From which node on the directions hold, and the directions.
    directions: Vec<(i64, Vec<i64>)>,
    matrices: Vec<FileMatrix>,
    /// Row and column of the next value.
    next: (u32, u32),
    digits: Digits,
}

pub(crate) fn read<R: BufRead>(source: R) -> Result<Vec<FileMatrix>, PlacedFault> {
    let mut lines = Lines::new(source);
    let (mut section, mut element) = (Section::Outside, Substructure::default());
    let mut names_nodes = false;
    while let Some(line) = lines.next()? {
        let taken = if let Some(comment) = line.strip_prefix(b"**") {
            names_nodes = element.comment(comment, names_nodes);
            Ok(())
        } else if line.starts_with(b"*") {
            let keyword = String::from_utf8_lossy(line).to_ascii_uppercase().replace(' ', "");
            element.keyword(&keyword).map(|found| section = found)
        } else {
            match section {
                Section::Outside => Ok(()),
                Section::Element => element.directions_of(line),
                Section::Matrix => element.values(line),
            }
        };
        let place = lines.place();
        taken.map_err(|fault| fault.at(place))?;
        if let Some(matrix) = element.matrices.last_mut()
            && matrix.rows == 0
            && matches!(section, Section::Matrix)
            && matrix.place == crate::FilePlace::Whole
        {
            matrix.place = place;
        }
    }
    element.finish().map_err(|fault| fault.at(lines.end()))
}

impl Substructure {
    /// Takes the nodes that a comment names; whether comments still do.
    fn comment(&mut self, comment: &[u8], names_nodes: bool) -> bool {
        let text = String::from_utf8_lossy(comment).to_ascii_uppercase();
        if text.contains("ELEMENT NODES") {
            self.nodes.clear();
            return true;
        }
        let numbers: Option<Vec<i64>> = words(comment).map(|word| whole(word, "a node").ok()).collect();
        match numbers {
            Some(numbers) if names_nodes && self.nodes.len() < self.declared => {
                self.nodes.extend(numbers);
                true
            }
            _ => false,
        }
    }

    fn keyword(&mut self, keyword: &str) -> Result<Section, MatrixFault> {
        let parameter = |name: &str| {
            keyword.split(',').find_map(|part| part.strip_prefix(name)?.strip_prefix('=').map(str::to_owned))
        };
        if keyword.starts_with("*USERELEMENT") {
            if !self.matrices.is_empty() {
                let (what, instead) =
                    ("a second element".to_owned(), "give each component a file of its own");
                return Err(MatrixFault::Unsupported { what, instead });
            }
            let count = parameter("NODES").unwrap_or_default();
            let count = whole(count.as_bytes(), "the number of nodes")?;
            if !(1..=MOST_ROWS as i64).contains(&count) {
                let (what, allowed) = ("the number of nodes", format!("1 to {MOST_ROWS}"));
                return Err(MatrixFault::OutOfRange { what, found: count, allowed });
            }
            self.declared = count as usize;
            return Ok(Section::Element);
        }
        if keyword.starts_with("*MATRIX") {
            let name = parameter("TYPE").unwrap_or_default();
            self.close()?;
            self.next = (0, 0);
            self.matrices.push(FileMatrix {
                name,
                rows: 0,
                columns: 0,
                entries: Vec::new(),
                one_triangle: true,
                is_sized: true,
                precision: 0.0,
                labels: Vec::new(),
                place: crate::FilePlace::Whole,
            });
            return Ok(Section::Matrix);
        }
        Ok(Section::Outside)
    }

    fn directions_of(&mut self, line: &[u8]) -> Result<(), MatrixFault> {
        let numbers: Result<Vec<i64>, MatrixFault> =
            words(line).map(|word| whole(word, "a direction")).collect();
        let mut numbers = numbers?;
        if numbers.is_empty() {
            return Ok(());
        }
        let from = if self.directions.is_empty() { 1 } else { numbers.remove(0) };
        let after = self.directions.last().map_or(0, |(from, _)| *from);
        if from <= after || from > self.declared as i64 {
            let allowed = format!("{} to {}", after + 1, self.declared);
            return Err(MatrixFault::OutOfRange { what: "the place of a node", found: from, allowed });
        }
        self.directions.push((from, numbers));
        Ok(())
    }

    fn values(&mut self, line: &[u8]) -> Result<(), MatrixFault> {
        let matrix = self.matrices.last_mut().expect("values follow the line of their matrix");
        for word in words(line) {
            self.digits.see(word);
            let value = number(word, "an entry")?;
            let (row, column) = self.next;
            if u64::from(row) >= MOST_ROWS {
                return Err(MatrixFault::Unexpected { expected: "no more entries", found: shown(word) });
            }
            if value != 0.0 {
                matrix.entries.push(Entry { row, column, value });
            }
            self.next = if column < row { (row, column + 1) } else { (row + 1, 0) };
        }
        Ok(())
    }

    /// Ends the matrix that is being read: its last row must be whole.
    fn close(&mut self) -> Result<(), MatrixFault> {
        let Some(matrix) = self.matrices.last_mut() else { return Ok(()) };
        if self.next.1 != 0 || self.next.0 == 0 {
            return Err(MatrixFault::Truncated { what: "a row of the triangle" });
        }
        (matrix.rows, matrix.columns) = (self.next.0 as usize, self.next.0 as usize);
        Ok(())
    }

    fn finish(mut self) -> Result<Vec<FileMatrix>, MatrixFault> {
        self.close()?;
        if self.matrices.is_empty() {
            return Err(MatrixFault::Truncated { what: "the search for *MATRIX" });
        }
        let count = self.label_count();
        let fits = self.matrices.iter().any(|matrix| matrix.rows == count);
        let labels = if fits { self.labels() } else { Vec::new() };
        let precision = self.digits.precision();
        for matrix in &mut self.matrices {
            if labels.len() == matrix.rows {
                matrix.labels.clone_from(&labels);
            }
            matrix.precision = precision;
        }
        Ok(self.matrices)
    }

    /// How many labels there are; a short file may declare millions of nodes.
    fn label_count(&self) -> usize {
        let ends = self.directions.iter().skip(1).map(|(from, _)| *from).chain([self.declared as i64 + 1]);
        let counts =
            self.directions.iter().zip(ends).map(|((from, own), end)| (end - from) as usize * own.len());
        counts.sum()
    }

    fn labels(&self) -> Vec<RowLabel> {
        let mut labels = Vec::new();
        for place in 1..=self.declared as i64 {
            let node = self.nodes.get(place as usize - 1).copied().unwrap_or(place);
            let holds = self.directions.iter().rfind(|(from, _)| *from <= place);
            let directions = holds.map_or(&[][..], |(_, directions)| directions);
            labels.extend(
                directions.iter().map(|&number| RowLabel::physical(node, Direction::numbered(number))),
            );
        }
        labels
    }
}
