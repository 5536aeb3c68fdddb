//! A further point of the path between two neighbouring accepted ones.

use crate::{
    corrector::Candidate,
    error::StepDoubt,
    point::{ContinuationPoint, Counters, PathEvents},
    predictor::{Node, hermite},
    problem::PathProblem,
    product::{distance, product, progress, weighed},
    settings::Settings,
};

/// Least cosine between the tangents of two points of one smooth arc.
const ALIGNED: f64 = 0.7;

/// Solves on the arc from one accepted point to the next, at `share` of the way; the problem was then
/// evaluated last at the new point.
///
/// With `σ₁ = ⟨t₀, z₁ − z₀⟩` the point lies in the plane `⟨t₀, z − z₀⟩ = share σ₁` and is predicted by the
/// cubic Hermite polynomial through both ends. No follower is involved: its counters and its memory stay as
/// they are, and `evaluations` of the point holds the work.
///
/// * `ends`: two points that follow each other on one smooth arc, in the order of travel.
/// * `share`: between 0 and 1.
///
/// # Errors
/// Why what was found is not between the two: it is too far from the prediction, or its tangent, determinant
/// or signature do not belong to the arc.
pub fn solve_between(
    problem: &mut dyn PathProblem,
    ends: [&ContinuationPoint; 2],
    share: f64,
    settings: &Settings,
) -> Result<ContinuationPoint, StepDoubt> {
    let [from, to] = ends;
    let weights = problem.weights().to_vec();
    check_aligned(&weights, &from.tangent, &to.tangent, ALIGNED.acos())?;
    let [first, second] = ends.map(|end| Node { point: end.point.clone(), tangent: end.tangent.clone() });
    let sigma = share * progress(&weights, &first.tangent, &second.point, &first.point);
    let step = distance(&weights, &second.point, &first.point);
    let mut candidate = Candidate::new(weights.len());
    hermite(&weights, &first, [&second], sigma, &mut candidate.point);
    let row = weighed(&weights, &first.tangent);
    let mut counters = Counters::default();
    candidate
        .correct(problem, &weights, &row, settings.limits(step), &mut counters)
        .map_err(StepDoubt::Corrector)?;
    if candidate.sign * from.orientation < 0.0 {
        return Err(StepDoubt::Reversed);
    }
    candidate.orient(from.orientation);
    check_aligned(&weights, &candidate.node.tangent, &to.tangent, settings.max_angle)?;
    if candidate.signature != from.signature && candidate.signature != to.signature {
        return Err(StepDoubt::Signature);
    }
    Ok(ContinuationPoint {
        arc_length: from.arc_length + share * (to.arc_length - from.arc_length),
        signature: candidate.signature,
        orientation: from.orientation,
        log_determinant: candidate.log_determinant,
        correction_norm: candidate.correction_norm,
        residual_norm: candidate.residual_norm,
        events: PathEvents::default(),
        uncertainty: 0.0,
        evaluations: counters.evaluations,
        point: candidate.point,
        tangent: candidate.node.tangent,
    })
}

fn check_aligned(weights: &[f64], a: &[f64], b: &[f64], most: f64) -> Result<(), StepDoubt> {
    let angle = product(weights, a, b).clamp(-1.0, 1.0).acos();
    if angle > most { Err(StepDoubt::Angle { angle }) } else { Ok(()) }
}
