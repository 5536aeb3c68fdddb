//! Units that suit the values of an axis: 73 nm instead of 0.000073 mm, 64.6 kHz instead of 64600 Hz.

/// Prefixes of units, from the largest on.
const PREFIXES: [(&str, f64); 8] =
    [("G", 1e9), ("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("µ", 1e-6), ("n", 1e-9), ("p", 1e-12)];
/// The largest value of an axis below which a smaller prefix is easier to read: 0.15 m is 150 mm.
const SMALL: f64 = 0.2;
/// Frequencies from which an axis has kilohertz: up to there all digits are before the point.
const LARGE_HZ: f64 = 1e4;
/// And below which it has millihertz.
const SMALL_HZ: f64 = 1e-2;

/// A unit of an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AxisUnit {
    /// Its symbol.
    pub(crate) symbol: String,
    /// From SI to the unit.
    pub(crate) factor: f64,
}

impl AxisUnit {
    /// A unit with the prefix in which values up to a largest one are easily read, where it takes prefixes.
    ///
    /// * `base`: in SI.
    pub(crate) fn of(base: &str, largest: f64) -> Self {
        match base {
            "Hz" => Self::of_frequencies(largest),
            // Masses have their prefixes before grams, and nobody reads megagrams.
            "kg" => {
                let of_grams = Self::suiting(1e3 * largest, "g", 1e3);
                Self { factor: 1e3 * of_grams.factor, ..of_grams }
            }
            // Nor kilometres per second.
            "m" | "m/s" | "m/s²" | "rad" | "s" => Self::suiting(largest, base, 1.0),
            "Pa" | "J" => Self::suiting(largest, base, f64::INFINITY),
            // Forces, stiffnesses, dampers.
            _ if base.starts_with('N') => Self::suiting(largest, base, f64::INFINITY),
            _ => Self { symbol: base.to_owned(), factor: 1.0 },
        }
    }

    /// The unit with that prefix to `base` in which values up to a largest one are easily read.
    ///
    /// * `most`: the largest prefix that is used for this unit: nobody reads kilometres per second.
    fn suiting(largest: f64, base: &str, most: f64) -> Self {
        let suits = |(_, size): &(&str, f64)| {
            *size <= most && largest / size >= if *size > 1.0 { 1.0 } else { SMALL }
        };
        let is_known = largest.is_finite() && largest > 0.0;
        let found = PREFIXES.into_iter().find(|prefix| is_known && suits(prefix));
        let (prefix, size) = found.unwrap_or(("", 1.0));
        Self { symbol: format!("{prefix}{base}"), factor: 1.0 / size }
    }

    /// The unit of frequencies up to a highest one.
    fn of_frequencies(highest_hz: f64) -> Self {
        if (SMALL_HZ..LARGE_HZ).contains(&highest_hz) {
            return Self { symbol: "Hz".to_owned(), factor: 1.0 };
        }
        Self::suiting(highest_hz, "Hz", f64::INFINITY)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_leave_numbers_that_are_read_at_a_glance() {
        let unit = |largest: f64, base: &str| AxisUnit::of(base, largest).symbol;
        let lengths = [73e-9, 0.4e-3, 0.15, 2.6, 2600.0, 0.0, f64::NAN].map(|largest| unit(largest, "m"));
        assert_eq!(lengths, ["nm", "mm", "mm", "m", "m", "m", "m"]);
        assert_eq!([40.0, 999.0, 1200.0].map(|largest| unit(largest, "N")), ["N", "N", "kN"]);
        assert_eq!(unit(2e4, "m/s²"), "m/s²");
        assert_eq!(unit(2e5, "N/m"), "kN/m");
        let frequencies = [64.6e3, 1800.0, 0.5, 1e-3].map(|highest| unit(highest, "Hz"));
        assert_eq!(frequencies, ["kHz", "Hz", "Hz", "mHz"]);
        assert!((AxisUnit::of("Hz", 64.6e3).factor * 64.6e3 - 64.6).abs() < 1e-12);
    }

    #[test]
    fn masses_have_their_prefixes_before_grams_and_other_units_none() {
        let cases = [(1e-9, "µg", 1.0), (0.0376, "g", 37.6), (5.0, "kg", 5.0), (7800.0, "kg", 7800.0)];
        for (mass_kg, symbol, shown) in cases {
            let unit = AxisUnit::of("kg", mass_kg);
            assert_eq!(unit.symbol, symbol);
            assert!((unit.factor * mass_kg / shown - 1.0).abs() < 1e-12, "{mass_kg} kg is {unit:?}");
        }
        for base in ["", "1/s", "m²", "kg/m³"] {
            assert_eq!(AxisUnit::of(base, 1e-5), AxisUnit { symbol: base.to_owned(), factor: 1.0 });
        }
    }
}
