//! Numbers of a study file by their key paths, and its text with other numbers in their places.
//!
//! A path leads through the tables of the file. An element of a list of tables is named by its `name`, or by
//! its number from 1: `structure.point.contact.mass_kg` and `structure.point.1.mass_kg` are the same. Numbers
//! that choose how something is computed are not numbers of the model and are left out.

use std::ops::Range;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use crate::document::unit::measured;

/// Tables that say how something is computed, and what.
const NOT_OF_THE_MODEL: [&str; 8] =
    ["reduction", "response", "search", "continuation", "vary", "curve", "figures", "rig"];
/// Keys that count or bound.
const NOT_A_QUANTITY: [&str; 4] = ["elements", "order", "frequency_hz", "frequency"];
/// Keys of names, which may look like quantities.
const NAMES: [&str; 5] = ["name", "title", "between", "fixed_to", "kind"];

/// A number in the text of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// Its paths, the one with names first.
    pub keys: Vec<String>,
    /// Where it stands [bytes].
    pub span: Range<usize>,
    /// Its value, in the SI unit at the end of its key.
    pub value: f64,
    /// That unit, where it is written as a text with a unit.
    pub unit: Option<&'static str>,
}

/// All numbers of the model that the text of a study holds.
pub fn numbers(text: &str) -> Vec<Number> {
    let (document, _) = DeTable::parse_recoverable(text);
    let mut found = Vec::new();
    let tables =
        document.get_ref().iter().filter(|(key, _)| !NOT_OF_THE_MODEL.contains(&key.get_ref().as_ref()));
    for (key, value) in tables {
        collect(value, &[key.get_ref().to_string()], &mut found);
    }
    found.sort_by_key(|number| number.span.start);
    found
}

/// The number with that key path, `None` if there is none.
///
/// # Errors
/// How many there are, if there are several: names of elements may be numbers of others.
pub fn number_named(text: &str, key: &str) -> Result<Option<Number>, usize> {
    let mut named = numbers(text);
    named.retain(|number| number.keys.iter().any(|known| known == key));
    if named.len() > 1 { Err(named.len()) } else { Ok(named.pop()) }
}

/// The key paths of everything that the text of a study holds, tables and what is no number as well.
pub(crate) fn written_paths(text: &str) -> Vec<String> {
    let (document, _) = DeTable::parse_recoverable(text);
    let mut found = Vec::new();
    for (key, value) in document.get_ref() {
        collect_paths(value, vec![key.get_ref().to_string()], &mut found);
    }
    found
}

fn collect_paths(value: &Spanned<DeValue<'_>>, paths: Vec<String>, found: &mut Vec<String>) {
    match value.get_ref() {
        DeValue::Table(table) => {
            for (key, value) in table {
                collect_paths(value, extended(&paths, &[key.get_ref().to_string()]), found);
            }
        }
        DeValue::Array(elements) => {
            for (index, element) in elements.iter().enumerate() {
                collect_paths(element, extended(&paths, &element_names(index, element)), found);
            }
        }
        _ => {}
    }
    found.extend(paths);
}

/// The name of an element of a list, if it has one, and its number from 1.
fn element_names(index: usize, element: &Spanned<DeValue<'_>>) -> Vec<String> {
    let name = match element.get_ref() {
        DeValue::Table(table) => table.get("name").and_then(|name| match name.get_ref() {
            DeValue::String(name) => Some(name.to_string()),
            _ => None,
        }),
        _ => None,
    };
    name.into_iter().chain([format!("{}", index + 1)]).collect()
}

fn collect(value: &Spanned<DeValue<'_>>, keys: &[String], found: &mut Vec<Number>) {
    let mut push = |value: Option<f64>, span: Range<usize>| {
        if let Some(value) = value.filter(|value| value.is_finite()) {
            found.push(Number { keys: keys.to_vec(), span, value, unit: None });
        }
    };
    match value.get_ref() {
        DeValue::Float(number) => push(number.as_str().parse().ok(), value.span()),
        DeValue::Integer(number) => {
            let whole = i64::from_str_radix(number.as_str(), number.radix()).ok();
            push(whole.map(|whole| whole as f64), value.span());
        }
        DeValue::String(text) => {
            if let Some(measured) = measured(text)
                && let Some(unit) = measured.dimension.unit()
            {
                let ends = || measured.dimension.suffixes().map(|(end, _)| end);
                let keys = keys.iter().flat_map(|key| ends().map(move |end| format!("{key}{end}"))).collect();
                found.push(Number { keys, span: value.span(), value: measured.value, unit: Some(unit) });
            }
        }
        DeValue::Table(table) => collect_table(table, keys, found),
        DeValue::Array(elements) => {
            for (index, element) in elements.iter().enumerate() {
                collect(element, &extended(keys, &element_names(index, element)), found);
            }
        }
        _ => {}
    }
}

