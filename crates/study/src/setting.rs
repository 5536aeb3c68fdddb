//! Keys of a study with other values: `--set stop.tip.gap_m=0.2e-3`.
//!
//! A path leads through the tables of the file as in `number.rs`: an element of a list is named by its
//! `name`, or by its number from 1. The value takes the place of the one in the text, which stays as it is
//! otherwise, so that everything is read, checked and kept as if the file said so. A key that the file does
//! not have is written into its table; whether there is such a key at all, the readers of the study say.

use std::{ops::Range, str::FromStr};

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use crate::document::unit::{measured, without_unit};

/// A key and the value that it is given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// Path of the key.
    pub key: String,
    /// The value, as TOML has it; or a text without its quotation marks.
    pub value: String,
}

/// Why a setting cannot be written into a study.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum SettingError {
    /// There is no key, or no value.
    #[error("\"{text}\" is no setting: allowed is KEY=VALUE, as in stop.1.gap_m=0.2e-3")]
    NoAssignment { text: String },
    /// A list has no such element.
    #[error("{key} cannot be set: {path} has no element \"{name}\"; it has {}", known.join(", "))]
    NoSuchElement { key: String, path: String, name: String, known: Vec<String> },
    /// What the path leads through is no table.
    #[error("{key} cannot be set: {path} is no table")]
    NotATable { key: String, path: String },
    /// The file is not TOML.
    #[error("{key} cannot be set: the file is not TOML")]
    NotToml { key: String },
}

impl FromStr for Setting {
    type Err = SettingError;

    fn from_str(text: &str) -> Result<Self, SettingError> {
        let none = || SettingError::NoAssignment { text: text.to_owned() };
        let (key, value) = text.split_once('=').ok_or_else(none)?;
        let (key, value) = (key.trim(), value.trim());
        if key.is_empty() || value.is_empty() || key.split('.').any(str::is_empty) {
            return Err(none());
        }
        Ok(Self { key: key.to_owned(), value: value.to_owned() })
    }
}

impl Setting {
    /// The settings of a family: for each key a list of values, as in `stop.1.gap_m=0.1e-3,0.2e-3`, in all
    /// combinations, the last key changing fastest.
    #[must_use]
    pub fn combinations(lists: &[Self]) -> Vec<Vec<Self>> {
        let mut families = vec![Vec::new()];
        for list in lists {
            let values = entries(&list.value);
            let with = |family: &Vec<Self>| -> Vec<Vec<Self>> {
                let one = |value: &&str| Self { key: list.key.clone(), value: (*value).to_owned() };
                values.iter().map(|value| [family.clone(), vec![one(value)]].concat()).collect()
            };
            families = families.iter().flat_map(with).collect();
        }
        families
    }

    /// The name of a folder for results under these settings.
    #[must_use]
    pub fn folder_name(settings: &[Self]) -> String {
        let plain = |character: char| match character {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '.' | '-' | '+' | '_' | '=' => character,
            _ => '_',
        };
        let name = |one: &Self| format!("{}={}", one.key, one.value).chars().map(plain).collect::<String>();
        settings.iter().map(name).collect::<Vec<_>>().join("_")
    }

    /// The text of a study with these values.
    ///
    /// # Errors
    /// [`SettingError`].
    pub fn written_into(settings: &[Self], text: &str) -> Result<String, SettingError> {
        settings.iter().try_fold(text.to_owned(), |text, setting| setting.write(&text))
    }

