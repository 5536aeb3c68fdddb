//! The condition that makes a curve of the solutions over two parameters.

use hammerbeam_motion::exact::MotionError;

use super::{
    bordered::Bordered,
    linear::Linear,
    lyapunov, normal_form,
    pair::Pair,
    shooting::{CurveOrbit, Shooting},
    touched::Touch,
};

/// A condition.
#[derive(Debug, Clone)]
pub(super) enum Condition {
    Multiplier(Bordered),
    Pair(Pair),
    Touch(Touch),
}

impl Condition {
    /// The condition at the place where the shooting equations were evaluated last; `None` where it is not
    /// defined.
    pub fn evaluate(
        &self,
        shooting: &mut Shooting,
        place: &CurveOrbit,
    ) -> Result<Option<Linear>, MotionError> {
        match self {
            Self::Multiplier(bordered) => bordered.evaluate(shooting, place),
            Self::Pair(pair) => pair.evaluate(shooting, place),
            Self::Touch(touch) => touch.evaluate(shooting, place).map(Some),
        }
    }

    /// Basis of the invariant subspace of the multipliers that the condition holds, at the last evaluated
    /// place.
    pub fn critical_vectors(&self, shooting: &Shooting) -> Vec<Vec<f64>> {
        match self {
            Self::Multiplier(bordered) => {
                bordered.vectors(shooting).map_or(Vec::new(), |vectors| vec![vectors.right])
            }
            Self::Pair(pair) => pair.right_plane(shooting).unwrap_or_default(),
            Self::Touch(_) => Vec::new(),
        }
    }

    /// The coefficient of the normal form at the place where the shooting equations were evaluated last, in a
    /// form that is bounded; `None` where it cannot be computed, or is none that changes its sign.
    pub fn criticality(
        &self,
        shooting: &mut Shooting,
        place: &CurveOrbit,
    ) -> Result<Option<f64>, MotionError> {
        let coefficient = match self {
            Self::Multiplier(bordered) if bordered.multiplier < 0.0 => {
                let Some(vectors) = bordered.vectors(shooting) else { return Ok(None) };
                normal_form::of_flip(shooting, place, &vectors)?
            }
            Self::Pair(pair) => {
                let Some(vectors) = pair.vectors(shooting) else { return Ok(None) };
                lyapunov::of_pair(shooting, place, &vectors)?
            }
            Self::Multiplier(_) | Self::Touch(_) => None,
        };
        Ok(coefficient.map(normal_form::Coefficient::bounded))
    }

    /// Adapts the condition to an accepted point, at which the equations were evaluated last.
    pub fn renew(&mut self, shooting: &Shooting) {
        match self {
            Self::Multiplier(bordered) => bordered.renew(shooting),
            Self::Pair(pair) => pair.renew(shooting),
            Self::Touch(_) => {}
        }
    }

    /// Adapts the condition to orbits that are cut elsewhere, at the last evaluated place (`start_phase.rs`).
    pub fn carry(&mut self, shooting: &Shooting, matrix: &[f64]) {
        match self {
            Self::Multiplier(bordered) => bordered.carry(shooting, matrix),
            Self::Pair(_) | Self::Touch(_) => {}
        }
    }

    /// Whether the phase at which the orbit is cut is unknown.
    pub fn has_phase(&self) -> bool {
        matches!(self, Self::Touch(_))
    }
}
