//! Derivatives of fundamental matrices along a vector, by central differences.
//!
//! Beside a grazing at the distance D matrices go like `sqrt(D)`. The *bend* of a difference, its second over
//! its first, is `h/(4 D)` then for a step h, and the quotient is off by twice its square; across the grazing
//! the bend stays about one. So steps are shortened until the bend is [`BEND`], or rounding, which goes like
//! one over the step, is more than is gained. The bend that is left gives the distance.

use hammerbeam_motion::exact::MotionError;

use super::shooting::{CurveOrbit, Segment, Shooting};

/// Step of central differences along a vector, relative to the orbit.
const DIFFERENCE: f64 = 1e-4;
/// Shortest such step: there rounding outweighs what is left of the bend in general ([`Quotients::error`]).
const LEAST_DIFFERENCE: f64 = 1e-11;
/// Part of a difference that its second difference may be.
const BEND: f64 = 0.001;
/// A bend that is left at the shortest step and says that the orbit grazes, as far as can be resolved.
const BREAK: f64 = 0.1;
/// Rounding of a matrix, relative to its largest entry.
const ROUNDING: f64 = 1e-11;
/// By how much a step is shortened at most at once, and which change of the quotients by that is none.
const SHORTENING: f64 = 0.05;
const SAME: f64 = 2.0 * BEND * BEND;

/// Quotients of differences, and how good they are.
#[derive(Debug)]
struct Quotients {
    segment: Segment,
    /// Second difference of the matrix, relative to the first.
    bend: f64,
    /// Rounding of the matrix, relative to the first.
    rounding: f64,
}

impl Quotients {
    /// Relative error, about.
    fn error(&self) -> f64 {
        2.0 * self.bend * self.bend + self.rounding
    }
}

impl Shooting {
    /// Derivative along the direction `v_k` at the node of each segment: of `G_k`, `dZ_k/df` and `dZ_k/dp`,
    /// by central differences.
    pub fn differences(
        &mut self,
        place: &CurveOrbit,
        directions: &[Vec<f64>],
    ) -> Result<Vec<Segment>, MotionError> {
        let by_segment = directions.iter().enumerate();
        by_segment.map(|(k, direction)| self.difference(k, place, direction)).collect()
    }

    /// That of one segment, with a step that is shortened as long as the difference is bent and rounding
    /// allows it.
    fn difference(
        &mut self,
        k: usize,
        place: &CurveOrbit,
        direction: &[f64],
    ) -> Result<Segment, MotionError> {
        let length = direction.iter().map(|d| d * d).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        let mut step = DIFFERENCE;
        let mut found = self.quotients(k, place, direction, step / length)?;
        while found.bend > BEND && step > LEAST_DIFFERENCE {
            let shorter = (step * (BEND / found.bend).max(SHORTENING)).max(LEAST_DIFFERENCE);
            let next = self.quotients(k, place, direction, shorter / length)?;
            let is_same = largest_change(&found.segment, &next.segment) <= SAME;
            // Across a grazing the bend stays about one, however short the step, until it is short against
            // the distance.
            if next.rounding > found.error() {
                break;
            }
            (found, step) = (next, shorter);
            if is_same {
                return self.with_number(k, place, direction, found.segment);
            }
        }
        if step < DIFFERENCE {
            let breaks = step == LEAST_DIFFERENCE && found.bend > BREAK;
            let distance = if breaks { 0.0 } else { step / (4.0 * found.bend.max(BEND)) };
            self.grazing_distance = self.grazing_distance.min(distance);
        }
        self.with_number(k, place, direction, found.segment)
    }

    /// The same, but where the parameter is a number of a family: there `dZ_k/dp` is a difference itself, so
    /// that `dG_k/dp` is taken of the matrices.
    fn with_number(
        &mut self,
        k: usize,
        place: &CurveOrbit,
        direction: &[f64],
        found: Segment,
    ) -> Result<Segment, MotionError> {
        let size = self.size();
        let scales = self.scale.values();
        let node = &place.nodes[k * size..(k + 1) * size];
        let unscaled = |values: &[f64]| values.iter().zip(scales).map(|(x, s)| x * s).collect::<Vec<f64>>();
        let (state, direction) = (unscaled(node), unscaled(direction));
        let stretch = self.stretch(k, place.frequency_hz, place.phase);
        let column = self.integrator.matrix_by_family((&stretch, &state), &direction)?;
        let Some(column) = column else { return Ok(found) };
        let by_parameter = column.iter().zip(self.scale.values()).map(|(z, s)| z / s).collect();
        Ok(Segment { by_parameter, ..found })
    }

    /// Central quotients of differences along a direction at the node of a segment.
    fn quotients(
        &mut self,
        segment: usize,
        place: &CurveOrbit,
        direction: &[f64],
        step: f64,
    ) -> Result<Quotients, MotionError> {
        let size = self.size();
        let node = &place.nodes[segment * size..(segment + 1) * size];
        let moved = |sign: f64| -> Vec<f64> {
            node.iter().zip(direction).map(|(z, d)| z + sign * step * d).collect()
        };
        let above = self.flow(segment, place, &moved(1.0))?;
        let below = self.flow(segment, place, &moved(-1.0))?;
        let quotient = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| (a - b) / (2.0 * step)).collect()
        };
        let here = &self.segments[segment].matrix;
        let ends = above.matrix.iter().zip(&below.matrix);
        let second = ends.zip(here).fold(0.0_f64, |most, ((a, b), at)| most.max((a - 2.0 * at + b).abs()));
        let quotients = Segment {
            end: Vec::new(),
            rounding: 0.0,
            touches: Vec::new(),
            matrix: quotient(&above.matrix, &below.matrix),
            by_frequency: quotient(&above.by_frequency, &below.by_frequency),
            by_parameter: quotient(&above.by_parameter, &below.by_parameter),
        };
        let first = (2.0 * step * largest(&quotients.matrix)).max(f64::MIN_POSITIVE);
        let rounding = ROUNDING * largest(here) / first;
        Ok(Quotients { segment: quotients, bend: second / first, rounding })
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}

/// Largest difference of the matrices of quotients, relative to their largest entry.
fn largest_change(a: &Segment, b: &Segment) -> f64 {
    let differences: Vec<f64> = a.matrix.iter().zip(&b.matrix).map(|(a, b)| a - b).collect();
    largest(&differences) / largest(&b.matrix).max(f64::MIN_POSITIVE)
}
