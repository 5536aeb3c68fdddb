//! Files that appear complete or not at all, and tables of comma-separated values in them.

use std::{
    fs::{self, File},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};

use super::ExportError;

/// A file that is written beside its place and moved there when it is finished; what is not finished leaves nothing behind.
#[derive(Debug)]
pub(super) struct WholeFile {
    path: PathBuf,
    /// Closed before its part is removed, as fields are let go in their order.
    pub writer: BufWriter<File>,
    part: Part,
}

impl WholeFile {
    /// Begins a file; its folder is made if it is not there.
    pub fn begin(path: PathBuf) -> Result<Self, ExportError> {
        let unfinished = path.with_extension("csv.part");
        let folder = path.parent().unwrap_or_else(|| Path::new("."));
        match fs::create_dir_all(folder).and_then(|()| File::create(&unfinished)) {
            Ok(file) => Ok(Self { path, writer: BufWriter::new(file), part: Part(Some(unfinished)) }),
            Err(source) => Err(ExportError::Write { path, source }),
        }
    }

    /// Moves the file to its place.
    pub fn finish(self) -> Result<PathBuf, ExportError> {
        let Self { path, writer, part } = self;
        let moved = writer
            .into_inner()
            .map_err(io::IntoInnerError::into_error)
            .and_then(|file| file.sync_all())
            .and_then(|()| part.rename(&path));
        match moved {
            Ok(()) => Ok(path),
            Err(source) => Err(ExportError::Write { path, source }),
        }
    }
}

/// A file that goes away unless it gets another name.
#[derive(Debug)]
struct Part(Option<PathBuf>);

impl Part {
    fn rename(mut self, to: &Path) -> io::Result<()> {
        if let Some(from) = &self.0 {
            fs::rename(from, to)?;
        }
        self.0 = None;
        Ok(())
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if let Some(path) = &self.0 {
            // Nothing better can be done where that fails.
            fs::remove_file(path).ok();
        }
    }
}

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
        let mut table = Self { file: WholeFile::begin(folder.join(name))? };
        table.row(header)?;
        Ok(table)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn row(&mut self, entries: &[String]) -> Result<(), ExportError> {
        writeln!(self.file.writer, "{}", entries.join(","))
            .map_err(|source| ExportError::Write { path: self.file.path.clone(), source })
    }

    /// Gives the table its name.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn finish(self) -> Result<PathBuf, ExportError> {
        self.file.finish()
    }
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
pub(super) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
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
