//! Numbers with their units, as in `length = "258 mm"`: what a unit is worth in SI, and of what dimension it
//! is.
//!
//! A unit is a product of powers: `N s/m`, `N/m^1.5`, `kg m^2`, `1/s`; what follows a stroke is divided by,
//! up to the next stroke or blank. A cycle is `2 pi` rad, so `1 Hz = 2 pi rad/s`, and `1/s` is something
//! else.
//!
//! A key of the study file that ends in an SI unit (`length_m`) has a form without it (`length`) that takes
//! such a text; `SUFFIXES` says which ends these are.

use std::f64::consts::{PI, TAU};

/// Powers of metre, kilogram, second and radian.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dimension([f64; 4]);

/// A quantity in SI, frequencies in hertz.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The number, in the SI unit of its dimension.
    pub value: f64,
    /// The dimension.
    pub dimension: Dimension,
}

/// Ends of keys and the units that they stand for, the longer of two that fit first.
const SUFFIXES: [(&str, &str); 23] = [
    ("_pa", "Pa"),
    ("_n_m_s_rad", "N m s/rad"),
    ("_n_m_rad", "N m/rad"),
    ("_n_s_m", "N s/m"),
    ("_n_m15", "N/m^1.5"),
    ("_n_m3", "N/m^3"),
    ("_n_m2", "N/m^2"),
    ("_kg_m3", "kg/m^3"),
    ("_kg_m2", "kg m^2"),
    ("_kg_m", "kg/m"),
    ("_m_s2", "m/s^2"),
    ("_per_s", "1/s"),
    ("_n_m", "N/m"),
    ("_s_m", "s/m"),
    ("_rad", "rad"),
    ("_hz", "Hz"),
    ("_kg", "kg"),
    ("_m4", "m^4"),
    ("_m3", "m^3"),
    ("_m2", "m^2"),
    ("_m", "m"),
    ("_n", "N"),
    ("_s", "s"),
];

