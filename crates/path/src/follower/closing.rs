//! A path that comes back to its start is closed.

use super::{arrival::Arrival, attempt::Attempt, locator::Locator};
use crate::{
    error::{PathStop, StepDoubt},
    judge::Image,
    point::ContinuationPoint,
    predictor::Node,
    product::{distance, product},
};

/// The start and two more points are needed for a loop.
const FEWEST_POINTS: u64 = 3;
/// Cosine between the tangents at the start, left and reached.
const ALIGNED: f64 = 0.999;

/// The image of the start that the step to the trial passes in the direction in which it was left, if
/// there is one; the start itself is image 0.
pub(super) fn passes_start(attempt: &mut Attempt<'_>, locator: &mut Locator) -> Option<usize> {
    let (state, weights) = (attempt.state, &attempt.frame.weights);
    let last = state.base().point.len() - 1;
    let off = (state.start.parameter() - state.base().point[last]).abs();
    let far = off * weights[last].sqrt() > 2.0 * attempt.step;
    if attempt.counters.accepted < FEWEST_POINTS || far || !off.is_finite() {
        return None;
    }
    let images = attempt.problem.judge().images();
    (0..images).find(|&image| {
        image_of_start(attempt, image).is_some_and(|start| passes(attempt, locator, &start.node))
    })
}

/// The start as that image.
fn image_of_start(attempt: &mut Attempt<'_>, image: usize) -> Option<Image> {
    let ContinuationPoint { point, tangent, .. } = &attempt.state.start;
    let start = Node { point: point.clone(), tangent: tangent.clone() };
    if image == 0 {
        Some(Image { node: start, magnification: 1.0 })
    } else {
        attempt.problem.judge().image(image, &start)
    }
}

fn passes(attempt: &Attempt<'_>, locator: &mut Locator, start: &Node) -> bool {
    let (weights, base) = (&attempt.frame.weights, attempt.state.base());
    if distance(weights, &start.point, &base.point) > 2.0 * attempt.step {
        return false;
    }
    let sigma = attempt.progress_of(start);
    let fold_first = start.tangent[start.tangent.len() - 1] * attempt.state.parameter_sign < 0.0;
    let same_way = product(weights, &base.tangent, &start.tangent) > 0.0;
    if sigma <= 0.0 || sigma > attempt.progress() || fold_first || !same_way {
        return false;
    }
    locator.predict_through(attempt, sigma, false);
    let apart = distance(weights, &locator.probe.point, &start.point);
    apart <= attempt.settings().allowed_displacement(attempt.step)
}

/// Ends the branch in the plane through this image of the start, if the path goes through the image itself.
pub(super) fn arrive_at_start(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    image: usize,
) -> Result<Arrival, StepDoubt> {
    let Image { node: start, magnification } = image_of_start(attempt, image).ok_or(StepDoubt::NotLocated)?;
    let sigma = attempt.progress_of(&start);
    locator.probe_between(attempt, sigma, sigma)?;
    locator.probe.orient(attempt.state.orientation);
    locator.arrive(attempt);
    let (weights, node) = (&attempt.frame.weights, &attempt.trial.node);
    let apart = distance(weights, &node.point, &start.point);
    let cosine = product(weights, &node.tangent, &start.tangent);
    let allowed = 10.0 * attempt.settings().correction_tolerance * magnification;
    let closed = apart <= allowed && cosine > ALIGNED;
    Ok(Arrival { end: closed.then_some(PathStop::Closed), ..Arrival::default() })
}
