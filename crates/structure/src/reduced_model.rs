//! The modal form in which a structure leaves this crate.

use faer::Mat;

use crate::{StructureError, modes::static_amplitudes};

/// A linear structure in mass-normalised modal coordinates `q`, relative to its supports.
///
/// With the prescribed displacements `u_s(t)` of its supports, forces `F_p` at the points and a uniform
/// acceleration field `a` (gravity),
///
/// `q'' + C q' + diag(w^2) q = -sum_s (g_s u_s'' + d_s u_s') + sum_p phi_p F_p + a m`,
/// `y_p = phi_p . q + sum_s s_ps u_s`,
///
/// where `y_p` is the absolute displacement of point `p`. The rows mean:
///
/// * `natural_frequencies`: `w` [rad/s], ascending, length n; rigid-body modes are exactly 0.0.
/// * `damping`: `C = Phi^T C Phi` [1/s], n x n, symmetric; diagonal if damping does not couple the modes.
/// * `points`: `phi_p` and `s_ps`, see [`PointOutput`].
/// * `supports`: `g_s` and `d_s` of each support that moves, see [`SupportInput`].
/// * `uniform_acceleration`: `m = Phi^T M 1` [kg^1/2] over the transverse coordinates.
#[derive(Debug, Clone)]
pub struct ReducedModel {
    /// Circular eigenfrequencies `w` [rad/s], ascending.
    pub natural_frequencies: Vec<f64>,
    /// Modal damping matrix `C` [1/s], n x n.
    pub damping: Mat<f64>,
    /// Displacement outputs and force inputs, one per named point.
    pub points: Vec<PointOutput>,
    /// How the motion of each support drives the modes.
    pub supports: Vec<SupportInput>,
    /// Modal load per unit uniform acceleration, `Phi^T M 1` [kg^1/2].
    pub uniform_acceleration: Vec<f64>,
}

/// A named point: where motion is observed and forces act.
#[derive(Debug, Clone, PartialEq)]
pub struct PointOutput {
    /// Name given in the study.
    pub name: String,
    /// Displacement of the point in each mode, `phi_p` [kg^-1/2], length n.
    pub shape: Vec<f64>,
    /// Displacement of the point per unit static motion of each support, `s_ps` [-].
    pub support_ratios: Vec<f64>,
}

/// How the prescribed displacement `u_s(t)` of a support drives the modes.
#[derive(Debug, Clone, PartialEq)]
pub struct SupportInput {
    /// `g_s = Phi^T (M_ff Gamma_s + M_fs)` [kg^1/2], with the static constraint vector `Gamma_s`.
    pub inertia: Vec<f64>,
    /// `d_s = Phi^T (C_ff Gamma_s + C_fs)` [kg^1/2/s], from discrete dampers only: modal and Rayleigh
    /// damping act on the motion relative to the supports.
    pub damping: Vec<f64>,
}

impl ReducedModel {
    /// Number of modes n.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.natural_frequencies.len()
    }

    /// The point of that name.
    #[must_use]
    pub fn point(&self, name: &str) -> Option<&PointOutput> {
        self.points.iter().find(|point| point.name == name)
    }

    /// Displacement [m] of a point under a uniform acceleration (gravity), the support at rest.
    ///
    /// `y_p = a sum_i phi_pi m_i / w_i^2`; `None` if there is no such point.
    ///
    /// * `acceleration`: a [m/s^2], along the positive displacement.
    ///
    /// # Errors
    /// A rigid-body mode that the load drives.
    pub fn static_deflection(&self, point: &str, acceleration: f64) -> Result<Option<f64>, StructureError> {
        let Some(point) = self.point(point) else { return Ok(None) };
        let amplitudes = static_amplitudes(&self.natural_frequencies, &self.uniform_acceleration)?;
        let per_acceleration: f64 = point.shape.iter().zip(amplitudes).map(|(phi, q)| phi * q).sum();
        Ok(Some(acceleration * per_acceleration))
    }
}