fn collect_table(table: &DeTable<'_>, keys: &[String], found: &mut Vec<Number>) {
    for (key, value) in table {
        let key = key.get_ref().as_ref();
        if !NOT_A_QUANTITY.contains(&key) && !NAMES.contains(&key) {
            collect(value, &extended(keys, &[key.to_owned()]), found);
        }
    }
}

/// Every path with every name appended.
fn extended(keys: &[String], names: &[String]) -> Vec<String> {
    names.iter().flat_map(|name| keys.iter().map(move |key| format!("{key}.{name}"))).collect()
}

/// The text with other numbers in their places.
pub fn replaced(text: &str, numbers: &[Number], values: &[f64]) -> String {
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by_key(|index| std::cmp::Reverse(numbers[*index].span.start));
    let mut text = text.to_owned();
    for index in order {
        let value = written(values[index]);
        let value = numbers[index].unit.map_or(value.clone(), |unit| format!("\"{value} {unit}\""));
        text.replace_range(numbers[index].span.clone(), &value);
    }
    text
}

/// A number as TOML has it, with every digit.
pub fn written(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 || (1e-3..1e6).contains(&magnitude) { format!("{value:?}") } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STUDY: &str = include_str!("../../../studies/beam-with-stop.toml");

    fn value(key: &str) -> Option<f64> {
        let all = numbers(STUDY);
        all.iter().find(|number| number.keys.iter().any(|known| known == key)).map(|number| number.value)
    }

    #[test]
    fn numbers_are_found_by_name_and_by_count() {
        assert_eq!(value("structure.youngs_modulus_pa"), Some(2.1e11));
        assert_eq!(value("structure.section.height_m"), Some(0.002));
        assert_eq!(value("structure.point.contact.mass_kg"), Some(0.03756));
        assert_eq!(value("structure.point.1.mass_kg"), Some(0.03756));
        assert_eq!(value("stop.1.stiffness_n_m15"), Some(4.5e9));
        assert_eq!(value("damping.modal_ratio"), Some(0.015));
    }

    #[test]
    fn what_is_no_quantity_of_the_model_is_left_out() {
        for key in
            ["structure.elements", "reduction.cut_off_hz", "search.trials", "excitation.frequency_hz.1"]
        {
            assert_eq!(value(key), None, "{key}");
        }
    }

    #[test]
    fn only_the_numbers_change() {
        let all = numbers(STUDY);
        let chosen: Vec<Number> = all
            .into_iter()
            .filter(|number| {
                ["structure.length_m", "stop.1.stiffness_n_m15"]
                    .iter()
                    .any(|key| number.keys.contains(&(*key).to_owned()))
            })
            .collect();
        let text = replaced(STUDY, &chosen, &[0.3, 1.25e9]);
        let expected = STUDY
            .replace("length_m = 0.2579822 ", "length_m = 0.3 ")
            .replace("4.5e9            #", "1.25e9            #");
        assert_ne!(expected, STUDY);
        assert_eq!(text, expected);
    }

    #[test]
    fn numbers_are_written_so_that_they_are_read_back_bit_by_bit() {
        for value in [0.0, 0.1 + 0.2, 2.1e11 / 3.0, 1.59e-8, -0.5, 1e22, 999_999.9] {
            let text = format!("x = {}", written(value));
            let table = DeTable::parse(&text).unwrap();
            let DeValue::Float(number) = table.get_ref().get("x").unwrap().get_ref() else {
                panic!("{text}")
            };
            assert_eq!(number.as_str().parse::<f64>().unwrap(), value);
        }
    }
}
