//! What numbers may be: unit and plausible range of a quantity, and those that several laws have.
//!
//! The limits are wide: they are there to catch a wrong unit and a wrong sign, not to judge designs.

use Bound::{Excluding, Including, Open};

/// An end of a range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// No limit.
    Open,
    /// The limit itself is allowed.
    Including(f64),
    /// The limit itself is not allowed.
    Excluding(f64),
}

/// Unit and range of a quantity, with hints for numbers outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    unit: &'static str,
    from: Bound,
    to: Bound,
    too_low: &'static str,
    too_high: &'static str,
}

impl Quantity {
    /// A quantity in a unit, from one end of its range to the other.
    #[must_use]
    pub const fn new(unit: &'static str, from: Bound, to: Bound) -> Self {
        Self { unit, from, to, too_low: "", too_high: "" }
    }

    /// The same with a word about numbers that are too low or too high.
    #[must_use]
    pub const fn hints(mut self, too_low: &'static str, too_high: &'static str) -> Self {
        self.too_low = too_low;
        self.too_high = too_high;
        self
    }

    /// The unit; empty for a number without one.
    #[must_use]
    pub const fn unit(&self) -> &'static str {
        self.unit
    }

    /// The number with its unit.
    #[must_use]
    pub fn with_unit(&self, number: f64) -> String {
        let number = plain(number);
        if self.unit.is_empty() { number } else { format!("{number} {}", self.unit) }
    }

    /// What is allowed instead, if the number is not.
    #[must_use]
    pub fn fault(&self, number: f64) -> Option<Vec<String>> {
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
    #[must_use]
    pub fn allowed(&self) -> String {
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

/// Young's modulus.
pub const MODULUS: Quantity = Quantity::new("Pa", Including(1e6), Including(2e12)).hints(
    "is the unit Pa? such numbers look like GPa or MPa: 210 GPa is 2.1e11 Pa",
    "is the unit Pa? diamond has 1.2e12 Pa",
);
/// Poisson's ratio.
pub const POISSON: Quantity = Quantity::new("", Excluding(-1.0), Including(0.5));
/// Radius of a sphere in contact.
pub const RADIUS: Quantity =
    Quantity::new("m", Including(1e-9), Including(1e4)).hints("is the unit m?", "write \"flat\" for a plane");
/// Constant of a Hertz contact.
pub const HERTZ_STIFFNESS: Quantity = Quantity::new("N/m^1.5", Excluding(0.0), Including(1e24));
/// Stiffness of a linear spring.
pub const STIFFNESS: Quantity = Quantity::new("N/m", Excluding(0.0), Including(1e18)).hints(
    "a stiffness that pushes away from the middle is a [[stop]] of law \"cubic\" with a negative \
     `stiffness_n_m`",
    "",
);
/// Constant of a damper.
pub const DAMPER: Quantity = Quantity::new("N s/m", Including(0.0), Including(1e15));
/// Rest distance of a stop.
pub const GAP: Quantity = Quantity::new("m", Including(0.0), Including(1e6))
    .hints("a stop that presses on the structure at rest has a `preload_n` instead of a gap", "");
/// Force with which a stop presses at rest.
pub const PRELOAD: Quantity = Quantity::new("N", Including(0.0), Including(1e15));
/// Any finite number.
pub const ANY: Quantity = Quantity::new("", Open, Open);
