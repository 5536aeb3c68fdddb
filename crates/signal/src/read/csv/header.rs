//! The lines before the first row of numbers: titles, units, comments, a sampling rate.
//!
//! The titles are the last line with as many fields as the rows. If all its fields are units (known ones, in
//! brackets, or empty) and the line before it has as many fields too, it is the row of units and that line
//! holds the titles. Without such a line the last comment is used if it has as many fields, separated like
//! the rows or by blanks. Without titles, channels are named `column 1`, `column 2`, ...

use super::{
    dialect::Dialect,
    lines::{NumberedLine, is_comment},
};
use crate::{title::split_title, unit::unit};

/// The header of a table.
#[derive(Debug)]
pub(super) struct TableHeader {
    /// Name and unit of each column.
    pub titles: Vec<(String, Option<String>)>,
    /// Whether the file has titles.
    pub titled: bool,
    /// A sampling rate given in words [Hz].
    pub rate_hz: Option<f64>,
}

/// Reads the header from the lines before the first row.
pub(super) fn read(before: &[NumberedLine], dialect: Dialect, width: usize) -> TableHeader {
    let rate_hz = before.iter().find_map(|(_, line)| sampling_rate(line));
    let Some((fields, units)) = title_fields(before, dialect, width) else {
        let titles = (1..=width).map(|number| (format!("column {number}"), None)).collect();
        return TableHeader { titles, titled: false, rate_hz };
    };
    let title = |(index, field): (usize, String)| {
        let (name, own) = split_title(&field);
        let below = units.as_ref().map(|units| bare(&units[index])).filter(|unit| !unit.is_empty());
        let name = if name.is_empty() { format!("column {}", index + 1) } else { name };
        match below {
            // With a row of units the whole title is the name, unless it repeats the unit.
            Some(below) if own.as_deref().is_none_or(|own| own != below) => (field, Some(below)),
            Some(below) => (name, Some(below)),
            None => (name, own),
        }
    };
    TableHeader { titles: fields.into_iter().enumerate().map(title).collect(), titled: true, rate_hz }
}

type Fields = Vec<String>;

/// Titles and the row of units, if there are any.
fn title_fields(before: &[NumberedLine], dialect: Dialect, width: usize) -> Option<(Fields, Option<Fields>)> {
    let split =
        |line: &str| -> Fields { dialect.split(line).iter().map(|field| field.to_string()).collect() };
    let mut rows = before
        .iter()
        .rev()
        .filter(|(_, line)| !is_comment(line) && sampling_rate(line).is_none())
        .map(|(_, line)| split(line))
        .take_while(|fields| fields.len() == width && !fields.iter().all(String::is_empty));
    if let Some(last) = rows.next() {
        let units =
            last.iter().all(|field| field.is_empty() || unit(field).is_some() || bare(field) != *field);
        return match rows.next() {
            Some(titles) if units => Some((titles, Some(last))),
            _ => Some((last, None)),
        };
    }
    let comment = before.iter().rev().find(|(_, line)| is_comment(line))?.1;
    let comment = comment.trim().trim_start_matches(['#', '%', '!', '/']).trim();
    [split(comment), comment.split_whitespace().map(str::to_owned).collect()]
        .into_iter()
        .find(|fields| fields.len() == width)
        .map(|fields| (fields, None))
}

/// Text without brackets around it.
fn bare(text: &str) -> String {
    let text = text.trim();
    let inside = [('[', ']'), ('(', ')'), ('{', '}')]
        .iter()
        .find_map(|&(open, close)| text.strip_prefix(open)?.strip_suffix(close));
    inside.unwrap_or(text).trim().to_owned()
}

/// The rate in lines like `Sampling rate: 10 kHz`, `# fs = 2048`, `Sample frequency [Hz];1000`.
fn sampling_rate(line: &str) -> Option<f64> {
    let lower = line.to_lowercase().replace(['_', '-'], " ");
    let words = [
        "sampling rate",
        "sample rate",
        "sampling frequency",
        "sample frequency",
        "samplerate",
        "abtastrate",
        "fs",
    ];
    let (word, at) = words.iter().find_map(|word| lower.find(word).map(|at| (word, at)))?;
    let alone = *word != "fs" || lower.trim_start_matches(['#', '%', '/', '"', ' ']).starts_with("fs");
    let rest = lower.get(at + word.len()..)?;
    let start = rest.find(|character: char| character.is_ascii_digit())?;
    let filler = &rest[..start];
    if !alone
        || !filler
            .chars()
            .all(|c| " :=;,\t\"'[](){}".contains(c) || "khz/".contains(c) || "sample".contains(c))
    {
        return None;
    }
    let number: String =
        rest[start..].chars().take_while(|c| c.is_ascii_digit() || ".,e+".contains(*c)).collect();
    let value: f64 = number.trim_end_matches([',', '.']).replace(',', ".").parse().ok()?;
    let kilo = filler.contains("khz") || rest[start + number.len()..].trim_start().starts_with("khz");
    Some(if kilo { 1e3 * value } else { value }).filter(|rate| *rate > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sampling_rate_is_found_in_words() {
        for (line, rate) in [
            ("Sampling rate: 10 kHz", Some(10_000.0)),
            ("# fs = 2048", Some(2048.0)),
            ("Sample frequency [Hz];1000", Some(1000.0)),
            ("\"Sampling_Rate [kHz]\",\"12,8\"", Some(12_800.0)),
            ("offset 3", None),
            ("sampling rate unknown, see page 7", None),
        ] {
            assert_eq!(sampling_rate(line), rate, "{line}");
        }
    }
}
