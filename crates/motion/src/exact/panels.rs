//! A motion in panels over which it is smooth, each with the states at the nodes of a Gauss rule: for
//! integrals over the motion and for its extrema.
//!
//! A flight and a force step are smooth from their start to their end, a force step in the variable `s` of
//! its grading (`collocation.rs`). A flight is also cut into panels of at most [`PANEL_RADIANS`] of whatever
//! moves fastest, a mode or a harmonic of the load. With `z = 2` radians from the middle of a panel to its
//! end the polynomial through [`PANEL_NODES`] Gauss nodes leaves at most `(2 z)^N/N!/C(2 N, N)` of a wave,
//! 3.4e-13 at an end and less inside, and the rule integrates products of two waves to rounding.
//!
//! A force step is short enough for the motion, to which its force counts as an integral; the force itself,
//! and the acceleration with it, may end like `t^1.5` where the step is not graded. There panels are halved
//! until their polynomials hold the forces.
//!
//! Velocities jump between panels where a rigid stop is hit: the impulses are those of the contacts of the
//! trace.

use std::sync::OnceLock;

use super::{collocation::Grading, recurrence::gauss_sixteen};

/// Nodes of a panel.
pub const PANEL_NODES: usize = 16;
/// Longest panel of a flight, in radians of the fastest mode or harmonic.
const PANEL_RADIANS: f64 = 4.0;
/// What the two highest coefficients of a force may be of its largest magnitude,
const LEFT: f64 = 1e-12;
/// and how often panels are halved to get there.
const HALVINGS: usize = 12;

/// A state and the forces of the elements.
pub(super) type StateAndForces = (Vec<f64>, Vec<f64>);

/// A part of a motion over which it is smooth.
///
/// In the variable of the panel, from 0 to 1, the nodes are those of Gauss-Legendre, and everything read off
/// the motion is a polynomial.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionPanel {
    /// Times of the nodes since the start of the stretch, ascending [s].
    pub times: [f64; PANEL_NODES],
    /// Weights of the nodes in integrals over the time of the panel [s].
    pub weights: [f64; PANEL_NODES],
    /// Modal states `[q; q']` at the nodes, each of length 2n.
    pub states: Vec<Vec<f64>>,
    /// Forces of the elements along their relative displacements at the nodes [N].
    pub forces: Vec<Vec<f64>>,
}

/// A piece of motion: a flight or a force step.
#[derive(Debug, Clone, Copy)]
pub(super) struct MotionSpan {
    /// Time since the start of the stretch, and length [s].
    pub start: f64,
    pub length: f64,
    pub grading: Grading,
}

impl MotionSpan {
    /// Its panels.
    ///
    /// * `fastest`: rate of what moves fastest [1/s]; `at`: states and forces at times.
    pub fn panels(self, fastest: f64, at: &impl Fn(&[f64]) -> Vec<StateAndForces>) -> Vec<MotionPanel> {
        let mut panels = Vec::new();
        let turns = fastest * self.length / PANEL_RADIANS;
        let count = if self.length > 0.0 { turns.ceil().max(1.0) as usize } else { 0 };
        let place = |k: usize| self.grading.inverse(k as f64 / count as f64);
        for k in 0..count {
            let ends = (place(k), place(k + 1));
            let panel = self.panel(ends, at);
            let scales = largest_forces(&panel);
            self.add((panel, ends), (&scales, HALVINGS), at, &mut panels);
        }
        panels
    }

    /// Adds a panel, in halves where its polynomials do not hold the forces.
    fn add(
        self,
        (panel, (from, to)): (MotionPanel, (f64, f64)),
        (scales, halvings): (&[f64], usize),
        at: &impl Fn(&[f64]) -> Vec<StateAndForces>,
        panels: &mut Vec<MotionPanel>,
    ) {
        if halvings == 0 || holds_forces(&panel, scales) {
            panels.push(panel);
            return;
        }
        let middle = 0.5 * (from + to);
        for ends in [(from, middle), (middle, to)] {
            self.add((self.panel(ends, at), ends), (scales, halvings - 1), at, panels);
        }
    }

