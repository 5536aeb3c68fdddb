//! What to say of a structure that can drift, before its periodic solutions are looked for.

use hammerbeam_study::{Drift, Model, Study};

use crate::failure::Failure;

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
    drifts.iter().for_each(|drift| anstream::eprintln!("warning: {drift}"));
}

/// Warns of a range that reaches so far above all eigenfrequencies that rounding hides what it asks for.
pub fn warn_of_range(model: &Model, study: &Study) {
    let [_, high] = study.excitation.range_hz();
    if let Some(resolved) = model.resolved_hz().filter(|resolved| high > *resolved) {
        anstream::eprintln!(
            "warning: the range reaches {high:e} Hz, where a period is so short that rounding hides what the \
             structure does in it; solutions are known up to {resolved:.1e} Hz, a million times the highest \
             eigenfrequency: end the range there"
        );
    }
}
