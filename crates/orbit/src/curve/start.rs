//! Where a curve begins: its condition at the start, and the settings of its path.

use hammerbeam_path::Settings;

use super::{
    bordered::Bordered,
    condition::Condition,
    grazing::Turn,
    pair::Pair,
    row::{CurveKind, CurveSettings},
    shooting::{CurveOrbit, Shooting},
    touched::Touch,
};
use crate::{OrbitError, PeriodicSolution};

/// The condition at the start, and where that is; `None` if the orbit has nothing to follow.
///
/// * `touch`: what is touched and where, on a curve of grazing orbits.
pub(super) fn first_condition(
    shooting: &mut Shooting,
    start: &PeriodicSolution,
    (kind, value): (CurveKind, f64),
    touch: Option<(Touch, Turn)>,
) -> Result<Option<(Condition, CurveOrbit)>, OrbitError> {
    let scaled = |nodes: &[Vec<f64>], scales: &[f64]| -> Vec<f64> {
        nodes.iter().flat_map(|node| node.iter().zip(scales).map(|(z, s)| z / s)).collect()
    };
    let frequency_hz = start.frequency_hz;
    let scales = shooting.scale.values().to_vec();
    let mut place =
        CurveOrbit { nodes: scaled(&start.nodes, &scales), frequency_hz, phase: start.phase, value };
    if let Some((touch, Turn { phase, state, .. })) = touch {
        let mut nodes = vec![state];
        shooting.fit_passing(frequency_hz, phase, &nodes[0])?;
        for k in 1..shooting.count {
            let stretch = shooting.stretch(k - 1, frequency_hz, phase);
            nodes.push(shooting.advance(stretch, phase, &nodes[k - 1])?);
        }
        place = CurveOrbit { nodes: scaled(&nodes, &scales), phase, ..place };
        return Ok(Some((Condition::Touch(touch), place)));
    }
    shooting.evaluate(&place)?;
    let condition = match kind {
        CurveKind::Fold => Some(Condition::Multiplier(Bordered::new(1.0, shooting))),
        CurveKind::Flip => Some(Condition::Multiplier(Bordered::new(-1.0, shooting))),
        _ => Pair::new(shooting).map(Condition::Pair),
    };
    Ok(condition.map(|condition| (condition, place)))
}

/// Settings of the path. The condition is known less exactly than an orbit: rounding of the monodromy matrix
/// is in it.
pub(super) fn path_settings(settings: &CurveSettings, units: [f64; 2]) -> Settings {
    let default = Settings::default();
    Settings {
        initial_step: 0.1 * settings.max_step,
        max_parameter_step: settings.max_step * units[1],
        max_step_length: settings.max_step,
        min_step: 1e-8,
        short_step: 1e-5,
        correction_tolerance: 1e-8,
        correction_floor: 1e-10,
        residual_floor: 1e3 * default.residual_floor,
        sheet_distance: 1e-4,
        signature_step: 1e-4,
        max_points: settings.max_rows as u64,
        ..default
    }
}
