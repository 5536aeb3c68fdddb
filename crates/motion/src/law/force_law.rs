//! What the kernel asks of a law. Most laws need the first few only.

use super::{Contact, Force, ForcePoint, LawConstant, LawError, Pressure};

/// The force of a law, its contacts, and its derivatives.
pub(crate) trait ForceLaw: Clone {
    /// Force on the structure along `r` at the relative displacement `r` [m] and velocity `r'` [m/s].
    fn force(&self, displacement: f64, velocity: f64) -> Force;

    /// The contacts; none for a law that is always active.
    fn contacts(&self) -> &[Contact] {
        &[]
    }

    /// A constant in its unit; `None` where the law has none such that can be varied.
    fn constant(&self, constant: LawConstant) -> Option<f64>;

    /// The law with another value of a constant that it has.
    fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError>;

    /// The value of a constant, if the force is proportional to it.
    fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        _ = constant;
        None
    }

    /// Derivative of the force of a pressing contact by a constant other than the gap.
    fn by_constant(&self, constant: LawConstant, at: ForcePoint) -> f64 {
        self.proportional_to(constant).map_or(0.0, |value| at.force / value)
    }

    /// Force of a contact that presses, continued smoothly to where its pressure has vanished: what a step
    /// that ends there follows.
    fn pressing_force(&self, displacement: f64, velocity: f64) -> Force {
        self.force(displacement, velocity)
    }

    /// What has to be positive for a contact to press, if its force depends on the velocity.
    fn pressure(&self) -> Option<Pressure> {
        None
    }

    /// Whether the force depends on the displacement.
    fn depends_on_displacement(&self) -> bool {
        true
    }

    /// Whether the force depends on the velocity.
    fn depends_on_velocity(&self) -> bool {
        self.pressure().is_some()
    }

    /// Mean of `df/dr'` between two velocities; most laws are linear in the velocity while they press.
    fn mean_damping(&self, displacement: f64, velocities: [f64; 2]) -> f64 {
        self.pressing_force(displacement, velocities[1]).damping
    }

    /// The constant c [N s/m] of the force `-c r'` with which a contact begins.
    fn onset_damping(&self) -> f64 {
        0.0
    }

    /// Whether the force changes its sign with the displacement and the velocity.
    fn is_odd(&self) -> bool {
        false
    }

    /// The magnitude of the displacement [m] beyond which the force is linear in it; `None` if it never is.
    fn linear_beyond(&self) -> Option<f64> {
        None
    }

    /// Whether the force may have no power series somewhere, at places that nothing tells beforehand. Kinks
    /// are told.
    fn has_corners(&self) -> bool {
        false
    }

    /// Whether the slope of the force of a closed contact jumps somewhere, where the force is continuous.
    /// Then the law is that of one piece of the force after the other ([`ForceLaw::in_piece`]), continued
    /// smoothly beyond its kinks, as a run goes through them (`exact/kink.rs`).
    fn has_kinks(&self) -> bool {
        false
    }

    /// The displacements at which the present piece of the force ends: where the penetration comes to be
    /// less, and where more.
    fn kinks(&self) -> [Option<f64>; 2] {
        [None; 2]
    }

    /// The law in the piece of its force that holds a displacement; of two, at a kink, in the one with less
    /// penetration.
    fn in_piece(&self, displacement: f64) -> Self {
        _ = displacement;
        self.clone()
    }

    /// The law in the piece beyond a kink of the present one.
    fn beyond_kink(&self, deeper: bool) -> Self {
        _ = deeper;
        self.clone()
    }

    /// Whether the force depends on the speed with which the present contact began.
    fn remembers_impact(&self) -> bool {
        false
    }

    /// The law in a contact that began with that speed [m/s].
    fn struck_at(&self, impact_speed: f64) -> Self {
        _ = impact_speed;
        self.clone()
    }

    /// The speed of the impact that the law remembers [m/s]; infinite before the first.
    fn impact_speed(&self) -> f64 {
        f64::INFINITY
    }

    /// Whether the law knows how its contact began, if it needs to.
    fn is_struck(&self) -> bool {
        true
    }

    /// Derivative of the force of a pressing contact by the speed with which it began.
    fn by_impact_speed(&self, displacement: f64, velocity: f64) -> f64 {
        _ = (displacement, velocity);
        0.0
    }
}

/// What a law says to a constant that it does not have.
pub(super) fn no_constant<T>(law: &'static str, constant: LawConstant) -> Result<T, LawError> {
    Err(LawError::NoConstant { law, constant: constant.name() })
}
