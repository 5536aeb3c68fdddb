//! Hertz contacts whose loss is set by a coefficient of restitution and by the speed of each impact.
//! Equation (L9) of the book, `docs/reference`.
//!
//! `f = -k p^1.5 (1 + c p'/v)` at penetration `p = r - level > 0` as long as that pushes, else `f = 0`. The
//! speed v is that with which the present contact began, so the law has a memory: a contact has to be
//! followed from its beginning. The factor c is what the models differ in:
//!
//! * [`HuntCrossley`](RestitutionModel::HuntCrossley): c(e) `3 (1 - e)/2`; source Hunt and Crossley, J. Appl.
//!   Mech. 42 (1975), 440-445.
//! * [`HerbertMcWhannell`](RestitutionModel::HerbertMcWhannell): c(e) `6 (1 - e)/((2 e - 1)^2 + 3)`; source
//!   Herbert and McWhannell, J. Eng. Ind. 99 (1977), 513-518.
//! * [`LeeWang`](RestitutionModel::LeeWang): c(e) `3 (1 - e)/4`; source Lee and Wang, J. Mech. Transm. Autom.
//!   Des. 105 (1983), 534-540.
//! * [`LankaraniNikravesh`](RestitutionModel::LankaraniNikravesh): c(e) `3 (1 - e^2)/4`; source Lankarani and
//!   Nikravesh, J. Mech. Des. 112 (1990), 369-376.
//! * [`Gonthier`](RestitutionModel::Gonthier): c(e) `(1 - e^2)/e`; source Gonthier and others, Multibody
//!   Syst. Dyn. 11 (2004), 209-233.
//! * [`Flores`](RestitutionModel::Flores): c(e) `8 (1 - e)/(5 e)`; source Flores and others, Multibody Syst.
//!   Dyn. 25 (2011), 357-375.
//! * [`HuGuo`](RestitutionModel::HuGuo): c(e) `3 (1 - e)/(2 e)`; source Hu and Guo, Multibody Syst. Dyn. 35
//!   (2015), 131-151.
//!
//! The coefficient e that goes in is not quite the ratio of speeds that comes out of two bodies with nothing
//! else acting: that is the `e_out` of `(1 + e_out) c = ln((1 + c)/(1 - e_out c))`, `e_out = 1 - 2 c/3 +
//! ...`. The models of Hunt and Crossley, Herbert and McWhannell, Lankarani and Nikravesh, and Hu and Guo
//! agree with that to first order in `1 - e`; those with e in the denominator stop completely at `e = 0`.
//!
//! **Slow touches.** The loss is `c p'/v`, so it has no bound as v goes to zero and other forces press the
//! contact on: such a law says nothing of pressing without an impact. A touch that turns by itself, `p'' <
//! 0`, is harmless: its force goes like `v^3`.

use super::{
    Contact, Force, ForceLaw, ForcePoint, HertzStop, LawAlternative, LawConstant, LawDescription, LawError,
    LawIdentity, LawKey, LawPart, LawSides, LawSymbol, LawWords, NoPreload, Pressure, Quantity,
    hunt_crossley::damped_hertz, quantity::Bound,
};

/// How the loss follows from the coefficient of restitution; formulas and sources see the module.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RestitutionModel {
    /// Good near `e = 1`.
    HuntCrossley,
    /// Good near `e = 1`.
    HerbertMcWhannell,
    /// Loses about half of what e says.
    LeeWang,
    /// Good near `e = 1`.
    LankaraniNikravesh,
    /// Good near `e = 0`.
    Gonthier,
    /// Fair for every e.
    Flores,
    /// Good near both ends.
    HuGuo,
}

impl RestitutionModel {
    /// Every model.
    pub const ALL: [Self; 7] = [
        Self::HuntCrossley,
        Self::HerbertMcWhannell,
        Self::LeeWang,
        Self::LankaraniNikravesh,
        Self::Gonthier,
        Self::Flores,
        Self::HuGuo,
    ];

    /// The factor c for a coefficient of restitution e.
    #[must_use]
    pub fn factor(self, e: f64) -> f64 {
        match self {
            Self::HuntCrossley => 1.5 * (1.0 - e),
            Self::HerbertMcWhannell => 6.0 * (1.0 - e) / ((2.0 * e - 1.0).powi(2) + 3.0),
            Self::LeeWang => 0.75 * (1.0 - e),
            Self::LankaraniNikravesh => 0.75 * (1.0 - e * e),
            Self::Gonthier => (1.0 - e * e) / e,
            Self::Flores => 1.6 * (1.0 - e) / e,
            Self::HuGuo => 1.5 * (1.0 - e) / e,
        }
    }

    /// `dc/de`.
    fn slope(self, e: f64) -> f64 {
        match self {
            Self::HuntCrossley => -1.5,
            Self::HerbertMcWhannell => {
                let below = (2.0 * e - 1.0).powi(2) + 3.0;
                -6.0 / below - 24.0 * (1.0 - e) * (2.0 * e - 1.0) / (below * below)
            }
            Self::LeeWang => -0.75,
            Self::LankaraniNikravesh => -1.5 * e,
            Self::Gonthier => -1.0 - 1.0 / (e * e),
            Self::Flores => -1.6 / (e * e),
            Self::HuGuo => -1.5 / (e * e),
        }
    }
}

