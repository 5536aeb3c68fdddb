//! Standard output: text, or one JSON document.

use std::io::Write;

use serde::Serialize;
use serde_json::{Value, json};

use crate::failure::Failure;

/// Where results go.
#[derive(Debug, Clone, Copy)]
pub struct Output {
    /// One JSON document instead of text.
    pub json: bool,
}

impl Output {
    /// Gives a result: the document, or the text.
    pub fn give(self, document: &impl Serialize, text: impl FnOnce() -> String) {
        if self.json {
            let document =
                serde_json::to_string_pretty(document).expect("results are plain data with text keys");
            print(&document);
        } else {
            print(text().trim_end());
        }
    }

    /// Tells a failure on standard error, and in JSON as the one document.
    pub fn failure(self, failure: &Failure) {
        match failure {
            Failure::Study(report) => anstream::eprintln!("{}", report.render(true)),
            Failure::Interrupted(message) | Failure::Disagreement(message) => {
                anstream::eprintln!("{message}");
            }
            other => anstream::eprintln!("error: {}", other.message()),
        }
        // Disagreements have their document.
        if self.json && !matches!(failure, Failure::Disagreement(_)) {
            print(&format!("{:#}", json!({ "error": document(failure) })));
        }
    }
}

/// Prints a text; a reader that has gone away (`| head`) is no failure.
fn print(text: &str) {
    let _ = writeln!(anstream::stdout(), "{text}");
}

/// A failure for programs: message, exit code, and the faults of a study with their places.
fn document(failure: &Failure) -> Value {
    let mut document = json!({ "message": failure.message(), "exit_code": failure.code() });
    if let Failure::Study(report) = failure {
        let fault = |problem: &hammerbeam_study::Problem| {
            let position = report.position(problem);
            json!({
                "file": report.name,
                "line": position.map(|(line, _)| line),
                "column": position.map(|(_, column)| column),
                "key": problem.key,
                "message": problem.message,
                "help": problem.help,
            })
        };
        document["problems"] = report.problems.iter().map(fault).collect();
    }
    document
}
