//! Matrix Market: coordinates or arrays, general, symmetric or skew-symmetric, real or integer.
//!
//! # Source
//! R. Boisvert, R. Pozo, K. Remington, "The Matrix Market exchange formats", NISTIR 5935 (1996).

use std::io::BufRead;

use hammerbeam_structure::Entry;

use super::text::{Digits, Lines, index, number, shown, whole, words};
use crate::{
    error::{MatrixFault, PlacedFault},
    matrix::{FileMatrix, MOST_ROWS},
};

#[derive(Clone, Copy, PartialEq)]
enum Symmetry {
    General,
    Symmetric,
}

struct Header {
    coordinate: bool,
    symmetry: Symmetry,
}

pub(crate) fn read<R: BufRead>(source: R) -> Result<FileMatrix, PlacedFault> {
    let mut lines = Lines::new(source);
    let header = header(lines.required("the first line")?).map_err(|fault| fault.at(lines.place()))?;
    let sizes = sizes(&mut lines, if header.coordinate { 3 } else { 2 })?;
    let place = lines.place();
    let (rows, columns) = (sizes[0], sizes[1]);
    if header.symmetry == Symmetry::Symmetric && rows != columns {
        return Err(MatrixFault::NotSquare { name: String::new(), rows, columns }.at(place));
    }
    let mut digits = Digits::default();
    let entries = if header.coordinate {
        coordinates(&mut lines, &sizes, &mut digits)?
    } else {
        array(&mut lines, &sizes, &header, &mut digits)?
    };
    Ok(FileMatrix {
        name: String::new(),
        rows: rows as usize,
        columns: columns as usize,
        entries,
        one_triangle: header.symmetry == Symmetry::Symmetric,
        is_sized: true,
        precision: digits.precision(),
        labels: Vec::new(),
        place,
    })
}

fn header(line: &[u8]) -> Result<Header, MatrixFault> {
    let text = String::from_utf8_lossy(line).to_lowercase();
    let mut parts = text.split_whitespace().skip(1);
    let unsupported = |what: String, instead| Err(MatrixFault::Unsupported { what, instead });
    match parts.next() {
        Some("matrix") => {}
        other => return unsupported(format!("a \"{}\"", other.unwrap_or_default()), "write a matrix"),
    }
    let coordinate = match parts.next() {
        Some("coordinate") => true,
        Some("array") => false,
        _ => return Err(MatrixFault::Unexpected { expected: "coordinate or array", found: shown(line) }),
    };
    match parts.next() {
        Some("real" | "integer" | "double") => {}
        Some("pattern") => return unsupported("a pattern without values".into(), "write the values"),
        Some("complex") => return unsupported("a complex matrix".into(), "write its real part"),
        _ => return Err(MatrixFault::Unexpected { expected: "real or integer", found: shown(line) }),
    }
    let symmetry = match parts.next() {
        None | Some("general") => Symmetry::General,
        Some("symmetric") => Symmetry::Symmetric,
        Some(other) => return unsupported(format!("a {other} matrix"), "write a symmetric or general one"),
    };
    Ok(Header { coordinate, symmetry })
}

/// The numbers of the line after the comments.
fn sizes<R: BufRead>(lines: &mut Lines<R>, count: usize) -> Result<Vec<u64>, PlacedFault> {
    loop {
        let line = lines.required("the comments")?;
        if line.starts_with(b"%") || words(line).next().is_none() {
            continue;
        }
        let numbers: Result<Vec<i64>, MatrixFault> =
            words(line).map(|word| whole(word, "a number of rows, columns or entries")).collect();
        let found = shown(line);
        let numbers = numbers.map_err(|fault| fault.at(lines.place()))?;
        if numbers.len() != count {
            let expected = if count == 3 { "rows, columns and entries" } else { "rows and columns" };
            return Err(MatrixFault::Unexpected { expected, found }.at(lines.place()));
        }
        let most = [MOST_ROWS as i64, MOST_ROWS as i64, i64::MAX];
        for (&found, most) in numbers.iter().zip(most) {
            if found < 0 || found > most {
                let (what, allowed) = ("a number of rows, columns or entries", format!("0 to {most}"));
                return Err(MatrixFault::OutOfRange { what, found, allowed }.at(lines.place()));
            }
        }
        return Ok(numbers.into_iter().map(|number| number as u64).collect());
    }
}

fn coordinates<R: BufRead>(
    lines: &mut Lines<R>,
    sizes: &[u64],
    digits: &mut Digits,
) -> Result<Vec<Entry>, PlacedFault> {
    let mut entries = Vec::new();
    while let Some(line) = lines.next()? {
        let read = entry(line, sizes, digits);
        entries.extend(read.map_err(|fault| fault.at(lines.place()))?);
    }
    match entries.len() as u64 {
        found if found == sizes[2] => Ok(entries),
        found => {
            let expected = sizes[2];
            Err(MatrixFault::WrongCount { what: "entries", found, expected }.at(lines.end()))
        }
    }
}

/// The entry of a line; `None` of an empty one or a comment.
fn entry(line: &[u8], sizes: &[u64], digits: &mut Digits) -> Result<Option<Entry>, MatrixFault> {
    let mut parts = words(line);
    let Some(row) = parts.next().filter(|word| !word.starts_with(b"%")) else { return Ok(None) };
    let row = index(row, "a row", sizes[0])?;
    let column = index(parts.next().unwrap_or_default(), "a column", sizes[1])?;
    let value = parts.next().unwrap_or_default();
    digits.see(value);
    Ok(Some(Entry { row, column, value: number(value, "an entry")? }))
}

fn array<R: BufRead>(
    lines: &mut Lines<R>,
    sizes: &[u64],
    header: &Header,
    digits: &mut Digits,
) -> Result<Vec<Entry>, PlacedFault> {
    let mut entries = Vec::new();
    for column in 0..sizes[1] {
        let first = if header.symmetry == Symmetry::Symmetric { column } else { 0 };
        for row in first..sizes[0] {
            let line = lines.required("the entries of an array")?;
            let word = words(line).next().unwrap_or_default();
            digits.see(word);
            let value = number(word, "an entry");
            let value = value.map_err(|fault| fault.at(lines.place()))?;
            if value != 0.0 {
                entries.push(Entry { row: row as u32, column: column as u32, value });
            }
        }
    }
    Ok(entries)
}
