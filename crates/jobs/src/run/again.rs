//! Where to look again: frequencies at which no stable solution is known, those at which a contact of a
//! stable solution appears or vanishes, and narrow ranges with contacts.
//!
//! A dissipative system has an attractor at every frequency. Where no branch is stable it is chaotic,
//! quasi-periodic, of a period that is not looked for, or on a branch that is missed. Between two successive
//! stable rows a stable solution is taken to be known; what that leaves of the range are *intervals*. Each of
//! them is looked at in its middle, however narrow, the widest first; then the widest part between two
//! frequencies that were looked at is halved. Where nothing new is found motion is chaotic as a rule, so that
//! only each branch that is found gives leave to halve further. That is done in rounds, since a branch that a
//! round finds may cover much of what is left.
//!
//! A grazing may have other attractors beside it although the solution that grazes stays stable. Where the
//! number of contacts changes between two successive stable rows, the first round looks there, too, unless a
//! search was near.
//!
//! Contacts that are made over a narrow range, at a resonance say, can have many attractors there, although
//! the motion without contact is stable beside them. Where that range has no more than [`NARROW`] parts of
//! the survey, or of [`PARTS`] of all, the first round halves it until no part is wider than one in
//! [`PARTS`].

use hammerbeam_orbit::Side;
use hammerbeam_results::store::JobKind;

use super::{
    Plan,
    agenda::{Agenda, Sketch},
};

/// Most frequencies that are looked at so, in all rounds, and no more than the survey has.
const MOST: usize = 48;
/// Frequencies of a first round, and for each branch that was found at one of them.
const ROUND: usize = 6;
/// Intervals narrower than this part of the distance of the frequencies of the survey are left out.
const NARROWEST: f64 = 1e-4;
/// A search within this part of that distance from a change of contacts is near.
const NEAR: f64 = 0.125;

/// Parts of the survey that a narrow range with contacts has at most,
const NARROW: f64 = 4.0;
/// and the parts into which searches cut it.
const PARTS: usize = 16;

/// Kinds of these jobs.
pub(super) const KINDS: [JobKind; 2] = [JobKind::NoneStable, JobKind::ContactChange];

/// The jobs of the next round; none when enough was looked at, or nothing is left to look at.
pub(super) fn jobs(agenda: &Agenda, plan: &Plan) -> Vec<(JobKind, f64, Option<i64>, u32)> {
    let of = |kind: JobKind| agenda.jobs.iter().filter(move |job| job.record.kind == kind);
    let searches = agenda.jobs.iter().filter(|job| job.record.source.is_none());
    let mut looked_at: Vec<f64> = searches.map(|job| job.record.frequency_hz).collect();
    let done = of(JobKind::NoneStable).count();
    let found = of(JobKind::NoneStable).filter(|job| !job.starts.is_empty()).count();
    let effort = Effort {
        most: plan.survey_hz.len().min(MOST).saturating_sub(done),
        halvings: (ROUND * (1 + found)).saturating_sub(done),
    };
    let width = plan.survey_width_hz();
    let intervals = uncovered(&stretches(stable_pairs(agenda)), plan.range_hz);
    let none_stable = places(&intervals, looked_at.clone(), NARROWEST * width, effort);
    looked_at.extend(&none_stable);
    let is_first = done == 0 && of(JobKind::ContactChange).count() == 0;
    let most = if is_first { plan.survey_hz.len() } else { 0 };
    let mut contact_changes =
        apart(changes_of_contacts(agenda), looked_at.clone(), NEAR * width, ROUND.min(most));
    looked_at.extend(&contact_changes);
    let mut in_contact = with_contacts(agenda, plan.range_hz);
    let part = width.min((plan.range_hz[1] - plan.range_hz[0]) / PARTS as f64);
    in_contact.retain(|[low, high]| high - low <= NARROW * part);
    contact_changes.extend(cut_finely(&in_contact, looked_at, most));
    let all = [(JobKind::NoneStable, none_stable), (JobKind::ContactChange, contact_changes)];
    all.into_iter().flat_map(|(kind, places)| places.into_iter().map(move |at| (kind, at, None, 0))).collect()
}

