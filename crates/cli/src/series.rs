//! A series of frequencies.

use hammerbeam_attractor::frequencies;

use crate::failure::Failure;

/// Frequencies from low to high; both ends belong to them.
///
/// * `step_hz`: a hundredth of the way if there is none.
/// * `first`: the option of the first frequency, with which ends that are the wrong way round are told.
pub fn series((from, to): (f64, f64), step_hz: Option<f64>, first: &str) -> Result<Vec<f64>, Failure> {
    if to < from {
        let message = format!("--to is {to} Hz, which is below {first}, {from} Hz");
        return Err(Failure::BadInput(message));
    }
    let step = step_hz.unwrap_or(((to - from) / 100.0).max(f64::MIN_POSITIVE));
    Ok(frequencies(from, to, step)?)
}
