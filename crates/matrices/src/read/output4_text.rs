//! Nastran OUTPUT4 in text: see [`super::output4`].
//!
//! Headers have four whole numbers of 8 columns (16 in files of large models), the name in 8 columns, and the
//! Fortran format of the values, such as `1P,3E23.16`.

use std::io::BufRead;

use super::{
    output4::Output4Matrix,
    text::{Digits, Lines, number, shown, whole},
};
use crate::{
    error::{MatrixFault, PlacedFault},
    matrix::FileMatrix,
};

/// How the values of a matrix stand on their lines.
#[derive(Clone, Copy)]
struct Layout {
    /// Columns of a whole number.
    whole: usize,
    /// Values of a line.
    count: usize,
    /// Columns of a value.
    width: usize,
}

pub(crate) fn read<R: BufRead>(source: R) -> Result<Vec<FileMatrix>, PlacedFault> {
    let mut lines = Lines::new(source);
    let mut matrices = Vec::new();
    while let Some(line) = lines.next()? {
        if line.iter().all(|byte| *byte == b' ') {
            continue;
        }
        let header = header(line);
        let place = lines.place();
        let (name, numbers, layout) = header.map_err(|fault| fault.at(place))?;
        let mut matrix = Output4Matrix::new(&name, numbers, place).map_err(|fault| fault.at(place))?;
        let mut digits = Digits::default();
        while column(&mut lines, &mut matrix, layout, &mut digits)? {}
        matrices.extend(matrix.finished(digits.precision()));
    }
    if matrices.is_empty() {
        return Err(MatrixFault::Truncated { what: "the search for a real matrix" }.at(lines.end()));
    }
    Ok(matrices)
}

/// Name, the four numbers, and the layout of the values.
fn header(line: &[u8]) -> Result<(String, [i64; 4], Layout), MatrixFault> {
    let attempt = |width: usize| -> Result<(String, [i64; 4], Layout), MatrixFault> {
        let mut numbers = [0; 4];
        for (place, number) in numbers.iter_mut().enumerate() {
            let field = line.get(place * width..(place + 1) * width).unwrap_or_default();
            *number = whole(field, "a number of the header")?;
        }
        let rest = line.get(4 * width..).unwrap_or_default();
        let (name, format) = rest.split_at(rest.len().min(8));
        let (count, value_width) = layout(&String::from_utf8_lossy(format));
        let name = String::from_utf8_lossy(name).trim().to_owned();
        Ok((name, numbers, Layout { whole: width, count, width: value_width }))
    };
    attempt(8).or_else(|fault| attempt(16).map_err(|_| fault))
}

/// Values of a line and their width of a format such as `1P,3E23.16`; `5E16.9` where there is none.
fn layout(format: &str) -> (usize, usize) {
    let of = |format: &str| -> Option<(usize, usize)> {
        let part = format.split([',', 'P', 'p']).rfind(|part| !part.trim().is_empty())?;
        let letter = part.find(['E', 'D', 'e', 'd', 'F', 'G'])?;
        let count = part[..letter].trim().parse().ok()?;
        let width = part[letter + 1..].split('.').next()?.trim().parse().ok()?;
        ((1..=64).contains(&count) && (1..=64).contains(&width)).then_some((count, width))
    };
    of(format).unwrap_or((5, 16))
}

/// Reads a column; false for the one that ends the matrix.
fn column<R: BufRead>(
    lines: &mut Lines<R>,
    matrix: &mut Output4Matrix,
    layout: Layout,
    digits: &mut Digits,
) -> Result<bool, PlacedFault> {
    let [number, row, words] = wholes(lines, layout, "a column")?;
    let place = lines.place();
    let column = matrix.column(number).map_err(|fault| fault.at(place))?;
    let per_number = if matrix.is_double() { 2 } else { 1 };
    if row > 0 {
        // Of dense columns files count numbers, not words.
        values(lines, matrix, layout, digits, (column, row, words))?;
        return Ok(column.is_some());
    }
    let mut left = words;
    while left > 0 {
        let (head, length, row) = if matrix.big {
            let [length, row] = wholes(lines, layout, "a string of values")?;
            (2, length - 1, row)
        } else {
            let [packed] = wholes(lines, layout, "a string of values")?;
            (1, packed / 65536 - 1, packed % 65536)
        };
        let place = lines.place();
        if length < 0 || head + length > left {
            let allowed = format!("1 to {}", left - head + 1);
            let found = length + 1;
            return Err(MatrixFault::OutOfRange { what: "the length of a string", found, allowed }.at(place));
        }
        values(lines, matrix, layout, digits, (column, row, length / per_number))?;
        left -= head + length;
    }
    Ok(column.is_some())
}

/// The whole numbers of a line.
fn wholes<R: BufRead, const N: usize>(
    lines: &mut Lines<R>,
    layout: Layout,
    what: &'static str,
) -> Result<[i64; N], PlacedFault> {
    let line = lines.required(what)?;
    let mut numbers = [0; N];
    let mut read = Ok(());
    for (place, number) in numbers.iter_mut().enumerate() {
        let start = (place * layout.whole).min(line.len());
        let field = &line[start..(start + layout.whole).min(line.len())];
        match whole(field, "a number of a column") {
            Ok(found) => *number = found,
            Err(fault) => read = Err(fault),
        }
    }
    read.map_err(|fault| fault.at(lines.place())).map(|()| numbers)
}

/// Reads the numbers of a string: column, first row, how many. Those of the last column are passed over.
fn values<R: BufRead>(
    lines: &mut Lines<R>,
    matrix: &mut Output4Matrix,
    layout: Layout,
    digits: &mut Digits,
    (column, row, count): (Option<u32>, i64, i64),
) -> Result<(), PlacedFault> {
    let parts = matrix.parts();
    let first = match column {
        None => 0,
        Some(_) => matrix.string(row, count / parts as i64).map_err(|fault| fault.at(lines.place()))?,
    };
    let mut left = count.max(0) as usize;
    let mut place = 0;
    while left > 0 {
        let line = lines.required("the values of a column")?;
        let on_line = left.min(layout.count);
        let mut taken = Ok(());
        for field in 0..on_line {
            let start = (field * layout.width).min(line.len());
            let word = &line[start..(start + layout.width).min(line.len())];
            digits.see(word);
            let kept = number(word, "an entry").and_then(|value| match column {
                Some(column) => matrix.push(first + (place / parts) as u32, column, value),
                None => Ok(()),
            });
            place += 1;
            if let Err(fault) = kept {
                taken = Err(if line.is_empty() {
                    MatrixFault::Unexpected { expected: "values", found: shown(line) }
                } else {
                    fault
                });
                break;
            }
        }
        taken.map_err(|fault| fault.at(lines.place()))?;
        left -= on_line;
    }
    Ok(())
}