/// A unit: its name, worth, decimal exponent and powers, and whether it takes prefixes.
struct Unit(&'static str, f64, i32, [f64; 4], bool);

const UNITS: [Unit; 20] = [
    Unit("m", 1.0, 0, [1.0, 0.0, 0.0, 0.0], true),
    Unit("g", 1.0, -3, [0.0, 1.0, 0.0, 0.0], true),
    Unit("t", 1.0, 3, [0.0, 1.0, 0.0, 0.0], false),
    Unit("s", 1.0, 0, [0.0, 0.0, 1.0, 0.0], true),
    Unit("min", 60.0, 0, [0.0, 0.0, 1.0, 0.0], false),
    Unit("h", 3600.0, 0, [0.0, 0.0, 1.0, 0.0], false),
    Unit("rad", 1.0, 0, [0.0, 0.0, 0.0, 1.0], true),
    Unit("deg", PI / 180.0, 0, [0.0, 0.0, 0.0, 1.0], false),
    Unit("Hz", TAU, 0, FREQUENCY, true),
    Unit("rpm", TAU / 60.0, 0, FREQUENCY, false),
    Unit("N", 1.0, 0, [1.0, 1.0, -2.0, 0.0], true),
    Unit("Pa", 1.0, 0, [-1.0, 1.0, -2.0, 0.0], true),
    Unit("bar", 1.0, 5, [-1.0, 1.0, -2.0, 0.0], true),
    Unit("J", 1.0, 0, [2.0, 1.0, -2.0, 0.0], true),
    Unit("in", 0.0254, 0, [1.0, 0.0, 0.0, 0.0], false),
    Unit("ft", 0.3048, 0, [1.0, 0.0, 0.0, 0.0], false),
    Unit("lb", 0.453_592_37, 0, [0.0, 1.0, 0.0, 0.0], false),
    Unit("lbf", 4.448_221_615_260_5, 0, [1.0, 1.0, -2.0, 0.0], false),
    Unit("psi", 6_894.757_293_168_361, 0, [-1.0, 1.0, -2.0, 0.0], false),
    Unit("ksi", 6_894.757_293_168_361, 3, [-1.0, 1.0, -2.0, 0.0], false),
];
const FREQUENCY: [f64; 4] = [0.0, 0.0, -1.0, 1.0];

const PREFIXES: [(&str, i32); 10] = [
    ("p", -12),
    ("n", -9),
    ("u", -6),
    ("\u{b5}", -6),
    ("\u{3bc}", -6),
    ("m", -3),
    ("c", -2),
    ("k", 3),
    ("M", 6),
    ("G", 9),
];

/// A product of units: its worth without the decimal exponent, that exponent, and the powers.
#[derive(Debug, Clone, Copy)]
struct Product {
    worth: f64,
    exponent: f64,
    powers: [f64; 4],
}

/// Bytes of a number with its unit at most: every start of it is tried.
const LONGEST: usize = 200;

/// A text such as `258 mm`; `None` where it is no number with a unit.
pub fn measured(text: &str) -> Option<Measured> {
    let text = text.trim();
    if text.len() > LONGEST {
        return None;
    }
    // The number is the longest start of the text that is one.
    let number = (1..=text.len()).rev().filter_map(|end| text.get(..end)).map(str::trim_end);
    let number = number.into_iter().find(|begin| begin.parse::<f64>().is_ok_and(f64::is_finite))?;
    let product = product(text[number.len()..].trim())?;
    let in_units = shifted(number, product.exponent)?;
    let value = in_units * if product.powers == FREQUENCY { product.worth / TAU } else { product.worth };
    value.is_finite().then_some(Measured { value, dimension: Dimension(product.powers) })
}

/// A frequency with its unit, such as `31.4 rad/s` or `5 kHz`, in hertz.
#[must_use]
pub fn hertz(text: &str) -> Option<f64> {
    measured(text)
        .filter(|measured| measured.dimension == Dimension(FREQUENCY))
        .map(|measured| measured.value)
}

/// A number with its unit to nine digits at most, in a unit in which it is neither tiny nor huge: `25.8 um`
/// for 2.58e-5 m, `8.1e-9 N m^2` where no prefix fits.
///
/// * `unit`: in SI.
#[must_use]
pub fn readable(value: f64, unit: &str) -> String {
    readable_to(value, unit, 9)
}

/// The same to so many digits at most, from 1.
#[must_use]
pub fn readable_to(value: f64, unit: &str, digits: usize) -> String {
    let digits = |value: f64| format!("{value:.*e}", digits.max(1) - 1).parse::<f64>().unwrap_or(value);
    let rounded = digits(value);
    if rounded == 0.0 {
        // Without a sign.
        return format!("0 {unit}");
    }
    // Masses have their prefixes before grams.
    let (base, own) = if unit == "kg" { ("g", 3) } else { (unit, 0) };
    let takes_prefixes = UNITS.iter().any(|known| known.0 == base && known.4);
    // Nobody writes megagrams.
    let most = if takes_prefixes && unit != "kg" { 1e4 } else { 1e6 };
    if (1e-4..most).contains(&rounded.abs()) {
        return format!("{rounded} {unit}");
    }
    let fits = |exponent: i32| (1.0..1000.0).contains(&digits(value * 10_f64.powi(own - exponent)).abs());
    let prefix = PREFIXES.iter().find(|(name, exponent)| *name != "c" && fits(*exponent));
    match prefix.filter(|_| takes_prefixes) {
        Some((name, exponent)) => format!("{} {name}{base}", digits(value * 10_f64.powi(own - exponent))),
        None if (1e-4..1e6).contains(&rounded.abs()) => format!("{rounded} {unit}"),
        None => format!("{rounded:e} {unit}"),
    }
}

/// A decimal number times a power of ten, rounded once: `258 mm` is the same number as `0.258 m`.
fn shifted(number: &str, exponent: f64) -> Option<f64> {
    if exponent.fract() != 0.0 {
        return Some(number.parse::<f64>().ok()? * 10_f64.powf(exponent));
    }
    let (mantissa, own) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    format!("{mantissa}e{}", own.parse::<i64>().ok()?.checked_add(exponent as i64)?).parse().ok()
}

/// The form of a key without its unit, and that SI unit: `gap` and `m` of `gap_m`.
pub fn stem_and_unit(key: &str) -> Option<(&str, &'static str)> {
    SUFFIXES.iter().find_map(|(end, name)| Some((key.strip_suffix(end)?, *name)))
}

/// The form of a key without its unit, and the dimension that this has.
pub fn without_unit(key: &str) -> Option<(&str, Dimension)> {
    let (stem, name) = stem_and_unit(key)?;
    Some((stem, Dimension(product(name)?.powers)))
}

impl Dimension {
    /// How keys end whose numbers have this dimension, with the SI unit: two ways for a pressure.
    pub fn suffixes(self) -> impl Iterator<Item = (&'static str, &'static str)> {
        SUFFIXES.into_iter().filter(move |(_, name)| product(name).is_some_and(|one| one.powers == self.0))
    }

    /// The SI unit, where keys have one of this dimension.
    pub fn unit(self) -> Option<&'static str> {
        self.suffixes().next().map(|(_, unit)| unit)
    }
}

