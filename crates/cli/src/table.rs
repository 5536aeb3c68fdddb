//! Tables of comma-separated values, written row by row.

use std::{
    fs::{self, File},
    io::{BufWriter, Write},
    path::{Path, PathBuf},
};

use anyhow::Context;

/// A table that is being written; it gets its name when it is finished, so that it is there whole or not at all.
#[derive(Debug)]
pub struct Table {
    path: PathBuf,
    unfinished: PathBuf,
    file: BufWriter<File>,
}

impl Table {
    /// Begins a table in a folder, which is made if it is not there.
    pub fn begin(folder: &Path, name: &str, header: &[String]) -> anyhow::Result<Self> {
        let path = folder.join(name);
        let unfinished = path.with_extension("part");
        let file = fs::create_dir_all(folder)
            .and_then(|()| File::create(&unfinished))
            .with_context(|| format!("cannot write {}", path.display()))?;
        let mut table = Self { path, unfinished, file: BufWriter::new(file) };
        table.row(header)?;
        Ok(table)
    }

    /// Adds a row.
    pub fn row(&mut self, entries: &[String]) -> anyhow::Result<()> {
        writeln!(self.file, "{}", entries.join(","))
            .with_context(|| format!("cannot write {}", self.path.display()))
    }

    /// Gives the table its name.
    pub fn finish(mut self) -> anyhow::Result<PathBuf> {
        self.file
            .flush()
            .and_then(|()| fs::rename(&self.unfinished, &self.path))
            .with_context(|| format!("cannot write {}", self.path.display()))?;
        Ok(self.path)
    }
}

/// A number in full precision; nothing if there is none.
pub fn number(value: impl Into<Option<f64>>) -> String {
    value.into().map_or_else(String::new, |value| format!("{value:e}"))
}

/// A header from plain words.
pub fn header(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

/// A word that may stand in a table: no comma, no quotation mark, no blank.
pub fn word(text: &str) -> String {
    text.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' }).collect()
}
