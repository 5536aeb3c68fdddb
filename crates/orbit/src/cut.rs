//! Where an orbit may start: at a phase at which no contact of an impact-speed-dependent law is closed, and
//! off the impacts on rigid stops, at which the state jumps.
//!
//! Contacts are read off a [`trace`](hammerbeam_motion::exact::ExactIntegrator::trace) of the motion. Each
//! lasts until its penetration has ended: no motion can start in what is left of it when the force has
//! vanished. An orbit starts at phase 0. Where a contact is closed there or within [`MARGIN`] of it, it
//! starts in the middle of the longest time without contact. Phases are multiples of `1/GRID` of a cycle, in
//! short flights of `1/FINE_GRID`, so that whole cycles can be added to them without rounding: a motion that
//! is followed cycle by cycle then goes on within its contacts. Without such laws the phase is 0. A rigid
//! stop may hold the structure at the start, and all the time.

use hammerbeam_motion::{
    Law, Stretch, System,
    exact::{ContactPiece, ExactIntegrator, MotionError},
};

use crate::OrbitError;

/// Phases of a cycle at which an orbit may start.
const GRID: f64 = 1024.0;
/// The same in a time without contact that is shorter than [`SHORTEST`].
const FINE_GRID: f64 = 1_073_741_824.0;
/// A contact this near [cycles] moves the phase,
pub(crate) const MARGIN: f64 = 1.0 / 32.0;
/// or a smaller part of the longest time without contact.
const PART: f64 = 1.0 / 8.0;
/// Shortest time without contact in which an orbit starts where it is looked for first [cycles].
const SHORTEST: f64 = 4.0 / GRID;

/// A state at a phase at which an orbit may start.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PermittedStart {
    /// From 0 to 1 [cycles].
    pub phase: f64,
    pub state: Vec<f64>,
}

impl PermittedStart {
    /// Phase and state.
    pub fn at(&self) -> (f64, &[f64]) {
        (self.phase, &self.state)
    }
}

/// A time without contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gap {
    pub start: f64,
    pub end: f64,
}

impl Gap {
    pub fn length(self) -> f64 {
        self.end - self.start
    }

    /// The same so much later.
    pub fn later(self, by: f64) -> Self {
        Self { start: self.start + by, end: self.end + by }
    }

    /// Its middle after the phase `from`, which is one of a grid, so that the phase there is one, too.
    pub fn middle(self, from: f64) -> f64 {
        let grid = if self.is_short() { FINE_GRID } else { GRID };
        ((from + 0.5 * (self.start + self.end)) * grid).round() / grid - from
    }

    /// Whether it is shorter than what an orbit starts in where it is looked for first.
    pub fn is_short(self) -> bool {
        self.length() < SHORTEST
    }

    /// Whether an orbit that starts so near a contact had better start in the middle of the gap.
    pub fn asks_to_move(self, nearest: f64) -> bool {
        nearest < MARGIN.min(PART * self.length())
    }
}

/// Whether the state of an orbit is incomplete, or jumps, at contacts of this law.
fn keeps_away(law: &Law) -> bool {
    law.remembers_impact() || law.rigid().is_some()
}

/// Whether the fundamental matrix over a segment jumps where a contact of this law passes over its end.
fn jumps(law: &Law) -> bool {
    keeps_away(law) || law.onset_damping() > 0.0
}

