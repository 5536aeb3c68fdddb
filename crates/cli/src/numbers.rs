//! Numbers of options, read with what is allowed.

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
    bounded(text, |number| (0.0..=50.0).contains(&number), "must be from 0 to 50 percent")
}

pub fn range(text: &str) -> Result<(usize, usize), String> {
    let numbers = text.split_once(':').and_then(|(from, to)| Some((from.parse().ok()?, to.parse().ok()?)));
    numbers
        .filter(|(from, to)| from < to)
        .ok_or_else(|| "must be two numbers of samples, as in 40:150".to_owned())
}
