//! Damping: modal, Rayleigh and discrete, added up.

use faer::{Mat, MatRef};

use crate::{
    StructureError,
    error::{finite, not_negative},
};

/// Modal damping ratios `z`.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum ModalRatios {
    /// No modal damping.
    #[default]
    None,
    /// The same ratio for every mode.
    Uniform(f64),
    /// A ratio for each mode of the reduced structure, lowest frequency first.
    PerMode(Vec<f64>),
}

/// Damping of a structure besides its discrete dampers.
///
/// `C = Phi^T C_d Phi + diag(2 z_i w_i) + alpha 1 + beta diag(w_i^2)`, with the discrete dampers `C_d`.
/// Modal and Rayleigh damping act on the motion relative to the support, discrete dampers on the
/// absolute motion, so these may couple the modes and make them overdamped.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Damping {
    /// Modal ratios `z` [-]; the modes are those of the reduced, supported structure.
    pub modal: ModalRatios,
    /// Rayleigh's `alpha` [1/s], proportional to mass.
    pub rayleigh_alpha: f64,
    /// Rayleigh's `beta` [s], proportional to stiffness.
    pub rayleigh_beta: f64,
}

impl Damping {
    /// Discrete dampers only.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// One modal ratio for all modes.
    #[must_use]
    pub fn modal(ratio: f64) -> Self {
        Self { modal: ModalRatios::Uniform(ratio), ..Self::default() }
    }

    /// Rayleigh damping `alpha M + beta K`.
    #[must_use]
    pub fn rayleigh(alpha: f64, beta: f64) -> Self {
        Self { rayleigh_alpha: alpha, rayleigh_beta: beta, ..Self::default() }
    }

    /// `C` [1/s] of modes with frequencies `w` and strains `D Phi` of the discrete dampers.
    ///
    /// # Errors
    /// A constant that is negative or not finite, or ratios that are not one for each mode.
    pub(crate) fn matrix(
        &self,
        frequencies: &[f64],
        damper_strains: MatRef<'_, f64>,
    ) -> Result<Mat<f64>, StructureError> {
        self.matrix_with(frequencies, (damper_strains.transpose() * damper_strains).as_ref())
    }

    /// `C` [1/s] of modes with frequencies `w` and `Phi^T C_d Phi` of the discrete dampers.
    ///
    /// # Errors
    /// A constant that is negative or not finite, or ratios that are not one for each mode.
    pub(crate) fn matrix_with(
        &self,
        frequencies: &[f64],
        product: MatRef<'_, f64>,
    ) -> Result<Mat<f64>, StructureError> {
        let ratios = self.ratios(frequencies.len())?;
        let alpha = not_negative("Rayleigh damping alpha", self.rayleigh_alpha)?;
        let beta = not_negative("Rayleigh damping beta", self.rayleigh_beta)?;
        let mut matrix = Mat::from_fn(ratios.len(), ratios.len(), |i, j| product[(i.max(j), i.min(j))]);
        for (mode, (&w, ratio)) in frequencies.iter().zip(ratios).enumerate() {
            matrix[(mode, mode)] += 2.0 * ratio * w + alpha + beta * w * w;
        }
        Ok(matrix)
    }

    fn ratios(&self, modes: usize) -> Result<Vec<f64>, StructureError> {
        let ratios = match &self.modal {
            ModalRatios::None => vec![0.0; modes],
            ModalRatios::Uniform(ratio) => vec![*ratio; modes],
            ModalRatios::PerMode(ratios) => ratios.clone(),
        };
        for ratio in &ratios {
            not_negative("modal damping ratio", finite("modal damping ratio", *ratio)?)?;
        }
        match ratios.len() {
            found if found == modes => Ok(ratios),
            found => Err(StructureError::DampingRatioCount { found, modes }),
        }
    }
}
