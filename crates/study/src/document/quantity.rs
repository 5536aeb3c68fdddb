//! What numbers may be: unit and plausible range of every quantity in a study.
//!
//! The limits are wide: they are there to catch a wrong unit (a Young's modulus of 210, a length in
//! millimetres) and a wrong sign, not to judge designs. They are listed in `docs/study-file.md`.

/// An end of a range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Bound {
    /// No limit.
    Open,
    /// The limit itself is allowed.
    Including(f64),
    /// The limit itself is not allowed.
    Excluding(f64),
}

/// Unit and range of a quantity, with hints for numbers outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quantity {
    unit: &'static str,
    from: Bound,
    to: Bound,
    too_low: &'static str,
    too_high: &'static str,
}

use Bound::{Excluding, Including, Open};

impl Quantity {
    const fn new(unit: &'static str, from: Bound, to: Bound) -> Self {
        Self { unit, from, to, too_low: "", too_high: "" }
    }

    const fn hints(mut self, too_low: &'static str, too_high: &'static str) -> Self {
        self.too_low = too_low;
        self.too_high = too_high;
        self
    }

    /// The number with its unit.
    pub(crate) fn with_unit(&self, number: f64) -> String {
        let number = plain(number);
        if self.unit.is_empty() { number } else { format!("{number} {}", self.unit) }
    }

    /// What is allowed instead, if the number is not.
    pub(crate) fn fault(&self, number: f64) -> Option<Vec<String>> {
        let hint = if !number.is_finite() {
            "numbers must be finite"
        } else if !above(self.from, number) {
            self.too_low
        } else if !below(self.to, number) {
            self.too_high
        } else {
            return None;
        };
        let mut help = vec![format!("allowed: {}", self.allowed())];
        if !hint.is_empty() {
            help.push(hint.to_owned());
        }
        Some(help)
    }

    /// The range in words.
    pub(crate) fn allowed(&self) -> String {
        let words = match (self.from, self.to) {
            (Open, Open) => "any finite number".to_owned(),
            (Excluding(low), Open) => format!("more than {}", plain(low)),
            (Including(low), Open) => format!("{} or more", plain(low)),
            (Open, Excluding(high)) => format!("less than {}", plain(high)),
            (Open, Including(high)) => format!("{} or less", plain(high)),
            (Including(low), Including(high)) => format!("{} to {}", plain(low), plain(high)),
            (Including(low), Excluding(high)) => format!("from {} to less than {}", plain(low), plain(high)),
            (Excluding(low), Including(high)) => format!("more than {} to {}", plain(low), plain(high)),
            (Excluding(low), Excluding(high)) => {
                format!("more than {} to less than {}", plain(low), plain(high))
            }
        };
        if self.unit.is_empty() { words } else { format!("{words} {}", self.unit) }
    }
}

fn above(bound: Bound, number: f64) -> bool {
    match bound {
        Open => true,
        Including(low) => number >= low,
        Excluding(low) => number > low,
    }
}

fn below(bound: Bound, number: f64) -> bool {
    match bound {
        Open => true,
        Including(high) => number <= high,
        Excluding(high) => number < high,
    }
}

/// A number as a person would write it: no exponent for ordinary magnitudes.
fn plain(number: f64) -> String {
    let magnitude = number.abs();
    if number == 0.0 || (1e-4..1e6).contains(&magnitude) || !number.is_finite() {
        format!("{number}")
    } else {
        format!("{number:e}")
    }
}

/// Length of a beam, largest extent of anything on it.
pub(crate) const LENGTH: Quantity = Quantity::new("m", Including(1e-7), Including(100.0))
    .hints("is the unit m?", "is the unit m? it looks like millimetres");
/// Width of a section.
pub(crate) const WIDTH: Quantity = Quantity::new("m", Including(1e-9), Including(10.0))
    .hints("is the unit m?", "is the unit m? it looks like millimetres");
/// Height of a section.
pub(crate) const HEIGHT: Quantity = WIDTH;
/// Area of a section.
pub(crate) const AREA: Quantity = Quantity::new("m^2", Including(1e-18), Including(100.0))
    .hints("is the unit m^2?", "is the unit m^2? it looks like mm^2");
