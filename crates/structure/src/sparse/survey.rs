//! What matrices are like before anything is said of supports and points: for a report on reading them.

use std::f64::consts::TAU;

use super::{
    Matrices, MatrixReport, RowLabel, SymmetricMatrix, assemble::Assembled, factor::Pencil,
    memory::MemoryBudget, passive::passive_mass_rank, pencil_modes::PencilModes, report,
};
use crate::StructureError;

/// Steps of the search for a frequency below which enough modes lie.
const STEPS: usize = 40;

/// Matrices without empty rows and multipliers, and what was found.
#[derive(Debug)]
pub struct MatrixSurvey {
    /// Stiffness of what is left.
    pub stiffness: SymmetricMatrix,
    /// Its mass.
    pub mass: SymmetricMatrix,
    /// Its damping.
    pub damping: Option<SymmetricMatrix>,
    /// What the rows are, where that is known of all.
    pub labels: Vec<RowLabel>,
    /// Rows, rigid-body modes, mass.
    pub report: MatrixReport,
    /// Rank of the mass; `None` if it could not be found.
    pub mass_rank: Option<usize>,
    /// First frequencies [Hz], rigid-body modes 0.
    pub frequencies_hz: Vec<f64>,
}

impl Matrices {
    /// Looks at the matrices, no support moving.
    ///
    /// * `count`: number of frequencies.
    ///
    /// # Errors
    /// As [`Matrices::reduce`].
    pub fn survey(&self, count: usize) -> Result<MatrixSurvey, StructureError> {
        let assembled = self.assembled(&[])?;
        let pencil = Pencil::new(
            assembled.stiffness.clone(),
            assembled.mass.clone(),
            MemoryBudget::of(self.memory_limit_bytes),
        )?;
        let mass_rank = passive_mass_rank(&assembled)?;
        let modes =
            pencil.first_modes(count, assembled.joined.precision).map_err(|error| assembled.named(error))?;
        let mut report = assembled.report.clone();
        report::complete(&mut report, self, &assembled, &pencil, &modes)?;
        let labels: Option<Vec<RowLabel>> =
            (0..assembled.free).map(|column| assembled.label_of(column)).collect();
        Ok(MatrixSurvey {
            labels: labels.unwrap_or_default(),
            report,
            mass_rank,
            frequencies_hz: modes.frequencies.iter().take(count).map(|w| w / TAU).collect(),
            stiffness: assembled.stiffness,
            mass: assembled.mass,
            damping: assembled.damping,
        })
    }
}

impl Assembled {
    /// The row that is a coordinate by itself.
    pub(super) fn row_of(&self, column: usize) -> Option<usize> {
        (0..self.map.rows()).find(|&row| {
            let mut terms = self.map.row(row);
            terms.next() == Some((column, 1.0)) && terms.next().is_none()
        })
    }

    fn label_of(&self, column: usize) -> Option<RowLabel> {
        self.joined.labels[self.row_of(column)?].clone()
    }

    /// A mechanism by the label of its row.
    pub(super) fn named(&self, error: StructureError) -> StructureError {
        match error {
            StructureError::Mechanism { coordinate } => {
                let row = self.row_of(coordinate).map_or_else(String::new, |row| self.joined.label(row));
                StructureError::MasslessMechanism { row }
            }
            other => other,
        }
    }
}

impl Pencil {
    /// So many modes, or all that there are.
    fn first_modes(&self, count: usize, precision: f64) -> Result<PencilModes, StructureError> {
        if self.size() <= super::pencil_modes::DENSE {
            return self.modes(f64::INFINITY, precision);
        }
        let mut square = self.typical_square();
        for _ in 0..STEPS {
            match self.count_below(square)? {
                few if few < count => square *= 10.0,
                many if many > 20 * count => square /= 10.0,
                _ => break,
            }
        }
        self.modes(square.sqrt() / TAU, precision)
    }
}
