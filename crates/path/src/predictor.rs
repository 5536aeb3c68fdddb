//! Predictors: where the path goes on. Equation (O9) of the book, `docs/theory`.
//!
//! Near `z₀` the path is a graph over its tangent: `z(σ)` with `⟨t₀, z(σ) − z₀⟩ = σ`. A point `z_k` with
//! tangent `t_k` is the node `σ_k = ⟨t₀, z_k − z₀⟩` with slope `m_k = t_k / ⟨t₀, t_k⟩`; no arc length has to
//! be guessed. One node gives the tangent predictor, two the cubic and three the quintic Hermite polynomial
//! (errors `h²`, `h⁴`, `h⁶`).
//!
//! Points and tangents have errors of their own, of which the cubic makes ten times and the quintic a hundred
//! times as much. Where steps are short against these errors the tangent is the best predictor, and the
//! others would keep the steps short. So every point that is reached is also predicted by all of them, and
//! the next step takes the one that would have served best.
//!
//! Source: Hermite interpolation as in Stoer and Bulirsch, *Introduction to Numerical Analysis*, section
//! 2.1.5.

use crate::product::{add_scaled, distance, product, progress};

/// A point of the path with its unit tangent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Node {
    /// `z = [x; λ]`, with the last Newton correction applied.
    pub point: Vec<f64>,
    /// Unit tangent in the direction of travel.
    pub tangent: Vec<f64>,
}

impl Node {
    pub(crate) fn zeros(length: usize) -> Self {
        Self { point: vec![0.0; length], tangent: vec![0.0; length] }
    }

    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.point.copy_from_slice(&other.point);
        self.tangent.copy_from_slice(&other.tangent);
    }
}

/// How many earlier points a predictor may use: 0 tangent, 1 cubic, 2 quintic.
pub(crate) const MOST_EARLIER_NODES: usize = 2;

/// Errors of the predictors with none, one, two earlier nodes.
pub(crate) type PredictorErrors = [f64; MOST_EARLIER_NODES + 1];

/// Error order in `h` of the predictor with this many earlier nodes.
pub(crate) fn order(earlier: usize) -> f64 {
    2.0 * (earlier as f64 + 1.0)
}

/// Most earlier nodes for a step `growth` times as long as the last, in which the predictors had these
/// errors; up to `harmless` an error costs nothing.
pub(crate) fn best_predictor(errors: &PredictorErrors, growth: f64, harmless: f64) -> usize {
    let expected = |earlier: usize| (errors[earlier] * growth.powf(order(earlier))).max(harmless);
    let known = errors.iter().take_while(|error| error.is_finite()).count();
    let best = (0..known).rev().min_by(|a, b| expected(*a).total_cmp(&expected(*b))).unwrap_or(0);
    // Of those that use more nodes than there were nothing is known.
    if best + 1 == known { MOST_EARLIER_NODES } else { best }
}

/// The last points of a smooth arc, the newest first.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Nodes; only the first `used` mean anything.
    pub nodes: Vec<Node>,
    /// Number of nodes that belong to the present smooth arc, at least one.
    pub used: usize,
}

impl History {
    pub(crate) fn new(length: usize) -> Self {
        Self { nodes: vec![Node::zeros(length); MOST_EARLIER_NODES + 1], used: 0 }
    }

    pub(crate) fn base(&self) -> &Node {
        &self.nodes[0]
    }

    pub(crate) fn push(&mut self, node: &Node) {
        self.nodes.rotate_right(1);
        self.nodes[0].copy_from(node);
        self.used = (self.used + 1).min(self.nodes.len());
    }

    /// Predicts at `σ = step` with at most `most_earlier` earlier nodes and returns how many were used.
    pub(crate) fn predict(&self, weights: &[f64], step: f64, most_earlier: usize, out: &mut [f64]) -> usize {
        let earlier = self.usable(weights, step).min(most_earlier);
        self.extrapolate(weights, step, earlier, out);
        earlier
    }

    /// Distances from a point of the path at which the predictors with none, one, two earlier nodes would
    /// have put it; infinite where there are not so many.
    pub(crate) fn errors(&self, weights: &[f64], reached: &[f64], scratch: &mut [f64]) -> PredictorErrors {
        let sigma = progress(weights, &self.base().tangent, reached, &self.base().point);
        let usable = self.usable(weights, sigma);
        std::array::from_fn(|earlier| {
            if earlier > usable {
                return f64::INFINITY;
            }
            self.extrapolate(weights, sigma, earlier, scratch);
            distance(weights, reached, scratch)
        })
    }

    /// How many earlier nodes can serve for a step: such whose tangents agree with the tangent of the base,
    /// and no farther from it than a quarter of the extrapolation.
    fn usable(&self, weights: &[f64], step: f64) -> usize {
        let base = self.base();
        let available = self.used.saturating_sub(1);
        let usable = |node: &&Node| {
            let distance = -progress(weights, &base.tangent, &node.point, &base.point);
            product(weights, &base.tangent, &node.tangent) > 0.7 && 4.0 * distance >= step
        };
        self.nodes[1..=available].iter().take_while(usable).count()
    }