    /// The panel between two places of the variable of the grading.
    fn panel(self, (from, to): (f64, f64), at: &impl Fn(&[f64]) -> Vec<StateAndForces>) -> MotionPanel {
        let (mut times, mut weights) = ([0.0; PANEL_NODES], [0.0; PANEL_NODES]);
        for (k, (x, weight)) in gauss_sixteen().iter().enumerate() {
            let (c, slope) = self.grading.map(from + (to - from) * x);
            times[k] = self.start + self.length * c;
            weights[k] = weight * (to - from) * slope * self.length;
        }
        let (states, forces) = at(&times).into_iter().unzip();
        MotionPanel { times, weights, states, forces }
    }
}

/// Largest magnitude of each force at the nodes.
fn largest_forces(panel: &MotionPanel) -> Vec<f64> {
    let count = panel.forces[0].len();
    let largest = |e: usize| panel.forces.iter().fold(0.0_f64, |most, forces| most.max(forces[e].abs()));
    (0..count).map(largest).collect()
}

/// Whether the two highest coefficients of Legendre of each force are small beside its largest magnitude.
fn holds_forces(panel: &MotionPanel, scales: &[f64]) -> bool {
    let small = |(element, scale): (usize, &f64)| {
        let coefficient = |weights: &[f64; PANEL_NODES]| {
            weights.iter().zip(&panel.forces).map(|(weight, forces)| weight * forces[element]).sum::<f64>()
        };
        *scale == 0.0 || highest_coefficients().iter().all(|of| coefficient(of).abs() <= LEFT * scale)
    };
    scales.iter().enumerate().all(small)
}

/// Weights of nodal values in their two highest coefficients of Legendre, `(2 d + 1) w_k P_d(2 s_k - 1)`.
fn highest_coefficients() -> &'static [[f64; PANEL_NODES]; 2] {
    static HIGHEST: OnceLock<[[f64; PANEL_NODES]; 2]> = OnceLock::new();
    HIGHEST.get_or_init(|| {
        let mut highest = [[0.0; PANEL_NODES]; 2];
        for (k, (s, weight)) in gauss_sixteen().iter().enumerate() {
            let x = 2.0 * s - 1.0;
            let (mut previous, mut current) = (1.0, x);
            for degree in 2..PANEL_NODES {
                let d = degree as f64;
                (previous, current) = (current, ((2.0 * d - 1.0) * x * current - (d - 1.0) * previous) / d);
            }
            let degree = (PANEL_NODES - 1) as f64;
            highest[0][k] = (2.0 * degree - 1.0) * weight * previous;
            highest[1][k] = (2.0 * degree + 1.0) * weight * current;
        }
        highest
    })
}

/// Nodes of a panel in its variable, from 0 to 1, with their weights, which add up to 1.
#[must_use]
pub fn panel_rule() -> &'static [(f64, f64); PANEL_NODES] {
    gauss_sixteen()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(start: f64, length: f64, grading: Grading) -> MotionSpan {
        MotionSpan { start, length, grading }
    }

    /// The integral of a force, by panels that hold it.
    fn integral(span: MotionSpan, fastest: f64, of: impl Fn(f64) -> f64) -> f64 {
        let at = |times: &[f64]| times.iter().map(|time| (Vec::new(), vec![of(*time)])).collect();
        let panels = span.panels(fastest, &at);
        let of_panel = |panel: &MotionPanel| {
            panel.weights.iter().zip(&panel.forces).map(|(weight, force)| weight * force[0]).sum::<f64>()
        };
        panels.iter().map(of_panel).sum()
    }

    /// `int_0^h t^1.5 dt = h^2.5/2.5`, a force that sets in like one of Hertz, whether or not the step is
    /// graded; and the integral of a wave.
    #[test]
    fn panels_integrate_forces_of_hertz_and_waves_to_rounding() {
        let (length, fastest) = (0.7_f64, 23.0);
        let exact = length.powf(2.5) / 2.5;
        for (grading, tolerance) in [(Grading::Touch, 1e-14), (Grading::Smooth, 1e-12)] {
            let found = integral(span(0.0, length, grading), 1.0, |time| time.powf(1.5));
            assert!((found / exact - 1.0).abs() < tolerance, "{found} {exact}");
        }
        let wave = |time: f64| (23.0 * time).cos().powi(2);
        let found = integral(span(0.2, length, Grading::Smooth), fastest, wave);
        let exact = 0.5 * length + ((46.0_f64 * 0.9).sin() - (46.0_f64 * 0.2).sin()) / 92.0;
        assert!((found - exact).abs() < 1e-14, "{found} {exact}");
        assert_eq!(integral(span(0.3, 0.0, Grading::Smooth), fastest, wave), 0.0);
    }
}
