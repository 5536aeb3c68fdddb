//! The quantities that are compared.

use hammerbeam_results::columns::TableColumn;

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum VerifiedQuantity {
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

impl VerifiedQuantity {
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
            Self::Displacement => TableColumn::Displacement.name(),
            Self::Acceleration => TableColumn::Acceleration.name(),
            Self::ContactForce => TableColumn::ContactForce.name(),
            Self::ImpactVelocity => TableColumn::ImpactVelocity.name(),
            Self::Impulse => TableColumn::Impulse.name(),
            Self::Contacts => TableColumn::Contacts.name(),
            Self::Events => "events",
            Self::Motion => "motion",
        }
    }
}
