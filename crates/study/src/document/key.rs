//! Keys of tables as constants: the reader takes its range and its default from where the book has them.
//!
//! A [`Key`] is a name, what its value may be, its default and a sentence. The reader of a table asks it for
//! the value, and the page of keys prints it as a [`KeyRow`]. What a reader of its own takes (a reference to
//! a point, a list, a key that only some studies have) is a row without such a constant; tests hold the names
//! of all rows to those that the readers ask for.

use super::{Quantity, TomlTable, Value};

/// What the value of a key may be.
pub trait KeyRange: Copy {
    /// What is read.
    type Read: Copy;

    /// The value, if it is allowed; `None` after noting what is wrong.
    fn take(&self, value: &Value<'_>) -> Option<Self::Read>;

    /// What is allowed, in words.
    fn allowed(&self) -> String;

    /// A value as the study file has it.
    fn written(&self, value: Self::Read) -> String;
}

impl KeyRange for Quantity {
    type Read = f64;

    fn take(&self, value: &Value<'_>) -> Option<f64> {
        value.number(self)
    }

    fn allowed(&self) -> String {
        spaced(&self.allowed())
    }

    fn written(&self, value: f64) -> String {
        format!("{value:?}").trim_end_matches(".0").to_owned()
    }
}

/// "more than 0, to 1 m": a range that leaves out its lower end, with the comma that shows where it begins.
fn spaced(allowed: &str) -> String {
    match allowed.strip_prefix("more than ").and_then(|rest| rest.split_once(" to ")) {
        Some((low, high)) => format!("more than {low}, to {high}"),
        None => allowed.to_owned(),
    }
}

/// Whole numbers from the first to the second.
#[derive(Debug, Clone, Copy)]
pub struct Whole(pub u32, pub u32);

impl KeyRange for Whole {
    type Read = u32;

    fn take(&self, value: &Value<'_>) -> Option<u32> {
        value.whole(self.0, self.1)
    }

    fn allowed(&self) -> String {
        format!("{} to {}", self.0, self.1)
    }

    fn written(&self, value: u32) -> String {
        value.to_string()
    }
}

/// `true` or `false`.
#[derive(Debug, Clone, Copy)]
pub struct TrueOrFalse;

impl KeyRange for TrueOrFalse {
    type Read = bool;

    fn take(&self, value: &Value<'_>) -> Option<bool> {
        value.boolean()
    }

    fn allowed(&self) -> String {
        "`true`, `false`".to_owned()
    }

    fn written(&self, value: bool) -> String {
        format!("`{value}`")
    }
}

/// A few words with their meanings.
#[derive(Debug, Clone, Copy)]
pub struct Words<T: 'static>(pub &'static [(&'static str, T)]);

impl<T: Copy + PartialEq> KeyRange for Words<T> {
    type Read = T;

    fn take(&self, value: &Value<'_>) -> Option<T> {
        value.choice(self.0)
    }

    fn allowed(&self) -> String {
        words(self.0.iter().map(|(word, _)| *word))
    }

    fn written(&self, value: T) -> String {
        words(self.0.iter().filter(|(_, meaning)| *meaning == value).map(|(word, _)| *word).take(1))
    }
}

/// Words as the study file has them.
pub fn words<'w>(words: impl Iterator<Item = &'w str>) -> String {
    words.map(|word| format!("`\"{word}\"`")).collect::<Vec<_>>().join(", ")
}

/// A key of a table.
#[derive(Debug, Clone, Copy)]
pub struct Key<R: KeyRange> {
    /// The name.
    pub name: &'static str,
    /// What the value may be.
    pub range: R,
    /// The value where the key is not given.
    pub default: Option<R::Read>,
    /// What the page has instead of a default where there is none.
    without: &'static str,
    /// What else is allowed, behind the range.
    further: &'static str,
    /// The sentence.
    meaning: &'static str,
}

impl<R: KeyRange> Key<R> {
    /// A key that has to be given.
    pub const fn new(name: &'static str, range: R, meaning: &'static str) -> Self {
        Self { name, range, default: None, without: "required", further: "", meaning }
    }

    /// The same with a default.
    pub const fn or(mut self, default: R::Read) -> Self {
        self.default = Some(default);
        self
    }

    /// The same with words for what holds where it is not given.
    pub const fn without(mut self, without: &'static str) -> Self {
        self.without = without;
        self
    }

    /// The same with words for what is allowed, too.
    pub const fn further(mut self, further: &'static str) -> Self {
        self.further = further;
        self
    }

    /// The same with another sentence.
    pub const fn meaning(mut self, meaning: &'static str) -> Self {
        self.meaning = meaning;
        self
    }

    /// The value, or the default; a key without one is required. A table that is not there has no keys.
    pub fn read<'t, 'a: 't>(&self, table: impl Into<Option<&'t TomlTable<'a>>>) -> Option<R::Read> {
        let Some(table) = table.into() else { return self.default };
        let value = match self.default {
            Some(default) => match table.optional(self.name) {
                None => return Some(default),
                value => value,
            },
            None => table.required(self.name),
        };
        value.and_then(|value| self.range.take(&value))
    }

    /// The value, if it is given: the inner `None` where it is not, the outer one where it is wrong.
    pub fn given<'t, 'a: 't>(&self, table: impl Into<Option<&'t TomlTable<'a>>>) -> Option<Option<R::Read>> {
        let value = table.into().and_then(|table| table.optional(self.name));
        value.map_or(Some(None), |value| self.range.take(&value).map(Some))
    }

    /// Its row of the page of keys.
    pub fn row(&self) -> KeyRow {
        let default = self.default.map(|default| self.range.written(default));
        KeyRow {
            name: self.name.to_owned(),
            of: String::new(),
            allowed: format!("{}{}", self.range.allowed(), self.further),
            default: default.unwrap_or_else(|| self.without.to_owned()),
            meaning: self.meaning.to_owned(),
        }
    }
}

/// A key as the page of keys has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyRow {
    /// The name.
    pub name: String,
    /// Of what it is a key, where others of its table have the same name.
    pub of: String,
    /// What is allowed.
    pub allowed: String,
    /// The default, "required", or what holds without the key.
    pub default: String,
    /// What it means.
    pub meaning: String,
}

impl KeyRow {
    /// A key with a reader of its own.
    pub fn read_apart(name: &str, allowed: impl Into<String>, default: &str, meaning: &str) -> Self {
        let [name, default, meaning] = [name, default, meaning].map(str::to_owned);
        Self { name, of: String::new(), allowed: allowed.into(), default, meaning }
    }
}

#[cfg(test)]
mod tests {
    use super::{super::quantity, Key, Whole, Words};

    #[test]
    fn rows_have_range_and_default() {
        let row = Key::new("cut_off_hz", quantity::FREQUENCY, "where it ends").or(850.0).row();
        assert_eq!([row.allowed.as_str(), &row.default], ["more than 0, to 1e10 Hz", "850"]);
        let row = Key::new("starts", Whole(0, 9), "how many").further(", or none").row();
        assert_eq!([row.allowed.as_str(), &row.default], ["0 to 9, or none", "required"]);
        let sides = Words(&[("above", 1), ("below", -1)]);
        let row = Key::new("side", sides, "where").or(-1).row();
        assert_eq!([row.allowed.as_str(), &row.default], ["`\"above\"`, `\"below\"`", "`\"below\"`"]);
    }
}
