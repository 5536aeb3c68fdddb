//! Tables as one JSON document: of each table its columns, of each column its entries.

use std::{
    io::{self, Write},
    path::Path,
};

use super::{ArrayTable, ArrayValues};
use crate::{
    export::ExportError,
    whole_file::{WholeFile, WriteError},
};

/// Writes `{"table": {"column": [entry, ...], ...}, ...}`; complex numbers are pairs, and what is no number
/// is null.
///
/// # Errors
/// [`ExportError::Write`].
pub fn write_json(tables: &[ArrayTable], path: &Path) -> Result<(), ExportError> {
    let failed = |source| WriteError { path: path.to_owned(), source };
    let mut file = WholeFile::begin(path)?;
    write(tables, &mut file).map_err(failed)?;
    file.finish()?;
    Ok(())
}

fn write(tables: &[ArrayTable], out: &mut impl Write) -> io::Result<()> {
    for (table, mark) in tables.iter().zip(marks("{\n")) {
        write!(out, "{mark}{}: ", text(&table.name))?;
        for (column, mark) in table.columns.iter().zip(marks("{\n")) {
            write!(out, "{mark}{}: ", text(&column.name))?;
            write_values(&column.values, out)?;
        }
        out.write_all(b"}")?;
    }
    out.write_all(if tables.is_empty() { b"{}\n" } else { b"\n}\n" })
}

fn write_values(values: &ArrayValues, out: &mut impl Write) -> io::Result<()> {
    match values {
        ArrayValues::Numbers(values) => list(values.iter().map(|value| number(*value)), out),
        ArrayValues::Whole(values) => list(values.iter().map(whole), out),
        ArrayValues::Flags(values) => list(values.iter().map(bool::to_string), out),
        ArrayValues::Words(words) => list(words.iter().map(|word| text(word)), out),
        ArrayValues::Vectors { width, values } => {
            let row = |row: &[f64]| joined(row.iter().map(|value| number(*value)));
            list(values.chunks((*width).max(1)).map(row), out)
        }
        ArrayValues::Complex { width, values } => {
            let pair = |[re, im]: &[f64; 2]| joined([number(*re), number(*im)].into_iter());
            list(values.chunks((*width).max(1)).map(|row| joined(row.iter().map(pair))), out)
        }
    }
}

fn list(entries: impl Iterator<Item = String>, out: &mut impl Write) -> io::Result<()> {
    out.write_all(b"[")?;
    for (number, entry) in entries.enumerate() {
        write!(out, "{}{entry}", if number == 0 { "" } else { "," })?;
    }
    out.write_all(b"]")
}

fn joined(entries: impl Iterator<Item = String>) -> String {
    format!("[{}]", entries.collect::<Vec<_>>().join(","))
}

/// What stands in front of the first entry, and in front of the others.
fn marks(first: &'static str) -> impl Iterator<Item = &'static str> {
    std::iter::once(first).chain(std::iter::repeat(",\n"))
}

fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { "null".to_owned() }
}

fn whole(value: &i64) -> String {
    if *value < 0 { "null".to_owned() } else { value.to_string() }
}

fn text(words: &str) -> String {
    serde_json::Value::from(words).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrays::named;

    #[test]
    fn the_document_has_the_entries_of_each_column() {
        let columns = named([
            ("row", ArrayValues::Whole(vec![0, -1])),
            ("x", ArrayValues::Numbers(vec![1e-300, f64::INFINITY])),
            ("word", ArrayValues::Words(vec!["a \"b\"".into(), "".into()])),
            ("z", ArrayValues::complex(&[vec![[1.0, -2.0]], vec![[0.5, 0.0]]])),
        ]);
        let mut out = Vec::new();
        write(&[ArrayTable::new("one", columns), ArrayTable::new("two", Vec::new())][..1], &mut out).unwrap();
        let found: serde_json::Value = serde_json::from_slice(&out).unwrap();
        let expected = serde_json::json!({ "one": {
            "row": [0, null],
            "x": [1e-300, null],
            "word": ["a \"b\"", ""],
            "z": [[[1.0, -2.0]], [[0.5, 0.0]]],
        }});
        assert_eq!(found, expected);
        out.clear();
        write(&[], &mut out).unwrap();
        assert_eq!(out, b"{}\n");
    }
}
