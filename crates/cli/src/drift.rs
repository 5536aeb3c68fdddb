//! What to say of a structure that can drift, before its periodic solutions are looked for.

use hammerbeam_study::{Drift, Model};

use crate::failure::Failure;

/// Warns of directions that only stops hold.
///
/// # Errors
/// [`Failure::BadInput`] if nothing holds a direction: then no periodic solution is isolated, and there is nothing to follow.
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
