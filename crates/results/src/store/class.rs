//! The kind of a motion, as six columns: class, period, doubt, largest exponent, its half width, K of the 0-1
//! test.

use hammerbeam_attractor::{Class, Estimate, MotionDoubt};
use rusqlite::{Row as SqlRow, types::Value};

use super::{StoreError, values::whole};

/// The longest period that a motion is looked at for [excitation periods], and some.
const MOST: i64 = 1 << 16;

/// What is known of a motion's kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kind {
    pub class: Class,
    pub largest_exponent: Option<Estimate>,
    pub zero_one: Option<f64>,
}

impl Kind {
    /// The six values.
    pub fn columns(self) -> [Value; 6] {
        let number = |value: Option<f64>| value.map_or(Value::Null, Value::Real);
        [
            Value::Text(self.class.name().to_owned()),
            self.class.period().map_or(Value::Null, |period| Value::Integer(period as i64)),
            self.class.doubt().map_or(Value::Null, |doubt| Value::Text(doubt.to_owned())),
            number(self.largest_exponent.map(|exponent| exponent.value)),
            number(self.largest_exponent.map(|exponent| exponent.half_width)),
            number(self.zero_one),
        ]
    }

    /// The kind that stands in six columns from `first` on.
    pub fn read(row: &SqlRow<'_>, first: usize) -> Result<Self, StoreError> {
        let (name, period, doubt): (String, Option<i64>, Option<String>) =
            (row.get(first)?, row.get(first + 1)?, row.get(first + 2)?);
        let exponent: (Option<f64>, Option<f64>) = (row.get(first + 3)?, row.get(first + 4)?);
        Ok(Self {
            class: class(name, period, doubt)?,
            largest_exponent: exponent
                .0
                .zip(exponent.1)
                .map(|(value, half_width)| Estimate { value, half_width }),
            zero_one: row.get(first + 5)?,
        })
    }
}

fn class(name: String, period: Option<i64>, doubt: Option<String>) -> Result<Class, StoreError> {
    match (name.as_str(), period) {
        ("periodic", Some(period)) => {
            Ok(Class::Periodic { period: whole("period", period, 1, MOST)? as usize })
        }
        ("quasi-periodic", _) => Ok(Class::QuasiPeriodic),
        ("chaotic", _) => Ok(Class::Chaotic),
        ("doubtful", _) => {
            let reason = doubt.unwrap_or_default();
            let named = MotionDoubt::ALL.into_iter().find(|doubt| doubt.reason() == reason);
            Ok(Class::Doubtful(named.ok_or(StoreError::Unknown { what: "doubt", found: reason })?))
        }
        _ => Err(StoreError::Unknown { what: "class of a motion", found: name }),
    }
}
