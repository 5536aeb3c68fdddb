//! A modal state from displacements and velocities of named points.
//!
//! The displacement of a point is `y_p = phi_p . q + s_p . u` and its velocity `phi_p . q' + s_p . u'`, with
//! the displacements `u` of the supports at that moment. Fewer points than modes leave the state open. Of all
//! states in which the points move as given the one of the smallest norm is taken, of `q` and of `q'` by
//! themselves. Modes are mass-normalised, so `|q'|^2` is twice the kinetic energy relative to the supports: a
//! mass that is not mentioned rests relative to them.

use hammerbeam_structure::PointOutput;

use super::Model;

/// Rows whose new part is smaller than this, relative to them, add nothing to those before.
const DEPENDENT: f64 = 1e-10;

/// What is known of a point at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct PointStart {
    /// Name of the point.
    pub point: String,
    /// Whether the value is a displacement or a velocity.
    pub kind: PointStartKind,
    /// Displacement [m] or velocity [m/s] in space.
    pub value: f64,
}

/// What of a point is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointStartKind {
    /// Displacement in space [m].
    Displacement,
    /// Velocity in space [m/s].
    Velocity,
}

/// Why points do not give a state.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum PointStartError {
    /// No point has this name.
    #[error("\"{point}\" is not a point of this structure; there are {}", known.join(", "))]
    UnknownPoint { point: String, known: Vec<String> },
    /// Other points, or a support, already say how this one moves.
    #[error("point \"{point}\" cannot move by {value} there: the others leave it {}", digits(*left))]
    Contradiction { point: String, value: f64, left: f64 },
}

/// A number to nine digits.
fn digits(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}

impl Model {
    /// The state `[q; q']` at phase 0 in which points move as given, and everything else as little as
    /// possible.
    ///
    /// # Errors
    /// [`PointStartError`]: an unknown name, or values that no state of the reduced model has.
    pub fn state_of_points(
        &self,
        frequency_hz: f64,
        starts: &[PointStart],
    ) -> Result<Vec<f64>, PointStartError> {
        let carried = |point: &PointOutput| self.system.carried(&point.support_ratios, frequency_hz, 0.0);
        let displaced = |point: &PointOutput| carried(point)[0];
        let mut state = self.least_norm(starts, PointStartKind::Displacement, &displaced)?;
        state.extend(self.least_norm(starts, PointStartKind::Velocity, &|point| carried(point)[1])?);
        Ok(state)
    }

    /// The shortest vector with `phi_p . x = value - carried` for every start of a kind.
    ///
    /// Each row is made orthogonal to those before it, so its own condition is met without touching theirs.
    fn least_norm(
        &self,
        starts: &[PointStart],
        kind: PointStartKind,
        carried: &dyn Fn(&PointOutput) -> f64,
    ) -> Result<Vec<f64>, PointStartError> {
        let mut x = vec![0.0; self.system.dof()];
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for start in starts.iter().filter(|start| start.kind == kind) {
            let point = self.known_point(&start.point)?;
            let missing = start.value - carried(point) - dot(&point.shape, &x);
            let mut row = point.shape.clone();
            for unit in basis.iter().chain(&basis) {
                let along = dot(unit, &row);
                row.iter_mut().zip(unit).for_each(|(entry, unit)| *entry -= along * unit);
            }
            let (length, whole) = (dot(&row, &row).sqrt(), dot(&point.shape, &point.shape).sqrt());
            if length <= DEPENDENT * whole {
                if missing.abs() <= DEPENDENT * start.value.abs() {
                    continue;
                }
                let (point, value) = (start.point.clone(), start.value);
                return Err(PointStartError::Contradiction { point, value, left: value - missing });
            }
            let unit: Vec<f64> = row.iter().map(|entry| entry / length).collect();
            x.iter_mut().zip(&unit).for_each(|(entry, unit)| *entry += missing / length * unit);
            basis.push(unit);
        }
        Ok(x)
    }

    fn known_point(&self, name: &str) -> Result<&PointOutput, PointStartError> {
        self.system.model().point(name).ok_or_else(|| PointStartError::UnknownPoint {
            point: name.to_owned(),
            known: self.point_names().into_iter().map(str::to_owned).collect(),
        })
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StudyFile;
    use hammerbeam_motion::PointMotion;

    fn two_masses() -> Model {
        let text = r#"
            [structure]
            kind = "lumped"
            mass = [{ name = "a", mass_kg = 2.0 }, { name = "b", mass_kg = 0.5 }]
            spring = [
                { between = ["a", "ground"], stiffness_n_m = 100.0 },
                { between = ["a", "b"], stiffness_n_m = 30.0 },
            ]
            [excitation]
            kind = "support-motion"
            at = "ground"
            amplitude_m = 1e-3
            frequency_hz = [1.0, 2.0]
            [response]
            point = "a"
        "#;
        Model::build(&StudyFile::parse("study.toml", text.to_owned()).unwrap()).unwrap()
    }

    fn start(point: &str, kind: PointStartKind, value: f64) -> PointStart {
        PointStart { point: point.to_owned(), kind, value }
    }

    /// Read back by the outputs of the points themselves; the ground is 1 mm up at phase 0.
    #[test]
    fn points_move_as_given_and_a_mass_that_is_not_mentioned_rests_relative_to_the_support() {
        use PointStartKind::{Displacement, Velocity};
        let model = two_masses();
        let starts = [start("b", Displacement, 0.02), start("a", Velocity, -0.3)];
        let state = model.state_of_points(1.5, &starts).unwrap();
        let motion = |name: &str| {
            let point = model.system.model().point(name).unwrap();
            PointMotion::of(&model.system, 1.5, &point.shape, &point.support_ratios).at(0.0, &state, &[])
        };
        for (name, expected) in [("a", [1e-3, -0.3]), ("b", [0.02, 0.0])] {
            for (found, expected) in motion(name).into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-12, "{name}: {found} instead of {expected}");
            }
        }
    }

    #[test]
    fn a_point_that_is_held_elsewhere_and_an_unknown_one_are_refused() {
        let model = two_masses();
        let twice = [1.0, 2.0].map(|value| start("a", PointStartKind::Displacement, value));
        assert!(matches!(
            model.state_of_points(1.5, &twice),
            Err(PointStartError::Contradiction { left, .. }) if (left - 1.0).abs() < 1e-12
        ));
        let unknown = [start("c", PointStartKind::Velocity, 1.0)];
        assert!(matches!(model.state_of_points(1.5, &unknown), Err(PointStartError::UnknownPoint { .. })));
    }
}