/// How much a round may look at.
#[derive(Debug, Clone, Copy)]
struct Effort {
    most: usize,
    /// Frequencies after which only intervals are looked at that never were.
    halvings: usize,
}

/// Successive rows of branches.
fn pairs(agenda: &Agenda) -> impl Iterator<Item = &[Sketch]> {
    let sides = agenda.accepted().flat_map(|start| [Side::Up, Side::Down].map(|side| start.walk(side)));
    sides.flat_map(|walk| walk.rows.windows(2))
}

/// Those that are stable.
fn stable_pairs(agenda: &Agenda) -> impl Iterator<Item = &[Sketch]> {
    pairs(agenda).filter(|pair| pair[0].else_stable && pair[1].else_stable)
}

/// Stretches of the frequency from one row to the next one.
fn stretches<'a>(pairs: impl Iterator<Item = &'a [Sketch]>) -> Vec<[f64; 2]> {
    pairs.map(|pair| [pair[0].frequency_hz, pair[1].frequency_hz]).collect()
}

/// Where the number of contacts changes from one stable row of a branch to the next one.
fn changes_of_contacts(agenda: &Agenda) -> impl Iterator<Item = f64> {
    let changes = stable_pairs(agenda).filter(|pair| pair[0].contacts != pair[1].contacts);
    changes.map(|pair| pair[0].frequency_hz)
}

/// Ranges of the frequency over which a branch has contacts, ascending.
fn with_contacts(agenda: &Agenda, range_hz: [f64; 2]) -> Vec<[f64; 2]> {
    let closed = pairs(agenda).filter(|pair| pair[0].contacts > 0 && pair[1].contacts > 0);
    uncovered(&uncovered(&stretches(closed), range_hz), range_hz)
}

/// Frequencies, at most so many, that cut each range into [`PARTS`] with those that were looked at.
fn cut_finely(ranges: &[[f64; 2]], mut looked_at: Vec<f64>, most: usize) -> Vec<f64> {
    let mut found = Vec::new();
    for range in ranges {
        let left = most - found.len();
        let narrowest = (range[1] - range[0]) / PARTS as f64;
        let cuts = places(&[*range], looked_at.clone(), narrowest, Effort { most: left, halvings: left });
        looked_at.extend(&cuts);
        found.extend(cuts);
    }
    found
}

/// The first so many frequencies that lie this far from what was looked at, and from each other.
fn apart(places: impl Iterator<Item = f64>, mut looked_at: Vec<f64>, distance: f64, most: usize) -> Vec<f64> {
    let known = looked_at.len();
    for at in places {
        if looked_at.len() < known + most && looked_at.iter().all(|other| (other - at).abs() > distance) {
            looked_at.push(at);
        }
    }
    looked_at.split_off(known)
}

/// What stretches leave of a range, ascending.
fn uncovered(stretches: &[[f64; 2]], [low, high]: [f64; 2]) -> Vec<[f64; 2]> {
    let mut ascending: Vec<[f64; 2]> = stretches.iter().map(|[a, b]| [a.min(*b), a.max(*b)]).collect();
    ascending.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut left = Vec::new();
    let mut covered_to = low;
    for [from, to] in ascending {
        if from > covered_to {
            left.push([covered_to, from]);
        }
        covered_to = covered_to.max(to);
    }
    if covered_to < high {
        left.push([covered_to, high]);
    }
    left
}

/// Frequencies to look at: each interval once, then the middles of the widest parts.
fn places(
    intervals: &[[f64; 2]],
    mut looked_at: Vec<f64>,
    narrowest: f64,
    Effort { most, halvings }: Effort,
) -> Vec<f64> {
    let intervals: Vec<[f64; 2]> = intervals.iter().filter(|[a, b]| b - a > narrowest).copied().collect();
    let mut found = Vec::new();
    while found.len() < most {
        let widest =
            intervals.iter().flat_map(|interval| parts(*interval, &looked_at)).reduce(|best, part| {
                let order = (part.is_whole, part.width()).partial_cmp(&(best.is_whole, best.width()));
                if order == Some(std::cmp::Ordering::Greater) { part } else { best }
            });
        let wanted = |part: &Part| part.width() > narrowest && (part.is_whole || found.len() < halvings);
        let Some(part) = widest.filter(wanted) else { break };
        found.push(part.middle());
        looked_at.push(part.middle());
    }
    found
}

