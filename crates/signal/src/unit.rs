//! Units as people write them, and what they measure.

/// What a channel measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Displacement [m].
    Displacement,
    /// Velocity [m/s].
    Velocity,
    /// Acceleration [m/s²].
    Acceleration,
    /// Force [N].
    Force,
    /// Time [s].
    Time,
    /// Frequency [Hz].
    Frequency,
    /// Anything else, in the unit of the file.
    Other,
}

impl Quantity {
    /// Ending of a key or column that says the unit, without the underscore; nothing for [`Quantity::Other`].
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Displacement => "m",
            Self::Velocity => "m_s",
            Self::Acceleration => "m_s2",
            Self::Force => "n",
            Self::Time => "s",
            Self::Frequency => "hz",
            Self::Other => "",
        }
    }

    /// SI unit for people to read.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Displacement => "m",
            Self::Velocity => "m/s",
            Self::Acceleration => "m/s^2",
            Self::Force => "N",
            Self::Time => "s",
            Self::Frequency => "Hz",
            Self::Other => "",
        }
    }

    /// The word for it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Force => "force",
            Self::Time => "time",
            Self::Frequency => "frequency",
            Self::Other => "other",
        }
    }
}

/// A unit that is known: value in SI = factor · value in the unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// What it measures.
    pub quantity: Quantity,
    /// SI value of one of it.
    pub factor: f64,
}

/// Standard acceleration of free fall [m/s²] (3rd General Conference on Weights and Measures, 1901).
pub const STANDARD_GRAVITY: f64 = 9.806_65;
const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;
const POUND_FORCE: f64 = 0.453_592_37 * STANDARD_GRAVITY;

use Quantity::{Acceleration, Displacement, Force, Frequency, Time, Velocity};

/// Spellings after [`simplified`]; upper and lower case matter.
const UNITS: &[(&str, Quantity, f64)] = &[
    ("m", Displacement, 1.0),
    ("cm", Displacement, 1e-2),
    ("mm", Displacement, 1e-3),
    ("um", Displacement, 1e-6),
    ("micron", Displacement, 1e-6),
    ("microns", Displacement, 1e-6),
    ("nm", Displacement, 1e-9),
    ("in", Displacement, INCH),
    ("inch", Displacement, INCH),
    ("mil", Displacement, 1e-3 * INCH),
    ("ft", Displacement, FOOT),
    ("m/s", Velocity, 1.0),
    ("cm/s", Velocity, 1e-2),
    ("mm/s", Velocity, 1e-3),
    ("um/s", Velocity, 1e-6),
    ("in/s", Velocity, INCH),
    ("ips", Velocity, INCH),
    ("ft/s", Velocity, FOOT),
    ("m/s2", Acceleration, 1.0),
    ("m/s/s", Acceleration, 1.0),
    ("cm/s2", Acceleration, 1e-2),
    ("mm/s2", Acceleration, 1e-3),
    ("um/s2", Acceleration, 1e-6),
    ("in/s2", Acceleration, INCH),
    ("ft/s2", Acceleration, FOOT),
    ("g", Acceleration, STANDARD_GRAVITY),
    ("G", Acceleration, STANDARD_GRAVITY),
    ("gn", Acceleration, STANDARD_GRAVITY),
    ("g_n", Acceleration, STANDARD_GRAVITY),
    ("g's", Acceleration, STANDARD_GRAVITY),
    ("mg", Acceleration, 1e-3 * STANDARD_GRAVITY),
    ("N", Force, 1.0),
    ("kN", Force, 1e3),
    ("mN", Force, 1e-3),
    ("lbf", Force, POUND_FORCE),
    ("s", Time, 1.0),
    ("sec", Time, 1.0),
    ("secs", Time, 1.0),
    ("second", Time, 1.0),
    ("seconds", Time, 1.0),
    ("Sec", Time, 1.0),
    ("S", Time, 1.0),
    ("ms", Time, 1e-3),
    ("msec", Time, 1e-3),
    ("us", Time, 1e-6),
    ("ns", Time, 1e-9),
    ("min", Time, 60.0),
    ("h", Time, 3600.0),
    ("Hz", Frequency, 1.0),
    ("hz", Frequency, 1.0),
    ("kHz", Frequency, 1e3),
];

/// Endings of names that say a unit, as in `acceleration_m_s2`; longest first.
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

/// Longest text that is compared with the spellings [bytes]; none comes near it, with blanks and brackets.
const LONGEST: usize = 64;

