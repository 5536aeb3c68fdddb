//! Standard output: text, or one JSON document; and what is reported beside it.

use std::{
    borrow::Cow,
    io::{self, Write},
};

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_signal::text::is_control;
use hammerbeam_study::readable;
use serde::Serialize;
use serde_json::{Value, json};

use crate::failure::Failure;

/// Where results go.
#[derive(Debug, Clone, Copy, Default)]
pub struct Output {
    /// One JSON document instead of text.
    pub json: bool,
    /// Unit in which texts and figures show frequencies.
    pub frequency_unit: FrequencyUnit,
}

/// A number to six decimals; what is rounded to nothing has no sign.
pub fn six_decimals(value: f64) -> String {
    let text = format!("{value:.6}");
    match text.strip_prefix('-') {
        Some(size) if size.bytes().all(|byte| matches!(byte, b'0' | b'.')) => size.to_owned(),
        _ => text,
    }
}

/// A number with so many decimals, 0 without any; what they would round to next to nothing has as many digits
/// instead.
pub fn decimals(value: f64, decimals: usize) -> String {
    let least = 10_f64.powi(3 - decimals as i32);
    if value == 0.0 {
        "0".to_owned()
    } else if value.abs() >= least.min(1e-2) {
        format!("{value:.decimals$}")
    } else {
        format!("{value:.decimals$e}")
    }
}

/// A frequency in a unit in which it is neither tiny nor huge.
pub fn readable_frequency(unit: FrequencyUnit, frequency_hz: f64) -> String {
    readable(unit.factor() * frequency_hz, unit.symbol())
}

impl Output {
    /// Gives a result: the document, or the text.
    ///
    /// # Errors
    /// Standard output does not take it: a full disk, say.
    pub fn give(self, document: &impl Serialize, text: impl FnOnce() -> String) -> Result<(), Failure> {
        if self.json {
            // As a value, whose keys are sorted.
            let document = serde_json::to_value(document).expect("results are plain data with text keys");
            give_text(&format!("{document:#}"))
        } else {
            give_text(&printable(text().trim_end()))
        }
    }

    /// Reports a failure on standard error, and in JSON as the one document.
    pub fn failure(self, failure: &Failure) {
        match failure {
            Failure::Study(report) => notify(&report.render(true)),
            Failure::Interrupted(message)
            | Failure::InterruptedWithResult(message)
            | Failure::Disagreement(message) => notify(&printable(message)),
            other => notify(&format!("error: {}", printable(&other.message()))),
        }
        if self.json && !failure.has_result() {
            // The exit code says already that there is no result.
            let _ = print(&format!("{:#}", json!({ "error": document(failure) })));
        }
    }
}

/// Writes something beside the results, on standard error. Where that cannot be written nobody listens, and
/// the work goes on.
pub fn notify(text: &str) {
    let _ = writeln!(anstream::stderr(), "{text}");
}

/// Gives a text as it is, the help of a command, say.
///
/// # Errors
/// Standard output does not take it.
pub fn give_text(text: &str) -> Result<(), Failure> {
    let written = print(text.trim_end());
    written.map_err(|error| Failure::NoResult(format!("cannot write to standard output: {error}")))
}

/// Prints a text; a reader that has gone away (`| head`) is no failure.
fn print(text: &str) -> io::Result<()> {
    ensure_writable()?;
    let mut stdout = anstream::stdout();
    match writeln!(stdout, "{text}").and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// Whether standard output can be written at all. The standard library takes a descriptor that was opened for
/// reading only (`1< file`) for one that nobody wants to see, and says that all is well.
#[cfg(unix)]
fn ensure_writable() -> io::Result<()> {
    use std::{fs::File, os::fd::AsFd};
    let mut stdout = File::from(io::stdout().as_fd().try_clone_to_owned()?);
    // The system looks at the descriptor before it sees that there is nothing to write.
    stdout.write(&[]).map(|_| ())
}

#[cfg(not(unix))]
fn ensure_writable() -> io::Result<()> {
    Ok(())
}

/// A text without what a terminal would obey: names and words out of files may hold anything.
fn printable(text: &str) -> Cow<'_, str> {
    let obeyed = |character: char| is_control(character) && !['\n', '\t'].contains(&character);
    if !text.contains(obeyed) {
        return Cow::Borrowed(text);
    }
    let shown = |character: char| if obeyed(character) { char::REPLACEMENT_CHARACTER } else { character };
    Cow::Owned(text.chars().map(shown).collect())
}

/// A failure for programs: message, exit code, and the faults of a study with their places.
fn document(failure: &Failure) -> Value {
    let mut document = json!({ "message": failure.message(), "exit_code": failure.code() });
    if let Failure::Study(report) = failure {
        document["problems"] = report.documents().into();
        if report.left_out > 0 {
            document["problems_left_out"] = json!(report.left_out);
        }
    }
    document
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_rounded_to_nothing_has_no_sign() {
        let shown = [-0.0, -4.9e-7, -5.1e-7, 1.5].map(six_decimals);
        assert_eq!(shown, ["0.000000", "0.000000", "-0.000001", "1.500000"]);
    }

    #[test]
    fn small_numbers_keep_their_digits() {
        let shown = [0.0, 36.2, 0.0123, 7.33e-8].map(|value| decimals(value, 6));
        assert_eq!(shown, ["0", "36.200000", "0.012300", "7.330000e-8"]);
        assert_eq!(decimals(0.05, 4), "0.0500");
    }

    #[test]
    fn a_terminal_gets_nothing_to_obey() {
        let text = "a\u{1b}[31m\r\u{9b}2J\u{202e}b\nc\td \u{e4}";
        assert_eq!(printable(text), "a\u{fffd}[31m\u{fffd}\u{fffd}2J\u{fffd}b\nc\td \u{e4}");
    }
}