/// How much later the segments of an orbit of `cycles` should start, to keep their ends away from contacts at
/// which fundamental matrices jump; `None` where they are clear of them, or cannot be. The segments are
/// `length` cycles long, and the first one starts at `phase` with `state`. Contacts that only jump at their
/// ends may be closed there.
///
/// # Errors
/// [`MotionError`] where the orbit cannot be followed.
pub(crate) fn offset_to_clear(
    integrator: &mut ExactIntegrator,
    (phase, cycles, length): (f64, f64, f64),
    state: &[f64],
    frequency_hz: f64,
) -> Result<Option<f64>, MotionError> {
    if !integrator.system().elements().iter().any(|element| jumps(&element.law)) {
        return Ok(None);
    }
    let stretch = Stretch { frequency_hz, start: phase, end: phase + cycles };
    let trace = integrator.trace(&stretch, state, &[])?;
    let elements = integrator.system().elements();
    let mut times = Vec::new();
    for contact in trace.contacts.iter().filter(|contact| jumps(&elements[contact.element].law)) {
        let start = contact.begin.as_ref().map(|touch| touch.time * frequency_hz);
        let end = contact.end.map(|end| end * frequency_hz);
        let clear = contact.clear.map(|clear| clear * frequency_hz);
        if keeps_away(&elements[contact.element].law) {
            times.push(Gap { start: start.unwrap_or(0.0), end: clear.unwrap_or(cycles) });
        } else {
            times.extend([start, end].into_iter().flatten().map(|at| Gap { start: at, end: at }));
        }
    }
    let folded = folded(&times, length);
    let Some((gap, nearest)) = longest_of_orbit(&folded, length, false) else { return Ok(None) };
    let offset = (0.5 * (gap.start + gap.end)).rem_euclid(length);
    Ok((gap.asks_to_move(nearest) && offset > 0.0).then_some(offset))
}

/// Times since the start of the segment in which they start, in their order; what goes on beyond its end
/// belongs to the next one, too.
pub(crate) fn folded(times: &[Gap], length: f64) -> Vec<Gap> {
    let mut folded = Vec::new();
    for time in times {
        let start = time.start.rem_euclid(length);
        let end = start + time.length();
        folded.push(Gap { start, end: end.min(length) });
        if end > length {
            folded.push(Gap { start: 0.0, end: (end - length).min(length) });
        }
    }
    folded.sort_by(|a, b| a.start.total_cmp(&b.start));
    folded
}

/// Whether orbits of a system have to start away from its contacts.
pub(crate) fn must_start_off_contacts(system: &System) -> bool {
    system.elements().iter().any(|element| keeps_away(&element.law))
}

/// Times of contacts away from which an orbit has to start, in cycles since the phase `start`, in their
/// order, over `cycles` of the motion.
pub(crate) fn contacts(
    integrator: &mut ExactIntegrator,
    (start, cycles): (f64, f64),
    state: &[f64],
    frequency_hz: f64,
) -> Result<Vec<Gap>, MotionError> {
    let stretch = Stretch { frequency_hz, start, end: start + cycles };
    let trace = integrator.trace(&stretch, state, &[])?;
    Ok(closed_times(integrator, &trace.contacts, (frequency_hz, cycles)))
}

fn closed_times(
    integrator: &ExactIntegrator,
    contacts: &[ContactPiece],
    (frequency_hz, cycles): (f64, f64),
) -> Vec<Gap> {
    let elements = integrator.system().elements();
    let of_law = contacts.iter().filter(|contact| keeps_away(&elements[contact.element].law));
    let mut times: Vec<Gap> = of_law
        .map(|contact| Gap {
            start: contact.since() * frequency_hz,
            end: contact.clear.map_or(cycles, |clear| clear * frequency_hz),
        })
        .collect();
    times.sort_by(|a, b| a.start.total_cmp(&b.start));
    times
}

/// Number of the element that is in contact longest without a break, over a motion of that duration [s].
fn longest_contact(contacts: &[ContactPiece], duration: f64) -> usize {
    let length = |contact: &ContactPiece| contact.clear.unwrap_or(duration) - contact.since();
    let longest = contacts.iter().max_by(|a, b| length(a).total_cmp(&length(b)));
    longest.map_or(0, |contact| contact.element)
}

