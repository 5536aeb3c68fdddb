//! Keys of a study file, read as a plain table.

use toml::{Table, Value};

use crate::results::BoxedError;

pub(super) fn table<'a>(table: &'a Table, key: &str) -> Result<&'a Table, BoxedError> {
    table.get(key).and_then(Value::as_table).ok_or_else(|| format!("no table {key}").into())
}

pub(super) fn list<'a>(table: &'a Table, key: &str) -> Vec<&'a Table> {
    let entries = table.get(key).and_then(Value::as_array);
    entries.into_iter().flatten().filter_map(Value::as_table).collect()
}

pub(super) fn text<'a>(table: &'a Table, key: &str) -> Result<&'a str, BoxedError> {
    table.get(key).and_then(Value::as_str).ok_or_else(|| format!("no text {key}").into())
}

pub(super) fn needed(table: &Table, key: &str) -> Result<f64, BoxedError> {
    let value = table.get(key).ok_or_else(|| format!("no number {key}"))?;
    let number = value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    number.ok_or_else(|| format!("{key} is no number").into())
}

pub(super) fn number(table: &Table, key: &str, default: f64) -> Result<f64, BoxedError> {
    if table.contains_key(key) { needed(table, key) } else { Ok(default) }
}
