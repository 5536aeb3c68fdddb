//! A value of the document, taken as what it has to be.

use std::ops::Range;

use toml::de::{DeFloat, DeInteger, DeTable, DeValue};

use hammerbeam_signal::text::is_control;

use super::{
    Quantity, Reading, closest,
    unit::{Dimension, measured, without_unit},
};

/// Elements of an array of tables: masses, springs, stops.
const MOST_TABLES: usize = 1000;
/// Entries of another list.
const LONGEST_LIST: usize = 10_000;
/// Bytes of a text.
const LONGEST_TEXT: usize = 1000;

/// A value with its key path and its place; the readers give `None` after noting what is wrong.
pub struct Value<'a> {
    reading: &'a Reading,
    path: String,
    span: Range<usize>,
    value: &'a DeValue<'a>,
    /// Whether numbers are texts with a unit of the dimension of the key, as in `length = "258 mm"`.
    has_unit: bool,
}

impl<'a> Value<'a> {
    /// The value at a key path.
    pub fn new(reading: &'a Reading, path: String, span: Range<usize>, value: &'a DeValue<'a>) -> Self {
        Self { reading, path, span, value, has_unit: false }
    }

    /// The same, whose numbers are texts with a unit.
    pub fn with_unit(self) -> Self {
        Self { has_unit: true, ..self }
    }

    /// Last part of the key path, for messages.
    fn key(&self) -> &str {
        self.path.rsplit('.').next().unwrap_or(&self.path)
    }

    /// Notes a fault of this value.
    pub fn problem(&self, message: String, help: Vec<String>) {
        self.reading.problem(&self.path, Some(self.span.clone()), message, help);
    }

    /// What the value is, in words.
    fn found(&self) -> String {
        match self.value {
            DeValue::String(text) => format!("the string \"{text}\""),
            DeValue::Integer(number) => format!("the number {number}"),
            DeValue::Float(number) => format!("the number {number}"),
            DeValue::Boolean(value) => format!("the boolean {value}"),
            DeValue::Datetime(_) => "a date".to_owned(),
            DeValue::Array(_) => "a list".to_owned(),
            DeValue::Table(_) => "a table".to_owned(),
        }
    }

    fn wrong_type<T>(&self, expected: &str) -> Option<T> {
        self.wrong_type_with_help(expected, Vec::new())
    }

    pub(super) fn wrong_type_with_help<T>(&self, expected: &str, help: Vec<String>) -> Option<T> {
        self.problem(format!("`{}` must be {expected}, found {}", self.key(), self.found()), help);
        None
    }

    /// A finite number within the range of the quantity.
    pub fn number(&self, quantity: &Quantity) -> Option<f64> {
        let number = match self.value {
            DeValue::Integer(number) => integer(number).map_or(f64::INFINITY, |number| number as f64),
            DeValue::Float(number) => float(number),
            DeValue::String(text) if self.has_unit => self.in_si(text)?,
            _ => return self.wrong_type("a number"),
        };
        match quantity.fault(number) {
            None => Some(number),
            Some(help) => {
                self.problem(format!("`{}` is {}", self.key(), quantity.with_unit(number)), help);
                None
            }
        }
    }

    /// The number of a text with a unit, which has to be of the dimension of the key.
    fn in_si(&self, text: &str) -> Option<f64> {
        let key = self.key().split('[').next().unwrap_or_default();
        let dimension = without_unit(key).map(|(_, dimension)| dimension);
        match measured(text).filter(|measured| Some(measured.dimension) == dimension) {
            Some(measured) => Some(measured.value),
            None => {
                let unit = dimension.and_then(Dimension::unit).unwrap_or_default();
                self.wrong_type(&format!("a number with a unit that fits {unit}"))
            }
        }
    }

    /// A whole number from `low` to `high`.
    pub fn whole(&self, low: u32, high: u32) -> Option<u32> {
        let DeValue::Integer(number) = self.value else { return self.wrong_type("a whole number") };
        match integer(number).and_then(|number| u32::try_from(number).ok()) {
            Some(number) if (low..=high).contains(&number) => Some(number),
            _ => {
                let help = vec![format!("allowed: whole numbers from {low} to {high}")];
                self.problem(format!("`{}` is {number}", self.key()), help);
                None
            }
        }
    }

    /// True or false.
    pub fn boolean(&self) -> Option<bool> {
        match self.value {
            DeValue::Boolean(value) => Some(*value),
            _ => self.wrong_type("true or false"),
        }
    }

