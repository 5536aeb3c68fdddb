//! Titles of columns: name and unit.

use crate::unit::{MeasuredQuantity, unit};

/// Endings of names that give a unit, as in `acceleration_m_s2`; longest first.
const ENDINGS: &[(&str, &str)] = &[
    ("_mm_s2", "mm/s2"),
    ("_m_s2", "m/s2"),
    ("_mm_s", "mm/s"),
    ("_m_s", "m/s"),
    ("_mm", "mm"),
    ("_um", "um"),
    ("_ms", "ms"),
    ("_us", "us"),
    ("_hz", "Hz"),
    ("_m", "m"),
    ("_s", "s"),
    ("_n", "N"),
    ("_g", "g"),
];

/// Splits the title of a column into name and unit: `acc (m/s^2)`, `time [s]`, `a / g`, `v m/s`,
/// `velocity_m_s`, `t, ms`, `x in mm`.
///
/// # Returns
/// The name, and the text of the unit if there is one. A text in brackets counts as a unit whether it is
/// known or not. Otherwise only known units count, the longest one at the end of the title. A quantity per
/// time (`rad/s`, `load_n_s`) is not a time.
pub(crate) fn split_title(title: &str) -> (String, Option<String>) {
    let title = title.trim();
    if let Some((name, unit)) = in_brackets(title) {
        return (name, Some(unit));
    }
    if unit(title).is_none()
        && let Some((name, text)) = known_end(title)
    {
        return (name.to_owned(), Some(text.to_owned()));
    }
    for (ending, text) in ENDINGS {
        if let Some(name) = title.strip_suffix(ending)
            && !name.is_empty()
            && !(is_time(text) && ends_in_dividend(name))
        {
            return (name.to_owned(), Some((*text).to_owned()));
        }
    }
    (title.to_owned(), None)
}

/// Name and unit of a title that ends in a known unit after a blank, a comma or a slash; or in an unknown
/// unit, if it is a quantity per time.
fn known_end(title: &str) -> Option<(&str, &str)> {
    for (at, separator) in title.match_indices([' ', '/', ',']) {
        let text = title[at + separator.len()..].trim();
        if text.is_empty() || unit(text).is_none() {
            continue;
        }
        let name = bare_name(&title[..at]);
        if name.is_empty() {
            return None;
        }
        // "speed m/s" is a quantity per time, "Test time/s" is a time.
        let last = name.rsplit([' ', '_', '.']).next().unwrap_or(name);
        let divided = separator == "/" && is_time(text) && !names_time(name) && !names_time(last);
        if !divided || title[..at].ends_with(' ') {
            return Some((name, text));
        }
        return title[..at].rfind(' ').map(|blank| (bare_name(&title[..blank]), title[blank..].trim()));
    }
    None
}

/// A name without the separator before its unit.
fn bare_name(text: &str) -> &str {
    let name = text.trim_end_matches([' ', ',', '/', '-', ':']);
    name.strip_suffix(" in").unwrap_or(name).trim()
}

fn is_time(text: &str) -> bool {
    unit(text).is_some_and(|unit| unit.quantity == MeasuredQuantity::Time)
}

/// Whether a name ends in a quantity of which `_s` makes a rate.
fn ends_in_dividend(name: &str) -> bool {
    ["_per", "_rad", "_deg", "_rev"]
        .into_iter()
        .chain(ENDINGS.iter().map(|ending| ending.0))
        .any(|end| name.ends_with(end))
}

fn in_brackets(title: &str) -> Option<(String, String)> {
    for (open, close) in [('[', ']'), ('(', ')'), ('{', '}')] {
        if let Some(body) = title.strip_suffix(close)
            && let Some((name, unit)) = body.rsplit_once(open)
        {
            let name = name.trim().trim_end_matches([':', ',', '/', '_']).trim();
            let name = if name.is_empty() { unit } else { name };
            return Some((name.to_owned(), unit.trim().to_owned()));
        }
    }
    None
}

/// Whether a name belongs to a time column.
pub(crate) fn names_time(name: &str) -> bool {
    let name = name.trim().to_lowercase();
    // X_Value is what LabVIEW calls it.
    matches!(name.as_str(), "t" | "temps" | "tiempo" | "tempo" | "seconds" | "sec" | "x_time" | "x_value")
        || ["time", "zeit", "elapsed"].iter().any(|word| name.starts_with(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_of_a_million_letters_is_split_in_linear_time() {
        // Regression: half a minute in a damaged file, since a unit was tried whole after every blank.
        let title = format!("{}x", "0.14 ".repeat(200_000));
        assert_eq!(split_title(&title), (title.clone(), None));
    }

    #[test]
    fn titles_are_split_into_name_and_unit() {
        for (title, name, text) in [
            ("time [s]", "time", Some("s")),
            ("acc (m/s^2)", "acc", Some("m/s^2")),
            ("a / g", "a", Some("g")),
            ("a/g", "a", Some("g")),
            ("velocity_m_s", "velocity", Some("m/s")),
            ("acceleration_m_s2", "acceleration", Some("m/s2")),
            ("Beschl. Spitze in mm/s²", "Beschl. Spitze", Some("mm/s²")),
            ("x, mm", "x", Some("mm")),
            ("tip [counts]", "tip", Some("counts")),
            ("speed m/s", "speed", Some("m/s")),
            ("Test time/s", "Test time", Some("s")),
            ("v mm/s", "v", Some("mm/s")),
            ("v/mm/s", "v", Some("mm/s")),
            ("acc m/s2", "acc", Some("m/s2")),
            ("Time - s", "Time", Some("s")),
            ("t/ms", "t", Some("ms")),
            ("time / s", "time", Some("s")),
            ("omega rad/s", "omega", Some("rad/s")),
            ("load N/s", "load", Some("N/s")),
            ("flow/s", "flow/s", None),
            ("load_n_s", "load_n_s", None),
            ("omega_rad_s", "omega_rad_s", None),
            ("exponent_per_s", "exponent_per_s", None),
            ("time_s", "time", Some("s")),
            ("left/right", "left/right", None),
            ("channel 1", "channel 1", None),
        ] {
            assert_eq!(split_title(title), (name.to_owned(), text.map(str::to_owned)), "{title}");
        }
    }
}
