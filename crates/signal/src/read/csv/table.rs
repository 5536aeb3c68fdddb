//! Tables whose fields are words as well as numbers.

use super::{dialect::Dialect, number};

/// How the fields of a table are separated.
pub(crate) struct TextTable(Dialect);

impl TextTable {
    /// The separator and the decimal sign by the line of titles.
    pub(crate) fn of_titles(titles: &str) -> Self {
        Self(Dialect::of_titles(titles))
    }

    /// Fields of a line.
    pub(crate) fn fields(&self, line: &str) -> Vec<String> {
        self.0.split(line).iter().map(|field| field.to_string()).collect()
    }

    /// Value of a field: NaN if it is empty or marked as missing, `None` if it is not a number.
    pub(crate) fn number(&self, field: &str) -> Option<f64> {
        number::parse(field, self.0.decimal_comma)
    }
}
