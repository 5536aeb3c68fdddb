//! An axis: its scale, its ticks and its label.

use crate::{
    scale::Scale,
    text::Text,
    ticks::{Tick, ticks},
};

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    pub(crate) scale: Scale,
    pub(crate) ticks: Vec<Tick>,
    /// What it measures, with the unit.
    pub(crate) label: Text,
}

impl Axis {
    /// An axis of a length on paper (pt), with a label about every `spacing` (pt).
    pub(crate) fn new(scale: Scale, label: Text, length: f64, spacing: f64) -> Self {
        Self { scale, ticks: ticks(&scale, length / spacing), label }
    }

    /// Width of the widest tick label (pt).
    pub(crate) fn label_width(&self, size: f64) -> f64 {
        let labels = self.ticks.iter().filter_map(|tick| tick.label.as_deref());
        labels.map(|label| Text::upright(label).width(size)).fold(0.0, f64::max)
    }
}