/// One-sided Hertz stop with a coefficient of restitution; the law see the module.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestitutionStop {
    elastic: HertzStop,
    model: RestitutionModel,
    restitution: f64,
    factor: f64,
    /// Speed v with which the present contact began [m/s]; infinite before the first.
    impact_speed: f64,
}

impl RestitutionStop {
    /// The stop `elastic` with a coefficient of restitution.
    ///
    /// * `restitution`: e, more than 0 and at most 1; 1 loses nothing.
    ///
    /// # Errors
    /// [`LawError::Restitution`] if it is outside, [`LawError::MemoryOfPreload`] if the stop presses on the
    /// undeformed structure: a contact that never began has no speed to remember.
    pub fn new(elastic: HertzStop, model: RestitutionModel, restitution: f64) -> Result<Self, LawError> {
        if !(restitution > 0.0 && restitution <= 1.0) {
            return Err(LawError::Restitution { found: restitution });
        }
        if elastic.contacts()[0].level < 0.0 {
            return Err(LawError::MemoryOfPreload);
        }
        let factor = model.factor(restitution);
        Ok(Self { elastic, model, restitution, factor, impact_speed: f64::INFINITY })
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> RestitutionModel {
        self.model
    }
}

impl ForceLaw for RestitutionStop {
    fn force(&self, displacement: f64, velocity: f64) -> Force {
        let force = self.pressing_force(displacement, velocity);
        if force.value < 0.0 { force } else { Force::ZERO }
    }

    fn pressing_force(&self, displacement: f64, velocity: f64) -> Force {
        damped_hertz(&self.elastic, self.factor / self.impact_speed, displacement, velocity)
    }

    fn contacts(&self) -> &[Contact] {
        self.elastic.contacts()
    }

    /// `1 + c p'/v`.
    fn pressure(&self) -> Option<Pressure> {
        Some(Pressure { displacement: 0.0, velocity: self.factor / self.impact_speed, offset: 1.0 })
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        match constant {
            LawConstant::Restitution => Some(self.restitution),
            other => self.elastic.constant(other),
        }
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        match constant {
            LawConstant::Restitution => {
                Ok(Self { impact_speed: self.impact_speed, ..Self::new(self.elastic, self.model, value)? })
            }
            other => Ok(Self { elastic: self.elastic.with_constant(other, value)?, ..*self }),
        }
    }

    fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        self.elastic.proportional_to(constant)
    }

    /// `df/de = -k p^1.5 c'(e) p'/v`.
    fn by_constant(&self, constant: LawConstant, at: ForcePoint) -> f64 {
        match constant {
            LawConstant::Restitution => {
                let force = self.elastic.force(at.displacement, 0.0).value;
                force * self.model.slope(self.restitution) * at.velocity / self.impact_speed
            }
            other => self.elastic.by_constant(other, at),
        }
    }

    fn remembers_impact(&self) -> bool {
        true
    }

    fn struck_at(&self, impact_speed: f64) -> Self {
        Self { impact_speed, ..*self }
    }

    fn impact_speed(&self) -> f64 {
        self.impact_speed
    }

    fn is_struck(&self) -> bool {
        self.impact_speed.is_finite()
    }

    /// `df/dv = k p^1.5 c p'/v^2`.
    fn by_impact_speed(&self, displacement: f64, velocity: f64) -> f64 {
        let speed = self.impact_speed;
        -self.elastic.force(displacement, 0.0).value * self.factor * velocity / (speed * speed)
    }
}

/// The coefficient of restitution.
const RESTITUTION: Quantity = Quantity::new("", Bound::Excluding(0.0), Bound::Including(1.0));

/// The law of a model.
macro_rules! described {
    ($model:ident, $name:literal, $alternative:expr) => {
        LawDescription {
            name: $name,
            identity: LawIdentity::Model { family: "restitution", model: $name },
            force: "k d^1.5 (1 + C d'/v)",
            sides: LawSides::One {
                no_preload: Some(NoPreload {
                    why: "the law needs the speed of each impact",
                    allowed: "allowed: a gap; a contact that is closed at rest has no impact to remember",
                }),
                build: |values, rest| {
                    let elastic = HertzStop::resting(values.number(0), rest)?;
                    let stop = RestitutionStop::new(elastic, RestitutionModel::$model, values.number(1))?;
                    Ok(LawPart::whole(stop.into()))
                },
            },
            keys: &[
                LawKey::hertz_stiffness(),
                LawKey::number("restitution", "e", RESTITUTION)
                    .named("coefficient of restitution")
                    .meaning("coefficient of restitution e that goes into C, below")
                    .varying(LawConstant::Restitution),
            ],
            alternative: $alternative,
            symbol: LawSymbol::LossySphere,
            words: LawWords {
                report: concat!("Hertz contact (", $name, ")"),
                caption: "Hertz contact",
                last_first: false,
            },
        }
    };
}

pub(super) static DESCRIPTIONS: [LawDescription; 7] = [
    described!(
        HuntCrossley,
        "hunt-crossley",
        Some(LawAlternative { own: "restitution", other: "loss_s_m", is_default: false })
    ),
    described!(HerbertMcWhannell, "herbert-mcwhannell", None),
    described!(LeeWang, "lee-wang", None),
    described!(LankaraniNikravesh, "lankarani-nikravesh", None),
    described!(Gonthier, "gonthier", None),
    described!(Flores, "flores", None),
    described!(HuGuo, "hu-guo", None),
];
