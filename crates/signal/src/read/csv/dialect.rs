//! Separator and decimal sign of a file.

use std::borrow::Cow;

use super::{Line, number};

/// How rows are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Dialect {
    /// The separator; `None` for any number of blanks.
    separator: Option<char>,
    /// Whether the decimal sign is a comma.
    pub decimal_comma: bool,
}

/// In the order in which they are preferred where a file reads the same with several.
const DIALECTS: [Dialect; 7] = [
    Dialect { separator: Some('\t'), decimal_comma: false },
    Dialect { separator: Some('\t'), decimal_comma: true },
    Dialect { separator: Some(';'), decimal_comma: false },
    Dialect { separator: Some(';'), decimal_comma: true },
    Dialect { separator: Some(','), decimal_comma: false },
    Dialect { separator: None, decimal_comma: false },
    Dialect { separator: None, decimal_comma: true },
];

/// Rows that are looked at.
const LOOKED_AT: usize = 200;

impl Dialect {
    /// That of a table whose titles are known: the separator that stands in them most often. A decimal comma is read wherever it does not separate.
    pub(super) fn of_titles(titles: &str) -> Self {
        let count = |separator: char| titles.matches(separator).count();
        let most = ['\t', ';', ','].into_iter().rev().max_by_key(|separator| count(*separator));
        let separator = most.filter(|separator| count(*separator) > 0);
        Self { separator, decimal_comma: separator != Some(',') }
    }

    /// Fields of a row, without their quotation marks.
    pub(super) fn split<'a>(self, line: &'a str) -> Vec<Cow<'a, str>> {
        match self.separator {
            None => line.split_whitespace().map(Cow::Borrowed).collect(),
            Some(separator) if line.contains('"') => quoted(line, separator),
            Some(separator) => line.split(separator).map(|field| Cow::Borrowed(field.trim())).collect(),
        }
    }

    /// Whether all fields of a row are numbers or nothing, and at least one is a number.
    pub(super) fn is_row(self, line: &str) -> bool {
        let values: Option<Vec<f64>> =
            self.split(line).iter().map(|field| number::parse(field, self.decimal_comma)).collect();
        values.is_some_and(|values| values.iter().any(|value| !value.is_nan()))
    }
}

/// Fields that may stand in quotation marks; a mark within is doubled.
fn quoted(line: &str, separator: char) -> Vec<Cow<'_, str>> {
    let mut fields = Vec::new();
    let mut field = String::new();
    let mut inside = false;
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '"' if inside && characters.peek() == Some(&'"') => {
                characters.next();
                field.push('"');
            }
            '"' => inside = !inside,
            _ if character == separator && !inside => {
                fields.push(Cow::Owned(field.trim().to_owned()));
                field.clear();
            }
            _ => field.push(character),
        }
    }
    fields.push(Cow::Owned(field.trim().to_owned()));
    fields
}

/// The dialect of a file, and the index of its first row of numbers.
///
/// Each dialect is judged by whether the line before its longest stretch of rows of numbers has as many fields (the titles), then by the length of
/// that stretch among the first lines, then by the width. A single column with decimal commas under a title with commas is none: it would
/// hide that a row of two is too short.
pub(super) fn detect(lines: &[Line]) -> Option<(Dialect, usize)> {
    let looked_at = &lines[..lines.len().min(LOOKED_AT)];
    let mut best: Option<((bool, usize, usize), Dialect, usize)> = None;
    for dialect in DIALECTS {
        let Some((first, length, width)) = stretch(looked_at, dialect) else { continue };
        let titles = first.checked_sub(1).is_some_and(|before| {
            let title = looked_at[before].1;
            dialect.split(title).len() == width
                && !(width == 1 && dialect.decimal_comma && title.contains(','))
        });
        let score = (titles, length, width);
        if best.as_ref().is_none_or(|(other, ..)| score > *other) {
            best = Some((score, dialect, first));
        }
    }
    best.map(|(_, dialect, first)| (dialect, first))
}

/// First row, number of rows and width of the longest stretch of rows of numbers.
fn stretch(lines: &[Line], dialect: Dialect) -> Option<(usize, usize, usize)> {
    let mut longest: Option<(usize, usize, usize)> = None;
    let mut current: Option<(usize, usize, usize)> = None;
    for (index, (_, line)) in lines.iter().enumerate() {
        if !dialect.is_row(line) {
            current = None;
            continue;
        }
        let width = dialect.split(line).len();
        current = match current {
            Some((first, length, same)) if same == width => Some((first, length + 1, width)),
            _ => Some((index, 1, width)),
        };
        if longest.is_none_or(|(_, length, _)| current.is_some_and(|current| current.1 > length)) {
            longest = current;
        }
    }
    longest
}
