//! The axis of a parameter other than the frequency.

use crate::axis_unit::AxisUnit;

/// What an axis over a parameter shows. Its data are in SI, and it has the prefix that suits them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ParameterAxis {
    /// What the parameter is, without its unit.
    pub title: String,
    /// Its SI unit without prefix; empty for a number without unit.
    pub unit: String,
}

impl ParameterAxis {
    /// The unit for values whose largest magnitude is given.
    pub(crate) fn unit_up_to(&self, largest: f64) -> AxisUnit {
        AxisUnit::of(&self.unit, largest)
    }

    /// Label of an axis in a unit.
    pub(crate) fn label(&self, unit: &AxisUnit) -> String {
        if unit.symbol.is_empty() { self.title.clone() } else { format!("{} ({})", self.title, unit.symbol) }
    }
}
