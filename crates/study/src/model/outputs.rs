//! Outputs of a study as signals of its motion.

use hammerbeam_motion::System;
use hammerbeam_orbit::{OrbitSignal, TimeDerivative};

use super::Model;
use crate::file::{OutputEntry, OutputPlace, OutputQuantity, OutputSource};

/// A displacement `shape . q + support_ratios . u`.
struct Displacement {
    shape: Vec<f64>,
    support_ratios: Vec<f64>,
}

impl Displacement {
    fn of(place: &OutputPlace, system: &System) -> Option<Self> {
        let model = system.model();
        let mut still =
            Self { shape: vec![0.0; model.dof()], support_ratios: vec![0.0; model.supports.len()] };
        match place {
            OutputPlace::Point(name) => {
                let point = model.point(name)?;
                Some(Self { shape: point.shape.clone(), support_ratios: point.support_ratios.clone() })
            }
            OutputPlace::Support(support) => {
                *still.support_ratios.get_mut(*support)? = 1.0;
                Some(still)
            }
            OutputPlace::Space => Some(still),
        }
    }

    fn less(mut self, other: &Self) -> Self {
        self.shape.iter_mut().zip(&other.shape).for_each(|(a, b)| *a -= b);
        self.support_ratios.iter_mut().zip(&other.support_ratios).for_each(|(a, b)| *a -= b);
        self
    }
}

/// What outputs of a study are to a system of it: that of the model, or one with another value of a
/// parameter.
///
/// # Returns
/// A signal for each output; `None` where the system lacks the point or the stop, as that of another study
/// does.
#[must_use]
pub fn output_signals(model: &Model, outputs: &[OutputEntry], system: &System) -> Option<Vec<OrbitSignal>> {
    outputs.iter().map(|output| signal(model, output, system)).collect()
}

fn signal(model: &Model, output: &OutputEntry, system: &System) -> Option<OrbitSignal> {
    let derivative = match output.quantity {
        OutputQuantity::Displacement | OutputQuantity::Force => TimeDerivative::Displacement,
        OutputQuantity::Velocity => TimeDerivative::Velocity,
        OutputQuantity::Acceleration => TimeDerivative::Acceleration,
    };
    let moving = match &output.source {
        OutputSource::At(place) => Displacement::of(place, system)?,
        OutputSource::Between(first, second) => {
            Displacement::of(first, system)?.less(&Displacement::of(second, system)?)
        }
        OutputSource::Stop { sides } => return pressing(model, sides, system),
    };
    let Displacement { shape, support_ratios } = moving;
    Some(OrbitSignal::Motion { shape, support_ratios, derivative })
}

fn pressing(model: &Model, sides: &[(usize, bool)], system: &System) -> Option<OrbitSignal> {
    let mut elements = Vec::new();
    for (stop, is_reversed) in sides {
        let turn = if *is_reversed { -1.0 } else { 1.0 };
        elements.extend(model.elements_of_stops.get(*stop)?.iter().map(|(e, sign)| (*e, turn * sign)));
    }
    let known = system.elements().len();
    let is_hole = |e: &usize| system.elements().get(*e).is_some_and(|e| e.law.round_hole().is_some());
    if let Some(first) = elements.iter().map(|(element, _)| *element).find(is_hole) {
        return (first + 1 < known).then_some(OrbitSignal::PressingAround { first });
    }
    elements.iter().all(|(element, _)| *element < known).then_some(OrbitSignal::Pressing { elements })
}
