//! Impacts on rigid stops in the figures of an orbit: a velocity that jumps, and an impulse instead of a
//! force.

use super::data::{OrbitDiagram, OrbitImpulse, OrbitSample};
use crate::{
    chart::{ChartPanel, Measure},
    dots::{Dot, Shape},
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    style::line_pattern,
};

/// Radius of the dot on an impulse (pt).
const RADIUS: f64 = 1.4;

/// A gap in a line.
const GAP: (f64, f64) = (f64::NAN, f64::NAN);

impl OrbitDiagram {
    /// Displacement (mm) over the time, with its corners.
    pub(super) fn displacement(&self) -> Vec<(f64, f64)> {
        let at = |impulse: &OrbitImpulse| vec![(impulse.cycles, 1e3 * impulse.displacement_m)];
        self.motion_history(|time, sample| (time, 1e3 * sample.displacement_m), at)
    }

    /// Acceleration over the time, with a gap at each impact.
    pub(super) fn acceleration(&self) -> Vec<(f64, f64)> {
        let at = |impulse: &OrbitImpulse| {
            let [before, after] = impulse.acceleration_m_s2;
            vec![(impulse.cycles, before), GAP, (impulse.cycles, after)]
        };
        self.motion_history(|time, sample| (time, sample.acceleration_m_s2), at)
    }

    /// Velocity over displacement (mm), with a gap at each impact.
    pub(super) fn portrait(&self) -> Vec<(f64, f64)> {
        let at = |impulse: &OrbitImpulse| {
            let [before, after] = ends(impulse);
            vec![before, GAP, after]
        };
        self.motion_history(|_, sample| (1e3 * sample.displacement_m, sample.velocity_m_s), at)
    }

    /// The jumps of the velocity, each a line of its own.
    pub(super) fn jumps(&self) -> Vec<(f64, f64)> {
        self.impulses.iter().flat_map(|impulse| [&ends(impulse)[..], &[GAP]].concat()).collect()
    }

    /// Points of the samples and of the impacts between them, closed at the end of the period.
    fn motion_history(
        &self,
        of_sample: impl Fn(f64, &OrbitSample) -> (f64, f64),
        of_impulse: impl Fn(&OrbitImpulse) -> Vec<(f64, f64)>,
    ) -> Vec<(f64, f64)> {
        let step = self.periods() / self.samples.len().max(1) as f64;
        let mut impulses = self.impulses.iter().peekable();
        let mut points = Vec::with_capacity(self.samples.len() + 1 + 3 * self.impulses.len());
        for (k, sample) in self.samples.iter().chain(self.samples.first()).enumerate() {
            let time = k as f64 * step;
            while let Some(impulse) = impulses.next_if(|impulse| impulse.cycles <= time) {
                points.extend(of_impulse(impulse));
            }
            points.push(of_sample(time, sample));
        }
        points
    }

    /// Whether there is a panel of forces: a force acts over a finite time, or there is no rigid stop.
    pub(super) fn has_forces(&self) -> bool {
        let forces = || self.samples.iter().flat_map(|sample| &sample.forces_n);
        forces().next().is_some() && (self.impulses.is_empty() || forces().any(|force| *force != 0.0))
    }

    /// The impulses as stems over the time.
    pub(super) fn impulse_panel(&self) -> Option<ChartPanel> {
        let mut layers = vec![Layer::Levels { at: vec![0.0] }];
        for element in self.hit_elements() {
            let of_element = self.impulses.iter().filter(|impulse| impulse.element == element);
            let tips: Vec<(f64, f64)> =
                of_element.map(|impulse| (impulse.cycles, impulse.impulse_n_s)).collect();
            let intervals = tips.iter().map(|&(time, value)| (time, 0.0, value)).collect();
            let dot = dot(element);
            layers.push(Layer::Whiskers { intervals, colour: dot.colour });
            layers.push(Layer::Dots { points: tips, dot });
        }
        let heading = self.impulses_in_words();
        let y = Measure::new("Impulse (N s)");
        (!self.impulses.is_empty()).then_some(ChartPanel { quantity: "impulse", y, layers, heading })
    }

