//! What a verification found.

use super::{
    VerifySettings,
    compare::{Comparison, bound},
};

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// That the motion from the first node meets the others and closes.
    Residual,
    /// Floquet multipliers; in a disagreement their moduli.
    Multipliers,
    /// Largest displacement [m].
    Displacement,
    /// Largest acceleration [m/s^2].
    Acceleration,
    /// Largest contact force [N].
    ContactForce,
    /// Largest impact velocity [m/s].
    ImpactVelocity,
    /// Sum of the impulses [N s].
    Impulse,
    /// Number of contacts.
    Contacts,
    /// That events are where they are claimed; in a disagreement the distance from there.
    Events,
    /// That the motion can be computed at all.
    Motion,
}

impl Quantity {
    /// All of them, in the order of a report.
    pub const ALL: [Self; 10] = [
        Self::Residual,
        Self::Multipliers,
        Self::Displacement,
        Self::Acceleration,
        Self::ContactForce,
        Self::ImpactVelocity,
        Self::Impulse,
        Self::Contacts,
        Self::Events,
        Self::Motion,
    ];

    /// Its name, with the unit of its values.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Residual => "residual",
            Self::Multipliers => "multiplier_modulus",
            Self::Displacement => "max_abs_displacement_m",
            Self::Acceleration => "max_abs_acceleration_m_s2",
            Self::ContactForce => "max_contact_force_n",
            Self::ImpactVelocity => "max_impact_velocity_m_s",
            Self::Impulse => "impulse_n_s",
            Self::Contacts => "contacts",
            Self::Events => "events",
            Self::Motion => "motion",
        }
    }
}

/// The worst of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// The quantity.
    pub quantity: Quantity,
    /// Largest difference, as it is compared with [`Worst::bound`].
    pub difference: f64,
    /// What it may be.
    pub bound: f64,
    /// Where: branch and frequency [Hz]; `None` if nothing was compared.
    pub place: Option<(u32, f64)>,
    /// Solutions that were compared.
    pub compared: u64,
    /// Solutions that disagree.
    pub disagree: u64,
    /// Solutions allowed for since a contact grazes.
    pub grazing: u64,
}

/// A solution that disagrees in a quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Disagreement {
    /// Number of the branch.
    pub branch: u32,
    /// Frequency [Hz].
    pub frequency_hz: f64,
    /// What disagrees.
    pub quantity: Quantity,
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
    /// One for each of [`Quantity::ALL`].
    pub worst: Vec<Worst>,
    /// Every disagreement, in the order of the branches; the worst of each quantity of a solution.
    pub disagreements: Vec<Disagreement>,
    /// Solutions with a difference that is allowed for since a contact grazes.
    pub grazing: u64,
}

impl Verification {
    pub(super) fn new(stored: u64, settings: &VerifySettings) -> Self {
        let worst = Quantity::ALL.map(|quantity| Worst {
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
        let mut places: Vec<(u32, u64)> =
            self.disagreements.iter().map(|d| (d.branch, d.frequency_hz.to_bits())).collect();
        places.dedup();
        places.len() as u64
    }

    /// Takes the comparisons of one solution.
    pub(super) fn add(&mut self, branch: u32, frequency_hz: f64, compared: Result<Vec<Comparison>, String>) {
        self.sampled += 1;
        let failed = |message: &String| Comparison {
            quantity: Quantity::Motion,
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
                worst.compared += u64::from(worst.quantity == Quantity::Motion);
                continue;
            };
            worst.compared += 1;
            let beyond = comparison.difference.is_nan() || comparison.difference > worst.bound;
            if beyond && comparison.grazing {
                worst.grazing += 1;
                allowed = true;
                continue;
            }
            if worst.place.is_none() || comparison.difference > worst.difference {
                (worst.difference, worst.place) = (comparison.difference, Some((branch, frequency_hz)));
            }
            if beyond {
                worst.disagree += 1;
                self.disagreements.push(Disagreement {
                    branch,
                    frequency_hz,
                    quantity: worst.quantity,
                    stored: comparison.stored,
                    recomputed: comparison.recomputed,
                    difference: comparison.difference,
                    bound: worst.bound,
                    message: message.clone(),
                });
            }
        }
        self.grazing += u64::from(allowed);
    }
}
