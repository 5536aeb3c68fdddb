//! What a step with forces aims for: an event, or a length.
//!
//! **Events at once.** Where contacts open or close in the same instant, as those of two stops of one level
//! on one mass do, the polynomials of a step that ends with one of them may find the other a moment earlier,
//! and the other way round. Each is then located by the motion itself, and the earlier one is taken; the
//! other follows at once or within the slack of the next step.
//!
//! So the polynomials are contradicted by a location, and may be so for two reasons alone. What they find
//! lies so near the end of the step that location and rounding do not tell them apart. Or it lies before
//! that, and the location that went out from there ended later: there is no zero, but a distance that comes
//! near to it. A location that went out from elsewhere says nothing of an earlier zero, and is made anew from
//! there, once for each such place, so that it comes to an end. All events that were located for the step are
//! remembered: of three that contradict one another in a circle the third would else send the step back to
//! the first. And only these are excused: others are looked for in the whole of the step.

use super::event::Event;

/// Part of a step within which two ends are one.
pub(super) const SAME: f64 = 1e-9;

/// A step about to be tried.
#[derive(Debug, Clone)]
pub(super) struct Aim {
    pub(super) length: f64,
    pub(super) event: Option<Event>,
    /// Length to fall back to if the event does not come [s].
    pub(super) otherwise: f64,
    /// The events that were located before, each once: the polynomials of the steps that end with them had
    /// another one come earlier.
    rivals: Vec<Rival>,
    /// Whether it was looked for an opening at the end of the step (`brief_opening.rs`).
    pub(super) settled: bool,
}

/// An event that was located.
#[derive(Debug, Clone, Copy)]
struct Rival {
    event: Event,
    /// From where Newton's method went out [s].
    sought: f64,
    /// Where it ended [s].
    located: f64,
}

impl Aim {
    /// As far as the length, whatever comes.
    pub(super) fn free(length: f64) -> Self {
        Self { length, event: None, otherwise: 0.0, rivals: Vec::new(), settled: false }
    }

    pub(super) fn to(event: Event, length: f64) -> Self {
        Self { event: Some(event), otherwise: 0.5 * length, ..Self::free(length) }
    }

    /// To an event, or as far as another length if it does not come.
    pub(super) fn to_or(event: Event, length: f64, otherwise: f64) -> Self {
        Self { otherwise, ..Self::to(event, length) }
    }

    /// To an opening just before the end of a step of the length `otherwise`, which is taken if there is
    /// none.
    pub(super) fn to_opening(event: Event, length: f64, otherwise: f64) -> Self {
        Self { settled: true, ..Self::to_or(event, length, otherwise) }
    }

    /// As far as the length for want of the event; the end of that step was looked at if it was to be taken
    /// instead.
    pub(super) fn without_event(&self, length: f64) -> Self {
        Self { settled: self.settled && self.event.is_some(), ..Self::free(length) }
    }

    /// Whether an event that the polynomials of a step find at `found`, before its own end, was located not
    /// to come before that; `undecided` is what location and rounding leave open of its time.
    pub(super) fn was_later(&self, event: Event, found: f64, (length, undecided): (f64, f64)) -> bool {
        self.rivals.iter().any(|rival| {
            let near = found >= length - undecided;
            let went_out_from_there = (rival.sought - found).abs() <= 0.5 * (rival.located - found);
            rival.event == event && rival.located >= length * (1.0 - SAME) && (near || went_out_from_there)
        })
    }

    /// The same, knowing that its event was located not to come before the end of the step at `length`, which
    /// is that of the stretch.
    pub(super) fn refuted(&self, length: f64) -> Self {
        let mut aim = self.clone();
        aim.rivals.extend(self.event.map(|event| Rival { event, sought: self.length, located: length }));
        aim
    }

    /// To an event that comes before `located`, with which the step ends at `length`.
    pub(super) fn rather(&self, event: Event, time: f64, located: Option<Event>, length: f64) -> Self {
        let (mut rivals, sought) = (self.rivals.clone(), self.length);
        if let Some(event) = located {
            rivals.retain(|rival| rival.event != event);
            rivals.push(Rival { event, sought, located: length });
        }
        Self { rivals, ..Self::to(event, time) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIFT: Event = Event::Lift(0);
    const PART: Event = Event::Part(1);
    const LENGTH: f64 = 1.0;

    /// The aim for a part that was found as a step ended with a lift, located at `located` by a search that
    /// went out from `sought`.
    fn after_a_lift((sought, located): (f64, f64)) -> Aim {
        Aim::to(LIFT, sought).rather(PART, 0.8, Some(LIFT), located)
    }

    #[test]
    fn an_event_at_the_end_of_the_step_is_excused_wherever_its_location_went_out_from() {
        assert!(after_a_lift((0.3, LENGTH)).was_later(LIFT, LENGTH - 1e-8, (LENGTH, 1e-7)));
        assert!(!after_a_lift((0.3, LENGTH)).was_later(PART, LENGTH - 1e-8, (LENGTH, 1e-7)));
        assert!(!after_a_lift((0.3, 0.9)).was_later(LIFT, LENGTH - 1e-8, (LENGTH, 1e-7)));
    }

    #[test]
    fn an_event_well_before_the_end_is_excused_only_if_its_location_went_out_from_there() {
        assert!(!after_a_lift((1.1, LENGTH)).was_later(LIFT, 0.5, (LENGTH, 1e-7)));
        assert!(!after_a_lift((0.1, LENGTH)).was_later(LIFT, 0.5, (LENGTH, 1e-7)));
        assert!(after_a_lift((0.51, LENGTH)).was_later(LIFT, 0.5, (LENGTH, 1e-7)));
    }

    /// Three that the polynomials put before one another: the last one is taken.
    #[test]
    fn all_that_were_located_are_excused() {
        let third = after_a_lift((0.3, LENGTH)).rather(Event::Release(2), 1.0 - 1e-8, Some(PART), LENGTH);
        for event in [LIFT, PART] {
            assert!(third.was_later(event, LENGTH - 1e-8, (LENGTH, 1e-7)), "{event:?}");
        }
        assert!(!third.was_later(Event::Release(2), LENGTH - 1e-8, (LENGTH, 1e-7)));
    }

    #[test]
    fn what_was_not_located_excuses_nothing() {
        assert!(!Aim::to(PART, 0.8).rather(PART, 0.8, None, LENGTH).was_later(LIFT, 1.0, (LENGTH, 1e-7)));
        assert!(!Aim::free(LENGTH).was_later(LIFT, 1.0, (LENGTH, 1e-7)));
    }
}
