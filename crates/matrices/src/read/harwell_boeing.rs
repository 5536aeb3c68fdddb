//! Harwell-Boeing: real assembled matrices, symmetric or not, in fixed columns.
//!
//! # Source
//! I. Duff, R. Grimes, J. Lewis, "Users' Guide for the Harwell-Boeing Sparse Matrix Collection" (1992).

use std::io::BufRead;

use hammerbeam_structure::Entry;

use super::text::{Digits, Lines, number, shown, whole, words};
use crate::{
    error::{MatrixFault, PlacedFault},
    matrix::{FileMatrix, MOST_ROWS},
};

/// Numbers of a line and the columns of each.
#[derive(Clone, Copy)]
struct Layout {
    count: usize,
    width: usize,
}

struct Header {
    name: String,
    symmetric: bool,
    rows: usize,
    columns: usize,
    entries: i64,
    layouts: [Layout; 3],
}

pub(crate) fn read<R: BufRead>(source: R) -> Result<FileMatrix, PlacedFault> {
    let mut lines = Lines::new(source);
    let header = header(&mut lines)?;
    let place = lines.place();
    let [of_starts, of_rows, of_values] = header.layouts;
    let starts = wholes(&mut lines, of_starts, header.columns as i64 + 1, (1, header.entries + 1))?;
    let rows = wholes(&mut lines, of_rows, header.entries, (1, header.rows as i64))?;
    let ordered = starts.windows(2).all(|pair| pair[0] <= pair[1]);
    if !ordered || starts.first() != Some(&1) || starts.last() != Some(&(header.entries + 1)) {
        let expected = "ascending starts of columns, from 1 to one more than there are entries";
        return Err(MatrixFault::Unexpected { expected, found: "others".into() }.at(lines.place()));
    }
    let mut digits = Digits::default();
    let mut entries = Vec::new();
    let mut column = 0;
    each_field(&mut lines, of_values, header.entries, |place, word| {
        digits.see(word);
        while starts[column + 1] <= place as i64 + 1 {
            column += 1;
        }
        let row = (rows[place] - 1) as u32;
        entries.push(Entry { row, column: column as u32, value: number(word, "an entry")? });
        Ok(())
    })?;
    Ok(FileMatrix {
        name: header.name,
        rows: header.rows,
        columns: header.columns,
        entries,
        one_triangle: header.symmetric,
        is_sized: true,
        precision: digits.precision(),
        labels: Vec::new(),
        place,
    })
}

fn header<R: BufRead>(lines: &mut Lines<R>) -> Result<Header, PlacedFault> {
    let title = lines.required("the title")?;
    let name = String::from_utf8_lossy(title.get(72..).unwrap_or_default()).trim().to_owned();
    let counts: Vec<Vec<u8>> = words(lines.required("the numbers of lines")?).map(<[u8]>::to_vec).collect();
    let of_right_sides = counts.get(4).map_or(Ok(0), |word| whole(word, "a number of lines"));
    let right_sides = of_right_sides.map_err(|fault| fault.at(lines.place()))?;
    let line = lines.required("the type of the matrix")?;
    let kind = String::from_utf8_lossy(line.get(..3).unwrap_or_default()).to_ascii_uppercase();
    let sizes: Result<Vec<i64>, MatrixFault> =
        words(line.get(3..).unwrap_or_default()).take(3).map(|word| whole(word, "a size")).collect();
    let found = shown(line);
    let checked = sizes.and_then(|sizes| checked(&kind, &sizes, found));
    let (symmetric, rows, columns, entries) = checked.map_err(|fault| fault.at(lines.place()))?;
    let formats = lines.required("the formats")?;
    let format = |start: usize, width: usize| {
        let start = start.min(formats.len());
        let text = &formats[start..(start + width).min(formats.len())];
        layout(&String::from_utf8_lossy(text))
            .ok_or_else(|| MatrixFault::Unexpected { expected: "a Fortran format", found: shown(text) })
    };
    let layouts = (|| Ok([format(0, 16)?, format(16, 16)?, format(32, 20)?]))();
    let layouts = layouts.map_err(|fault: MatrixFault| fault.at(lines.place()))?;
    if right_sides > 0 {
        lines.required("the format of right sides")?;
    }
    Ok(Header { name, symmetric, rows, columns, entries, layouts })
}

