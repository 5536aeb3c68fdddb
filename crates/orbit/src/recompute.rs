//! The same point of a branch, computed with other segments or tolerances.
//!
//! At a fold the frequency does not fix where on its branch an orbit is, and beside it badly: `dz/df` is
//! unbounded. The orbit is therefore held in the plane through its first node `z_0` and frequency `f` that is
//! normal to the branch there, `t_z (z - z_0) + t_f (f - f_0) = 0`, with the tangent `[t_z; t_f]` of the
//! first node in the units of the shooting equations. The plane is the same however the orbit is cut.
//!
//! Beside grazing, multipliers change by up to 1e7 per relative change of the orbit, so what Newton's method
//! leaves within its tolerance shows in them. Here it goes on until its corrections no longer shrink.

use hammerbeam_motion::System;
use hammerbeam_path::PathProblem;

use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response, Segments,
    shooting::ShootingProblem,
    size::{Cut, orbit_scale},
    solve::{correct_in_plane, evaluate, integrator, newton_update, nodes_of, solution},
};

/// So many more corrections of an accepted orbit at most; they end where rounding keeps them from shrinking.
const MOST_POLISHES: u32 = 3;

/// Recomputes a solution with these settings, as closely as rounding allows, held in the plane normal to its
/// branch; [`Segments::Automatic`] keeps its segments.
///
/// # Errors
/// [`OrbitError::NotConverged`] if the solution given is not near an orbit, [`OrbitError::Motion`],
/// [`OrbitError::Eigenvalues`].
pub fn recompute(
    system: &System,
    response: &Response,
    given: &PeriodicSolution,
    settings: &OrbitSettings,
) -> Result<PeriodicSolution, OrbitError> {
    let mut integrator = integrator(system, response, settings)?;
    let (frequency_hz, multiple) = (given.frequency_hz, given.period_multiple);
    let segments = match settings.segments {
        Segments::Fixed(count) => count.max(1),
        Segments::Automatic => given.nodes.len(),
    };
    let nodes = nodes_of(&mut integrator, &Cut::of(given), segments)?;
    let scale = orbit_scale(&mut integrator, given)?;
    let mut problem =
        ShootingProblem::new(integrator, (multiple, segments), scale, 1.0).starting_at(given.phase);
    let mut point = problem.point(&nodes, frequency_hz);
    evaluate(&mut problem, &point)?;
    let row = plane(&mut problem, frequency_hz)?;
    let mut correction = correct_in_plane(&mut problem, &mut point, &row, settings)?;
    for _ in 0..MOST_POLISHES {
        let (update, before) = newton_update(&mut problem, &point, &row)?;
        point.iter_mut().zip(&update).for_each(|(x, u)| *x += u);
        (_, correction) = newton_update(&mut problem, &point, &row)?;
        if correction > 0.5 * before {
            break;
        }
    }
    solution(&mut problem, &point, correction)
}

/// Border of the plane at the point evaluated last: the tangent at the first node, zero at the others.
fn plane(problem: &mut ShootingProblem, frequency_hz: f64) -> Result<Vec<f64>, OrbitError> {
    let (size, last) = (problem.node_size(), problem.unknowns());
    let mut row = vec![0.0; last + 1];
    row[last] = 1.0;
    // Along the frequency axis the first tangent may be steep; across it the second is not.
    for _ in 0..2 {
        let failed = OrbitError::NotConverged { frequency_hz, correction: f64::INFINITY, iterations: 0 };
        problem.factorise(&row).map_err(|_| failed)?;
        let mut tangent = vec![0.0; last + 1];
        tangent[last] = 1.0;
        problem.solve(&mut tangent);
        tangent[size..last].fill(0.0);
        let length = tangent.iter().map(|t| t * t).sum::<f64>().sqrt();
        row = tangent.iter().map(|t| t / length).collect();
    }
    Ok(row)
}
