//! A branch point to all digits, from points beside it.
//!
//! In the plane of the corrector the crossing branch leaves a branch point: rounding `r` of the residual, and
//! whatever correction stays unapplied, becomes a displacement of `r / |D|` along it, which moves the zero of
//! `D` itself. So a search that ends at `|D| = 0` knows the place to about the root of `r`. Beside it, at
//! `±w` and `±2w` with `w` a fiftieth of the step, points are sharp and `D` is smooth: the cubic polynomial
//! of the path's length over `D` through these four gives the length at `D = 0`, the Hermite polynomial
//! through the inner two the point. The quadratic polynomial through three of them shows how far that can be
//! trusted. Where the step is so long that this point is not on the path, a quarter of `w` serves, with less
//! than a hundredth of the error.

use super::{attempt::Attempt, bracket::at_zero, locator::Locator};
use crate::{
    predictor::{Node, hermite},
    product::progress,
};

/// `w` as a share of the step: the second where the first is too much.
const ASIDES: [f64; 2] = [0.02, 0.005];

/// Makes the probe, evaluated last, the branch point at this share of the step; returns the arc length within
/// which it lies. If points beside it do not decide, the probe stays where it was.
pub(super) fn sharpen(attempt: &mut Attempt<'_>, locator: &mut Locator, share: f64) -> f64 {
    let found = locator.probe.clone();
    for aside in ASIDES {
        if let Some(uncertainty) = place_from_beside(attempt, locator, (share, aside)) {
            return uncertainty;
        }
    }
    locator.probe = found;
    // It was evaluated before: this cannot fail, and if it did the next step would show it.
    let _ = attempt.evaluate(&locator.probe.point);
    ASIDES[0] * attempt.progress()
}

fn place_from_beside(
    attempt: &mut Attempt<'_>,
    locator: &mut Locator,
    (share, aside): (f64, f64),
) -> Option<f64> {
    let length = attempt.progress();
    let scale = attempt.trial.log_determinant.max(attempt.state.current.log_determinant);
    let mut beside: Vec<(Node, f64)> = Vec::new();
    for place in [-2.0, -1.0, 1.0, 2.0] {
        locator.probe_between(attempt, attempt.step, (share + place * aside) * length).ok()?;
        let probe = &locator.probe;
        if probe.signature != attempt.state.current.signature {
            return None;
        }
        let size = (probe.log_determinant - scale).exp();
        beside.push((probe.node.clone(), size * probe.sign * attempt.state.orientation));
    }
    let (low, high) = (&beside[1].0, &beside[2].0);
    let weights = &attempt.frame.weights;
    let of = |node: &Node| progress(weights, &low.tangent, &node.point, &low.point);
    let places: Vec<(f64, f64)> = beside.iter().map(|(node, value)| (of(node), *value)).collect();
    let falls = places.windows(2).all(|pair| pair[0].1 > pair[1].1) && places[1].1 > 0.0 && places[2].1 < 0.0;
    if !falls {
        return None;
    }
    let root = at_zero(&places);
    hermite(weights, low, [high], root, &mut locator.probe.point);
    attempt.evaluate(&locator.probe.point).ok()?;
    let (probe, settings) = (&mut locator.probe, attempt.settings());
    probe.residual_norm = attempt.problem.residual().iter().fold(0.0, |m: f64, r| r.abs().max(m));
    if probe.residual_norm > settings.correction_tolerance.max(settings.residual_floor) {
        return None;
    }
    probe.node.point.copy_from_slice(&probe.point);
    Some((root - at_zero(&places[..3])).abs().max((root - at_zero(&places[1..])).abs()))
}
