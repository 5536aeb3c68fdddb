//! A table that is asked for its keys one by one.

use std::{cell::RefCell, ops::Range};

use toml::de::{DeTable, DeValue};

use super::{
    Quantity, Reading, Value, closest,
    unit::{Dimension, measured, without_unit},
};

/// Entries of a table of names that the file chooses.
pub(crate) const MOST_NAMES: usize = 100;

/// A table of the document; what is never asked for is an unknown key.
pub struct TomlTable<'a> {
    reading: &'a Reading,
    path: String,
    span: Range<usize>,
    entries: &'a DeTable<'a>,
    asked: RefCell<Vec<&'static str>>,
    /// Keys refused by name: neither unknown nor offered.
    refused: RefCell<Vec<&'static str>>,
}

impl<'a> TomlTable<'a> {
    /// The table at a key path.
    pub fn new(reading: &'a Reading, path: String, span: Range<usize>, entries: &'a DeTable<'a>) -> Self {
        Self { reading, path, span, entries, asked: RefCell::default(), refused: RefCell::default() }
    }

    /// Path of a key of this table.
    pub fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// The value of a key, if it is there: under its name, or without the unit at the end of its name and
    /// with a unit.
    pub fn optional(&self, key: &'static str) -> Option<Value<'a>> {
        self.asked.borrow_mut().push(key);
        let (value, stem) = match (self.entries.get(key), self.with_unit(key)) {
            (value, None) => (value?, None),
            (None, Some((stem, value))) => (value, Some(stem)),
            (Some(_), Some((stem, _))) => {
                let help = vec![format!("allowed: one of `{key}` and `{stem}`")];
                self.refuse(stem, format!("`{stem}` is given, and `{key}`, too"), help);
                return None;
            }
        };
        let path = self.path_of(key);
        self.reading.note_place(&path, value.span());
        let taken = Value::new(self.reading, path, value.span(), value.get_ref());
        Some(match stem {
            Some(stem) => {
                self.asked.borrow_mut().push(stem);
                taken.with_unit()
            }
            None => taken,
        })
    }

    /// The form of a key without its unit, where it is there with a value of that dimension.
    fn with_unit(&self, key: &'static str) -> Option<(&'static str, &'a toml::Spanned<DeValue<'a>>)> {
        let (stem, dimension) = without_unit(key)?;
        let value = self.entries.get(stem)?;
        let text = text_of(value.get_ref())?;
        (measured(text)?.dimension == dimension).then_some((stem, value))
    }

    /// The value of a key that has to be there.
    pub fn required(&self, key: &'static str) -> Option<Value<'a>> {
        self.required_with_help(key, Vec::new())
    }

    /// The same; `help` says what is allowed where it is missing.
    pub fn required_with_help(&self, key: &'static str, help: Vec<String>) -> Option<Value<'a>> {
        let value = self.optional(key);
        // What is given, but wrongly, is reported as that and not as missing.
        if value.is_none() && !self.entries.contains_key(key) && !self.refuse_without_quantity(key) {
            self.problem(key, format!("`{key}` is missing{}", self.place_name()), help);
        }
        value
    }

    /// Refuses a text that stands under the key without its unit and is no quantity, or one of another
    /// dimension; whether there is one.
    fn refuse_without_quantity(&self, key: &'static str) -> bool {
        let Some((stem, dimension)) = without_unit(key) else { return false };
        let text = self.entries.get(stem).and_then(|value| text_of(value.get_ref()));
        let fits = |text: &str| measured(text).is_some_and(|measured| measured.dimension == dimension);
        let is_wrong = text.is_some_and(|text| !fits(text));
        if is_wrong && !self.refused.borrow().contains(&stem) {
            self.refused.borrow_mut().push(stem);
            self.other_unit(stem, key, dimension);
        }
        is_wrong
    }

    /// Whether the key is there.
    pub fn has(&self, key: &'static str) -> bool {
        self.entries.contains_key(key) || self.with_unit(key).is_some()
    }

    /// The elements of an array of tables such as `[[stop]]`; none if the key is not there.
    pub fn tables(&self, key: &'static str) -> Vec<TomlTable<'a>> {
        let Some(value) = self.optional(key) else { return Vec::new() };
        let elements = value.tables(&format!("tables, written [[{}]]", self.path_of(key)));
        elements.unwrap_or_default().iter().filter_map(Value::table).collect()
    }

    /// All entries of a table whose keys are names that the file chooses, as numbers; `None` where one is
    /// none.
    pub fn named_numbers(&self, quantity: &Quantity) -> Option<Vec<(String, f64)>> {
        if self.entries.len() > MOST_NAMES {
            let message = format!("there are {} entries{}", self.entries.len(), self.place_name());
            let help = vec![format!("allowed: at most {MOST_NAMES} names")];
            self.reading.problem(&self.path, Some(self.span.clone()), message, help);
            return None;
        }
        let mut keys: Vec<&str> = self.entries.keys().map(|key| key.get_ref().as_ref()).collect();
        keys.sort_unstable();
        let number = |key: &str| {
            let (value, path) = (self.entries.get(key)?, self.path_of(key));
            self.reading.note_place(&path, value.span());
            let taken = Value::new(self.reading, path, value.span(), value.get_ref());
            Some((key.to_owned(), taken.number(quantity)?))
        };
        let read: Vec<Option<(String, f64)>> = keys.into_iter().map(number).collect();
        read.into_iter().collect()
    }

    /// Notes a fault of a key of this table.
    pub fn problem(&self, key: &str, message: String, help: Vec<String>) {
        let path = self.path_of(key);
        let entry = self.entries.get(key).or_else(|| self.entries.get(without_unit(key)?.0));
        let span = entry.map_or_else(|| self.span.clone(), toml::Spanned::span);
        self.reading.problem(&path, Some(span), message, help);
    }

    /// Notes the fault of a key that this table does not take.
    pub fn refuse(&self, key: &'static str, message: String, help: Vec<String>) {
        self.refused.borrow_mut().push(key);
        self.problem(key, message, help);
    }

    /// Notes every key that was never asked for.
    pub fn finish(self) {
        let (asked, refused) = (self.asked.borrow(), self.refused.borrow());
        let is_known = |key: &str| asked.contains(&key) || refused.contains(&key);
        for key in self.entries.keys().filter(|key| !is_known(key.get_ref().as_ref())) {
            let name = key.get_ref().as_ref();
            if self.reading.is_full() {
                self.reading.count_another();
                continue;
            }
            if self.has_other_unit(name, &asked) {
                continue;
            }
            let mut help = vec![format!("known keys: {}", asked.join(", "))];
            if let Some(close) = closest(name, asked.iter().copied()) {
                help.insert(0, format!("did you mean `{close}`?"));
            }
            let message = format!("unknown key `{name}`{}", self.place_name());
            self.reading.problem(&self.path_of(name), Some(key.span()), message, help);
        }
    }

    /// Whether this is a known key without its unit; what is wrong with its value is noted then.
    fn has_other_unit(&self, name: &str, asked: &[&'static str]) -> bool {
        let is_form = |key: &&&'static str| without_unit(key).is_some_and(|(stem, _)| stem == name);
        let is_text = self.entries.get(name).is_some_and(|value| text_of(value.get_ref()).is_some());
        let Some(key) = asked.iter().find(is_form).filter(|_| is_text) else { return false };
        if let Some((_, dimension)) = without_unit(key) {
            self.other_unit(name, key, dimension);
        }
        true
    }

    /// Notes that a name, a key without its unit, has no value of its dimension.
    fn other_unit(&self, name: &str, key: &str, dimension: Dimension) {
        let unit = dimension.unit().unwrap_or_default();
        let help = vec![format!("allowed: a text such as `{name} = \"1 {unit}\"`, or a number as `{key}`")];
        self.problem(name, format!("`{name}` has to be a number with a unit that fits {unit}"), help);
    }

    fn place_name(&self) -> String {
        if self.path.is_empty() { String::new() } else { format!(" in [{}]", self.path) }
    }
}

impl<'a> Value<'a> {
    /// The value as a table.
    pub fn table(&self) -> Option<TomlTable<'a>> {
        self.table_with_help(Vec::new())
    }

    /// The same; `help` says what is allowed where it is something else.
    pub fn table_with_help(&self, help: Vec<String>) -> Option<TomlTable<'a>> {
        match self.entries() {
            Some((reading, path, span, entries)) => Some(TomlTable::new(reading, path, span, entries)),
            None => self.wrong_type_with_help("a table", help),
        }
    }
}

/// The text that a value is, or the first of a list.
fn text_of<'v>(value: &'v DeValue<'_>) -> Option<&'v str> {
    match value {
        DeValue::Array(elements) => text_of(elements.first()?.get_ref()),
        DeValue::String(text) => Some(text),
        _ => None,
    }
}
