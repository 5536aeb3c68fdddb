//! A table that is asked for its keys one by one.

use std::{cell::RefCell, ops::Range};

use toml::de::DeTable;

use super::{Reading, Value, closest};

/// Elements of an array of tables: masses, springs, stops.
const MOST_TABLES: usize = 1000;

/// A table of the document; what is never asked for is an unknown key.
pub(crate) struct Table<'a> {
    reading: &'a Reading,
    path: String,
    span: Range<usize>,
    entries: &'a DeTable<'a>,
    asked: RefCell<Vec<&'static str>>,
    /// Keys refused by name: neither unknown nor offered.
    refused: RefCell<Vec<&'static str>>,
}

impl<'a> Table<'a> {
    pub(crate) fn new(
        reading: &'a Reading,
        path: String,
        span: Range<usize>,
        entries: &'a DeTable<'a>,
    ) -> Self {
        Self { reading, path, span, entries, asked: RefCell::default(), refused: RefCell::default() }
    }

    /// Path of a key of this table.
    pub(crate) fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// The value of a key, if it is there.
    pub(crate) fn optional(&self, key: &'static str) -> Option<Value<'a>> {
        self.asked.borrow_mut().push(key);
        let value = self.entries.get(key)?;
        let path = self.path_of(key);
        self.reading.note_place(&path, value.span());
        Some(Value::new(self.reading, path, value.span(), value.get_ref()))
    }

    /// The value of a key that has to be there.
    pub(crate) fn required(&self, key: &'static str) -> Option<Value<'a>> {
        let value = self.optional(key);
        if value.is_none() {
            self.problem(key, format!("`{key}` is missing{}", self.place_name()), Vec::new());
        }
        value
    }

    /// Whether the key is there.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// The elements of an array of tables such as `[[stop]]`; none if the key is not there.
    pub(crate) fn tables(&self, key: &'static str) -> Vec<Table<'a>> {
        let Some(value) = self.optional(key) else { return Vec::new() };
        let Some(elements) = value.array_of(&format!("tables, written [[{}]]", self.path_of(key))) else {
            return Vec::new();
        };
        if elements.len() > MOST_TABLES {
            let found = format!("`{key}` has {} entries", elements.len());
            self.problem(key, found, vec![format!("allowed: at most {MOST_TABLES} tables")]);
            return Vec::new();
        }
        elements.iter().filter_map(Value::table).collect()
    }

    /// Notes a fault of a key of this table.
    pub(crate) fn problem(&self, key: &str, message: String, help: Vec<String>) {
        let path = self.path_of(key);
        let span = self.entries.get(key).map_or_else(|| self.span.clone(), toml::Spanned::span);
        self.reading.problem(&path, Some(span), message, help);
    }

    /// Notes the fault of a key that this table does not take.
    pub(crate) fn refuse(&self, key: &'static str, message: String, help: Vec<String>) {
        self.refused.borrow_mut().push(key);
        self.problem(key, message, help);
    }

    /// Notes every key that was never asked for.
    pub(crate) fn finish(self) {
        let (asked, refused) = (self.asked.borrow(), self.refused.borrow());
        let told = |key: &str| asked.contains(&key) || refused.contains(&key);
        for key in self.entries.keys().filter(|key| !told(key.get_ref().as_ref())) {
            let name = key.get_ref().as_ref();
            let mut help = vec![format!("known keys: {}", asked.join(", "))];
            if let Some(close) = closest(name, asked.iter().copied()) {
                help.insert(0, format!("did you mean `{close}`?"));
            }
            let message = format!("unknown key `{name}`{}", self.place_name());
            self.reading.problem(&self.path_of(name), Some(key.span()), message, help);
        }
    }

    fn place_name(&self) -> String {
        if self.path.is_empty() { String::new() } else { format!(" in [{}]", self.path) }
    }
}
