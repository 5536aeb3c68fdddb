//! The quantity of a panel in the unit that suits its values.

use super::data::{MeasuredMark, ResponseDiagram, ResponsePoint, ResponseQuantity};
use crate::{axis_unit::AxisUnit, scale::ScaleKind, text::Text};

/// A quantity with the unit of its axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PanelQuantity {
    pub(super) quantity: ResponseQuantity,
    unit: AxisUnit,
    /// What an output is.
    title: String,
}

impl PanelQuantity {
    /// A quantity in the unit that suits what is seen of a diagram between two frequencies.
    pub(super) fn of(diagram: &ResponseDiagram, quantity: ResponseQuantity, (from, to): (f64, f64)) -> Self {
        let inside = diagram.all_points().filter(|point| (from..=to).contains(&point.frequency_hz));
        let marks = diagram.measured.iter().filter(|mark| (from..=to).contains(&mark.frequency_hz));
        let values =
            inside.map(|point| si(quantity, point)).chain(marks.map(|mark| measured(quantity, mark)));
        let values = values.filter(|&value| ScaleKind::Linear.shows(value));
        let largest = values.fold(0.0_f64, |most, value| most.max(value.abs()));
        let base = match quantity {
            ResponseQuantity::Displacement => "m",
            ResponseQuantity::Acceleration => "m/s²",
            ResponseQuantity::ContactForce => "N",
            ResponseQuantity::ImpactVelocity => "m/s",
            ResponseQuantity::Output => &diagram.output.unit,
        };
        // Lengths that are all zero are in millimetres.
        let none = if base == "m" { 1e-3 } else { 1.0 };
        let unit = AxisUnit::of(base, if largest > 0.0 { largest } else { none });
        Self { quantity, unit, title: diagram.output.title.clone() }
    }

    /// The quantity in words.
    pub(super) fn name(&self) -> &'static str {
        self.quantity.name()
    }

    /// The value in the unit of the axis.
    pub(super) fn value(&self, point: &ResponsePoint) -> f64 {
        self.unit.factor * si(self.quantity, point)
    }

    /// The value of a measured point in the unit of the axis; NaN if it was not measured.
    pub(super) fn measured(&self, mark: &MeasuredMark) -> f64 {
        self.unit.factor * measured(self.quantity, mark)
    }

    /// What the vertical axis shows.
    pub(super) fn label(&self) -> Text {
        let symbol = &self.unit.symbol;
        match self.quantity {
            ResponseQuantity::Displacement => {
                Text::upright("Displacement max\u{2009}|").variable("y").and(format!("| ({symbol})"))
            }
            ResponseQuantity::Acceleration => {
                Text::upright("Acceleration max\u{2009}|").variable("ÿ").and(format!("| ({symbol})"))
            }
            ResponseQuantity::ContactForce => Text::upright(format!("Largest contact force ({symbol})")),
            ResponseQuantity::ImpactVelocity => Text::upright(format!("Largest impact velocity ({symbol})")),
            ResponseQuantity::Output => Text::upright(format!("{} ({symbol})", self.title)),
        }
    }
}

fn si(quantity: ResponseQuantity, point: &ResponsePoint) -> f64 {
    match quantity {
        ResponseQuantity::Displacement => point.displacement_m,
        ResponseQuantity::Acceleration => point.acceleration_m_s2,
        ResponseQuantity::ContactForce => point.contact_force_n,
        ResponseQuantity::ImpactVelocity => point.impact_velocity_m_s,
        ResponseQuantity::Output => point.output,
    }
}

fn measured(quantity: ResponseQuantity, mark: &MeasuredMark) -> f64 {
    match quantity {
        ResponseQuantity::Displacement => mark.displacement_m.unwrap_or(f64::NAN),
        ResponseQuantity::Acceleration => mark.acceleration_m_s2.unwrap_or(f64::NAN),
        ResponseQuantity::ContactForce | ResponseQuantity::ImpactVelocity | ResponseQuantity::Output => {
            f64::NAN
        }
    }
}
