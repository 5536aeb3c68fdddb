//! What is asked of a law is asked of the one that it is.

use super::{
    Contact, Force, ForceLaw, ForcePoint, Law, LawConstant, LawError, Pressure, RigidStop, RoundHole,
};

impl Law {
    /// Force on the structure along `r` at the relative displacement `r` [m] and the relative velocity `r'`
    /// [m/s].
    #[must_use]
    pub fn force(&self, displacement: f64, velocity: f64) -> Force {
        of_law!(self, law => law.force(displacement, velocity))
    }

    /// Forces and their slopes at several displacements, of a law that does not depend on the velocity: the
    /// law is asked for once.
    pub(crate) fn elastic_forces(&self, displacements: &[f64], values: &mut [f64], slopes: &mut [f64]) {
        of_law!(self, law => {
            for ((&displacement, value), slope) in displacements.iter().zip(values).zip(slopes) {
                let force = law.force(displacement, 0.0);
                (*value, *slope) = (force.value, force.slope);
            }
        });
    }

    /// The contacts of the law; none for a law that is always active.
    #[must_use]
    pub fn contacts(&self) -> &[Contact] {
        of_law!(self, law => ForceLaw::contacts(law))
    }

    /// The stop, if the law is that of a rigid one.
    #[must_use]
    pub fn rigid(&self) -> Option<&RigidStop> {
        if let Self::Rigid(law) = self { Some(law) } else { None }
    }

    /// Whether bounces without end may come before it sticks, which count as one contact: it is a rigid stop
    /// that gives something back.
    pub(crate) fn chatters(&self) -> bool {
        self.rigid().is_some_and(|stop| stop.restitution() > 0.0)
    }

    /// The round hole with this law along its radius, and its gap as clearance.
    ///
    /// # Errors
    /// [`LawError::NotForHole`] unless it is a Hertz contact or a linear stop without a damper;
    /// [`LawError::Clearance`] unless its gap is more than 0.
    pub fn in_round_hole(&self) -> Result<RoundHole, LawError> {
        let stiffness = self.constant(LawConstant::Stiffness).ok_or(LawError::NotForHole)?;
        let clearance = self.contacts().first().map_or(0.0, |contact| contact.level);
        match self {
            Self::Linear(law) if law.onset_damping() == 0.0 => RoundHole::linear(stiffness, clearance),
            Self::Hertz(_) => RoundHole::hertz(stiffness, clearance),
            _ => Err(LawError::NotForHole),
        }
    }

    /// The hole, if the law is that of the first direction of one.
    #[must_use]
    pub fn round_hole(&self) -> Option<&RoundHole> {
        if let Self::RoundHole(law) = self { Some(law) } else { None }
    }

    /// Whether the law is that of the second direction of a round hole, whose force that of the first has.
    #[must_use]
    pub fn is_across_hole(&self) -> bool {
        matches!(self, Self::AcrossHole(_))
    }

    /// Force along a displacement of the element alone: of a round hole while its point does not move across.
    #[must_use]
    pub fn force_along(&self, displacement: f64) -> f64 {
        match self {
            Self::RoundHole(hole) => hole.force_at([displacement, 0.0]).value[0],
            other => other.force(displacement, 0.0).value,
        }
    }

    /// Force of a contact that presses, continued smoothly to where its pressure has vanished: what a step
    /// that ends there follows.
    #[must_use]
    pub(crate) fn pressing_force(&self, displacement: f64, velocity: f64) -> Force {
        of_law!(self, law => law.pressing_force(displacement, velocity))
    }

    /// What has to be positive for a contact to press, if its force depends on the velocity.
    #[must_use]
    pub fn pressure(&self) -> Option<Pressure> {
        of_law!(self, law => ForceLaw::pressure(law))
    }

    /// Whether a contact of the law can part while there is penetration left.
    #[must_use]
    pub fn has_pressure(&self) -> bool {
        self.pressure().is_some()
    }

    /// Whether the force depends on the displacement.
    #[must_use]
    pub fn depends_on_displacement(&self) -> bool {
        of_law!(self, law => ForceLaw::depends_on_displacement(law))
    }

    /// Whether the force depends on the velocity: that of a contact that has a pressure, or a formula.
    #[must_use]
    pub fn depends_on_velocity(&self) -> bool {
        of_law!(self, law => ForceLaw::depends_on_velocity(law))
    }

    /// Mean of `df/dr'` between two velocities, by which the force jumps with its velocity.
    pub(crate) fn mean_damping(&self, displacement: f64, velocities: [f64; 2]) -> f64 {
        of_law!(self, law => ForceLaw::mean_damping(law, displacement, velocities))
    }

