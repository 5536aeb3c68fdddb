//! Aperiodic motions, and their stroboscopic points.
//!
//! Points of a section are stored as pairs of u16: steps of a 65 535th of the range of each coordinate from
//! its least value.

use serde_json::{Value, json};

use crate::{base64, motion::MotionKind};

/// Points of all sections together: 1.3 MB of a page.
const MOST_POINTS: usize = 250_000;
/// Steps in the range of a coordinate.
const STEPS: f64 = 65_535.0;

/// A settled motion of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct PageMotion {
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// What it is.
    pub kind: MotionKind,
    /// Largest displacement of the response point (m).
    pub displacement_m: f64,
}

/// Stroboscopic points of a motion.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageSection {
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Description of the source of the motion.
    pub origin: String,
    /// Kind of the motion; `None` if it was not classified.
    pub kind: Option<MotionKind>,
    /// Largest Lyapunov exponent with its half-width (1/s).
    pub exponent_per_s: Option<(f64, f64)>,
    /// Kaplan-Yorke dimension.
    pub dimension: Option<f64>,
    /// Coordinates of its points.
    pub plane: SectionPlane,
    /// Its points at phase 0, in the order of time.
    pub points: Vec<(f64, f64)>,
}

/// Coordinates of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SectionPlane {
    /// Displacement (m) and velocity (m/s) of the response point.
    #[default]
    Velocity,
    /// Its displacement (m), and that one excitation period later.
    NextDisplacement,
}

/// A motion in the format of the script.
pub(super) fn motion(motion: &PageMotion) -> Value {
    let kind = word(motion.kind);
    json!({ "frequency": motion.frequency_hz, "displacement": motion.displacement_m, "kind": kind })
}

/// Sections in the format of the script, each limited to its share of all points.
pub(super) fn sections(sections: &[PageSection]) -> Vec<Value> {
    let most = MOST_POINTS / sections.len().max(1);
    sections.iter().map(|one| section(one, most)).collect()
}

fn section(section: &PageSection, most: usize) -> Value {
    let is_finite = |point: &&(f64, f64)| point.0.is_finite() && point.1.is_finite();
    let points: Vec<(f64, f64)> = section.points.iter().filter(is_finite).copied().collect();
    let carried = &points[..points.len().min(most)];
    let x = CoordinateRange::of(carried.iter().map(|point| point.0));
    let y = CoordinateRange::of(carried.iter().map(|point| point.1));
    let pair = |point: &(f64, f64)| [x.steps(point.0), y.steps(point.1)];
    let bytes: Vec<u8> = carried.iter().flat_map(pair).flat_map(u16::to_le_bytes).collect();
    json!({
        "frequency": section.frequency_hz,
        "origin": section.origin,
        "kind": section.kind.map(word),
        "exponent": section.exponent_per_s,
        "dimension": section.dimension,
        "next": section.plane == SectionPlane::NextDisplacement,
        "count": points.len(),
        "x": [x.low, x.high],
        "y": [y.low, y.high],
        "points": base64::encode(&bytes),
    })
}

/// Least and largest value of a coordinate.
struct CoordinateRange {
    low: f64,
    high: f64,
}

impl CoordinateRange {
    fn of(values: impl Iterator<Item = f64>) -> Self {
        let widen = |range: Self, value: f64| Self { low: range.low.min(value), high: range.high.max(value) };
        values.fold(Self { low: f64::INFINITY, high: f64::NEG_INFINITY }, widen)
    }

    fn steps(&self, value: f64) -> u16 {
        let share = (value - self.low) / (self.high - self.low);
        (STEPS * share).round() as u16 // 0 / 0 for an empty range becomes 0
    }
}

fn word(kind: MotionKind) -> &'static str {
    match kind {
        MotionKind::Periodic { .. } => "periodic",
        MotionKind::QuasiPeriodic => "quasi-periodic",
        MotionKind::Chaotic => "chaotic",
        MotionKind::Doubtful => "doubtful",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(points: Vec<(f64, f64)>, most: usize) -> Value {
        section(&PageSection { points, ..PageSection::default() }, most)
    }

    /// Four zero bytes and four of 255 are the letters below.
    #[test]
    fn points_are_steps_in_their_ranges() {
        let found = of(vec![(-1.0, 2.0), (1.0, 3.0), (f64::NAN, 0.0)], 10);
        assert_eq!((&found["x"], &found["y"]), (&json!([-1.0, 1.0]), &json!([2.0, 3.0])));
        assert_eq!((&found["count"], &found["points"]), (&json!(2), &json!("AAAAAP////8=")));
    }

    #[test]
    fn what_has_no_room_is_counted_and_the_first_points_are_carried() {
        let found = of(vec![(0.0, 0.0); 7], 3);
        assert_eq!((&found["count"], found["points"].as_str().map(str::len)), (&json!(7), Some(16)));
        let nothing = of(Vec::new(), 3);
        assert_eq!((&nothing["x"], &nothing["points"]), (&json!([null, null]), &json!("")));
    }
}
