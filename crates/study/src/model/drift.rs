//! Directions in which a structure can drift: rigid-body motions that no spring and no stop holds.
//!
//! Let `d` be a combination of the rigid-body modes (`w = 0`), so that `K d = 0`. Local forces depend on `s_j
//! . q`, where `s_j` is the shape of element j. If `s_j . d = 0` for all of them, `q + c d` solves the
//! equations of motion with `q`, for every constant c: periodic orbits are never isolated, their monodromy
//! matrix always has the multiplier +1, and shooting has no unique answer. If elements hold `d`, but all of
//! them can open, this is so for the orbits on which none of them acts.
//!
//! The directions are the orthogonal complement of the shapes within the rigid-body modes, first for all
//! elements, then for those that always act.

use hammerbeam_motion::{Law, System};

/// Shapes below this share of what the direction moves elsewhere hold nothing: rounding of the modes.
const NOTHING: f64 = 1e-8;

/// A rigid-body motion that nothing holds, or only stops that can open.
#[derive(Debug, Clone, PartialEq)]
pub struct Drift {
    /// Displacement of the points that it moves, by their names; the largest is 1.
    pub motion: Vec<(String, f64)>,
    /// Whether stops hold it while they are closed; otherwise no periodic orbit is isolated.
    pub held_by_stops: bool,
}

impl Drift {
    /// The direction in words.
    #[must_use]
    pub fn direction(&self) -> String {
        let shown = self.motion.iter().take(4).map(|(name, size)| format!("{name} {size:.3}"));
        let more = if self.motion.len() > 4 { ", ..." } else { "" };
        format!("{}{more}", shown.collect::<Vec<_>>().join(", "))
    }
}

impl std::fmt::Display for Drift {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let direction = self.direction();
        if self.held_by_stops {
            write!(
                f,
                "only stops that can open hold the rigid-body motion ({direction}), at 0 Hz; solutions that \
                do not touch them come in families, \
                 and a search among them may take long"
            )
        } else {
            write!(
                f,
                "nothing holds the rigid-body motion ({direction}), at 0 Hz; solutions come in families"
            )
        }
    }
}

/// The directions in which the structure can drift; none for one that springs hold.
pub(super) fn drifts(system: &System) -> Vec<Drift> {
    let rigid: Vec<usize> =
        (0..system.dof()).filter(|&i| system.model().natural_frequencies[i] == 0.0).collect();
    let shapes = |wanted: &dyn Fn(&Law) -> bool| -> Vec<Vec<f64>> {
        let elements = system.elements().iter().filter(|element| wanted(&element.law));
        elements.map(|element| rigid.iter().map(|&i| element.shape[i]).collect()).collect()
    };
    let (mut held, never) = complement(rigid.len(), &shapes(&Law::depends_on_displacement));
    let drift = |direction: &Vec<f64>, held_by_stops| Drift {
        motion: motion(system, &rigid, direction),
        held_by_stops,
    };
    let mut drifts: Vec<Drift> = never.iter().map(|direction| drift(direction, false)).collect();
    let (always, _) = complement(rigid.len(), &shapes(&always_acts));
    // What all elements hold and those that always act do not.
    held.retain_mut(|direction| reduce(direction, &always));
    let mut open: Vec<Vec<f64>> = Vec::new();
    for mut direction in held {
        if reduce(&mut direction, &open) {
            drifts.push(drift(&direction, true));
            open.push(direction);
        }
    }
    drifts
}

/// Whether the force of a law is nowhere zero but at a point.
fn always_acts(law: &Law) -> bool {
    // Both directions of a hole are free up to its clearance.
    if law.round_hole().is_some() || law.is_across_hole() {
        return false;
    }
    let acts = |size: f64| law.force(size, 0.0).value != 0.0 && law.force(-size, 0.0).value != 0.0;
    law.depends_on_displacement() && (law.contacts().is_empty() || (-12..=0).all(|k| acts(10f64.powi(k))))
}

/// Orthonormal bases of what these rows span in so many dimensions, and of its complement.
pub(super) fn complement(dimension: usize, rows: &[Vec<f64>]) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let mut span: Vec<Vec<f64>> = Vec::new();
    for row in rows {
        let mut row = row.clone();
        if norm(&row) > 0.0 && reduce(&mut row, &span) {
            span.push(row);
        }
    }
    let rank = span.len();
    let mut all = span;
    for i in 0..dimension {
        let mut unit = vec![0.0; dimension];
        unit[i] = 1.0;
        if reduce(&mut unit, &all) {
            all.push(unit);
        }
    }
    let rest = all.split_off(rank);
    (all, rest)
}

/// Takes from a vector what lies in an orthonormal basis, and makes it one long; false if nothing is left.
fn reduce(vector: &mut [f64], basis: &[Vec<f64>]) -> bool {
    let before = norm(vector);
    // Twice is enough for rounding.
    for direction in basis.iter().chain(basis) {
        let share: f64 = vector.iter().zip(direction).map(|(a, b)| a * b).sum();
        vector.iter_mut().zip(direction).for_each(|(a, b)| *a -= share * b);
    }
    let left = norm(vector);
    vector.iter_mut().for_each(|entry| *entry /= left);
    left > NOTHING * before
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

/// How the named points move in a combination of the rigid-body modes.
fn motion(system: &System, rigid: &[usize], direction: &[f64]) -> Vec<(String, f64)> {
    let of = |shape: &[f64]| rigid.iter().zip(direction).map(|(&i, d)| shape[i] * d).sum::<f64>();
    let points = system.model().points.iter();
    let moved: Vec<(String, f64)> = points.map(|point| (point.name.clone(), of(&point.shape))).collect();
    let largest =
        moved.iter().map(|(_, size)| *size).fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    let scaled = moved.into_iter().map(|(name, size)| (name, size / largest));
    scaled.filter(|(_, size)| size.abs() > NOTHING).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn complement_of_a_row_is_orthogonal_to_it() {
        let (span, rest) = complement(3, &[vec![1.0, 2.0, 2.0], vec![2.0, 4.0, 4.0]]);
        assert_eq!((span.len(), rest.len()), (1, 2));
        for direction in &rest {
            let product = direction[0] + 2.0 * direction[1] + 2.0 * direction[2];
            assert!(product.abs() < 1e-15 && (norm(direction) - 1.0).abs() < 1e-15);
        }
    }
}