    fn write(&self, text: &str) -> Result<String, SettingError> {
        let (document, errors) = DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            return Err(SettingError::NotToml { key: self.key.clone() });
        }
        let mut place = Place { table: document.get_ref(), span: None, path: Vec::new(), text };
        let mut rest = self.key.as_str();
        while let Some((name, further)) = rest.split_once('.') {
            let Some((_, value)) = entry(place.table, name) else {
                // A dotted key makes the tables on its way.
                return Ok(place.with_value(rest, &self.toml()));
            };
            place.path.push(name.to_owned());
            rest = further;
            match self.step(value, &mut place, &mut rest)? {
                Found::Table => {}
                Found::Value(span) => return Ok(replaced(text, span, &self.toml())),
            }
        }
        // A text with a unit stands under the key without one.
        let name = match without_unit(rest) {
            Some((stem, _)) if measured(self.value.trim_matches(['"', '\''])).is_some() => stem,
            _ => rest,
        };
        Ok(place.with_value(name, &self.toml()))
    }

    /// Goes into a table, or into an element of a list and on into its table.
    fn step<'d>(
        &self,
        value: &'d Spanned<DeValue<'d>>,
        place: &mut Place<'d>,
        rest: &mut &str,
    ) -> Result<Found, SettingError> {
        let mut value = value;
        while let DeValue::Array(elements) = value.get_ref() {
            let (index, further) = element(elements.iter().map(Spanned::get_ref), rest).ok_or_else(|| {
                let name = rest.split('.').next().unwrap_or_default().to_owned();
                let known = element_names(elements.iter().map(Spanned::get_ref));
                let path = place.path.join(".");
                SettingError::NoSuchElement { key: self.key.clone(), path, name, known }
            })?;
            value = &elements[index];
            place.path.push(format!("{}", index + 1));
            let Some(further) = further else { return Ok(Found::Value(value.span())) };
            *rest = &rest[rest.len() - further..];
        }
        let DeValue::Table(table) = value.get_ref() else {
            return Err(SettingError::NotATable { key: self.key.clone(), path: place.path.join(".") });
        };
        (place.table, place.span) = (table, Some(value.span()));
        Ok(Found::Table)
    }

    /// The value as TOML has it: a text without quotation marks gets them.
    fn toml(&self) -> String {
        let line = format!("x = {}", self.value);
        let is_toml =
            !self.value.contains('\n') && DeTable::parse(&line).is_ok_and(|table| table.get_ref().len() == 1);
        if is_toml { self.value.clone() } else { toml::Value::String(self.value.clone()).to_string() }
    }
}

enum Found {
    Table,
    Value(Range<usize>),
}

/// A table of the document in which a key is looked for.
struct Place<'d> {
    table: &'d DeTable<'d>,
    /// Where it stands; `None` of the whole document.
    span: Option<Range<usize>>,
    path: Vec<String>,
    text: &'d str,
}

impl Place<'_> {
    /// The text with a value for a key of this table.
    fn with_value(&self, key: &str, value: &str) -> String {
        if let Some((_, old)) = self.table.get_key_value(key) {
            return replaced(self.text, old.span(), value);
        }
        // Under its other name, with or without its unit, it would be there twice.
        if let Some((name, old)) = entry(self.table, key) {
            return replaced(self.text, name.span().start..old.span().end, &format!("{key} = {value}"));
        }
        let Some(span) = &self.span else { return format!("{key} = {value}\n{}", self.text) };
        if !self.text[span.clone()].starts_with(['{', '[']) {
            return self.beside_dotted_key(span, key, value);
        }
        if self.text[span.clone()].starts_with('[') {
            let header_end = self.text[span.start..].find('\n').map(|end| span.start + end + 1);
            let at = header_end.unwrap_or(self.text.len());
            let line = if header_end.is_some() { "" } else { "\n" };
            return replaced(self.text, at..at, &format!("{line}{key} = {value}\n"));
        }
        let last = self.table.iter().map(|(_, value)| value.span().end).max();
        match last {
            Some(end) => replaced(self.text, end..end, &format!(", {key} = {value}")),
            None => replaced(self.text, span.clone(), &format!("{{ {key} = {value} }}")),
        }
    }

    /// The same in a table that has no header, but is named in a dotted key.
    ///
    /// * `span`: of its name there.
    fn beside_dotted_key(&self, span: &Range<usize>, key: &str, value: &str) -> String {
        let start = self.text[..span.start].rfind(['\n', '{', ',']).map_or(0, |before| before + 1);
        let is_line = start == 0 || self.text[..start].ends_with('\n');
        let (table, end) = (&self.text[start..span.end], if is_line { "\n" } else { "," });
        replaced(self.text, start..start, &format!("{table}.{key} = {value}{end}"))
    }
}

