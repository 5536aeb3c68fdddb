//! Cards of Nastran bulk data, one at a time: small field, large field and free field, with continuations.
//!
//! # Source
//! MSC Nastran Quick Reference Guide, "Format of Bulk Data Entries".

use std::io::BufRead;

use super::text::Lines;
use crate::error::{FilePlace, PlacedFault};

/// Most lines that one card may have: lists of points are long, endless ones are no cards.
const MOST_LINES: usize = 1 << 20;

/// A card: its fields with those of continuations, names and marks of lines left out.
pub(crate) struct Card {
    pub fields: Vec<String>,
    pub place: FilePlace,
}

impl Card {
    /// A field, empty where there is none.
    pub fn field(&self, place: usize) -> &str {
        self.fields.get(place).map_or("", String::as_str)
    }
}

/// The next card whose name is wanted; `None` at the end of the file.
///
/// Columns of a `DMIG` matrix may have many entries, so a continuation is one only of a card that is wanted.
pub(crate) fn next_card<R: BufRead>(
    lines: &mut Lines<R>,
    wanted: &[&str],
) -> Result<Option<Card>, PlacedFault> {
    loop {
        let Some(line) = lines.next()? else { return Ok(None) };
        let name = name_of(line);
        if !wanted.contains(&name.as_str()) {
            continue;
        }
        let mut fields = fields_of(line);
        let place = lines.place();
        for _ in 0..MOST_LINES {
            match lines.next()? {
                Some(line) if is_continuation(line) => fields.extend(fields_of(line)),
                Some(line) if line.starts_with(b"$") => {}
                Some(_) => {
                    lines.push_back();
                    break;
                }
                None => break,
            }
        }
        return Ok(Some(Card { fields, place }));
    }
}

/// The first field in capitals, without the star of the large field.
fn name_of(line: &[u8]) -> String {
    let end = line.iter().position(|byte| *byte == b',').unwrap_or(line.len().min(8));
    let name = String::from_utf8_lossy(&line[..end]).trim().to_ascii_uppercase();
    name.trim_end_matches('*').to_owned()
}

fn is_continuation(line: &[u8]) -> bool {
    match line.first() {
        Some(b'+' | b'*' | b',') => true,
        Some(b' ') => line.iter().any(|byte| *byte != b' '),
        _ => false,
    }
}

/// The fields of a line: 8 of 8 columns, 4 of 16, or what stands between commas.
fn fields_of(line: &[u8]) -> Vec<String> {
    let text = |part: &[u8]| String::from_utf8_lossy(part).trim().to_owned();
    let line = &line[..line.iter().position(|byte| *byte == b'$').unwrap_or(line.len())];
    let large = line.iter().take(8).any(|byte| *byte == b'*');
    if line.contains(&b',') {
        let mut fields: Vec<String> = line.split(|byte| *byte == b',').skip(1).map(text).collect();
        // The tenth field marks the continuation.
        fields.resize(if large { 4 } else { 8 }, String::new());
        return fields;
    }
    let (width, count) = if large { (16, 4) } else { (8, 8) };
    let rest = line.get(8..).unwrap_or_default();
    (0..count)
        .map(|field| {
            let start = (field * width).min(rest.len());
            text(&rest[start..(start + width).min(rest.len())])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_three_forms_of_a_card_give_the_same_fields() {
        let small = "GRID          11              1.      2.      3.\n";
        let large = "GRID*                 11                              1.              \
        2.\n*                     3.\n";
        let free = "GRID,11,,1.,2.,3.\n";
        for text in [small, large, free] {
            let mut lines = Lines::new(text.as_bytes());
            let card = next_card(&mut lines, &["GRID"]).unwrap().unwrap();
            let fields: Vec<&str> = (0..5).map(|place| card.field(place)).collect();
            assert_eq!(fields, ["11", "", "1.", "2.", "3."], "{text}");
        }
    }

    #[test]
    fn cards_that_are_not_wanted_are_passed_over_with_their_continuations() {
        let text = "$ title\nASET           3  123456\nCORD2R*  10\n* 1\n* 2\nEXTRN          3      \
        12       4       0\n               5       3\nENDDATA\n";
        let mut lines = Lines::new(text.as_bytes());
        let card = next_card(&mut lines, &["EXTRN"]).unwrap().unwrap();
        assert_eq!((card.field(0), card.field(3), card.field(8), card.field(9)), ("3", "0", "5", "3"));
        assert!(next_card(&mut lines, &["EXTRN"]).unwrap().is_none());
    }
}
