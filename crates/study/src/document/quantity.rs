//! What numbers may be: unit and plausible range of every quantity in a study but those of laws, which stand
//! with the laws.
//!
//! The limits are wide: they are there to catch a wrong unit (a Young's modulus of 210, a length in
//! millimetres) and a wrong sign, not to judge designs. They are listed in `docs/reference/study-file.md`.

pub use hammerbeam_motion::law::{
    Quantity,
    quantity::{ANY, Bound, DAMPER, GAP, HERTZ_STIFFNESS, MODULUS, POISSON, PRELOAD, RADIUS, STIFFNESS},
};

use Bound::{Excluding, Including, Open};

/// Length of a beam, largest extent of anything on it.
pub const LENGTH: Quantity = Quantity::new("m", Including(1e-7), Including(100.0))
    .hints("is the unit m?", "is the unit m? it looks like millimetres");
/// Width of a section.
pub const WIDTH: Quantity = Quantity::new("m", Including(1e-9), Including(10.0))
    .hints("is the unit m?", "is the unit m? it looks like millimetres");
/// Height of a section.
pub const HEIGHT: Quantity = WIDTH;
/// Area of a section.
pub const AREA: Quantity = Quantity::new("m^2", Including(1e-18), Including(100.0))
    .hints("is the unit m^2?", "is the unit m^2? it looks like mm^2");
/// Second moment of area of a section.
pub const SECOND_MOMENT: Quantity = Quantity::new("m^4", Including(1e-36), Including(1e3))
    .hints("is the unit m^4?", "is the unit m^4? it looks like mm^4");
/// Density.
pub const DENSITY: Quantity = Quantity::new("kg/m^3", Including(10.0), Including(25_000.0)).hints(
    "is the unit kg/m^3? such numbers look like g/cm^3: 7.8 g/cm^3 is 7800 kg/m^3",
    "is the unit kg/m^3? osmium has 22590 kg/m^3",
);
/// Position along a beam; the beam's own length bounds it further.
pub const POSITION: Quantity = Quantity::new("m", Including(0.0), Open);
/// What brings numbers of a file to SI units.
pub const FACTOR: Quantity = Quantity::new("", Excluding(0.0), Including(1e30));
/// Part of a direction in space.
pub const DIRECTION: Quantity = Quantity::new("", Including(-1e30), Including(1e30));
/// Memory for factors of matrices.
pub const MEMORY_GB: Quantity = Quantity::new("GB", Including(0.01), Including(1e5));
/// A mass that must be there.
pub const MASS: Quantity = Quantity::new("kg", Excluding(0.0), Including(1e12));
/// A mass added to a beam.
pub const ADDED_MASS: Quantity = Quantity::new("kg", Including(0.0), Including(1e9));
/// Mass per length added to a beam.
pub const ADDED_MASS_PER_LENGTH: Quantity = Quantity::new("kg/m", Including(0.0), Including(1e9));
/// Shear coefficient of a section.
pub const SHEAR_COEFFICIENT: Quantity = Quantity::new("", Including(0.01), Including(1.0))
    .hints("", "the part of the section that bears shear: 0.85 of a rectangle");
/// Rotary inertia added to a beam.
pub const ROTARY_INERTIA: Quantity = Quantity::new("kg m^2", Including(0.0), Including(1e9));
/// Stiffness of an added spring that may be absent.
pub const ADDED_STIFFNESS: Quantity = Quantity::new("N/m", Including(0.0), Including(1e18));
/// Stiffness of an added rotational spring.
pub const ROTATIONAL_STIFFNESS: Quantity = Quantity::new("N m/rad", Including(0.0), Including(1e18));
/// Constant of an added rotational damper.
pub const ROTATIONAL_DAMPER: Quantity = Quantity::new("N m s/rad", Including(0.0), Including(1e15));
/// Damping ratio of a mode.
pub const DAMPING_RATIO: Quantity = Quantity::new("", Including(0.0), Including(1.0))
    .hints("", "a ratio to critical damping, not a per cent: 1.5 % is 0.015");
