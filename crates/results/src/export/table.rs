//! Tables of comma-separated values.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use super::error::ExportError;
use crate::whole_file::{WholeFile, WriteError};

/// A table that is being written; it gets its name when it is finished.
#[derive(Debug)]
pub struct Table {
    file: WholeFile,
}

impl Table {
    /// Begins a table in a folder, which is made if it is not there.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn begin(folder: &Path, name: &str, header: &[String]) -> Result<Self, ExportError> {
        let mut table = Self { file: WholeFile::begin(&folder.join(name))? };
        table.row(header)?;
        Ok(table)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn row(&mut self, entries: &[String]) -> Result<(), ExportError> {
        let written = writeln!(self.file, "{}", entries.join(","));
        Ok(written.map_err(|source| WriteError { path: self.file.path().to_owned(), source })?)
    }

    /// Gives the table its name.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn finish(self) -> Result<PathBuf, ExportError> {
        Ok(self.file.finish()?)
    }
}

/// Writes a file that appears complete or not at all.
pub(super) fn write_whole<T>(
    path: &Path,
    write: impl FnOnce(&mut WholeFile) -> Result<T, ExportError>,
) -> Result<T, ExportError> {
    let mut file = WholeFile::begin(path)?;
    let written = write(&mut file)?;
    file.finish()?;
    Ok(written)
}

/// A number in full precision; nothing if there is none.
#[must_use]
pub fn number(value: impl Into<Option<f64>>) -> String {
    value.into().map_or_else(String::new, |value| format!("{value:e}"))
}

/// What is shown of something that may not be there.
pub(super) fn optional(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// A text in which a comma, a quotation mark or an end of line would change the columns, in quotation marks.
pub(crate) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// A header from plain words.
#[must_use]
pub fn header(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

/// A word that may stand in a table: no comma, no quotation mark, no blank.
#[must_use]
pub fn word(text: &str) -> String {
    text.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Neither a table that is given up nor one that cannot get its name.
    #[test]
    fn an_unfinished_table_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let begin = |name| Table::begin(folder.path(), name, &header(&["a"])).unwrap();
        let names = || fs::read_dir(folder.path()).unwrap().count();
        let given_up = begin("a.csv");
        assert_eq!(names(), 1);
        drop(given_up);
        assert_eq!(names(), 0);
        fs::create_dir(folder.path().join("b.csv")).unwrap();
        fs::write(folder.path().join("b.csv/mine"), "").unwrap();
        assert!(begin("b.csv").finish().is_err());
        assert_eq!(names(), 1);
        begin("c.csv").finish().unwrap();
        assert_eq!(names(), 2);
    }
}
