//! Lines of text with upright and italic parts, their widths, and numbers as they are printed.

use crate::font;

/// A line of text.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Text {
    pub(crate) spans: Vec<Span>,
}

/// A part of a line in one face.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Span {
    pub(crate) content: String,
    pub(crate) italic: bool,
}

impl Text {
    /// Upright text.
    pub(crate) fn upright(content: impl Into<String>) -> Self {
        Self::default().then(content, false)
    }

    /// The line with an italic part added, for a variable.
    pub(crate) fn variable(self, content: impl Into<String>) -> Self {
        self.then(content, true)
    }

    /// The line with an upright part added.
    pub(crate) fn and(self, content: impl Into<String>) -> Self {
        self.then(content, false)
    }

    fn then(mut self, content: impl Into<String>, italic: bool) -> Self {
        self.spans.push(Span { content: content.into(), italic });
        self
    }

    /// Width of the line (pt) at a font size (pt).
    pub(crate) fn width(&self, size: f64) -> f64 {
        self.spans.iter().map(|span| size * span.width()).sum()
    }
}

impl Span {
    fn width(&self) -> f64 {
        let face = if self.italic { font::ITALIC } else { font::UPRIGHT };
        self.content.chars().map(|character| font::character_width(face, character)).sum()
    }
}

/// Breaks a text at spaces into lines no wider than `width` (pt); a longer word has its own line.
pub(crate) fn wrap(content: &str, size: f64, width: f64) -> Vec<Text> {
    let mut lines: Vec<String> = Vec::new();
    for word in content.split_whitespace() {
        let extended = lines.last().map(|line| format!("{line} {word}"));
        match (extended, lines.last_mut()) {
            (Some(extended), Some(line)) if Text::upright(extended.as_str()).width(size) <= width => {
                *line = extended;
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.into_iter().map(Text::upright).collect()
}

/// A text no wider than `width` (pt), truncated with an ellipsis if necessary.
pub(crate) fn cut(content: &str, size: f64, width: f64) -> Text {
    let whole = Text::upright(content);
    if whole.width(size) <= width {
        return whole;
    }
    let starts: Vec<usize> = content.char_indices().map(|(start, _)| start).collect();
    let cut = starts.iter().rev().map(|&end| Text::upright(format!("{}…", content[..end].trim_end())));
    cut.into_iter().find(|text| text.width(size) <= width).unwrap_or_default()
}

/// A number with a given count of decimals, a true minus sign, and thin spaces between thousands from 10 000.
pub(crate) fn decimal(value: f64, decimals: usize) -> String {
    let digits = format!("{:.decimals$}", value.abs());
    let (whole, fraction) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    let negative = value < 0.0 && digits.contains(|digit: char| ('1'..='9').contains(&digit));
    format!("{}{}{fraction}", if negative { "−" } else { "" }, grouped(whole))
}

fn grouped(whole: &str) -> String {
    if whole.len() < 5 {
        return whole.to_owned();
    }
    let mut grouped = String::new();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) {
            grouped.push('\u{2009}');
        }
        grouped.push(digit);
    }
    grouped
}

/// A number with at most nine significant digits and without trailing zeros.
#[must_use]
pub fn plain_number(value: f64) -> String {
    let rounded = format!("{value:.8e}").parse::<f64>().unwrap_or(value);
    // Zero has no sign.
    (rounded + 0.0).to_string()
}

/// `mantissa × 10^exponent`, without a mantissa of one.
pub(crate) fn power_of_ten(mantissa: &str, exponent: i32) -> String {
    let power = format!("10{}", superscript(exponent));
    if mantissa == "1" { power } else { format!("{mantissa}\u{2009}×\u{2009}{power}") }
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent
        .to_string()
        .chars()
        .map(|digit| digit.to_digit(10).map_or('⁻', |value| DIGITS[value as usize]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_printed_as_in_a_journal() {
        assert_eq!(decimal(-0.25, 2), "−0.25");
        assert_eq!(decimal(-0.0001, 2), "0.00");
        assert_eq!(decimal(1500.0, 0), "1500");
        assert_eq!(decimal(1_234_567.0, 0), "1\u{2009}234\u{2009}567");
        assert_eq!(power_of_ten("1", -12), "10⁻¹²");
        assert_eq!(power_of_ten("2", 5), "2\u{2009}×\u{2009}10⁵");
    }

    #[test]
    fn rounding_is_not_printed() {
        assert_eq!(plain_number(0.1 + 0.24 - 1e-16), "0.34");
        assert_eq!(plain_number(0.339_999_999_999_999_97), "0.34");
        assert_eq!(plain_number(54.110_780_4), "54.1107804");
        assert_eq!(plain_number(30.0), "30");
        assert_eq!(plain_number(f64::NAN), "NaN");
    }

    #[test]
    fn lines_break_at_spaces_and_keep_every_word() {
        let lines = wrap("Clamped beam with an  elastic stop at its contact mass", 8.0, 90.0);
        assert!(lines.len() > 1);
        assert!(lines.iter().all(|line| line.width(8.0) <= 90.0));
        let words: Vec<_> = lines.iter().map(|line| line.spans[0].content.clone()).collect();
        assert_eq!(words.join(" "), "Clamped beam with an elastic stop at its contact mass");
        assert!(wrap("  ", 8.0, 90.0).is_empty());
    }

    #[test]
    fn what_has_no_room_is_cut_and_says_so() {
        assert_eq!(cut("contact", 7.0, 90.0), Text::upright("contact"));
        let text = cut("première masse with a very long name", 7.0, 60.0);
        assert!(text.width(7.0) <= 60.0 && text.width(7.0) > 50.0);
        assert!(text.spans[0].content.starts_with("première") && text.spans[0].content.ends_with('…'));
        assert_eq!(cut("contact", 7.0, 1.0), Text::default());
    }
}