    /// A string.
    pub fn text(&self) -> Option<&'a str> {
        match self.value {
            DeValue::String(text) => self.visible(text.as_ref()),
            _ => self.wrong_type("a string"),
        }
    }

    /// Refuses a text that is very long or has characters that are not seen, which terminals obey and tables
    /// stumble over.
    fn visible(&self, text: &'a str) -> Option<&'a str> {
        let fault = if let Some(found) = text.chars().find(|character| is_control(*character)) {
            format!("`{}` has the control character U+{:04X}", self.key(), u32::from(found))
        } else if text.len() > LONGEST_TEXT {
            format!("`{}` is {} bytes long", self.key(), text.len())
        } else {
            return Some(text);
        };
        self.problem(fault, vec![format!("allowed: one line of at most {LONGEST_TEXT} bytes")]);
        None
    }

    /// Whether the value is a string.
    pub fn is_text(&self) -> bool {
        matches!(self.value, DeValue::String(_))
    }

    /// Whether the value is a list.
    pub fn is_list(&self) -> bool {
        matches!(self.value, DeValue::Array(_))
    }

    /// Whether the value is a list with nothing in it.
    pub fn is_empty_list(&self) -> bool {
        matches!(self.value, DeValue::Array(entries) if entries.is_empty())
    }

    /// One of a few words, each with its meaning. Another word is a fault; what was probably meant is read
    /// then, for the faults of what depends on it.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Option<T> {
        let text = self.text()?;
        let meaning =
            |word: &str| choices.iter().find(|(name, _)| *name == word).map(|(_, meaning)| *meaning);
        meaning(text).or_else(|| {
            let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
            self.unknown_word(text, "one of the allowed words", &names);
            meaning(closest(text, names)?)
        })
    }

    /// Notes that a word is not one of those known.
    pub fn unknown_word(&self, word: &str, what: &str, known: &[&str]) {
        let mut help = vec![format!("allowed: {}", known.join(", "))];
        if let Some(close) = closest(word, known.iter().copied()) {
            help.insert(0, format!("did you mean \"{close}\"?"));
        }
        self.problem(format!("`{}` is \"{word}\", which is not {what}", self.key()), help);
    }

    /// What a value is that has to be a table: where it stands and its entries.
    pub(super) fn entries(&self) -> Option<(&'a Reading, String, Range<usize>, &'a DeTable<'a>)> {
        match self.value {
            DeValue::Table(entries) => Some((self.reading, self.path.clone(), self.span.clone(), entries)),
            _ => None,
        }
    }

    /// A list; `what` says of what, for the message.
    pub fn array_of(&self, what: &str) -> Option<Vec<Value<'a>>> {
        self.at_most(LONGEST_LIST, "entries", what)
    }

    /// The elements of an array of tables.
    pub fn tables(&self, what: &str) -> Option<Vec<Value<'a>>> {
        self.at_most(MOST_TABLES, "tables", what)
    }

    fn at_most(&self, most: usize, name: &str, what: &str) -> Option<Vec<Value<'a>>> {
        let DeValue::Array(elements) = self.value else {
            return self.wrong_type(&format!("a list of {what}"));
        };
        if elements.len() > most {
            let found = format!("`{}` has {} entries", self.key(), elements.len());
            self.problem(found, vec![format!("allowed: at most {most} {name}")]);
            return None;
        }
        let element = |(index, element): (usize, &'a toml::Spanned<DeValue<'a>>)| {
            let path = format!("{}[{index}]", self.path);
            self.reading.note_place(&path, element.span());
            let element = Value::new(self.reading, path, element.span(), element.get_ref());
            if self.has_unit { element.with_unit() } else { element }
        };
        Some(elements.iter().enumerate().map(element).collect())
    }

    /// A list of exactly `N` numbers.
    pub fn numbers<const N: usize>(&self, quantity: &Quantity) -> Option<[f64; N]> {
        self.exactly(&format!("{N} numbers"), |element| element.number(quantity))
    }

    /// A list of exactly `N` values.
    pub fn exactly<const N: usize, T>(
        &self,
        what: &str,
        read: impl Fn(&Value<'a>) -> Option<T>,
    ) -> Option<[T; N]> {
        let elements = self.array_of(what)?;
        if elements.len() != N {
            self.problem(
                format!("`{}` has {} entries", self.key(), elements.len()),
                vec![format!("allowed: a list of {what}")],
            );
            return None;
        }
        let values: Vec<Option<T>> = elements.iter().map(read).collect();
        values.into_iter().collect::<Option<Vec<T>>>()?.try_into().ok()
    }
}

/// The integer, `None` if it has more than 64 bits.
fn integer(number: &DeInteger<'_>) -> Option<i64> {
    i64::from_str_radix(number.as_str(), number.radix()).ok()
}

/// The number; what is too large for a double becomes infinite and is refused as such.
fn float(number: &DeFloat<'_>) -> f64 {
    number.as_str().parse().unwrap_or(f64::NAN)
}