    fn extrapolate(&self, weights: &[f64], sigma: f64, earlier: usize, out: &mut [f64]) {
        let base = self.base();
        match earlier {
            0 => hermite(weights, base, [], sigma, out),
            1 => hermite(weights, base, [&self.nodes[1]], sigma, out),
            _ => hermite(weights, base, [&self.nodes[1], &self.nodes[2]], sigma, out),
        }
    }
}

/// Point at `σ` of the Hermite polynomial through `base` and the others, over the tangent of `base`.
///
/// `z(σ) = z₀ + Σ_k A_k (z_k − z₀) + Σ_k B_k m_k` with `A_k = (1 − 2 L_k'(σ_k)(σ − σ_k)) L_k²`, `B_k = (σ −
/// σ_k) L_k²` and the Lagrange polynomials `L_k`.
pub(crate) fn hermite<const K: usize>(
    weights: &[f64],
    base: &Node,
    others: [&Node; K],
    sigma: f64,
    out: &mut [f64],
) {
    let nodes = others.map(|node| progress(weights, &base.tangent, &node.point, &base.point));
    let at_base: f64 = nodes.iter().map(|s| (sigma - s) / -s).product();
    out.copy_from_slice(&base.point);
    add_scaled(out, sigma * at_base * at_base, &base.tangent);
    for (k, node) in others.iter().enumerate() {
        let (value, slope) = basis(&nodes, k, sigma);
        let along = product(weights, &base.tangent, &node.tangent);
        for (i, o) in out.iter_mut().enumerate() {
            *o += value * (node.point[i] - base.point[i]) + slope / along * node.tangent[i];
        }
    }
}

/// `(A_k, B_k)` at `σ` for the nodes `0, σ_0, σ_1, …`.
fn basis(nodes: &[f64], k: usize, sigma: f64) -> (f64, f64) {
    let s = nodes[k];
    let mut lagrange = sigma / s;
    let mut derivative = 1.0 / s;
    for (j, other) in nodes.iter().enumerate() {
        if j != k {
            lagrange *= (sigma - other) / (s - other);
            derivative += 1.0 / (s - other);
        }
    }
    let square = lagrange * lagrange;
    ((1.0 - 2.0 * derivative * (sigma - s)) * square, (sigma - s) * square)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn on_circle(angle: f64) -> Node {
        Node { point: vec![angle.sin(), angle.cos()], tangent: vec![angle.cos(), -angle.sin()] }
    }

    fn error_at(step: f64, most_earlier: usize) -> f64 {
        let mut history = History::new(2);
        for k in [-2.0, -1.0, 0.0] {
            history.push(&on_circle(k * step));
        }
        let mut out = [0.0; 2];
        history.predict(&[1.0; 2], step, most_earlier, &mut out);
        (out[0].hypot(out[1]) - 1.0).abs()
    }

    #[test]
    fn predictors_have_error_orders_two_four_six() {
        for earlier in 0..=MOST_EARLIER_NODES {
            let slope = (error_at(0.1, earlier) / error_at(0.05, earlier)).log2();
            assert_relative_eq!(slope, order(earlier), epsilon = 0.3);
        }
    }

    /// Of errors `a h^2`, `b h^4`, `c h^6` in the last step.
    #[test]
    fn the_best_predictor_is_the_one_with_the_least_error_in_the_next_step() {
        let unknown = f64::INFINITY;
        // Twice the step: 4e-6, 1.6e-6, 6.4e-6.
        assert_eq!(best_predictor(&[1e-6, 1e-7, 1e-7], 2.0, 0.0), 1);
        assert_eq!(best_predictor(&[1e-6, 1e-7, 1e-7], 1.0, 0.0), 2);
        assert_eq!(best_predictor(&[1e-9, 1e-8, 1e-7], 1.0, 0.0), 0);
        // Below what does no harm all are as good, and the highest order bears the longest steps.
        assert_eq!(best_predictor(&[1e-9, 1e-8, 1e-7], 1.0, 1e-6), 2);
        // Where the best of the known ones has the highest order, a higher one may be better still.
        assert_eq!(best_predictor(&[1e-6, 1e-7, unknown], 1.0, 0.0), 2);
        assert_eq!(best_predictor(&[1e-7, 1e-6, unknown], 1.0, 0.0), 0);
        assert_eq!(best_predictor(&[1e-6, unknown, unknown], 1.0, 0.0), 2);
    }

    #[test]
    fn prediction_lies_in_the_plane_of_the_step() {
        let mut history = History::new(2);
        for angle in [-0.3, -0.1, 0.0] {
            history.push(&on_circle(angle));
        }
        let mut out = [0.0; 2];
        assert_eq!(history.predict(&[1.0; 2], 0.2, 2, &mut out), 2);
        assert_relative_eq!(out[0], 0.2, epsilon = 1e-14);
    }
}
