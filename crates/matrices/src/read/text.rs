//! Lines of a text file, one at a time, and the numbers in them.

use std::io::BufRead;

use crate::error::{FilePlace, MatrixFault, PlacedFault};

/// Longest line [bytes].
const LONGEST: usize = 1 << 20;
/// Most characters of a line that a message repeats.
const SHOWN: usize = 40;

/// The lines of a file.
pub(crate) struct Lines<R> {
    source: R,
    buffer: Vec<u8>,
    number: u64,
    /// The last line is given once more.
    again: bool,
}

impl<R: BufRead> Lines<R> {
    pub fn new(source: R) -> Self {
        Self { source, buffer: Vec::new(), number: 0, again: false }
    }

    /// The next line without its ending; `None` at the end of the file.
    pub fn next(&mut self) -> Result<Option<&[u8]>, PlacedFault> {
        if std::mem::take(&mut self.again) {
            return Ok(Some(&self.buffer));
        }
        self.buffer.clear();
        let mut limited = std::io::Read::take(&mut self.source, LONGEST as u64);
        if limited.read_until(b'\n', &mut self.buffer)? == 0 {
            return Ok(None);
        }
        self.number += 1;
        if self.buffer.len() >= LONGEST {
            let (found, allowed) = (LONGEST as i64, format!("less than {LONGEST} bytes"));
            return Err(
                MatrixFault::OutOfRange { what: "the length of a line", found, allowed }.at(self.place())
            );
        }
        while self.buffer.last().is_some_and(|byte| matches!(byte, b'\n' | b'\r')) {
            self.buffer.pop();
        }
        Ok(Some(&self.buffer))
    }

    /// The next line that is there.
    pub fn required(&mut self, what: &'static str) -> Result<&[u8], PlacedFault> {
        match self.next() {
            Err(error) => return Err(error),
            Ok(None) => return Err(MatrixFault::Truncated { what }.at(self.end())),
            Ok(Some(_)) => {}
        }
        Ok(&self.buffer)
    }

    /// Gives the last line once more.
    pub fn push_back(&mut self) {
        self.again = true;
    }

    /// The line last given.
    pub fn place(&self) -> FilePlace {
        FilePlace::Line(self.number)
    }

    /// Beyond the last line.
    pub fn end(&self) -> FilePlace {
        FilePlace::Line(self.number + 1)
    }
}

/// What a message repeats of the text of a file.
pub(crate) fn shown(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    let mut short: String = text.trim().chars().take(SHOWN).flat_map(char::escape_default).collect();
    if text.trim().chars().count() > SHOWN {
        short.push_str("...");
    }
    short
}

/// Words between spaces, tabs and commas.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|byte| matches!(byte, b' ' | b'\t' | b',')).filter(|word| !word.is_empty())
}

/// A whole number.
pub(crate) fn whole(word: &[u8], what: &'static str) -> Result<i64, MatrixFault> {
    let parsed = std::str::from_utf8(word).ok().and_then(|text| text.trim().parse().ok());
    parsed.ok_or_else(|| MatrixFault::NotANumber { what, found: shown(word) })
}

/// An index from 1, given from 0.
pub(crate) fn index(word: &[u8], what: &'static str, most: u64) -> Result<u32, MatrixFault> {
    let found = whole(word, what)?;
    if found < 1 || found as u64 > most.min(u64::from(u32::MAX)) {
        return Err(MatrixFault::OutOfRange { what, found, allowed: format!("1 to {most}") });
    }
    Ok((found - 1) as u32)
}

/// A finite number, also with a Fortran exponent: `1.5D+3`, `1.5+3`.
pub(crate) fn number(word: &[u8], what: &'static str) -> Result<f64, MatrixFault> {
    let text = std::str::from_utf8(word).map(str::trim).unwrap_or_default();
    let value = match text.parse::<f64>() {
        Ok(value) => Some(value),
        Err(_) => fortran(text),
    };
    match value {
        Some(value) if value.is_finite() => Ok(value),
        Some(found) => Err(MatrixFault::NotFinite { what, found }),
        None => Err(MatrixFault::NotANumber { what, found: shown(word) }),
    }
}

fn fortran(text: &str) -> Option<f64> {
    if let Some(place) = text.find(['d', 'D']) {
        return format!("{}e{}", &text[..place], text.get(place + 1..)?.trim()).parse().ok();
    }
    // A sign within, without a letter before it, is that of the exponent.
    let place = 1 + text.get(1..)?.rfind(['+', '-'])?;
    format!("{}e{}", &text[..place], &text[place..]).parse().ok()
}

/// Finds how many digits the entries of a file have, from the first of them.
#[derive(Debug, Default)]
pub(crate) struct Digits {
    most: usize,
    seen: usize,
}

impl Digits {
    const ENOUGH: usize = 2000;

    /// Looks at the text of an entry.
    pub fn see(&mut self, word: &[u8]) {
        if self.seen < Self::ENOUGH {
            self.seen += 1;
            let mantissa = word.iter().take_while(|byte| byte.is_ascii_digit() || b"+-. ".contains(byte));
            // Leading zeros and signs are no digits; an exponent without a letter counts a little too much.
            let digits = mantissa.filter(|byte| byte.is_ascii_digit()).skip_while(|byte| **byte == b'0');
            self.most = self.most.max(digits.count());
        }
    }

    /// Half a unit of the last digit, and that of a double number at least.
    pub fn precision(&self) -> f64 {
        // Few digits are numbers that happen to be round.
        let digits = if self.most < 5 { 17 } else { self.most };
        (0.5 * 10.0_f64.powi(1 - digits as i32)).max(0.5 * f64::EPSILON)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_c_and_of_fortran_are_read() {
        for (text, value) in [
            ("1.5e3", 1500.0),
            ("1.5D+3", 1500.0),
            (" -2.5+2", -250.0),
            ("7.-1", 0.7),
            ("4", 4.0),
            ("1.5D 03", 1500.0),
        ] {
            assert_eq!(number(text.as_bytes(), "x").unwrap(), value, "{text}");
        }
        for text in ["nan", "1e999", "inf", "abc", "", "1.5D", "-", "+", "1-", "\u{e9}"] {
            assert!(number(text.as_bytes(), "x").is_err(), "{text}");
        }
    }

    #[test]
    fn precision_is_half_a_unit_of_the_last_digit() {
        let mut digits = Digits::default();
        digits.see(b" 1.736458917D+05");
        assert!((digits.precision() / 5e-10 - 1.0).abs() < 1e-12);
        assert_eq!(Digits::default().precision(), 0.5 * f64::EPSILON);
    }
}
