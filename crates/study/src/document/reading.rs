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
        self.count.set(self.count.get() + 1);
        if self.count.get() <= MOST_PROBLEMS {
            self.problems.borrow_mut().push(Problem { key: key.to_owned(), span, message, help });
        }
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
