//! Samples that are not numbers: an error, or interpolated linearly (constant at the ends) if permitted.

use crate::{
    error::RecordError,
    finding::{RecordFinding, Repairs},
    raw::RawChannel,
};

/// Interpolates missing samples of a channel, if permitted.
pub(super) fn fill(
    channel: &mut RawChannel,
    repairs: &Repairs,
    findings: &mut Vec<RecordFinding>,
) -> Result<(), RecordError> {
    let samples = &mut channel.samples;
    let count = samples.iter().filter(|value| !value.is_finite()).count();
    let Some(first) = samples.iter().position(|value| !value.is_finite()) else { return Ok(()) };
    if !repairs.missing || count == samples.len() {
        return Err(RecordError::Missing { channel: channel.name.clone(), count, of: samples.len(), first });
    }
    let mut at = first;
    while at < samples.len() {
        if samples[at].is_finite() {
            at += 1;
            continue;
        }
        let end = samples[at..].iter().position(|value| value.is_finite()).map_or(samples.len(), |n| at + n);
        let after = samples.get(end).copied();
        let before = at.checked_sub(1).map(|index| samples[index]);
        let (from, to) = match (before, after) {
            (Some(from), Some(to)) => (from, to),
            (Some(held), None) | (None, Some(held)) => (held, held),
            (None, None) => return Ok(()),
        };
        let steps = (end - at + 1) as f64;
        for (k, value) in samples[at..end].iter_mut().enumerate() {
            *value = from + (to - from) * (k + 1) as f64 / steps;
        }
        at = end;
    }
    findings.push(RecordFinding::MissingInterpolated { channel: channel.name.clone(), count, first });
    Ok(())
}