/// The entry of a key: under its name, or with or without its unit.
fn entry<'d>(
    table: &'d DeTable<'d>,
    key: &str,
) -> Option<(&'d Spanned<std::borrow::Cow<'d, str>>, &'d Spanned<DeValue<'d>>)> {
    let stem = |key: &str| without_unit(key).map(|(stem, _)| stem.to_owned());
    let wanted = stem(key);
    let is_form = |name: &str| wanted.as_deref() == Some(name) || stem(name).as_deref() == Some(key);
    table.get_key_value(key).or_else(|| table.iter().find(|(name, _)| is_form(name.get_ref())))
}

/// The element that a path starts with, and how much of the path is left behind it.
fn element<'d>(
    elements: impl Iterator<Item = &'d DeValue<'d>> + Clone,
    path: &str,
) -> Option<(usize, Option<usize>)> {
    let behind = |name: &str| match path.strip_prefix(name)? {
        "" => Some(None),
        rest => rest.strip_prefix('.').map(|rest| Some(rest.len())),
    };
    let named = elements.clone().enumerate().filter_map(|(index, element)| {
        let name = name_of(element)?;
        Some((index, name.len(), behind(name)?))
    });
    // Of names that begin alike the longest.
    if let Some((index, _, rest)) = named.max_by_key(|(_, length, _)| *length) {
        return Some((index, rest));
    }
    let number = path.split('.').next()?;
    let index = number.parse::<usize>().ok()?.checked_sub(1)?;
    (index < elements.count()).then(|| behind(number).map(|rest| (index, rest)))?
}

fn name_of<'d>(element: &'d DeValue<'d>) -> Option<&'d str> {
    match element {
        DeValue::Table(table) => match table.get("name")?.get_ref() {
            DeValue::String(name) => Some(name),
            _ => None,
        },
        _ => None,
    }
}

fn element_names<'d>(elements: impl Iterator<Item = &'d DeValue<'d>>) -> Vec<String> {
    let name = |(index, element): (usize, &'d DeValue<'d>)| {
        name_of(element).map_or_else(|| format!("{}", index + 1), str::to_owned)
    };
    elements.enumerate().map(name).collect()
}

fn replaced(text: &str, span: Range<usize>, by: &str) -> String {
    format!("{}{by}{}", &text[..span.start], &text[span.end..])
}

