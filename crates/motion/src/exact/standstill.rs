//! Whether a run gets on.
//!
//! A pass through the loop of a run (`flow.rs`) moves time on, or changes what acts in one instant: a contact
//! closes or opens, presses or parts, a stop is hit or lifts. That is an end of its own as a rule: between
//! impacts velocities do not jump, so that in one instant every contact closes or opens at most once and
//! presses or parts at most once, and does so again only where another one has changed the force meanwhile.
//! With E elements these are fewer than `4 E^2` passes; up to 25 elements that is below [`MOST_CHANGES`] for
//! each. If there are more, rounding leaves two decisions that contradict one another, and time stands still
//! for ever.
//!
//! Impacts on rigid stops do turn velocities round, and chatter has any number of them within what time
//! resolves. They are counted by themselves (`impact.rs`), and each begins an instant anew.

use super::run::Run;

/// Passes without time for each element, and for one more.
const MOST_CHANGES: usize = 100;
/// Rounding of the time, relative to the end of the stretch: less is no getting on.
const RESOLUTION: f64 = 4.0 * f64::EPSILON;

/// The instant at which a run stands.
#[derive(Debug)]
pub(super) struct Standstill {
    since: f64,
    impacts: u64,
    passes: usize,
    /// Closed and parted contacts of each element after the last pass.
    contacts: Vec<(Option<usize>, Option<usize>)>,
    /// Elements whose contacts have changed in this instant.
    changing: Vec<usize>,
}

impl Standstill {
    /// At the start of a run.
    pub(super) fn new(run: &Run) -> Self {
        let (since, impacts) = (run.time, run.impacts);
        Self { since, impacts, passes: 0, contacts: Vec::new(), changing: Vec::new() }
    }

    /// Notes a pass of a run to `end`; true if time has stood still for too many of them.
    pub(super) fn lasts(&mut self, run: &Run, end: f64) -> bool {
        if run.time > self.since + RESOLUTION * end || run.impacts != self.impacts {
            *self = Self { contacts: std::mem::take(&mut self.contacts), ..Self::new(run) };
            return false;
        }
        let now = run.closed.iter().copied().zip(run.parted.iter().copied());
        if self.passes > 0 {
            let changed = now.clone().zip(&self.contacts).enumerate().filter(|(_, (now, then))| now != *then);
            for (element, _) in changed {
                if !self.changing.contains(&element) {
                    self.changing.push(element);
                }
            }
        }
        self.contacts.clear();
        self.contacts.extend(now);
        self.passes += 1;
        self.passes > MOST_CHANGES * (1 + run.closed.len())
    }

    /// Elements whose contacts have changed in this instant; all if it is none of them.
    pub(super) fn changing(&self, run: &Run) -> Vec<usize> {
        if self.changing.is_empty() { (0..run.closed.len()).collect() } else { self.changing.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Passes of a run of two elements until it is said to stand still; `pass` changes the run.
    fn passes(most: usize, mut pass: impl FnMut(&mut Run, usize)) -> (usize, Vec<usize>) {
        let mut run = Run { closed: vec![Some(0), None], parted: vec![None; 2], ..Run::default() };
        let mut standstill = Standstill::new(&run);
        for count in 0..most {
            pass(&mut run, count);
            if standstill.lasts(&run, 1.0) {
                return (count, standstill.changing);
            }
        }
        (most, standstill.changing)
    }

    #[test]
    fn a_contact_that_opens_and_closes_in_one_instant_is_named_after_hundreds_of_passes() {
        let (count, changing) = passes(1000, |run, count| run.closed[1] = (count % 2 == 0).then_some(0));
        assert_eq!((count, changing), (3 * MOST_CHANGES, vec![1]));
    }

    #[test]
    fn time_within_its_rounding_is_no_getting_on() {
        let (count, _) = passes(1000, |run, _| run.time += 1e-18);
        assert_eq!(count, 3 * MOST_CHANGES);
    }

    #[test]
    fn a_run_that_gets_on_or_bounces_does_not_stand_still() {
        assert_eq!(passes(1000, |run, count| run.time = count as f64 * 1e-12).0, 1000);
        assert_eq!(passes(1000, |run, _| run.impacts += 1).0, 1000);
        // A hundred changes of each contact at every one of three instants.
        assert_eq!(passes(600, |run, count| run.time = (count / 200) as f64 * 1e-3).0, 600);
    }
}
