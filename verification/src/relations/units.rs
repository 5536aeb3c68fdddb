//! A study in other units of mass, length and time.
//!
//! The unit of a number stands at the end of its key, so its dimension `M^a L^b T^c` is read off there, and
//! the number is multiplied by `mass^a length^b time^c`. A key without a unit (counts, ratios, angles, names)
//! stays as it is.

use toml::{Table, Value};

/// What numbers of masses, lengths and times are multiplied by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Numbers of masses.
    pub mass: f64,
    /// Numbers of lengths.
    pub length: f64,
    /// Numbers of times.
    pub time: f64,
}

/// Ends of keys with their powers of mass, length and time; the first that fits counts.
const DIMENSIONS: [(&str, [f64; 3]); 20] = [
    ("_n_m_s_rad", [1.0, 2.0, -1.0]),
    ("_n_m_rad", [1.0, 2.0, -2.0]),
    ("_kg_m2", [1.0, 2.0, 0.0]),
    ("_kg_m3", [1.0, -3.0, 0.0]),
    ("_n_m15", [1.0, -0.5, -2.0]),
    ("_n_m3", [1.0, -2.0, -2.0]),
    ("_n_s_m", [1.0, 0.0, -1.0]),
    ("_n_m", [1.0, 0.0, -2.0]),
    ("_m_s2", [0.0, 1.0, -2.0]),
    ("_s_m", [0.0, -1.0, 1.0]),
    ("_m2", [0.0, 2.0, 0.0]),
    ("_m4", [0.0, 4.0, 0.0]),
    ("_pa", [1.0, -1.0, -2.0]),
    ("_per_s", [0.0, 0.0, -1.0]),
    ("_kg", [1.0, 0.0, 0.0]),
    ("_n", [1.0, 1.0, -2.0]),
    ("_hz", [0.0, 0.0, -1.0]),
    ("_rad", [0.0, 0.0, 0.0]),
    ("_m", [0.0, 1.0, 0.0]),
    ("_s", [0.0, 0.0, 1.0]),
];

impl Units {
    /// Those of the study.
    pub const SI: Self = Self { mass: 1.0, length: 1.0, time: 1.0 };

    /// The study in these units.
    #[must_use]
    pub fn rescaled(&self, study: &Table) -> Table {
        study.iter().map(|(key, value)| (key.clone(), self.value(key, value))).collect()
    }

    /// What a number of the dimension `M^a L^b T^c` is multiplied by.
    #[must_use]
    pub fn factor(&self, [a, b, c]: [f64; 3]) -> f64 {
        self.mass.powf(a) * self.length.powf(b) * self.time.powf(c)
    }

    /// What a number under this key is multiplied by.
    fn of_key(&self, key: &str) -> f64 {
        let dimension = DIMENSIONS.iter().find(|(end, _)| key.ends_with(end));
        dimension.map_or(1.0, |(_, powers)| self.factor(*powers))
    }

    fn value(&self, key: &str, value: &Value) -> Value {
        match value {
            Value::Table(table) => Value::Table(self.rescaled(table)),
            Value::Array(entries) if entries.iter().all(Value::is_array) => {
                Value::Array(entries.iter().map(|pair| self.of_table(key, pair)).collect())
            }
            Value::Array(entries) => {
                Value::Array(entries.iter().map(|entry| self.value(key, entry)).collect())
            }
            _ => number(value).map_or_else(|| value.clone(), |x| scaled(value, x, self.of_key(key))),
        }
    }

    /// A pair of frequency and amplitude.
    fn of_table(&self, key: &str, pair: &Value) -> Value {
        let entries = pair.as_array().map_or(&[][..], Vec::as_slice);
        let keys = ["frequency_hz", key];
        Value::Array(entries.iter().zip(keys).map(|(entry, key)| self.value(key, entry)).collect())
    }
}

/// A number stays as it was written if nothing changes, since counts are whole numbers.
fn scaled(value: &Value, number: f64, factor: f64) -> Value {
    if factor == 1.0 { value.clone() } else { Value::Float(number * factor) }
}

/// The number of a value, written with or without a decimal point.
pub(super) fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stiffness_is_a_force_over_a_length() {
        let units = Units { mass: 3.0, length: 0.7, time: 1.9 };
        let force = units.of_key("amplitude_n");
        for (key, expected) in [
            ("stiffness_n_m", force / 0.7),
            ("stiffness_n_m3", force / 0.7_f64.powi(3)),
            ("stiffness_n_m15", force / 0.7_f64.powf(1.5)),
            ("damping_n_s_m", force / 0.7 * 1.9),
            ("youngs_modulus_pa", force / 0.49),
            ("density_kg_m3", 3.0 / 0.343),
            ("loss_s_m", 1.9 / 0.7),
            ("rotational_damper_n_m_s_rad", force * 0.7 * 1.9),
            ("mass_per_s", 1.0 / 1.9),
            ("stiffness_s", 1.9),
            ("acceleration_m_s2", 0.7 / 3.61),
            ("frequency_hz", 1.0 / 1.9),
            ("phase_rad", 1.0),
            ("restitution", 1.0),
        ] {
            assert!((units.of_key(key) / expected - 1.0).abs() < 1e-14, "{key}");
        }
    }
}