/// A part of an interval between two frequencies that were looked at, or its ends.
#[derive(Debug, Clone, Copy)]
struct Part {
    ends: [f64; 2],
    /// Whether nothing was looked at within the interval.
    is_whole: bool,
}

impl Part {
    fn width(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    fn middle(&self) -> f64 {
        0.5 * (self.ends[0] + self.ends[1])
    }
}

fn parts([low, high]: [f64; 2], looked_at: &[f64]) -> Vec<Part> {
    let mut within: Vec<f64> = looked_at.iter().filter(|at| (low..=high).contains(*at)).copied().collect();
    let is_whole = within.is_empty();
    within.extend([low, high]);
    within.sort_by(f64::total_cmp);
    within.windows(2).map(|pair| Part { ends: [pair[0], pair[1]], is_whole }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_stretch_covers_is_left() {
        let left = uncovered(&[[3.0, 2.0], [1.0, 2.5], [6.0, 8.0]], [0.0, 10.0]);
        assert_eq!(left, [[0.0, 1.0], [3.0, 6.0], [8.0, 10.0]]);
        assert!(uncovered(&[[-1.0, 5.0], [5.0, 11.0]], [0.0, 10.0]).is_empty());
    }

    #[test]
    fn every_interval_is_looked_at_before_the_widest_is_halved_again() {
        let intervals = [[0.0, 8.0], [9.0, 9.0625], [10.0, 11.0]];
        let effort = Effort { most: 5, halvings: 9 };
        assert_eq!(places(&intervals, vec![], 1e-6, effort), [4.0, 10.5, 9.03125, 2.0, 6.0]);
        let effort = Effort { most: 2, halvings: 9 };
        assert_eq!(
            places(&intervals, vec![4.0], 1e-6, effort),
            [10.5, 9.03125],
            "the first one was looked at"
        );
    }

    #[test]
    fn what_was_looked_at_without_success_is_not_halved_for_ever() {
        let intervals = [[0.0, 8.0], [9.0, 9.0625], [10.0, 11.0]];
        assert_eq!(places(&intervals, vec![], 1e-6, Effort { most: 9, halvings: 1 }), [4.0, 10.5, 9.03125]);
        assert!(
            places(&intervals, vec![4.0, 10.5, 9.03125], 1e-6, Effort { most: 9, halvings: 0 }).is_empty()
        );
    }

    #[test]
    fn changes_of_contacts_are_looked_at_where_no_search_was_near() {
        let found = |most| apart([1.0, 1.05, 2.0, 3.0, 0.5].into_iter(), vec![2.1, 7.0], 0.2, most);
        assert_eq!(found(6), [1.0, 3.0, 0.5]);
        assert_eq!(found(2), [1.0, 3.0]);
    }

    #[test]
    fn a_narrow_range_is_cut_until_no_part_is_wider_than_one_in_sixteen() {
        let cuts = cut_finely(&[[0.0, 16.0], [20.0, 20.0]], vec![3.0, 12.5], 99);
        let mut all = [&cuts[..], &[0.0, 3.0, 12.5, 16.0]].concat();
        all.sort_by(f64::total_cmp);
        assert!(all.windows(2).all(|pair| pair[1] - pair[0] <= 1.0 && pair[1] - pair[0] > 0.4), "{all:?}");
        assert_eq!(cut_finely(&[[0.0, 16.0], [20.0, 36.0]], vec![], 20).len(), 20);
        assert!(cut_finely(&[[0.0, 16.0]], vec![], 0).is_empty());
    }

    #[test]
    fn intervals_within_rounding_are_left_out() {
        let effort = Effort { most: 5, halvings: 5 };
        assert!(places(&[[1.0, 1.0 + 1e-9]], vec![], 1e-6, effort).is_empty());
    }
}
