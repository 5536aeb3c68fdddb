//! Orbits and their images half their period later, and orbits that are their own image.
//!
//! # Mathematics
//! `sigma: z(t) -> s z(t + N T/2)` takes periodic orbits of `N` excitation periods `T` to such orbits and is
//! its own inverse: with `s = +1` for even `N`, in any system, since half the period is a number of whole
//! excitation periods; with `s = -1` for odd `N` where the system is symmetric, so that the excitation
//! changes its sign and forces do with the state. An orbit is one of a pair of images, or its own image: then
//! its period is half as long, or it is a symmetric one.
//!
//! An own image is a fixed point of the map over half its period, `H(z) = s Z(z, N T/2)`, and as such an
//! ordinary orbit with a matrix B, `A = B^2`. Pairs branch off from it where B has a multiplier at -1: a
//! flip, or the branch point at which the symmetry is lost, of which A sees a multiplier at +1. Everything
//! that is known of flips holds of B: the curve, its normal form and where that changes its sign.

use hammerbeam_motion::exact::MotionError;

use super::{
    closing::half_of,
    shooting::{CurveOrbit, Shooting},
};

/// The first node of an orbit beside its image, scaled.
#[derive(Debug, Clone)]
pub(super) struct Apart {
    /// `(z + sigma z)/2`.
    pub mean: Vec<f64>,
    /// `(z - sigma z)/2`.
    pub odd: Vec<f64>,
}

/// How far the orbit, which is a whole one, is from its image.
pub(super) fn apart(shooting: &mut Shooting, place: &CurveOrbit) -> Result<Apart, MotionError> {
    let scales = shooting.scale.values().to_vec();
    let (size, between) = (scales.len(), shooting.count / 2);
    let half = 0.5 * shooting.cycles();
    let node: Vec<f64> =
        place.nodes[between * size..(between + 1) * size].iter().zip(&scales).map(|(x, s)| x * s).collect();
    let mut stretch = shooting.stretch(between, place.frequency_hz, place.phase);
    stretch.end = place.phase + half;
    shooting.set_parameter(place.value)?;
    let later =
        if stretch.end > stretch.start { shooting.integrator.advance(&stretch, &node)? } else { node };
    let sign = half_of(shooting.period_multiple).1.sign();
    let pairs = place.nodes.iter().zip(later.iter().zip(&scales).map(|(z, s)| sign * z / s));
    let (mean, odd) = pairs.map(|(z, image)| (0.5 * (z + image), 0.5 * (z - image))).unzip();
    Ok(Apart { mean, odd })
}

/// All nodes of the orbit with the first one of a place, scaled.
pub(super) fn nodes_from_first(shooting: &mut Shooting, place: &CurveOrbit) -> Result<Vec<f64>, MotionError> {
    let scales = shooting.scale.values().to_vec();
    let mut node: Vec<f64> = place.nodes.iter().zip(&scales).map(|(x, s)| x * s).collect();
    let mut nodes = place.nodes.clone();
    for k in 1..shooting.count {
        let stretch = shooting.stretch(k - 1, place.frequency_hz, place.phase);
        node = shooting.integrator.advance(&stretch, &node)?;
        nodes.extend(node.iter().zip(&scales).map(|(z, s)| z / s));
    }
    Ok(nodes)
}

/// The orbit at a place, or as much of it as another one's segments are long, with its nodes where the nodes
/// of `like` are when they start at a phase.
pub(super) fn unfolded(
    shooting: &mut Shooting,
    place: &CurveOrbit,
    like: &Shooting,
    phase: f64,
) -> Result<CurveOrbit, MotionError> {
    let scales = shooting.scale.values().to_vec();
    let cycles = shooting.cycles();
    let length = cycles / shooting.count as f64;
    let mut nodes = Vec::with_capacity(like.count * scales.len());
    for k in 0..like.count {
        let wanted = like.stretch(k, place.frequency_hz, phase).start;
        let halves = ((wanted - place.phase) / cycles).floor();
        let behind = wanted - place.phase - halves * cycles;
        let from = ((behind / length) as usize).min(shooting.count - 1);
        let mut stretch = shooting.stretch(from, place.frequency_hz, place.phase);
        stretch.end = place.phase + behind;
        let range = from * scales.len()..(from + 1) * scales.len();
        let node: Vec<f64> = place.nodes[range].iter().zip(&scales).map(|(x, s)| x * s).collect();
        let later =
            if stretch.end > stretch.start { shooting.integrator.advance(&stretch, &node)? } else { node };
        let sign = if halves.rem_euclid(2.0) == 1.0 { shooting.closing.sign() } else { 1.0 };
        nodes.extend(later.iter().zip(like.scale.values()).map(|(z, s)| sign * z / s));
    }
    Ok(CurveOrbit { nodes, phase, ..place.clone() })
}
