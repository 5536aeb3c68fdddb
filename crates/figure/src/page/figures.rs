//! Printed figures on the page, of results that it does not draw itself.

use serde_json::{Value, json};

use crate::figure::Figure;

/// Length of all figures together (bytes).
const MOST_BYTES: usize = 1_500_000;

/// A printed figure.
#[derive(Debug, Clone, PartialEq)]
pub struct PageFigure {
    /// Name of its file, without the suffix.
    pub name: String,
    /// Name of the kind of result.
    pub heading: String,
    description: String,
    svg: String,
}

impl PageFigure {
    /// A figure under a heading.
    #[must_use]
    pub fn new(name: &str, heading: &str, figure: &Figure) -> Self {
        let description = figure.description().to_owned();
        Self { name: name.to_owned(), heading: heading.to_owned(), description, svg: figure.svg() }
    }
}

/// Printed figures, as many as a page has room for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageFigures {
    carried: Vec<PageFigure>,
    length: usize,
    no_room: Vec<String>,
    refused: Vec<(String, String)>,
}

impl PageFigures {
    /// Adds a figure, or its name only if there is no room for it.
    pub fn push(&mut self, figure: PageFigure) {
        let length = self.length + figure.svg.len();
        if length <= MOST_BYTES {
            self.length = length;
            self.carried.push(figure);
        } else {
            self.no_room.push(figure.name);
        }
    }

    /// Adds the reason why a figure does not exist.
    pub fn refuse(&mut self, name: &str, reason: &str) {
        self.refused.push((name.to_owned(), reason.to_owned()));
    }

    /// Names, headings and descriptions of all figures.
    pub(super) fn list(&self) -> Value {
        let entry = |figure: &PageFigure| {
            let (name, heading, description) = (&figure.name, &figure.heading, &figure.description);
            json!({ "name": name, "heading": heading, "description": description })
        };
        json!({
            "carried": self.carried.iter().map(entry).collect::<Vec<_>>(),
            "noRoom": self.no_room,
            "refused": self.refused,
        })
    }

    /// The SVG documents, in the order of the list.
    pub(super) fn documents(&self) -> Value {
        self.carried.iter().map(|figure| figure.svg.as_str()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(name: &str, length: usize) -> PageFigure {
        let [heading, description] = ["Sweeps", ""].map(str::to_owned);
        PageFigure { name: name.to_owned(), heading, description, svg: "s".repeat(length) }
    }

    #[test]
    fn what_has_no_room_is_named_and_what_is_smaller_still_fits() {
        let mut figures = PageFigures::default();
        for (name, length) in [("one", MOST_BYTES - 10), ("two", 11), ("three", 10)] {
            figures.push(figure(name, length));
        }
        assert_eq!(figures.list()["noRoom"], json!(["two"]));
        assert_eq!(figures.list()["carried"][1]["name"], "three");
        assert_eq!(figures.documents().as_array().map(Vec::len), Some(2));
    }
}
