//! Stops of a study file.

/// What a stop does at a relative displacement beyond its gap.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Law {
    /// `k d + c d'`, and a force at the gap [N/m, N s/m, N].
    Linear { stiffness: f64, damping: f64, preload: f64 },
    /// `k d^1.5 (1 + 3/2 a d')` [N/m^1.5, s/m].
    Hertz { stiffness: f64, loss: f64 },
    /// An impact leaves `e` of the speed.
    Rigid { restitution: f64 },
    /// `k1 r + k2 r^2 + k3 r^3`, always.
    Power { terms: [f64; 3] },
}

/// A stop between two masses, or a mass and what carries it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stop {
    /// The relative displacement is `row . y - ratio u`.
    pub row: Vec<f64>,
    pub ratio: f64,
    /// 1 above, -1 below.
    pub side: f64,
    pub gap: f64,
    pub law: Law,
}