    /// Legend of the stems, if several stops are hit.
    pub(super) fn impulse_entries(&self) -> Vec<LegendEntry> {
        let elements = self.hit_elements();
        let name = |element: usize| format!("impulse of {}", self.element_name(element));
        let entry =
            |&element: &usize| LegendEntry { sample: LegendSample::Dot(dot(element)), name: name(element) };
        if elements.len() > 1 { elements.iter().map(entry).collect() } else { Vec::new() }
    }

    /// Local elements that are hit, once each.
    fn hit_elements(&self) -> Vec<usize> {
        let mut elements: Vec<usize> = self.impulses.iter().map(|impulse| impulse.element).collect();
        elements.sort_unstable();
        elements.dedup();
        elements
    }
}

/// Displacement (mm) and velocity before and after an impact.
fn ends(impulse: &OrbitImpulse) -> [(f64, f64); 2] {
    impulse.velocity_m_s.map(|velocity| (1e3 * impulse.displacement_m, velocity))
}

/// The dot on the impulses of a local element.
fn dot(element: usize) -> Dot {
    const SHAPES: [Shape; 4] = [Shape::Circle, Shape::Square, Shape::TriangleUp, Shape::TriangleDown];
    let (shape, colour) = (SHAPES[element % SHAPES.len()], line_pattern(element).colour);
    Dot { shape, colour, full: true, radius: RADIUS }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball between phase 0 and an impact half-way, which turns its velocity from 2 to -1 m/s.
    fn bouncing() -> OrbitDiagram {
        let sample = |k: i32| OrbitSample {
            displacement_m: 1e-3 * f64::from(k),
            velocity_m_s: if k < 2 { 2.0 } else { -1.0 },
            forces_n: vec![0.0],
            ..OrbitSample::default()
        };
        let impulse = OrbitImpulse {
            cycles: 0.375,
            impulse_n_s: -3.0,
            displacement_m: 1.5e-3,
            velocity_m_s: [2.0, -1.0],
            ..OrbitImpulse::default()
        };
        OrbitDiagram {
            period_multiple: 1,
            samples: (0..4).map(sample).collect(),
            impulses: vec![impulse],
            ..OrbitDiagram::default()
        }
    }

    #[test]
    fn a_jump_of_the_velocity_is_a_gap_between_its_two_ends() {
        let points = bouncing().portrait();
        assert_eq!(points[..3], [(0.0, 2.0), (1.0, 2.0), (1.5, 2.0)]);
        assert!(points[3].0.is_nan());
        assert_eq!(points[4..], [(1.5, -1.0), (2.0, -1.0), (3.0, -1.0), (0.0, 2.0)]);
        assert_eq!(bouncing().jumps()[..2], [(1.5, 2.0), (1.5, -1.0)]);
    }

    #[test]
    fn a_displacement_has_a_corner_at_the_impact_and_no_gap() {
        let points = bouncing().displacement();
        assert_eq!(points[2], (0.375, 1.5));
        assert!(points.iter().all(|point| point.0.is_finite()) && points.len() == 6);
    }

    #[test]
    fn impulses_stand_in_words_few_of_them_each() {
        let mut orbit = bouncing();
        assert_eq!(orbit.impulses_in_words(), "impulse of the impact on a rigid stop: 3 N s");
        let second = OrbitImpulse { impulse_n_s: 0.25, ..orbit.impulses[0].clone() };
        orbit.impulses.push(second.clone());
        assert_eq!(orbit.impulses_in_words(), "impulses of 2 impacts on rigid stops: 3, 0.25 N s");
        orbit.impulses.extend(vec![second; 4]);
        let words = "6 impacts on rigid stops: together 4.25 N s, the largest 3 N s";
        assert_eq!(orbit.impulses_in_words(), words);
    }

    #[test]
    fn forces_have_a_panel_only_where_one_acts_over_a_time() {
        let mut orbit = bouncing();
        assert!(!orbit.has_forces());
        orbit.samples[0].forces_n = vec![-1.0];
        assert!(orbit.has_forces());
        orbit.impulses.clear();
        orbit.samples[0].forces_n = vec![0.0];
        assert!(orbit.has_forces(), "a stop that is not reached has its zero");
    }
}