/// Second moment of area of a section.
pub(crate) const SECOND_MOMENT: Quantity = Quantity::new("m^4", Including(1e-36), Including(1e3))
    .hints("is the unit m^4?", "is the unit m^4? it looks like mm^4");
/// Young's modulus.
pub(crate) const MODULUS: Quantity = Quantity::new("Pa", Including(1e6), Including(2e12)).hints(
    "is the unit Pa? such numbers look like GPa or MPa: 210 GPa is 2.1e11 Pa",
    "is the unit Pa? diamond has 1.2e12 Pa",
);
/// Density.
pub(crate) const DENSITY: Quantity = Quantity::new("kg/m^3", Including(10.0), Including(25_000.0)).hints(
    "is the unit kg/m^3? such numbers look like g/cm^3: 7.8 g/cm^3 is 7800 kg/m^3",
    "is the unit kg/m^3? osmium has 22590 kg/m^3",
);
/// Poisson's ratio.
pub(crate) const POISSON: Quantity = Quantity::new("", Excluding(-1.0), Including(0.5));
/// Radius of a sphere in contact.
pub(crate) const RADIUS: Quantity =
    Quantity::new("m", Including(1e-9), Including(1e4)).hints("is the unit m?", "write \"flat\" for a plane");
/// Position along a beam; the beam's own length bounds it further.
pub(crate) const POSITION: Quantity = Quantity::new("m", Including(0.0), Open);
/// What brings numbers of a file to SI units.
pub(crate) const FACTOR: Quantity = Quantity::new("", Excluding(0.0), Including(1e30));
/// Part of a direction in space.
pub(crate) const DIRECTION: Quantity = Quantity::new("", Including(-1e30), Including(1e30));
/// Memory for factors of matrices.
pub(crate) const MEMORY_GB: Quantity = Quantity::new("GB", Including(0.01), Including(1e5));
/// A mass that must be there.
pub(crate) const MASS: Quantity = Quantity::new("kg", Excluding(0.0), Including(1e12));
/// A mass added to a beam.
pub(crate) const ADDED_MASS: Quantity = Quantity::new("kg", Including(0.0), Including(1e9));
/// Rotary inertia added to a beam.
pub(crate) const ROTARY_INERTIA: Quantity = Quantity::new("kg m^2", Including(0.0), Including(1e9));
/// Stiffness of a linear spring.
pub(crate) const STIFFNESS: Quantity = Quantity::new("N/m", Excluding(0.0), Including(1e18)).hints(
    "a stiffness that pushes away from the middle is a [[stop]] of law \"cubic\" with a negative \
     `stiffness_n_m`",
    "",
);
/// Stiffness of an added spring that may be absent.
pub(crate) const ADDED_STIFFNESS: Quantity = Quantity::new("N/m", Including(0.0), Including(1e18));
/// Constant of a damper.
pub(crate) const DAMPER: Quantity = Quantity::new("N s/m", Including(0.0), Including(1e15));
/// Stiffness of an added rotational spring.
pub(crate) const ROTATIONAL_STIFFNESS: Quantity = Quantity::new("N m/rad", Including(0.0), Including(1e18));
/// Constant of an added rotational damper.
pub(crate) const ROTATIONAL_DAMPER: Quantity = Quantity::new("N m s/rad", Including(0.0), Including(1e15));
/// Constant of a Hertz contact.
pub(crate) const HERTZ_STIFFNESS: Quantity = Quantity::new("N/m^1.5", Excluding(0.0), Including(1e24));
/// Loss of a contact after Hunt and Crossley.
pub(crate) const LOSS: Quantity = Quantity::new("s/m", Including(0.0), Including(1e6));
/// Coefficient of restitution.
pub(crate) const RESTITUTION: Quantity = Quantity::new("", Excluding(0.0), Including(1.0));
/// Coefficient of restitution of a rigid stop.
pub(crate) const RIGID_RESTITUTION: Quantity = Quantity::new("", Including(0.0), Including(1.0));
/// Stiffness of the linear term of a spring that may push away from the middle.
pub(crate) const SIGNED_STIFFNESS: Quantity = Quantity::new("N/m", Including(-1e18), Including(1e18));
/// Constant of a quadratic spring, either sign.
pub(crate) const QUADRATIC_STIFFNESS: Quantity = Quantity::new("N/m^2", Including(-1e24), Including(1e24));
/// Constant of a cubic spring, either sign.
pub(crate) const CUBIC_STIFFNESS: Quantity = Quantity::new("N/m^3", Including(-1e30), Including(1e30));
/// Rest distance of a stop.
pub(crate) const GAP: Quantity = Quantity::new("m", Including(0.0), Including(1e6))
    .hints("a stop that presses on the structure at rest has a `preload_n` instead of a gap", "");
