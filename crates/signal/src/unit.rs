//! Units as users write them, and the quantities they measure.

/// Quantity that a channel measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredQuantity {
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
    /// Any other quantity, in the unit of the file.
    Other,
}

impl MeasuredQuantity {
    /// Ending of a key or column that names the unit, without the underscore; empty for
    /// [`MeasuredQuantity::Other`].
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

    /// Symbol of the SI unit.
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

    /// Its name in messages and reports.
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

/// A known unit: value in SI = factor · value in the unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// The quantity.
    pub quantity: MeasuredQuantity,
    /// SI value of one unit.
    pub factor: f64,
}

/// Standard acceleration of free fall [m/s²] (3rd General Conference on Weights and Measures, 1901).
pub const STANDARD_GRAVITY: f64 = 9.806_65;
const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;
const POUND_FORCE: f64 = 0.453_592_37 * STANDARD_GRAVITY;

use MeasuredQuantity::{Acceleration, Displacement, Force, Frequency, Time, Velocity};

/// Spellings after [`simplified`], case-sensitive.
const UNITS: &[(&str, MeasuredQuantity, f64)] = &[
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

/// Longest text that is compared with the spellings [bytes], far longer than any of them.
const LONGEST: usize = 64;

/// A unit from its text, `None` if it is unknown.
#[must_use]
pub fn unit(text: &str) -> Option<Unit> {
    let text = text.trim();
    // A title of a million letters is tried from each of its blanks on.
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
}