/// A unit from its text, `None` if it is not known.
#[must_use]
pub fn unit(text: &str) -> Option<Unit> {
    let text = text.trim();
    // A title of a million letters is looked at from each of its blanks on.
    if text.len() > LONGEST {
        return None;
    }
    let simple = simplified(text);
    UNITS
        .iter()
        .find(|(spelling, ..)| *spelling == simple)
        .map(|&(_, quantity, factor)| Unit { quantity, factor })
}

/// One spelling for `m/s^2`, `m/s²`, `m s^-2`, `m·s⁻²`, `m/s**2`, and `u` for the two letters mu.
fn simplified(text: &str) -> String {
    let text = text.trim().trim_matches(['[', ']', '(', ')', '{', '}']).trim();
    let mut simple: String = text
        .replace('²', "2")
        .replace("⁻", "-")
        .replace('¹', "1")
        .replace(['µ', 'μ'], "u")
        .replace("**", "^")
        .replace(['^', '{', '}'], "");
    for separator in ["·", "*", "."] {
        simple = simple.replace(separator, " ");
    }
    let words: Vec<&str> = simple.split_whitespace().collect();
    match words[..] {
        [length, "s-2"] => format!("{length}/s2"),
        [length, "s-1"] => format!("{length}/s"),
        // Without a blank.
        [power] if power.ends_with("s-2") || power.ends_with("s-1") => {
            power.replacen("s-2", "/s2", 1).replacen("s-1", "/s", 1)
        }
        _ => words.concat(),
    }
}

/// Splits the title of a column into name and unit: `acc (m/s^2)`, `time [s]`, `a / g`, `v m/s`,
/// `velocity_m_s`, `t, ms`, `x in mm`.
///
/// # Returns
/// The name, and the text of the unit if there is one. A text in brackets is taken for a unit whether it is
/// known or not; otherwise only known units are told from words, the longest that the title ends in. What is
/// something per time (`rad/s`, `load_n_s`) is no time.
#[must_use]
pub fn split_title(title: &str) -> (String, Option<String>) {
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

/// Name and unit of a title that ends in a known unit behind a blank, a comma or a slash; or in one that is
/// not known, if it is something per time.
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
        // "speed m/s" is divided by a time, "Test time/s" is one.
        let last = name.rsplit([' ', '_', '.']).next().unwrap_or(name);
        let divided = separator == "/" && is_time(text) && !names_time(name) && !names_time(last);
        if !divided || title[..at].ends_with(' ') {
            return Some((name, text));
        }
        return title[..at].rfind(' ').map(|blank| (bare_name(&title[..blank]), title[blank..].trim()));
    }
    None
}

/// Without what joins a name to its unit.
fn bare_name(text: &str) -> &str {
    let name = text.trim_end_matches([' ', ',', '/', '-', ':']);
    name.strip_suffix(" in").unwrap_or(name).trim()
}

fn is_time(text: &str) -> bool {
    unit(text).is_some_and(|unit| unit.quantity == Time)
}

/// Whether a name ends in something that `_s` makes a rate of.
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

/// Whether a name is that of a time column.
#[must_use]
pub fn names_time(name: &str) -> bool {
    let name = name.trim().to_lowercase();
    // X_Value is what LabVIEW calls it.
    matches!(name.as_str(), "t" | "temps" | "tiempo" | "tempo" | "seconds" | "sec" | "x_time" | "x_value")
        || ["time", "zeit", "elapsed"].iter().any(|word| name.starts_with(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acceleration_has_many_spellings() {
        for text in [
            "m/s^2",
            "m/s²",
            "m/s2",
            "m/s/s",
            "[m/s^2]",
            "m s^-2",
            "m·s⁻²",
            "m/s**2",
            " m / s^2 ",
            "ms-2",
            "ms^-2",
        ] {
            let found = unit(text).unwrap_or_else(|| panic!("{text} is not known"));
            assert_eq!((found.quantity, found.factor), (Acceleration, 1.0), "{text}");
        }
        assert_eq!(unit("g").unwrap().factor, 9.80665);
        assert_eq!(unit("µm"), unit("μm"));
        assert_eq!(unit("mm").unwrap().factor, 1e-3);
        assert_eq!(unit("furlong"), None);
    }

    #[test]
    fn a_title_of_a_million_letters_is_looked_at_once() {
        // Half a minute in a damaged file, as every blank began a unit that was simplified whole.
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