    /// The constant c [N s/m] of the force `-c r'` with which a contact begins; 0 where the force is
    /// continuous.
    #[must_use]
    pub fn onset_damping(&self) -> f64 {
        of_law!(self, law => law.onset_damping())
    }

    /// Whether the force of the opposite motion is the opposite one.
    pub(crate) fn is_odd(&self) -> bool {
        of_law!(self, law => ForceLaw::is_odd(law))
    }

    /// Whether the force may have no power series somewhere, at places that nothing tells beforehand.
    pub(crate) fn has_corners(&self) -> bool {
        of_law!(self, law => law.has_corners())
    }

    /// The magnitude of the displacement [m] beyond which the force is linear in it; `None` if it never is.
    #[must_use]
    pub fn linear_beyond(&self) -> Option<f64> {
        of_law!(self, law => law.linear_beyond())
    }

    /// Whether the slope of the force of a closed contact jumps somewhere.
    pub(crate) fn has_kinks(&self) -> bool {
        of_law!(self, law => law.has_kinks())
    }

    /// The displacements at which the present piece of the force ends: where the penetration comes to be
    /// less, and where more.
    pub(crate) fn kinks(&self) -> [Option<f64>; 2] {
        of_law!(self, law => law.kinks())
    }

    /// The law in the piece of its force that holds a displacement, continued smoothly beyond it.
    pub(crate) fn in_piece(&self, displacement: f64) -> Self {
        of_law!(self, law => law.in_piece(displacement).into())
    }

    /// The law in the piece beyond a kink of the present one.
    pub(crate) fn beyond_kink(&self, deeper: bool) -> Self {
        of_law!(self, law => law.beyond_kink(deeper).into())
    }
}

impl Law {
    /// The gap [m]; `None` for a spring, a preloaded stop and a stop with two different gaps.
    #[must_use]
    pub fn gap(&self) -> Option<f64> {
        let contacts = self.contacts();
        let gap = contacts.first()?.sign * contacts[0].level;
        (gap >= 0.0 && contacts.iter().all(|contact| contact.sign * contact.level == gap)).then_some(gap)
    }

    /// A constant of the law in its unit; `None` where it has none that can be varied.
    #[must_use]
    pub fn constant(&self, constant: LawConstant) -> Option<f64> {
        match constant {
            LawConstant::Gap => self.gap(),
            other => of_law!(self, law => law.constant(other)),
        }
    }

    /// The law with another value of a constant. The levels of contacts change with the gap alone.
    ///
    /// # Errors
    /// [`LawError`]: the law has no such constant, or it cannot have this value.
    pub fn with_constant(&self, constant: LawConstant, value: f64) -> Result<Self, LawError> {
        of_law!(self, law => law.with_constant(constant, value).map(Into::into))
    }

    /// The value of a constant, if the force is proportional to it.
    pub(crate) fn proportional_to(&self, constant: LawConstant) -> Option<f64> {
        of_law!(self, law => law.proportional_to(constant))
    }

    /// Derivative of the force of a pressing contact by a constant; the gap shifts its argument instead, see
    /// [`Law::level_by_gap`].
    pub(crate) fn by_constant(&self, constant: LawConstant, at: ForcePoint) -> f64 {
        of_law!(self, law => law.by_constant(constant, at))
    }

    /// Derivative of the level by the gap, of the contact that acts at a displacement.
    pub(crate) fn level_by_gap(&self, displacement: f64) -> f64 {
        let acts = |contact: &&Contact| contact.sign * (displacement - contact.level) > 0.0;
        self.contacts().iter().find(acts).map_or(0.0, |contact| contact.sign)
    }
}

impl Law {
    /// Whether the force depends on the speed with which the present contact began, so that a contact has to
    /// be followed from its beginning.
    #[must_use]
    pub fn remembers_impact(&self) -> bool {
        of_law!(self, law => law.remembers_impact())
    }

    /// The law in a contact that began with that speed [m/s]; as built, a law that remembers loses nothing.
    #[must_use]
    pub fn struck_at(&self, impact_speed: f64) -> Self {
        of_law!(self, law => ForceLaw::struck_at(law, impact_speed).into())
    }

    /// The speed of the impact that the law remembers [m/s]; infinite before the first, and of a law that
    /// remembers none.
    pub(crate) fn impact_speed(&self) -> f64 {
        of_law!(self, law => ForceLaw::impact_speed(law))
    }

    /// Whether the law knows how its contact began, if it needs to.
    pub(crate) fn is_struck(&self) -> bool {
        of_law!(self, law => ForceLaw::is_struck(law))
    }

    /// Derivative of the force of a pressing contact by the speed with which it began.
    pub(crate) fn by_impact_speed(&self, displacement: f64, velocity: f64) -> f64 {
        of_law!(self, law => ForceLaw::by_impact_speed(law, displacement, velocity))
    }
}
