//! Positions of the parts of a beam on the page.

use crate::structure_diagram::data::{
    SketchBeam, SketchCarrier, SketchPoint, SketchStop, StopKind, StructureDiagram,
};
use crate::style::Style;

/// Half the depth of the beam, and radius of a mass (pt).
pub(super) const HALF: f64 = 1.8;
pub(super) const MASS: f64 = 3.6;
/// Room for stops on a side, and for the support of an end (pt).
pub(super) const REACH: f64 = 26.0;
pub(super) const END: f64 = 26.0;
/// Half the height of the support of an end (pt).
pub(super) const END_HALF: f64 = 11.0;
/// Thickness of parts that move with a support, and distance of dimension lines (pt).
pub(super) const BASE: f64 = 5.0;
pub(super) const ROW: f64 = 11.0;
/// Distance of fixed parts from moving parts (pt).
pub(super) const CLEAR: f64 = 7.0;
/// Largest number of points whose distances are drawn.
pub(super) const MEASURED: usize = 3;

/// Positions of all parts of a beam on the page.
pub(super) struct BeamLayout<'a> {
    pub(super) diagram: &'a StructureDiagram,
    pub(super) beam: &'a SketchBeam,
    pub(super) style: &'a Style,
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) middle: f64,
    /// Height of the carriers of stops above and below.
    pub(super) ceiling: f64,
    pub(super) floor: f64,
}

impl BeamLayout<'_> {
    pub(super) fn across(&self, at_m: f64) -> f64 {
        self.left + (self.right - self.left) * at_m / self.beam.length_m
    }

    /// Position of a point or an end; `None` for the ground.
    pub(super) fn of(&self, name: &str) -> Option<f64> {
        match name {
            "left" => Some(self.left),
            "right" => Some(self.right),
            _ => {
                let point = self.beam.points.iter().find(|point| point.name == name)?;
                Some(self.across(point.at_m))
            }
        }
    }

    pub(super) fn is_on(&self, stop: &SketchStop, above: bool) -> bool {
        let is_free = !matches!(stop.carrier, SketchCarrier::Point(_));
        is_free
            && match stop.kind {
                StopKind::TwoSided => true,
                StopKind::Always => !above,
                _ => stop.above == above,
            }
    }

    pub(super) fn has_above(&self) -> bool {
        self.diagram.stops.iter().any(|stop| self.is_on(stop, true))
    }

    pub(super) fn has_below(&self) -> bool {
        let held = |point: &SketchPoint| point.has_spring || point.has_damper;
        self.diagram.stops.iter().any(|stop| self.is_on(stop, false))
            || self.diagram.stops.iter().any(|stop| matches!(stop.carrier, SketchCarrier::Point(_)))
            || self.beam.points.iter().any(held)
            || self.inner_moving().next().is_some()
    }

    /// Whether a part below the beam is so close to a position that a line down from there would cross it.
    pub(super) fn is_taken_below(&self, x: f64) -> bool {
        let stops = self.diagram.stops.iter().filter(|stop| self.is_on(stop, false));
        let held = self.beam.points.iter().filter(|point| point.has_spring || point.has_damper);
        let places = stops.filter_map(|stop| self.of(&stop.point));
        let mut places = places.chain(held.map(|point| self.across(point.at_m)));
        (x == self.right && self.diagram.moves("right")) || places.any(|place| (place - x).abs() < 9.0)
    }

    /// Points between the ends that move with a support.
    pub(super) fn inner_moving(&self) -> impl Iterator<Item = f64> + '_ {
        let inner = self.diagram.moving.iter().filter(|moving| !["left", "right"].contains(&&*moving.place));
        inner.filter_map(|moving| self.of(&moving.place))
    }

    /// Points whose distances are drawn.
    pub(super) fn measured(&self) -> Vec<f64> {
        let inner = self.beam.points.iter().map(|point| point.at_m);
        let mut all: Vec<f64> = inner.filter(|at| *at > 0.0 && *at < self.beam.length_m).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        if all.len() > MEASURED { Vec::new() } else { all }
    }
}