/// Mass-proportional damping.
pub const RAYLEIGH_MASS: Quantity = Quantity::new("1/s", Including(0.0), Including(1e12));
/// Stiffness-proportional damping.
pub const RAYLEIGH_STIFFNESS: Quantity = Quantity::new("s", Including(0.0), Including(1e6));
/// Amplitude of a prescribed displacement.
pub const AMPLITUDE: Quantity = Quantity::new("m", Excluding(0.0), Including(1e6))
    .hints("a motion turned round is one with `phase_rad = 3.141592653589793`", "");
/// Amplitude of a prescribed acceleration.
pub const ACCELERATION: Quantity = Quantity::new("m/s^2", Excluding(0.0), Including(1e9))
    .hints("a motion turned round is one with `phase_rad = 3.141592653589793`", "");
/// Distance of an unbalance from its axis.
pub const ECCENTRICITY: Quantity = Quantity::new("m", Excluding(0.0), Including(100.0))
    .hints("", "is the unit m? it looks like millimetres");
/// Amplitude of a force.
pub const FORCE: Quantity = Quantity::new("N", Excluding(0.0), Including(1e15))
    .hints("a force turned round is one with `phase_rad = 3.141592653589793`", "");
/// Displacement or force of a load, either sign, since it may be constant.
pub const LOAD_DISPLACEMENT: Quantity = Quantity::new("m", Including(-1e6), Including(1e6));
/// Force of a load, either sign, since it may be constant.
pub const LOAD_FORCE: Quantity = Quantity::new("N", Including(-1e15), Including(1e15));
/// Acceleration of gravity, either sign.
pub const GRAVITY: Quantity = Quantity::new("m/s^2", Including(-1e6), Including(1e6));
/// Phase of a harmonic.
pub const PHASE: Quantity = Quantity::new("rad", Including(-100.0), Including(100.0))
    .hints("is the unit rad?", "is the unit rad? it looks like degrees");
/// Excitation frequency: its period and what follows from that are plain numbers.
pub const EXCITATION_FREQUENCY: Quantity = Quantity::new("Hz", Including(1e-10), Including(1e10));
/// Cut-off frequency, and whatever else has hertz.
pub const FREQUENCY: Quantity = Quantity::new("Hz", Excluding(0.0), Including(1e10));
/// Step along a branch.
pub const STEP: Quantity = Quantity::new("Hz", Excluding(0.0), Including(1e10));
/// Time that a run may take.
pub const TIME: Quantity = Quantity::new("s", Excluding(0.0), Including(1e10));
/// Standard deviation of the noise of a sensor, in its unit.
pub const NOISE: Quantity = Quantity::new("", Including(0.0), Including(1e9));
/// Tolerance of the solver.
pub const TOLERANCE: Quantity = Quantity::new("", Including(1e-13), Including(1e-4));
/// A standard deviation relative to its value.
pub const RELATIVE_DEVIATION: Quantity = Quantity::new("", Excluding(0.0), Including(10.0))
    .hints("a standard deviation is more than 0", "1 % is 0.01");
/// A measured damping ratio, or its standard deviation.
pub const MEASURED_RATIO: Quantity = Quantity::new("", Excluding(0.0), Excluding(1.0))
    .hints("a measured number is more than 0", "1 % is 0.01");
/// A maximum of a response, or its standard deviation, in the unit of its key.
pub const MAXIMUM: Quantity = Quantity::new("", Excluding(0.0), Open);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_modulus_of_210_is_refused_with_a_word_about_gigapascals() {
        let help = MODULUS.fault(210.0).unwrap().join("; ");
        assert_eq!(
            help,
            "allowed: 1e6 to 2e12 Pa; is the unit Pa? such numbers look like GPa or MPa: 210 GPa is 2.1e11 Pa"
        );
        assert_eq!(MODULUS.fault(2.1e11), None);
    }

    #[test]
    fn what_is_not_finite_is_refused_even_without_limits() {
        for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(POSITION.fault(number).is_some(), "{number} passed");
        }
    }

    #[test]
    fn excluded_limits_are_refused_and_included_ones_are_not() {
        assert!(MASS.fault(0.0).is_some());
        assert!(ADDED_MASS.fault(0.0).is_none());
        assert!(POISSON.fault(-1.0).is_some());
        assert!(POISSON.fault(0.5).is_none());
    }
}
