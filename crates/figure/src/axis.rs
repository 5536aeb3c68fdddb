//! An axis: its scale, its ticks and its label.

use crate::{
    scale::Scale,
    text::Text,
    ticks::{Tick, ticks},
};

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlotAxis {
    pub(crate) scale: Scale,
    pub(crate) ticks: Vec<Tick>,
    /// What it measures, with the unit.
    pub(crate) label: Text,
}

impl PlotAxis {
    /// An axis of a length on paper (pt), with a label about every `spacing` (pt).
    pub(crate) fn new(scale: Scale, label: Text, length: f64, spacing: f64) -> Self {
        Self::in_unit((scale, 1.0), label, length, spacing)
    }

    /// The same with numbers that are the values of the data times a factor: these are in another unit.
    pub(crate) fn in_unit((scale, factor): (Scale, f64), label: Text, length: f64, spacing: f64) -> Self {
        let shown = Scale { from: factor * scale.from, to: factor * scale.to, ..scale };
        let of_data = |tick: Tick| Tick { value: tick.value / factor, ..tick };
        let ticks = ticks(&shown, length / spacing).into_iter().map(of_data).collect();
        Self { scale, ticks, label }
    }

    /// Width of the widest tick label (pt).
    pub(crate) fn label_width(&self, size: f64) -> f64 {
        let labels = self.ticks.iter().filter_map(|tick| tick.label.as_deref());
        labels.map(|label| Text::upright(label).width(size)).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scale::ScaleKind;

    #[test]
    fn ticks_of_another_unit_are_round_there_and_stand_where_the_data_have_them() {
        for kind in [ScaleKind::Linear, ScaleKind::Logarithmic] {
            let scale = Scale::exact(kind, (1.0, 50.0));
            let axis = PlotAxis::in_unit((scale, std::f64::consts::TAU), Text::default(), 300.0, 60.0);
            let labelled = axis.ticks.iter().filter_map(|tick| Some((tick.value, tick.label.as_deref()?)));
            let numbers: Vec<(f64, f64)> =
                labelled.filter_map(|(value, label)| Some((value, label.parse().ok()?))).collect();
            assert!(numbers.len() >= 2, "{:?}", axis.ticks);
            for (value, shown) in numbers {
                assert!((std::f64::consts::TAU * value / shown - 1.0).abs() < 1e-12, "{value} {shown}");
                assert!((0.0..=1.0).contains(&scale.share(value)));
            }
        }
    }
}
