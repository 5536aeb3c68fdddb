//! Separator and decimal sign of a file.

use std::borrow::Cow;

use super::{lines::NumberedLine, number};

/// How rows are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Dialect {
    /// The separator; `None` for any number of blanks.
    separator: Option<char>,
    /// Whether the decimal sign is a comma.
    pub decimal_comma: bool,
}

/// All dialects, in order of preference where several suit a file equally well.
const DIALECTS: [Dialect; 7] = [
    Dialect { separator: Some('\t'), decimal_comma: false },
    Dialect { separator: Some('\t'), decimal_comma: true },
    Dialect { separator: Some(';'), decimal_comma: false },
    Dialect { separator: Some(';'), decimal_comma: true },
    Dialect { separator: Some(','), decimal_comma: false },
    Dialect { separator: None, decimal_comma: false },
    Dialect { separator: None, decimal_comma: true },
];

/// Rows that are examined.
const EXAMINED: usize = 200;

impl Dialect {
    /// The dialect of a table with known titles: the separator that is most frequent in them. The decimal
    /// sign may be a comma unless it separates.
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

    /// Number of fields, if all of them are numbers or missing and at least one is a number.
    pub(super) fn width_of_row(self, line: &str) -> Option<usize> {
        let fields = self.split(line);
        let mut numbers = false;
        for field in &fields {
            numbers |= !number::parse(field, self.decimal_comma)?.is_nan();
        }
        numbers.then_some(fields.len())
    }

    /// Whether rows of two columns separated by commas could also be one column of numbers with decimal
    /// commas.
    pub(super) fn may_be_decimal(self, rows: &[NumberedLine]) -> bool {
        self.separator == Some(',') && rows.iter().all(|(_, line)| halves(line).is_some())
    }

    /// Whether they must be one column: no whole number is written as 007.
    fn is_decimal(self, rows: &[NumberedLine]) -> bool {
        self.may_be_decimal(rows)
            && rows.iter().any(|(_, line)| {
                halves(line).is_some_and(|[_, decimals]| decimals.len() > 1 && decimals.starts_with('0'))
            })
    }

    /// Whether a line holds the titles of `width` columns: it is not a row of numbers in any dialect, and has
    /// no commas above a single column.
    fn has_titles(self, line: &str, width: usize) -> bool {
        self.split(line).len() == width
            && !(width == 1 && line.contains(','))
            && DIALECTS.iter().all(|dialect| dialect.width_of_row(line).is_none())
    }
}

/// Digits before and after the comma of a line that holds nothing else.
fn halves(line: &str) -> Option<[&str; 2]> {
    let (whole, decimals) = line.trim().split_once(',')?;
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    (digits(whole.strip_prefix('-').unwrap_or(whole)) && digits(decimals)).then_some([whole, decimals])
}

/// Fields that may be in quotation marks; a mark within is doubled.
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

/// The dialect of a file.
///
/// The best dialect is chosen by three criteria in this order: the line before its first row of numbers has
/// as many fields (the titles); the longest run of rows among the first lines; the width.
///
/// # Returns
/// The dialect, the index of the first row of numbers with the width of the longest run, and that width. The
/// reader refuses lines that interrupt the rows after it.
pub(super) fn detect(lines: &[NumberedLine]) -> Option<(Dialect, usize, usize)> {
    let examined = &lines[..lines.len().min(EXAMINED)];
    let mut best: Option<((bool, usize, usize), Dialect, usize)> = None;
    for dialect in DIALECTS {
        let Some((length, width)) = longest_run(examined, dialect) else { continue };
        let Some(first) = examined.iter().position(|(_, line)| dialect.width_of_row(line) == Some(width))
        else {
            continue;
        };
        let above = first.checked_sub(1).map(|before| examined[before].1);
        // Commas in the line above are separators. As decimal signs of a single column they would hide that a
        // row of two is too short.
        if width == 1 && dialect.decimal_comma && above.is_some_and(|above| above.contains(',')) {
            continue;
        }
        if above.is_none() && dialect.is_decimal(examined) {
            continue;
        }
        let titles = above.is_some_and(|above| dialect.has_titles(above, width));
        let score = (titles, length, width);
        if best.as_ref().is_none_or(|(other, ..)| score > *other) {
            best = Some((score, dialect, first));
        }
    }
    best.map(|((_, _, width), dialect, first)| (dialect, first, width))
}

/// Number of rows and width of the longest run of rows of numbers.
fn longest_run(lines: &[NumberedLine], dialect: Dialect) -> Option<(usize, usize)> {
    let mut longest: Option<(usize, usize)> = None;
    let mut current: Option<(usize, usize)> = None;
    for (_, line) in lines {
        current = dialect.width_of_row(line).map(|width| match current {
            Some((length, same)) if same == width => (length + 1, width),
            _ => (1, width),
        });
        if longest.is_none_or(|(length, _)| current.is_some_and(|current| current.0 > length)) {
            longest = current;
        }
    }
    longest
}
