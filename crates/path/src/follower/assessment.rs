//! The assessment of a corrected candidate: the same smooth arc, an event on the way, or doubt. Equation (O8)
//! of the book, `docs/theory`.

use super::{attempt::Attempt, closing, locator::Locator};
use crate::{
    error::StepDoubt,
    product::{distance, product, progress},
};

/// What lies between the last point and a candidate that is beyond doubt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StepAssessment {
    /// Nothing.
    Regular,
    /// One fold.
    Fold,
    /// The tangents agree but the determinant changed its sign: a branch point, or a jump to another sheet.
    Reversed,
    /// The start of the branch, as this image.
    Closing(usize),
}

/// Roots of the slope of `λ` this close to an end of the step (share of the step) belong to that end.
const EDGE: f64 = 0.02;
/// A slope that falls inside a step to this share of its smaller end value is looked at more closely.
const DIP: f64 = 0.5;
/// Error of the matrix where it is nearly singular, in tolerances of a point: at the distance of the whole
/// solution that leaves the default of `fold_tolerance` in a slope.
const MATRIX_NOISE: f64 = 1000.0;
/// Nearer than so many distances of sheets to a simpler path the parameter has to go back by more than errors
/// of points.
pub(super) const BESIDE: f64 = 1000.0;
/// Part of the parameter by which it has to go back: less is rounding, as among free vibrations of an
/// undamped mode, which all have one frequency.
pub(super) const ROUNDED: f64 = 1e-12;
/// So many times the rounding of a point are beyond doubt: steps, to look a second time for two folds in
/// them, and what it makes of slopes.
const NOISE: f64 = 100.0;

/// Assesses the corrected trial, and orients its tangent.
pub(super) fn assess(attempt: &mut Attempt<'_>, locator: &mut Locator) -> Result<StepAssessment, StepDoubt> {
    if attempt.changes_signature() && attempt.step > attempt.settings().signature_step {
        return Err(StepDoubt::Signature);
    }
    check_defect(attempt, attempt.step)?;
    if attempt.trial.sign * attempt.state.orientation < 0.0 {
        return Ok(StepAssessment::Reversed);
    }
    check_hidden_folds(attempt)?;
    if let Some(image) = closing::passes_start(attempt, locator) {
        return Ok(StepAssessment::Closing(image));
    }
    if let Some(arc_length) = attempt.meets_earlier_stretch() {
        return Err(StepDoubt::Retraced { arc_length });
    }
    let slope = attempt.trial.tangent_parameter();
    Ok(if turned(attempt, slope) { StepAssessment::Fold } else { StepAssessment::Regular })
}

/// Whether the parameter has turned, when it has this slope at the trial.
///
/// Beside a branch point, at the distance `d` from the simpler path, the bordered matrix is singular up to
/// `d`, and errors `ε` of a point leave `ε/d` in its tangent: a sign of `t_λ` below that is rounding, and
/// says nothing until the path has left. The matrix is known less well than the point, to some tolerances.
/// Nor does a sign say anything there while the parameter goes back by no more than errors of points; nor
/// beside a simpler path that the judge does not know, which leaves more than the tolerance of corrections:
/// an orbit that is the same backwards in time is one to those that are not.
pub(super) fn turned(attempt: &mut Attempt<'_>, slope: f64) -> bool {
    if slope * attempt.state.parameter_sign >= 0.0 {
        return false;
    }
    let settings = &attempt.frame.settings;
    let error = attempt.trial.correction_norm.max(attempt.state.current.correction_norm);
    let error = error.max(settings.correction_floor);
    let of_matrix = MATRIX_NOISE * settings.correction_tolerance;
    let left = attempt.problem.judge().distance_to_simpler(&attempt.trial.point);
    let step = distance(&attempt.frame.weights, &attempt.state.base().point, &attempt.trial.node.point);
    let gone = if left < BESIDE * settings.sheet_distance { left.min(step) } else { left };
    let rounding = ROUNDED * attempt.trial.parameter().abs();
    let way = step.max(settings.sheet_distance);
    let weight = attempt.frame.weights[attempt.frame.weights.len() - 1].sqrt();
    let is_rough = error > settings.correction_tolerance && slope.abs() * weight * step <= NOISE * error;
    let by_rounding = is_rough || slope.abs() * way <= rounding;
    slope.abs() * left > of_matrix && slope.abs() * gone > NOISE * error && !by_rounding
}