/// The entries of a list of values: commas within brackets and quotation marks do not part them.
fn entries(list: &str) -> Vec<&str> {
    let (mut found, mut start, mut depth, mut quoted) = (Vec::new(), 0, 0_usize, None);
    for (at, character) in list.char_indices() {
        match (quoted, character) {
            (Some(mark), _) if character == mark => quoted = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quoted = Some(character),
            (None, '[' | '{') => depth += 1,
            (None, ']' | '}') => depth = depth.saturating_sub(1),
            (None, ',') if depth == 0 => {
                found.push(list[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    found.push(list[start..].trim());
    found.retain(|entry| !entry.is_empty());
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const STUDY: &str = r#"title = "a beam"
[structure]
kind = "beam"
length = "258 mm"    # as measured
section = { width_m = 0.02, height_m = 0.003 }
[[structure.point]]
name = "tip"
at_m = 0.25
[[structure.point]]
name = "tip.2"
at_m = 0.1
[excitation]
frequency_hz = [5.0, 25.0]
[[stop]]
at = "tip"
"#;

    fn with(settings: &[&str]) -> Result<String, SettingError> {
        let settings: Vec<Setting> = settings.iter().map(|text| text.parse().unwrap()).collect();
        Setting::written_into(&settings, STUDY)
    }

    #[track_caller]
    fn assert_written(setting: &str, old: &str, new: &str) {
        assert!(STUDY.contains(old), "{old}");
        assert_eq!(with(&[setting]).unwrap(), STUDY.replacen(old, new, 1));
    }

    #[test]
    fn a_value_takes_the_place_of_the_one_in_the_text() {
        assert_written("structure.section.height_m=4e-3", "0.003", "4e-3");
        assert_written("structure.point.1.at_m = 0.2", "0.25", "0.2");
        assert_written("structure.point.tip.at_m=0.2", "0.25", "0.2");
        assert_written("structure.point.tip.2.at_m=0.2", "0.1\n", "0.2\n");
        assert_written("excitation.frequency_hz.2=30", "25.0", "30");
        assert_written("excitation.frequency_hz=[6, 7]", "[5.0, 25.0]", "[6, 7]");
        assert_written("title=another", "\"a beam\"", "\"another\"");
    }

    #[test]
    fn a_key_with_its_unit_and_one_without_are_one() {
        assert_written("structure.length_m=0.3", "length = \"258 mm\"", "length_m = 0.3");
        assert_written("structure.length=30 cm", "\"258 mm\"", "\"30 cm\"");
        assert_written("structure.length_m=30 cm", "\"258 mm\"", "\"30 cm\"");
        assert_written("structure.point.1.at_m=20 cm", "at_m = 0.25", "at = \"20 cm\"");
        assert_written("structure.section.width=2 cm", "width_m = 0.02", "width = \"2 cm\"");
    }

    #[test]
    fn keys_that_the_file_does_not_have_are_written_into_their_tables() {
        assert_written("stop.1.gap_m=1e-3", "[[stop]]\n", "[[stop]]\ngap_m = 1e-3\n");
        assert_written("structure.section.form=x", "0.003 }", "0.003, form = \"x\" }");
        assert_written("search.trials=3", "title", "search.trials = 3\ntitle");
        let two = with(&["search.trials=3", "search.starts=2"]).unwrap();
        assert!(two.starts_with("search.starts = 2\nsearch.trials = 3\ntitle"), "{two}");
        let within = with(&["structure.section.web.x=1", "structure.section.web.y=2"]).unwrap();
        assert!(within.contains("height_m = 0.003, web.y = 2, web.x = 1 }"), "{within}");
        assert_written("excitation.order=2", "[excitation]\n", "[excitation]\norder = 2\n");
    }

    #[test]
    fn settings_are_written_one_after_the_other() {
        let text = with(&["structure.length_m=0.3", "structure.length=40 cm"]).unwrap();
        assert_eq!(text, STUDY.replacen("258 mm", "40 cm", 1));
    }

    #[test]
    fn what_is_no_setting_is_refused() {
        for text in ["gap", "=3", "stop.1.gap_m=", "stop..gap_m=3"] {
            assert!(text.parse::<Setting>().is_err(), "{text}");
        }
        let message = |text: &str| with(&[text]).unwrap_err().to_string();
        assert_eq!(
            message("structure.point.top.at_m=1"),
            "structure.point.top.at_m cannot be set: structure.point has no element \"top\"; it has tip, \
             tip.2"
        );
        assert_eq!(
            message("stop.2.gap_m=1"),
            "stop.2.gap_m cannot be set: stop has no element \"2\"; it has 1"
        );
        assert_eq!(
            message("structure.kind.x=1"),
            "structure.kind.x cannot be set: structure.kind is no table"
        );
    }

    #[test]
    fn families_are_all_combinations() {
        let lists: Vec<Setting> =
            ["a.b=1,2", "c=\"x, y\",[3, 4]"].iter().map(|text| text.parse().unwrap()).collect();
        let families = Setting::combinations(&lists);
        let names: Vec<String> = families.iter().map(|family| Setting::folder_name(family)).collect();
        assert_eq!(names, ["a.b=1_c=_x__y_", "a.b=1_c=_3__4_", "a.b=2_c=_x__y_", "a.b=2_c=_3__4_"]);
        assert_eq!(families[1][1].value, "[3, 4]");
        assert_eq!(Setting::combinations(&[]), vec![Vec::new()]);
    }
}