/// A product of powers of units.
fn product(text: &str) -> Option<Product> {
    let mut product = Product { worth: 1.0, exponent: 0.0, powers: [0.0; 4] };
    let mut factors = 0;
    for (place, part) in text.split('/').enumerate() {
        let parts = part.split([' ', '*', '\u{b7}']).filter(|factor| !factor.is_empty());
        for (index, factor) in parts.enumerate() {
            if factor == "1" && place == 0 {
                continue;
            }
            let (name, power) = match factor.split_once('^') {
                Some((name, power)) => (name, power.parse::<f64>().ok().filter(|power| power.abs() <= 12.0)?),
                None => (factor, 1.0),
            };
            // Only the first factor behind a stroke is divided by.
            let power = if place > 0 && index == 0 { -power } else { power };
            let (Unit(_, worth, exponent, powers, _), prefix) = named(name)?;
            product.worth *= worth.powf(power);
            product.exponent += power * f64::from(exponent + prefix);
            for (sum, own) in product.powers.iter_mut().zip(powers) {
                *sum += power * own;
            }
            factors += 1;
        }
    }
    (factors > 0).then_some(product)
}

/// A unit by its name, and the exponent of its prefix.
fn named(name: &str) -> Option<(&'static Unit, i32)> {
    if let Some(unit) = UNITS.iter().find(|unit| unit.0 == name) {
        return Some((unit, 0));
    }
    UNITS.iter().filter(|unit| unit.4).find_map(|unit| {
        let prefix = name.strip_suffix(unit.0)?;
        Some((unit, PREFIXES.iter().find(|(known, _)| *known == prefix)?.1))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value, and the unit of its dimension.
    fn read(text: &str) -> Option<(f64, &'static str)> {
        let measured = measured(text)?;
        Some((measured.value, measured.dimension.unit()?))
    }

    #[test]
    fn quantities_are_read_in_si() {
        let cases = [
            ("258 mm", 0.258, "m"),
            ("4.5e9 N/m^1.5", 4.5e9, "N/m^1.5"),
            ("210GPa", 2.1e11, "Pa"),
            ("7.85 g/cm^3", 7850.0, "kg/m^3"),
            ("2 kN s/m", 2000.0, "N s/m"),
            ("3 N*s/mm", 3000.0, "N s/m"),
            ("-2.5 um", -2.5e-6, "m"),
            ("1 \u{b5}m", 1e-6, "m"),
            ("3 kg/s^2", 3.0, "N/m"),
            ("0.1 1/s", 0.1, "1/s"),
            ("1 in", 0.0254, "m"),
            ("1 psi", 6_894.757_293_168, "Pa"),
            ("12 kg m^2", 12.0, "kg m^2"),
            ("5 N m/rad", 5.0, "N m/rad"),
            ("9.81 m/s^2", 9.81, "m/s^2"),
            ("64.6 kHz", 64_600.0, "Hz"),
            ("6.283185307179586 rad/s", 1.0, "Hz"),
            ("90 rpm", 1.5, "Hz"),
            ("180 deg", PI, "rad"),
        ];
        for (text, value, unit) in cases {
            let (read, of) = read(text).unwrap_or_else(|| panic!("{text}"));
            assert!((read - value).abs() <= 1e-12 * value.abs(), "{text}: {read}");
            assert_eq!(of, unit, "{text}");
        }
    }

    #[test]
    fn frequencies_are_read_in_hertz() {
        assert_eq!(hertz("5 kHz"), Some(5000.0));
        assert_eq!(hertz("3 1/s"), None, "no cycles");
        assert!((hertz("31.4159265358979 rad/s").unwrap() - 5.0).abs() < 1e-13);
    }

    #[test]
    fn numbers_are_shown_in_a_unit_that_fits() {
        let shown = [
            (7.33e-8, "m", "73.3 nm"),
            (2.1e11, "Pa", "210 GPa"),
            (0.2579822, "m", "0.2579822 m"),
            (64_600.0, "Hz", "64.6 kHz"),
            (8_100.5, "Hz", "8100.5 Hz"),
            (25_000.0, "kg", "25000 kg"),
            (25_000.0, "N/m", "25000 N/m"),
            (6.46e6, "Hz", "6.46 MHz"),
            (-2.5e-5, "N", "-25 uN"),
            (3.756e-5, "kg", "37.56 mg"),
            (8.1e-9, "N m^2", "8.1e-9 N m^2"),
            (4.5e9, "N/m^1.5", "4.5e9 N/m^1.5"),
            (1e-15, "m", "1e-15 m"),
            (-0.0, "m", "0 m"),
        ];
        for (value, unit, text) in shown {
            assert_eq!(readable(value, unit), text);
        }
    }

    #[test]
    fn numbers_are_shown_to_so_many_digits() {
        assert_eq!(readable_to(1.018_599_305_4e-6, "m", 10), "1.018599305 um");
        assert_eq!(readable_to(9.999_96e-5, "m", 5), "0.0001 m", "rounding reaches the next unit");
        assert_eq!(readable_to(0.0, "N", 10), "0 N");
    }

    /// What is shown is read again.
    #[test]
    fn readable_numbers_are_quantities() {
        for value in [7.33e-8, 2.1e11, 0.258, -3.2e-5] {
            let again = measured(&readable(value, "m")).unwrap().value;
            assert!((again / value - 1.0).abs() < 1e-12, "{again} {value}");
        }
    }

    #[test]
    fn what_is_no_quantity_is_none() {
        for text in ["", "tip", "258", "mm", "3 parsec", "nan m", "1e999 m", "3 m^x", "3 m^99", "3 /", "- m"]
        {
            assert_eq!(measured(text), None, "{text}");
        }
    }

    #[test]
    fn keys_have_a_form_without_their_unit() {
        for (key, stem) in [
            ("length_m", Some("length")),
            ("stiffness_n_m15", Some("stiffness")),
            ("stiffness_n_m", Some("stiffness")),
            ("damping_n_s_m", Some("damping")),
            ("frequency_hz", Some("frequency")),
            ("mass_per_s", Some("mass")),
            ("name", None),
        ] {
            assert_eq!(without_unit(key).map(|(stem, _)| stem), stem, "{key}");
        }
    }

    #[test]
    fn a_quantity_is_the_number_that_one_would_write_in_si() {
        for (text, value) in
            [("258 mm", 0.258), ("0.1 um", 1e-7), ("64.6 kHz", 64_600.0), ("2e-3 MN", 2000.0)]
        {
            assert_eq!(measured(text).unwrap().value.to_bits(), f64::to_bits(value), "{text}");
        }
    }

    #[test]
    fn a_dimension_has_one_suffix_but_for_pressures() {
        for (suffix, name) in SUFFIXES {
            let of = |name: &str| product(name).unwrap().powers;
            let same: Vec<&str> =
                SUFFIXES.iter().filter(|pair| of(pair.1) == of(name)).map(|pair| pair.0).collect();
            assert!(same == [suffix] || same == ["_pa", "_n_m2"], "{suffix}: {same:?}");
        }
    }
}
