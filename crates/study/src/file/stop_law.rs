//! The force law of a stop, as the study states it.

use serde::Serialize;

/// Force law of a local element.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum StopLaw {
    /// One-sided, `k p^1.5`.
    Hertz {
        /// The constant.
        stiffness: HertzStiffness,
        /// Gap or preload.
        approach: Approach,
        /// On which side the stop is.
        side: Side,
    },
    /// One-sided, `k p`.
    Linear {
        /// Stiffness [N/m].
        stiffness_n_m: f64,
        /// Constant of the damper beside the spring [N s/m].
        #[serde(skip_serializing_if = "is_absent")]
        damping_n_s_m: f64,
        /// Gap or preload.
        approach: Approach,
        /// On which side the stop is.
        side: Side,
    },
    /// One-sided, `k p^1.5 (1 + 3/2 a p')`.
    HuntCrossley {
        /// The constant.
        stiffness: HertzStiffness,
        /// The loss a [s/m].
        loss_s_m: f64,
        /// Gap or preload.
        approach: Approach,
        /// On which side the stop is.
        side: Side,
    },
    /// One-sided, `k p^1.5 (1 + c p'/v)` with the speed v of each impact.
    Restitution {
        /// How c follows from the coefficient of restitution.
        model: ImpactModel,
        /// The constant.
        stiffness: HertzStiffness,
        /// Coefficient of restitution.
        restitution: f64,
        /// The gap.
        approach: Approach,
        /// On which side the stop is.
        side: Side,
    },
    /// One-sided and rigid: an impact turns the velocity round.
    Rigid {
        /// Coefficient of restitution.
        restitution: f64,
        /// The gap.
        approach: Approach,
        /// On which side the stop is.
        side: Side,
    },
    /// Linear springs on both sides.
    TwoSided {
        /// Stiffness [N/m].
        stiffness_n_m: f64,
        /// Rest distance of the upper spring [m].
        gap_above_m: f64,
        /// Rest distance of the lower spring [m].
        gap_below_m: f64,
        /// From where the gaps count.
        gap_measured: GapMeasured,
    },
    /// Cubic spring, always active: `k1 r + k2 r^2 + k3 r^3`, constants of either sign.
    Cubic {
        /// Constant of the linear term [N/m].
        #[serde(skip_serializing_if = "is_absent")]
        stiffness_n_m: f64,
        /// Constant of the quadratic term [N/m^2].
        #[serde(skip_serializing_if = "is_absent")]
        stiffness_n_m2: f64,
        /// Constant of the cubic term [N/m^3].
        #[serde(skip_serializing_if = "is_absent")]
        stiffness_n_m3: f64,
    },
    /// A formula of displacement and velocity, always active.
    Formula {
        /// The force with which the element resists [N], of `x` [m] and `v` [m/s].
        formula: String,
        /// Its constants by their names, in the order of these.
        #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "as_table")]
        constants: Vec<(String, f64)>,
    },
}

/// Absent unless given, so that studies without it stay the same studies.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
fn is_absent(number: &f64) -> bool {
    *number == 0.0
}

fn as_table<S: serde::Serializer>(constants: &[(String, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(constants.iter().map(|(name, value)| (name, value)))
}

/// How the loss of a contact follows from its coefficient of restitution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "names of authors")]
pub enum ImpactModel {
    HuntCrossley,
    HerbertMcwhannell,
    LeeWang,
    LankaraniNikravesh,
    Gonthier,
    Flores,
    HuGuo,
}

/// The constant of a Hertz contact, given or from two spheres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum HertzStiffness {
    /// Given [N/m^1.5].
    Given(f64),
    /// Of two spheres.
    Spheres {
        /// Radii [m]; `None` is a plane.
        radii_m: [Option<f64>; 2],
        /// Young's moduli [Pa].
        moduli_pa: [f64; 2],
        /// Poisson's ratios.
        poisson_ratios: [f64; 2],
    },
}

/// How close a one-sided stop is at rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Approach {
    /// At a distance.
    Gap {
        /// Distance [m].
        gap_m: f64,
        /// From where it counts.
        measured: GapMeasured,
    },
    /// Pressing on the undeformed structure.
    Preload {
        /// Force [N].
        preload_n: f64,
    },
}

/// From where a gap counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum GapMeasured {
    /// From the undeformed structure.
    Undeformed,
    /// From where the structure rests under the constant loads.
    AtRest,
}

/// On which side of the point a one-sided stop is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Contact where `r > gap`.
    Above,
    /// Contact where `r < -gap`.
    Below,
}

impl StopLaw {
    /// Its gap [m], if it has a single one.
    #[must_use]
    pub fn gap_m(&self) -> Option<f64> {
        match self {
            Self::Hertz { approach: Approach::Gap { gap_m, .. }, .. }
            | Self::HuntCrossley { approach: Approach::Gap { gap_m, .. }, .. }
            | Self::Restitution { approach: Approach::Gap { gap_m, .. }, .. }
            | Self::Linear { approach: Approach::Gap { gap_m, .. }, .. }
            | Self::Rigid { approach: Approach::Gap { gap_m, .. }, .. } => Some(*gap_m),
            Self::TwoSided { gap_above_m, gap_below_m, .. } if gap_above_m == gap_below_m => {
                Some(*gap_above_m)
            }
            _ => None,
        }
    }

    /// From where its gap counts, if it has one.
    #[must_use]
    pub fn gap_measured(&self) -> GapMeasured {
        match self {
            Self::Hertz { approach: Approach::Gap { measured, .. }, .. }
            | Self::HuntCrossley { approach: Approach::Gap { measured, .. }, .. }
            | Self::Restitution { approach: Approach::Gap { measured, .. }, .. }
            | Self::Linear { approach: Approach::Gap { measured, .. }, .. }
            | Self::Rigid { approach: Approach::Gap { measured, .. }, .. } => *measured,
            Self::TwoSided { gap_measured, .. } => *gap_measured,
            _ => GapMeasured::Undeformed,
        }
    }
}
