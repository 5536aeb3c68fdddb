//! What to say of a structure that can drift, or of a range without periodic solutions, before they are
//! looked for.

use hammerbeam_study::{Drift, Model, Study};

use crate::{failure::Failure, output::tell};

/// Warns of directions that only stops hold.
///
/// # Errors
/// [`Failure::BadInput`] if nothing holds a direction: then no periodic solution is isolated, and there is
/// nothing to follow.
pub fn heed(model: &Model) -> Result<(), Failure> {
    let drifts = model.drifts();
    if let Some(drift) = drifts.iter().find(|drift| !drift.held_by_stops) {
        return Err(Failure::BadInput(format!(
            "{drift}: none of them is isolated, so none can be found or followed; allowed: a structure with a spring or a stop that acts on this motion"
        )));
    }
    warn(&drifts);
    Ok(())
}

/// Tells every direction on standard error.
pub fn warn(drifts: &[Drift]) {
    drifts.iter().for_each(|drift| tell(&format!("warning: {drift}")));
}

/// Refuses a range that reaches so far above all eigenfrequencies that rounding hides what it asks for.
///
/// # Errors
/// [`Failure::BadInput`] with the highest frequency that may be asked for.
pub fn heed_range(model: &Model, study: &Study) -> Result<(), Failure> {
    let [_, high] = study.excitation.range_hz();
    match model.resolved_hz().filter(|resolved| high > *resolved) {
        Some(resolved) => Err(Failure::BadInput(format!(
            "`frequency_hz` of the excitation reaches {high:e} Hz, where a period is so short that rounding \
             hides what the structure does in it; allowed: up to {resolved:.3e} Hz, ten million times the \
             highest eigenfrequency"
        ))),
        None => Ok(()),
    }
}
