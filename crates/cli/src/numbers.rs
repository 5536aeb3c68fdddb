//! Numbers of options, read with what is allowed.

use hammerbeam_signal::exponent::StraightPart;

/// A finite number of a kind.
fn bounded(text: &str, holds: impl Fn(f64) -> bool, allowed: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && holds(number) => Ok(number),
        _ => Err(allowed.to_owned()),
    }
}

pub fn number(text: &str) -> Result<f64, String> {
    bounded(text, |_| true, "must be a finite number")
}

pub fn positive_number(text: &str) -> Result<f64, String> {
    bounded(text, |number| number > 0.0, "must be a finite number, more than 0")
}

pub fn not_negative(text: &str) -> Result<f64, String> {
    bounded(text, |number| number >= 0.0, "must be a finite number, at least 0")
}

pub fn not_zero(text: &str) -> Result<f64, String> {
    bounded(text, |number| number != 0.0, "must be a finite number, not 0")
}

pub fn above_one(text: &str) -> Result<f64, String> {
    bounded(text, |number| number > 1.0, "must be a finite number, more than 1")
}

pub fn overlap(text: &str) -> Result<f64, String> {
    bounded(text, |number| (0.0..=0.95).contains(&number), "must be a number from 0 to 0.95")
}

pub fn part(text: &str) -> Result<f64, String> {
    bounded(text, |number| number > 0.0 && number <= 1.0, "must be a number of more than 0, at most 1")
}

/// Percent of a frequency to each side.
pub fn within(text: &str) -> Result<f64, String> {
    bounded(text, |number| number > 0.0 && number <= 50.0, "must be more than 0, at most 50 percent")
}

/// Two numbers of samples, or the word for the steepest mean period.
pub fn straight_part(text: &str) -> Result<StraightPart, String> {
    if text == "period" {
        return Ok(StraightPart::SteepestPeriod);
    }
    let numbers = text.split_once(':').and_then(|(from, to)| Some((from.parse().ok()?, to.parse().ok()?)));
    match numbers {
        Some((from, to)) if from < to => Ok(StraightPart::Given(from, to)),
        _ => Err("must be two numbers of samples, as in 40:150, or the word period".to_owned()),
    }
}
