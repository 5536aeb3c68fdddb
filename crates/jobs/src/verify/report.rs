//! What a verification found.

use super::{
    compare::{Comparison, bound},
    quantity::VerifiedQuantity,
    settings::VerifySettings,
};

/// Where a stored solution is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VerifiedPlace {
    /// Of a branch over another parameter, or a curve: the place of its piece in the study, from 1, and the
    /// value of the parameter, in the unit of its name.
    pub piece: Option<(u32, f64)>,
    /// Number of the branch, within its piece.
    pub branch: u32,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
}

/// The worst of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// The quantity.
    pub quantity: VerifiedQuantity,
    /// Largest difference, as it is compared with [`Worst::bound`].
    pub difference: f64,
    /// What it may be.
    pub bound: f64,
    /// Where; `None` if nothing was compared.
    pub place: Option<VerifiedPlace>,
    /// Solutions that were compared.
    pub compared: u64,
    /// Solutions that disagree.
    pub disagree: u64,
    /// Solutions allowed for since a contact grazes.
    pub grazing: u64,
}

impl Worst {
    /// Whether a difference is larger, as a part of what it may be.
    fn is_exceeded_by(&self, difference: f64, bound: f64) -> bool {
        if bound == self.bound {
            difference > self.difference
        } else {
            difference / bound > self.difference / self.bound
        }
    }
}

/// A solution that disagrees in a quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Disagreement {
    /// Where.
    pub place: VerifiedPlace,
    /// What disagrees.
    pub quantity: VerifiedQuantity,
    /// Stored value.
    pub stored: f64,
    /// Recomputed value.
    pub recomputed: f64,
    /// Difference, as it is compared with the bound.
    pub difference: f64,
    /// What it may be.
    pub bound: f64,
    /// What the integrator said, if it could not go through.
    pub message: Option<String>,
}

/// What a verification found.
#[derive(Debug, Clone, PartialEq)]
pub struct Verification {
    /// Solutions stored.
    pub stored: u64,
    /// Solutions that were computed again.
    pub sampled: u64,
    /// One for each of [`VerifiedQuantity::ALL`].
    pub worst: Vec<Worst>,
    /// Every disagreement, in the order of the branches; the worst of each quantity of a solution.
    pub disagreements: Vec<Disagreement>,
    /// Solutions with a difference that is allowed for since a contact grazes.
    pub grazing: u64,
}

impl Verification {
    pub(super) fn new(stored: u64, settings: &VerifySettings) -> Self {
        let worst = VerifiedQuantity::ALL.map(|quantity| Worst {
            quantity,
            difference: 0.0,
            bound: bound(quantity, settings.tolerance),
            place: None,
            compared: 0,
            disagree: 0,
            grazing: 0,
        });
        Self { stored, sampled: 0, worst: worst.to_vec(), disagreements: Vec::new(), grazing: 0 }
    }

    /// Number of solutions that disagree in something.
    #[must_use]
    pub fn disagreeing(&self) -> u64 {
        let mut places: Vec<VerifiedPlace> = self.disagreements.iter().map(|found| found.place).collect();
        places.dedup();
        places.len() as u64
    }

    /// Takes the comparisons of one solution, which were made with a tolerance.
    pub(super) fn add(
        &mut self,
        place: VerifiedPlace,
        tolerance: f64,
        compared: Result<Vec<Comparison>, String>,
    ) {
        self.sampled += 1;
        let failed = |message: &String| Comparison {
            quantity: VerifiedQuantity::Motion,
            stored: 0.0,
            recomputed: f64::NAN,
            difference: if message.is_empty() { 0.0 } else { f64::INFINITY },
            grazing: false,
        };
        let (message, comparisons) = match &compared {
            Ok(comparisons) => (None, comparisons.clone()),
            Err(message) => (Some(message.clone()), vec![failed(message)]),
        };
        let mut allowed = false;
        for worst in &mut self.worst {
            let of_quantity = comparisons.iter().filter(|comparison| comparison.quantity == worst.quantity);
            let largest = of_quantity.max_by(|a, b| a.difference.total_cmp(&b.difference)).copied();
            let Some(comparison) = largest else {
                worst.compared += u64::from(worst.quantity == VerifiedQuantity::Motion);
                continue;
            };
            worst.compared += 1;
            let bound = bound(worst.quantity, tolerance);
            let beyond = comparison.difference.is_nan() || comparison.difference > bound;
            if beyond && comparison.grazing {
                worst.grazing += 1;
                allowed = true;
                continue;
            }
            if worst.place.is_none() || worst.is_exceeded_by(comparison.difference, bound) {
                (worst.difference, worst.bound, worst.place) = (comparison.difference, bound, Some(place));
            }
            if beyond {
                worst.disagree += 1;
                self.disagreements.push(Disagreement {
                    place,
                    quantity: worst.quantity,
                    stored: comparison.stored,
                    recomputed: comparison.recomputed,
                    difference: comparison.difference,
                    bound,
                    message: message.clone(),
                });
            }
        }
        self.grazing += u64::from(allowed);
    }
}
