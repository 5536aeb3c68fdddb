//! Nastran punch files: matrices as `DMIG` cards.
//!
//! The header `DMIG NAME 0 IFO TIN` says whether the matrix is symmetric (IFO 6), square (1) or rectangular
//! (2, 9), and how its numbers are stored (TIN 1 and 2 real, 3 and 4 complex). Each further card is a column:
//! the point and component of the column, an empty field, and for each entry point, component and value. Of a
//! symmetric matrix each pair of mirrored entries stands once. Rows are numbered in the order of points and
//! components, those of all square matrices of the file together; component 0 is a scalar point.
//!
//! # Source
//! MSC Nastran Quick Reference Guide, "DMIG".

use std::{
    collections::{BTreeMap, BTreeSet},
    io::BufRead,
};

use hammerbeam_structure::{Direction, Entry, RowLabel};

use super::{
    cards::{Card, next_card},
    text::{Digits, Lines, number, whole},
};
use crate::{
    error::{FilePlace, MatrixFault, PlacedFault},
    matrix::FileMatrix,
};

/// Matrices of a file: each takes the labels of all its rows.
const MOST_MATRICES: usize = 1000;
/// Labels of all rows of all matrices of a file.
const MOST_LABELS: usize = 10_000_000;

/// A point and its component.
type Freedom = (i64, i64);

struct Dmig {
    name: String,
    symmetric: bool,
    square: bool,
    complex: bool,
    entries: Vec<(Freedom, Freedom, f64)>,
    digits: Digits,
    place: FilePlace,
}

pub(crate) fn read<R: BufRead>(source: R) -> Result<Vec<FileMatrix>, PlacedFault> {
    let mut lines = Lines::new(source);
    let mut matrices: Vec<Dmig> = Vec::new();
    while let Some(card) = next_card(&mut lines, &["DMIG"])? {
        take(&mut matrices, &card).map_err(|fault| fault.at(card.place))?;
    }
    if matrices.is_empty() {
        return Err(MatrixFault::Truncated { what: "the search for a DMIG card" }.at(lines.end()));
    }
    numbered(matrices)
}

fn take(matrices: &mut Vec<Dmig>, card: &Card) -> Result<(), MatrixFault> {
    let (name, first) = (card.field(0).to_owned(), card.field(1));
    if first == "0" {
        let form = whole(card.field(2).as_bytes(), "the form of a matrix")?;
        let kind = whole(card.field(3).as_bytes(), "the type of a matrix")?;
        let allowed = |what, found, allowed: &str| {
            Err(MatrixFault::OutOfRange { what, found, allowed: allowed.to_owned() })
        };
        if !matches!(form, 1 | 2 | 6 | 9) {
            return allowed("the form of a matrix", form, "1, 2, 6 or 9");
        }
        if !(1..=4).contains(&kind) {
            return allowed("the type of a matrix", kind, "1 to 4");
        }
        if matrices.len() == MOST_MATRICES {
            return allowed("the number of matrices", MOST_MATRICES as i64 + 1, "1000 in a file");
        }
        matrices.push(Dmig {
            name,
            symmetric: form == 6,
            square: matches!(form, 1 | 6),
            complex: kind > 2,
            entries: Vec::new(),
            digits: Digits::default(),
            place: card.place,
        });
        return Ok(());
    }
    let known = || matrices.iter().map(|matrix| matrix.name.clone()).collect();
    let place = matrices.iter().position(|matrix| matrix.name == name);
    let place = place.ok_or_else(|| MatrixFault::NoSuchMatrix {
        name: format!("{name} before its column"),
        known: known(),
    })?;
    column(&mut matrices[place], card)
}

fn column(matrix: &mut Dmig, card: &Card) -> Result<(), MatrixFault> {
    if matrix.complex {
        return Ok(());
    }
    let freedom = |point: usize| -> Result<Freedom, MatrixFault> {
        let component = card.field(point + 1);
        let component = if component.is_empty() { 0 } else { whole(component.as_bytes(), "a component")? };
        Ok((whole(card.field(point).as_bytes(), "a point")?, component))
    };
    let column = freedom(1)?;
    // Fields 4 to 7 are an entry, an empty field before them; further entries have four fields each.
    for start in (4..card.fields.len()).step_by(4) {
        if card.field(start).is_empty() {
            continue;
        }
        let value = card.field(start + 2);
        matrix.digits.see(value.as_bytes());
        matrix.entries.push((freedom(start)?, column, number(value.as_bytes(), "an entry")?));
    }
    Ok(())
}

fn numbered(matrices: Vec<Dmig>) -> Result<Vec<FileMatrix>, PlacedFault> {
    let square = || matrices.iter().filter(|matrix| matrix.square && !matrix.complex);
    let freedoms: BTreeSet<Freedom> =
        square().flat_map(|matrix| &matrix.entries).flat_map(|&(row, column, _)| [row, column]).collect();
    let rows: BTreeMap<Freedom, u32> = freedoms.iter().copied().zip(0..).collect();
    let (all, place) = (square().count() * rows.len(), matrices[0].place);
    if all > MOST_LABELS {
        let allowed = format!("at most {MOST_LABELS}");
        let what = "the number of rows of all matrices";
        return Err(MatrixFault::OutOfRange { what, found: all as i64, allowed }.at(place));
    }
    let label = |&(point, component): &Freedom| match component {
        0 => RowLabel::modal(point),
        _ => RowLabel::physical(point, Direction::numbered(component)),
    };
    let labels: Vec<RowLabel> = freedoms.iter().map(label).collect();
    let matrix = |dmig: &Dmig| FileMatrix {
        name: dmig.name.clone(),
        rows: rows.len(),
        columns: rows.len(),
        entries: dmig
            .entries
            .iter()
            .map(|(row, column, value)| Entry { row: rows[row], column: rows[column], value: *value })
            .collect(),
        one_triangle: dmig.symmetric,
        is_sized: true,
        precision: dmig.digits.precision(),
        labels: labels.clone(),
        place: dmig.place,
    };
    Ok(square().map(matrix).collect())
}
