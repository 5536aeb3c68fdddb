//! The state of reading one document: the faults so far, and where each key stands.

use std::{
    cell::{Cell, RefCell},
    collections::BTreeMap,
    ops::Range,
    path::{Path, PathBuf},
};

use super::Problem;

/// Faults that are kept; nobody reads more, and of a file that is something else altogether there would be
/// thousands.
const MOST_PROBLEMS: usize = 100;

/// Collects faults and the places of keys while a document is read.
#[derive(Debug, Default)]
pub struct Reading {
    problems: RefCell<Vec<Problem>>,
    places: RefCell<BTreeMap<String, Range<usize>>>,
    count: Cell<usize>,
    folder: PathBuf,
}

impl Reading {
    /// Reads a document that names files relative to a folder.
    pub(crate) fn in_folder(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), ..Self::default() }
    }

    /// The folder of files that the document names.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Notes a fault at a place.
    pub fn problem(&self, key: &str, span: Option<Range<usize>>, message: String, help: Vec<String>) {
        if !self.is_full() {
            let key = shortened(key.to_owned());
            let (message, help) = (shortened(message), help.into_iter().map(shortened).collect());
            self.problems.borrow_mut().push(Problem { key, span, message, help });
        }
        self.count.set(self.count.get() + 1);
    }

    /// Whether further faults are counted alone, so that nobody needs to find words for them.
    pub fn is_full(&self) -> bool {
        self.count.get() >= MOST_PROBLEMS
    }

    /// Counts a fault for which no words were sought.
    pub fn count_another(&self) {
        self.count.set(self.count.get() + 1);
    }

    /// Notes where a key stands.
    pub fn note_place(&self, key: &str, span: Range<usize>) {
        self.places.borrow_mut().insert(key.to_owned(), span);
    }

    /// Number of faults so far.
    pub fn count(&self) -> usize {
        self.count.get()
    }

    /// The faults, the number of further ones that are left out, and the places of the keys.
    pub fn into_parts(self) -> (Vec<Problem>, usize, BTreeMap<String, Range<usize>>) {
        let left_out = self.count.get().saturating_sub(MOST_PROBLEMS);
        (self.problems.into_inner(), left_out, self.places.into_inner())
    }
}

/// A text for a terminal: what a file holds may be megabytes long.
fn shortened(mut text: String) -> String {
    const LONGEST: usize = 4000;
    if text.len() > LONGEST {
        text.truncate((0..=LONGEST).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0));
        text.push_str(" ...");
    }
    text
}

/// The place of a key, or of the closest table around it.
pub fn place(places: &BTreeMap<String, Range<usize>>, key: &str) -> Option<Range<usize>> {
    let mut key = key;
    loop {
        if let Some(span) = places.get(key) {
            return Some(span.clone());
        }
        key = &key[..key.rfind(['.', '['])?];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_that_is_not_there_stands_in_its_table() {
        let places = BTreeMap::from([("stop[0]".to_owned(), 3..7)]);
        assert_eq!(place(&places, "stop[0].gap_m"), Some(3..7));
        assert_eq!(place(&places, "reduction.cut_off_hz"), None);
    }
}
