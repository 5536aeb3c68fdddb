//! Where the mirror image of a stored branch is.

use hammerbeam_orbit::{PeriodicSolution, mirror_image, states_at_phase};
use hammerbeam_results::StoreError;
use hammerbeam_study::Model;

use super::{
    StoredBranch, StoredBranches,
    images::{MirrorImage, Placed, holder, integrator},
};

impl StoredBranches {
    /// Where the mirror image of a branch is; `None` of a system without symmetry, and of a branch whose
    /// motion cannot be computed.
    ///
    /// The image is that of an orbit at a third of the branch. A closed branch of asymmetric orbits that
    /// starts where it leaves symmetric ones meets them again in its middle, and these are their own images.
    ///
    /// # Errors
    /// The store refuses.
    pub fn mirror_image_of(
        &self,
        model: &Model,
        branch: &StoredBranch,
    ) -> Result<Option<MirrorImage>, StoreError> {
        let third = branch.rows.len().div_ceil(3).min(branch.rows.len().saturating_sub(1));
        let Some(asked) = branch.rows.get(third).filter(|_| model.system.is_symmetric()) else {
            return Ok(None);
        };
        let beside = &branch.rows[third.saturating_sub(1)];
        let frequency_hz = 0.5 * (asked.row.frequency_hz + beside.row.frequency_hz);
        let multiple = branch.record.period_multiple;
        let stored =
            self.stored_crossings(model, frequency_hz, |record| record.period_multiple == multiple)?;
        let Some(mut integrator) = integrator(model) else { return Ok(None) };
        let mut states =
            |orbit: &PeriodicSolution| states_at_phase(&mut integrator, orbit, 0.0).unwrap_or_default();
        let placed: Vec<Placed> =
            stored.iter().map(|(branch, orbit)| Placed { branch: *branch, states: states(orbit) }).collect();
        let own = stored.iter().find(|(id, _)| *id == branch.record.id);
        let image = own.map(|(_, orbit)| states(&mirror_image(orbit))).filter(|states| !states.is_empty());
        Ok(image.map(|image| match holder(&placed, &image, model, frequency_hz) {
            Some(id) if id == branch.record.id => MirrorImage::Itself,
            Some(id) => MirrorImage::Branch(id),
            None => MirrorImage::Given,
        }))
    }
}