/// Whether it is symmetric, rows, columns and entries.
fn checked(kind: &str, sizes: &[i64], found: String) -> Result<(bool, usize, usize, i64), MatrixFault> {
    let unsupported = |what: &str, instead| Err(MatrixFault::Unsupported { what: what.to_owned(), instead });
    let symmetric = match kind {
        "RSA" => true,
        "RUA" | "RRA" => false,
        kind if kind.starts_with('P') => return unsupported("a pattern without values", "write the values"),
        kind if kind.starts_with('C') => return unsupported("a complex matrix", "write its real part"),
        kind if kind.ends_with('E') => return unsupported("a matrix in elements", "assemble it"),
        kind if kind.starts_with("RZ") => {
            return unsupported("a skew-symmetric matrix", "write a symmetric one");
        }
        _ => return Err(MatrixFault::Unexpected { expected: "RSA or RUA", found }),
    };
    let &[rows, columns, entries] = sizes else {
        return Err(MatrixFault::Unexpected { expected: "rows, columns and entries", found });
    };
    for (found, most) in [(rows, MOST_ROWS as i64), (columns, MOST_ROWS as i64), (entries, i64::MAX - 1)] {
        if !(0..=most).contains(&found) {
            let what = "a number of rows, columns or entries";
            return Err(MatrixFault::OutOfRange { what, found, allowed: format!("0 to {most}") });
        }
    }
    Ok((symmetric, rows as usize, columns as usize, entries))
}

/// The layout of a format such as `(16I5)`, `(1P,4E20.12)`, `(1P5D16.8)`.
fn layout(format: &str) -> Option<Layout> {
    let inner = format.trim().trim_start_matches('(').trim_end_matches(')').to_ascii_uppercase();
    let part = inner.rsplit(['P', ',']).next()?.trim();
    let letter = part.find(['I', 'E', 'D', 'F', 'G'])?;
    let count = if letter == 0 { 1 } else { part[..letter].trim().parse().ok()? };
    let width = part[letter + 1..].split(['.', '(']).next()?.trim().parse().ok()?;
    ((1..=1000).contains(&count) && (1..=64).contains(&width)).then_some(Layout { count, width })
}

/// Whole numbers within a range.
fn wholes<R: BufRead>(
    lines: &mut Lines<R>,
    layout: Layout,
    count: i64,
    (least, most): (i64, i64),
) -> Result<Vec<i64>, PlacedFault> {
    let mut numbers = Vec::new();
    each_field(lines, layout, count, |_, word| {
        let found = whole(word, "an index")?;
        if !(least..=most).contains(&found) {
            let allowed = format!("{least} to {most}");
            return Err(MatrixFault::OutOfRange { what: "an index", found, allowed });
        }
        numbers.push(found);
        Ok(())
    })?;
    Ok(numbers)
}

/// Visits so many fields with their number. Where a line has as many words as fields, these are they: some
/// programs write other columns than their format says. Else numbers may stand without a blank between them.
fn each_field<R: BufRead>(
    lines: &mut Lines<R>,
    layout: Layout,
    count: i64,
    mut visit: impl FnMut(usize, &[u8]) -> Result<(), MatrixFault>,
) -> Result<(), PlacedFault> {
    let mut done = 0_usize;
    while (done as i64) < count {
        let line = lines.required("the numbers of the matrix")?;
        let on_line = ((count - done as i64) as usize).min(layout.count);
        let words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let visited = if words.clone().take(on_line + 1).count() == on_line {
            words.enumerate().try_for_each(|(field, word)| visit(done + field, word))
        } else {
            (0..on_line).try_for_each(|field| {
                let start = (field * layout.width).min(line.len());
                visit(done + field, &line[start..(start + layout.width).min(line.len())])
            })
        };
        visited.map_err(|fault| fault.at(lines.place()))?;
        done += on_line;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_of_fortran_are_understood() {
        let found = |format| layout(format).map(|layout| (layout.count, layout.width));
        assert_eq!(found("(16I5)          "), Some((16, 5)));
        assert_eq!(found("(1P,4E20.12)"), Some((4, 20)));
        assert_eq!(found("(1P5D16.8)"), Some((5, 16)));
        assert_eq!(found("(I8)"), Some((1, 8)));
        assert_eq!(found("(*)"), None);
    }
}