/// Force with which a stop presses at rest.
pub(crate) const PRELOAD: Quantity = Quantity::new("N", Including(0.0), Including(1e15));
/// Damping ratio of a mode.
pub(crate) const DAMPING_RATIO: Quantity = Quantity::new("", Including(0.0), Including(1.0))
    .hints("", "a ratio to critical damping, not a per cent: 1.5 % is 0.015");
/// Mass-proportional damping.
pub(crate) const RAYLEIGH_MASS: Quantity = Quantity::new("1/s", Including(0.0), Including(1e12));
/// Stiffness-proportional damping.
pub(crate) const RAYLEIGH_STIFFNESS: Quantity = Quantity::new("s", Including(0.0), Including(1e6));
/// Amplitude of a prescribed displacement.
pub(crate) const AMPLITUDE: Quantity = Quantity::new("m", Excluding(0.0), Including(1e6))
    .hints("a motion turned round is one with `phase_rad = 3.141592653589793`", "");
/// Amplitude of a force.
pub(crate) const FORCE: Quantity = Quantity::new("N", Excluding(0.0), Including(1e15))
    .hints("a force turned round is one with `phase_rad = 3.141592653589793`", "");
/// Displacement or force of a load, either sign, since it may be constant.
pub(crate) const LOAD_DISPLACEMENT: Quantity = Quantity::new("m", Including(-1e6), Including(1e6));
/// Force of a load, either sign, since it may be constant.
pub(crate) const LOAD_FORCE: Quantity = Quantity::new("N", Including(-1e15), Including(1e15));
/// Acceleration of gravity, either sign.
pub(crate) const GRAVITY: Quantity = Quantity::new("m/s^2", Including(-1e6), Including(1e6));
/// Phase of a harmonic.
pub(crate) const PHASE: Quantity = Quantity::new("rad", Including(-100.0), Including(100.0))
    .hints("is the unit rad?", "is the unit rad? it looks like degrees");
/// Excitation frequency: its period and what follows from that are plain numbers.
pub(crate) const EXCITATION_FREQUENCY: Quantity = Quantity::new("Hz", Including(1e-10), Including(1e10));
/// Cut-off frequency, and whatever else has hertz.
pub(crate) const FREQUENCY: Quantity = Quantity::new("Hz", Excluding(0.0), Including(1e10));
/// Step along a branch.
pub(crate) const STEP: Quantity = Quantity::new("Hz", Excluding(0.0), Including(1e10));
/// Time that a run may take.
pub(crate) const TIME: Quantity = Quantity::new("s", Excluding(0.0), Including(1e10));
/// Standard deviation of the noise of a sensor, in its unit.
pub(crate) const NOISE: Quantity = Quantity::new("", Including(0.0), Including(1e9));
/// Tolerance of the solver.
pub(crate) const TOLERANCE: Quantity = Quantity::new("", Including(1e-13), Including(1e-4));
/// Any finite number.
pub(crate) const ANY: Quantity = Quantity::new("", Open, Open);
/// A standard deviation relative to its value.
pub(crate) const RELATIVE_DEVIATION: Quantity = Quantity::new("", Excluding(0.0), Including(10.0))
    .hints("a standard deviation is more than 0", "1 % is 0.01");
/// A measured damping ratio, or its standard deviation.
pub(crate) const MEASURED_RATIO: Quantity = Quantity::new("", Excluding(0.0), Excluding(1.0))
    .hints("a measured number is more than 0", "1 % is 0.01");
/// A maximum of a response, or its standard deviation, in the unit of its key.
pub(crate) const MAXIMUM: Quantity = Quantity::new("", Excluding(0.0), Open);

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
