//! Hertz contact that loses energy in proportion to its force.
//! Equations (L7) and (L8) of the book, `docs/reference`.

use super::{
    Contact, Force, ForceLaw, ForcePoint, HertzStop, LawAlternative, LawConstant, LawDescription, LawError,
    LawIdentity, LawKey, LawPart, LawSides, LawSymbol, LawWords, Pressure, Quantity, VariesAs,
    quantity::Bound,
};

/// One-sided stop after Hunt and Crossley.
///
/// `f = -k p^1.5 (1 + 3/2 a p')` at penetration `p = r - level > 0` as long as that pushes, else `f = 0`. The
/// force sets in and ends like that of Hertz. With nothing but the contact acting it never ends before the
/// penetration does, since `p' = -2/(3 a)` is not passed.
///
/// The coefficient of restitution of an impact with the speed v goes to `1 - a v` for small `a v`, whatever
/// the masses; over the whole range e solves `(1 + e) y = ln((1 + y)/(1 - e y))`, `y = 3/2 a v`.
///
/// # Source
/// Hunt and Crossley, J. Appl. Mech. 42 (1975), 440-445.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HuntCrossleyStop {
    elastic: HertzStop,
    loss: f64,
}

impl HuntCrossleyStop {
    /// The stop `elastic` with the loss `a` [s/m].
    ///
    /// # Errors
    /// [`LawError::Damping`] unless finite and not negative.
    pub fn new(elastic: HertzStop, loss: f64) -> Result<Self, LawError> {
        Ok(Self { elastic, loss: super::valid_damping(loss)? })
    }
}

impl ForceLaw for HuntCrossleyStop {
    fn force(&self, displacement: f64, velocity: f64) -> Force {
        let force = self.pressing_force(displacement, velocity);
        if force.value < 0.0 { force } else { Force::ZERO }
    }

    fn pressing_force(&self, displacement: f64, velocity: f64) -> Force {
        damped_hertz(&self.elastic, 1.5 * self.loss, displacement, velocity)
    }

    fn contacts(&self) -> &[Contact] {
        self.elastic.contacts()
    }

    /// `1 + 3/2 a p'`.
    fn pressure(&self) -> Option<Pressure> {
        let velocity = 1.5 * self.loss;
        (velocity > 0.0).then_some(Pressure { displacement: 0.0, velocity, offset: 1.0 })
    }

    fn constant(&self, constant: LawConstant) -> Option<f64> {
        if constant == LawConstant::Damping { Some(self.loss) } else { self.elastic.constant(constant) }
    }

    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        match constant {
            LawConstant::Damping => Self::new(self.elastic, value),
            other => Self::new(self.elastic.with_constant(other, value)?, self.loss),
        }
    }

    fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        self.elastic.proportional_to(constant)
    }

    /// `df/da = -3/2 k p^1.5 p'`.
    fn by_constant(&self, constant: LawConstant, at: ForcePoint) -> f64 {
        match constant {
            LawConstant::Damping => 1.5 * self.elastic.force(at.displacement, 0.0).value * at.velocity,
            other => self.elastic.by_constant(other, at),
        }
    }
}

/// `-k p^1.5 (1 + factor p')` and its derivatives.
pub(super) fn damped_hertz(elastic: &HertzStop, factor: f64, displacement: f64, velocity: f64) -> Force {
    let force = elastic.force(displacement, velocity);
    let share = 1.0 + factor * velocity;
    Force { value: force.value * share, slope: force.slope * share, damping: force.value * factor }
}

/// The loss.
const LOSS: Quantity = Quantity::new("s/m", Bound::Including(0.0), Bound::Including(1e6));

pub(super) static DESCRIPTION: LawDescription = LawDescription {
    name: "hunt-crossley",
    identity: LawIdentity::Named("hunt-crossley"),
    force: "k d^1.5 (1 + 3/2 a d')",
    sides: LawSides::One {
        no_preload: None,
        build: |values, rest| {
            let elastic = HertzStop::resting(values.number(0), rest)?;
            Ok(LawPart::whole(HuntCrossleyStop::new(elastic, values.number(1))?.into()))
        },
    },
    keys: &[
        LawKey::hertz_stiffness(),
        LawKey {
            varies: Some(VariesAs::UnlessZero(LawConstant::Damping)),
            ..LawKey::number("loss_s_m", "a", LOSS).named("loss").meaning(
                "loss a of the law of Hunt and Crossley: an impact of the speed v leaves `e = 1 - a v` of \
                 it, for small `a v`",
            )
        },
    ],
    alternative: Some(LawAlternative { own: "loss_s_m", other: "restitution", is_default: true }),
    symbol: LawSymbol::LossySphere,
    words: LawWords {
        report: "Hertz contact after Hunt and Crossley",
        caption: "Hertz contact",
        last_first: false,
    },
};
