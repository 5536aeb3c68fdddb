//! What is wrong with a document, and how it is shown.

use std::{fmt, ops::Range};

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use hammerbeam_signal::text::is_control;
use serde_json::{Value, json};

/// One fault of a document.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Path of the key, such as `stop[0].gap_m`; empty for a fault of the whole document.
    pub key: String,
    /// Where it stands [bytes]; `None` if nowhere in the text.
    pub span: Option<Range<usize>>,
    /// What was found.
    pub message: String,
    /// What is allowed.
    pub help: Vec<String>,
}

/// All faults of one document, with its text.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultReport {
    /// Name of the document, usually its path.
    pub name: String,
    text: String,
    /// The faults, in the order of the text.
    pub problems: Vec<Problem>,
    /// Number of further faults.
    pub left_out: usize,
}

impl FaultReport {
    /// The faults in a text, in its order.
    pub fn new(name: &str, text: &str, mut problems: Vec<Problem>) -> Self {
        problems.sort_by_key(|problem| problem.span.as_ref().map_or(usize::MAX, |span| span.start));
        Self { name: name.to_owned(), text: text.to_owned(), problems, left_out: 0 }
    }

    /// The same with further faults that are only counted.
    pub fn and(self, left_out: usize) -> Self {
        Self { left_out, ..self }
    }

    /// The text that has the faults.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The same with a further fault in its place.
    pub(crate) fn with(self, problem: Problem) -> Self {
        let mut problems = self.problems;
        problems.push(problem);
        Self::new(&self.name, &self.text, problems).and(self.left_out)
    }

    /// Line and column of a fault, both counted from 1; `None` if it stands nowhere in the text.
    #[must_use]
    pub fn position(&self, problem: &Problem) -> Option<(usize, usize)> {
        let before = &self.text[..boundary(&self.text, problem.span.as_ref()?.start)];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Some((before.matches('\n').count() + 1, before[line_start..].chars().count() + 1))
    }

    /// The faults for programs: each with its file, line, column and key, its message and its help.
    #[must_use]
    pub fn documents(&self) -> Vec<Value> {
        let document = |problem: &Problem| {
            let position = self.position(problem);
            json!({
                "file": self.name,
                "line": position.map(|(line, _)| line),
                "column": position.map(|(_, column)| column),
                "key": problem.key,
                "message": problem.message,
                "help": problem.help,
            })
        };
        self.problems.iter().map(document).collect()
    }

    /// The faults as text for a terminal: each with its line, what was found and what is allowed.
    ///
    /// * `styled`: with ANSI colours.
    #[must_use]
    pub fn render(&self, styled: bool) -> String {
        let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
        let mut shown: Vec<String> =
            self.problems.iter().map(|problem| renderer.render(&[self.group(problem)])).collect();
        if self.left_out > 0 {
            shown.push(format!("and {} more", self.left_out));
        }
        shown.join("\n\n")
    }

    fn group(&self, problem: &Problem) -> Group<'static> {
        let title = Level::ERROR.primary_title(visible(&problem.message));
        let mut group = match &problem.span {
            Some(span) => {
                let (span, line) = (self.clip(span), self.line(span.start));
                let number = self.text[..line.start].matches('\n').count() + 1;
                // Stand-ins take other numbers of bytes than what they stand for.
                let before = |place: usize| visible(&self.text[line.start..place]).len();
                let span = before(span.start)..before(span.end);
                title.element(
                    Snippet::source(visible(&self.text[line]))
                        .line_start(number)
                        .path(visible(&self.name))
                        .annotation(AnnotationKind::Primary.span(span).label(visible(&problem.key))),
                )
            }
            None => Group::with_title(title),
        };
        for help in &problem.help {
            group = group.element(Level::HELP.message(visible(help)));
        }
        group
    }

    /// The line around a place, without its end, or of a long one what is near; the rest of the text is not
    /// looked through for each fault.
    fn line(&self, place: usize) -> Range<usize> {
        const NEAR: usize = 1000;
        let place = boundary(&self.text, place);
        let (low, high) = (boundary(&self.text, place.saturating_sub(NEAR)), place + NEAR);
        let high = boundary(&self.text, high);
        let start = self.text[low..place].rfind('\n').map_or(low, |newline| low + newline + 1);
        let end = self.text[place..high].find('\n').map_or(high, |newline| place + newline);
        start..end
    }

    /// The span cut to its first line: a table may span the rest of the file.
    fn clip(&self, span: &Range<usize>) -> Range<usize> {
        let start = boundary(&self.text, span.start);
        let end = boundary(&self.text, span.end).max(start);
        start..end.min(self.line(start).end)
    }
}

/// A text with a stand-in for every character that a terminal would obey or not show; those of ASCII are left
/// to the renderer, which has a picture for each.
fn visible(text: &str) -> String {
    text.replace(|character: char| !character.is_ascii() && is_control(character), "\u{fffd}")
}

/// The last place in the text, up to `index`, where a character starts.
fn boundary(text: &str, index: usize) -> usize {
    (0..=index.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

impl fmt::Display for FaultReport {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.render(false))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> FaultReport {
        let text = "title = \"ä\"\nlength_m = -1.0\n";
        let problem = Problem {
            key: "length_m".into(),
            span: Some(24..28),
            message: "`length_m` is -1 m".into(),
            help: vec!["allowed: more than 0 m".into()],
        };
        FaultReport::new("study.toml", text, vec![problem])
    }

    #[test]
    fn position_counts_lines_and_characters_from_one() {
        let report = report();
        assert_eq!(report.position(&report.problems[0]), Some((2, 12)));
    }

    #[test]
    fn rendering_shows_line_key_and_what_is_allowed() {
        let shown = report().render(false);
        for part in ["study.toml:2:12", "length_m = -1.0", "`length_m` is -1 m", "allowed: more than 0 m"] {
            assert!(shown.contains(part), "{part} is missing in\n{shown}");
        }
    }

    #[test]
    fn what_a_terminal_would_obey_is_seen_and_the_mark_stays_in_its_place() {
        let key = "a\u{9b}31m\u{202e}\u{2028}\u{200b}\u{e0041}b";
        let text = format!("\"\u{feff}\" = {{ \"{key}\" = 1 }}");
        let start = text.find("\"a").unwrap();
        let problem = Problem {
            key: key.into(),
            span: Some(start..start + key.len() + 2),
            message: format!("unknown key `{key}`"),
            help: vec![key.into()],
        };
        let shown = FaultReport::new("b\u{85}.toml", &text, vec![problem]).render(false);
        assert!(!shown.contains(|one: char| one != '\n' && is_control(one)), "{shown:?}");
        let column = |part: &str| {
            let line = shown.lines().find(|line| line.contains(part)).unwrap();
            line[..line.find(part).unwrap()].chars().count()
        };
        assert_eq!(column("\"a"), column("^"), "{shown}");
        assert_eq!(shown.matches('^').count(), key.chars().count() + 2, "{shown}");
    }

    #[test]
    fn of_a_line_of_megabytes_what_is_near_is_shown() {
        let text = format!("{} = 1\n", "k".repeat(3_000_000));
        let report = |span| {
            let problem = Problem { key: "k".into(), span: Some(span), message: String::new(), help: vec![] };
            FaultReport::new("study.toml", &text, vec![problem]).render(false)
        };
        for span in [0..3_000_000, 3_000_003..3_000_004] {
            assert!(report(span).len() < 20_000);
        }
    }

    #[test]
    fn a_span_over_several_lines_is_shown_by_its_first() {
        let report = report();
        assert_eq!(report.clip(&(0..25)), 0..12);
    }
}