/// `‖z₁ − z₀ − h (t₀ + t₁)/2‖ ≤ sheet_distance + h θ / 10`, else chord and tangents are not of one arc.
pub(super) fn check_defect(attempt: &Attempt<'_>, length: f64) -> Result<(), StepDoubt> {
    let (weights, base, node) = (&attempt.frame.weights, attempt.state.base(), &attempt.trial.node);
    let cosine = product(weights, &base.tangent, &node.tangent).clamp(-1.0, 1.0);
    let angle = cosine.acos();
    if angle > attempt.settings().max_angle {
        return Err(StepDoubt::Angle { angle });
    }
    let chord = distance(weights, &node.point, &base.point) * (1.0 + angle * angle / 24.0);
    let half = -0.5 * chord;
    let offset = |i: usize| node.point[i] - base.point[i] + half * base.tangent[i] + half * node.tangent[i];
    let squares = weights.iter().enumerate().map(|(i, weight)| weight * offset(i) * offset(i));
    let defect = squares.sum::<f64>().sqrt();
    let allowed = attempt.allowed_displacement(length) + 0.1 * chord * angle;
    if defect > allowed { Err(StepDoubt::Defect { defect }) } else { Ok(()) }
}

/// The cubic Hermite polynomial of `λ` over the step must neither turn twice nor come near to it.
fn check_hidden_folds(attempt: &Attempt<'_>) -> Result<(), StepDoubt> {
    if attempt.step < NOISE * attempt.settings().correction_floor {
        return Ok(());
    }
    let slope = parameter_slope(attempt);
    let same_sign = slope.start * slope.end > 0.0;
    // The slope is a difference of parameters over the step: what errors of points and rounding leave of it
    // means nothing.
    let error = attempt.trial.correction_norm.max(attempt.state.current.correction_norm);
    let error = error / attempt.frame.weights[attempt.frame.weights.len() - 1].sqrt();
    let digits = f64::EPSILON * attempt.trial.parameter().abs();
    let rounding = (64.0 * digits).max(4.0 * error) / attempt.step;
    let turns_twice = slope.most() > rounding && slope.inner_roots() == 2;
    let hidden = turns_twice || (slope.least() > rounding && slope.dips());
    if same_sign && hidden { Err(StepDoubt::HiddenFolds) } else { Ok(()) }
}

/// Slope `dλ/dσ` of the Hermite polynomial through base and trial.
pub(super) fn parameter_slope(attempt: &Attempt<'_>) -> ParameterSlope {
    let (weights, base, node) = (&attempt.frame.weights, attempt.state.base(), &attempt.trial.node);
    let n = base.point.len() - 1;
    let sigma = progress(weights, &base.tangent, &node.point, &base.point);
    ParameterSlope {
        start: base.tangent[n],
        end: node.tangent[n] / product(weights, &base.tangent, &node.tangent),
        chord: (node.point[n] - base.point[n]) / sigma,
    }
}

/// `q(u) = 6 u (1−u) chord + (1−u)(1−3u) start + u (3u−2) end`, the slope of a cubic Hermite polynomial.
#[derive(Debug, Clone, Copy)]
pub(super) struct ParameterSlope {
    pub start: f64,
    pub end: f64,
    chord: f64,
}

impl ParameterSlope {
    fn at(self, u: f64) -> f64 {
        let v = 1.0 - u;
        6.0 * u * v * self.chord + v * (v - 2.0 * u) * self.start + u * (u - 2.0 * v) * self.end
    }

    /// Number of roots well inside the step: `q = a u² + b u + start`.
    fn inner_roots(self) -> usize {
        let a = 3.0 * (self.start + self.end - 2.0 * self.chord);
        let b = 6.0 * self.chord - 4.0 * self.start - 2.0 * self.end;
        let discriminant = b * b - 4.0 * a * self.start;
        if discriminant <= 0.0 {
            return 0;
        }
        let pivot = -0.5 * (b + discriminant.sqrt().copysign(b));
        [pivot / a, self.start / pivot].iter().filter(|u| (EDGE..=1.0 - EDGE).contains(*u)).count()
    }

    /// The largest of what it is made of, in magnitude.
    fn most(self) -> f64 {
        self.start.abs().max(self.end.abs()).max(self.chord.abs())
    }

    /// The smaller end value, in magnitude.
    fn least(self) -> f64 {
        self.start.abs().min(self.end.abs())
    }

    /// Whether the slope falls inside the step to less than [`DIP`] of its smaller end value: it may be zero
    /// twice there.
    fn dips(self) -> bool {
        let a = 3.0 * (self.start + self.end - 2.0 * self.chord);
        let b = 6.0 * self.chord - 4.0 * self.start - 2.0 * self.end;
        let place = -0.5 * b / a;
        let inside = (EDGE..=1.0 - EDGE).contains(&place);
        inside && self.at(place) * self.start.signum() < DIP * self.least()
    }

    /// The place where the slope changes its sign, as a share of the step, if its ends differ in sign.
    pub fn root(self) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if self.at(middle) * self.end > 0.0 { high = middle } else { low = middle }
        }
        0.5 * (low + high)
    }
}