/// The longest time between contacts within `from..to`.
fn longest_gap(contacts: &[Gap], (from, to): (f64, f64)) -> Gap {
    let (mut longest, mut reached) = (Gap { start: from, end: from }, from);
    let end = Gap { start: to, end: to };
    for contact in contacts.iter().chain([&end]) {
        if contact.start - reached > longest.length() {
            longest = Gap { start: reached, end: contact.start };
        }
        reached = reached.max(contact.end);
    }
    longest
}

/// The longest time without contact of an orbit of that many cycles that starts in flight; it may go on
/// beyond the end of the orbit. The second number is the time from the start to the nearest contact, before
/// or behind.
///
/// * `avoids_start`: the start counts as a contact.
pub(crate) fn longest_of_orbit(contacts: &[Gap], cycles: f64, avoids_start: bool) -> Option<(Gap, f64)> {
    let first = contacts.first()?.start;
    let last = contacts.iter().map(|contact| contact.end).fold(0.0, f64::max);
    let nearest = first.min(cycles - last).max(0.0);
    if avoids_start {
        return Some((longest_gap(contacts, (0.0, cycles)), nearest));
    }
    Some((longest_gap(contacts, (first, cycles + first)), nearest))
}

/// Where an orbit of some periods may start near the motion from `state` at phase 0, which the integrator has
/// followed up to there; and, where the motion was looked at, the state at a later phase 0, from which it can
/// be followed on.
///
/// # Errors
/// [`OrbitError::NeverOpens`], [`OrbitError::Motion`].
pub(crate) fn search_cut(
    integrator: &mut ExactIntegrator,
    state: &[f64],
    (frequency_hz, period_multiple): (f64, u32),
) -> Result<(PermittedStart, Option<Vec<f64>>), OrbitError> {
    let at_zero = || PermittedStart { phase: 0.0, state: state.to_vec() };
    if !must_start_off_contacts(integrator.system()) {
        return Ok((at_zero(), None));
    }
    let cycles = f64::from(period_multiple + 1);
    let phases: Vec<f64> = (0..=(cycles * GRID) as u32).map(|k| f64::from(k) / GRID).collect();
    let stretch = Stretch { frequency_hz, start: 0.0, end: cycles };
    let trace = integrator.trace(&stretch, state, &phases)?;
    let mut contacts = closed_times(integrator, &trace.contacts, (frequency_hz, cycles));
    // Of a contact that has parted before, and is still penetrated, the trace has no piece: up to the next
    // one of its element nothing is known to be flight.
    for element in integrator.system().remembered_contacts(frequency_hz, 0.0, state) {
        let next = trace.contacts.iter().find(|contact| contact.element == element);
        let end = next.map_or(cycles, |next| next.since() * frequency_hz);
        contacts.push(Gap { start: 0.0, end });
    }
    contacts.sort_by(|a, b| a.start.total_cmp(&b.start));
    let gap = longest_gap(&contacts, (0.0, cycles));
    if gap.is_short() && !integrator.system().remembers_impacts() {
        return Ok((at_zero(), None));
    }
    if gap.is_short() {
        let element = longest_contact(&trace.contacts, cycles / frequency_hz);
        let element = integrator.system().elements()[element].name.clone();
        return Err(OrbitError::NeverOpens { element, frequency_hz });
    }
    // Phase 0 after one cycle, where what comes before is known, too.
    let distance = |contact: &Gap| (contact.start - 1.0).max(1.0 - contact.end).max(0.0);
    let nearest = contacts.iter().map(distance).fold(f64::INFINITY, f64::min);
    let at = if gap.asks_to_move(nearest) { gap.middle(0.0) } else { 1.0 };
    let state = trace.samples[(at * GRID) as usize].clone();
    Ok((PermittedStart { phase: at.fract(), state }, Some(trace.state)))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

    use hammerbeam_motion::{
        exact::ExactSettings,
        law::{HertzStop, RestitutionModel, RestitutionStop},
    };

    use super::*;
    use crate::test_oscillator::oscillator;

    const GAP: f64 = 0.1;

    /// `x'' + 0.1 x' + x = 0.4 cos(2 pi f t)` with a stop after Flores that gives back little.
    fn integrator_of_a_bouncing_mass() -> ExactIntegrator {
        let elastic = HertzStop::with_gap(1e3, GAP).unwrap();
        let law = Law::Restitution(RestitutionStop::new(elastic, RestitutionModel::Flores, 0.3).unwrap());
        let (system, _) = oscillator(0.1, 0.4, law);
        ExactIntegrator::new(system, ExactSettings::default()).unwrap()
    }

    /// Behind the end of its force, too: no orbit can start in what is left of it.
    #[test]
    fn a_contact_lasts_until_its_penetration_ends() {
        let (mut integrator, frequency_hz, state) = (integrator_of_a_bouncing_mass(), 0.15, [0.0, 0.5]);
        let stretch = |cycles| Stretch { frequency_hz, start: 0.0, end: cycles };
        let trace = integrator.trace(&stretch(3.0), &state, &[]).unwrap();
        let times = contacts(&mut integrator, (0.0, 3.0), &state, frequency_hz).unwrap();
        let pieces = trace.contacts.iter().filter(|piece| piece.clear.is_some());
        let mut parted = 0;
        for (piece, time) in pieces.zip(&times) {
            let at = integrator.advance(&stretch(time.end), &state).unwrap()[0];
            assert!((at - GAP).abs() < 1e-9, "{at} m at {time:?}");
            parted += u32::from(time.end > piece.end.unwrap() * frequency_hz + 1e-4);
        }
        assert!(parted > 1, "{parted} contacts part before they end");
    }

    const CONTACTS: [Gap; 2] = [Gap { start: 0.25, end: 0.5 }, Gap { start: 0.625, end: 0.75 }];

    #[test]
    fn the_longest_gap_of_an_orbit_may_lie_across_its_end() {
        let across = Gap { start: 0.75, end: 1.25 };
        assert_eq!(longest_of_orbit(&CONTACTS, 1.0, false), Some((across, 0.25)));
        // From the phase 3/8 its middle is the phase 11/8, one cycle after 3/8.
        assert_eq!(across.middle(0.375), 1.0);
        let before = Gap { start: 0.0, end: 0.25 };
        assert_eq!(longest_of_orbit(&CONTACTS, 1.0, true), Some((before, 0.25)));
        assert_eq!(longest_of_orbit(&[], 1.0, false), None);
    }

    #[test]
    fn times_of_all_segments_are_folded_onto_one() {
        let times = [Gap { start: 0.25, end: 0.375 }, Gap { start: 0.875, end: 1.25 }];
        let expected =
            [Gap { start: 0.0, end: 0.25 }, Gap { start: 0.25, end: 0.375 }, Gap { start: 0.375, end: 0.5 }];
        assert_eq!(folded(&times, 0.5), expected);
    }

    /// In a flight shorter than a step of the coarse grid, too, at a phase to which cycles can be added
    /// without rounding.
    #[test]
    fn the_middle_of_a_short_gap_is_in_the_gap() {
        let gap = Gap { start: 0.300_010, end: 0.300_012 };
        let (from, phase) = (0.671_875, 0.671_875 + gap.middle(0.671_875));
        assert!(gap.start < phase - from && phase - from < gap.end, "{phase}");
        assert_eq!(phase + 1e6 - 1e6, phase);
    }

    /// Overlapping contacts of two stops leave only what both leave.
    #[test]
    fn a_gap_is_free_of_all_contacts() {
        let both = [Gap { start: 0.1, end: 0.6 }, Gap { start: 0.2, end: 0.3 }, Gap { start: 0.9, end: 1.0 }];
        assert_eq!(longest_gap(&both, (0.0, 1.0)), Gap { start: 0.6, end: 0.9 });
        assert_eq!(longest_gap(&[Gap { start: 0.0, end: 1.0 }], (0.0, 1.0)).length(), 0.0);
    }
}
