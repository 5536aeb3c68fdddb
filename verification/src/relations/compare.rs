//! Whether two studies have the same answers.
//!
//! # Tolerances
//! A stored orbit is known to 1e-10 of its size, and what it leads to is worse by what its own sensitivity
//! makes of that; an orbit at a frequency between rows is corrected to the same tolerance. Orbits that differ
//! by more than [`SAME`] of their maxima or multipliers are others. A located event is known within its own
//! uncertainty or 1e-8 of its frequency, whichever is more; corners at rigid stops, where speeds below 1e-5
//! of the orbit's are not resolved, say so in their uncertainty. Ends of branches are cut at the range or are
//! events.

use std::fmt;

use super::answers::{Answers, EventAnswer, OrbitAnswer};

/// Relative difference from which two orbits are not the same.
const SAME: f64 = 1e-6;
/// Part of the range within which events and ends of branches are the same, besides their own uncertainty.
const SAME_PLACE: f64 = 1e-7;

/// What differs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Disagreeing {
    /// A branch that only one of them has.
    Branch,
    /// An event that only one of them has.
    Event,
    /// An orbit at a frequency that only one of them has.
    Orbit,
    /// Rows with which the independent integrator does not agree.
    Verification,
}

/// A difference between answers.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Of what.
    pub kind: Disagreeing,
    /// In words, with numbers.
    pub message: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:?}: {}", self.kind, self.message)
    }
}

/// All differences between the answers to a study and those to the same physics written another way.
#[must_use]
pub fn differences(study: &Answers, other: &Answers) -> Vec<Difference> {
    let mut found = Vec::new();
    let mut add = |kind, messages: Vec<String>| {
        found.extend(messages.into_iter().map(|message| Difference { kind, message }));
    };
    add(Disagreeing::Branch, unmatched(&study.branches, &other.branches, same_branch));
    add(Disagreeing::Event, unmatched(&study.events, &other.events, same_event));
    for ((at, orbits), (_, others)) in study.orbits.iter().zip(&other.orbits) {
        let here = unmatched(orbits, others, same_orbit);
        add(
            Disagreeing::Orbit,
            here.into_iter().map(|message| format!("at {at:.6} of the range, {message}")).collect(),
        );
    }
    add(
        Disagreeing::Verification,
        study.disagreements.iter().map(|message| format!("study: {message}")).collect(),
    );
    add(
        Disagreeing::Verification,
        other.disagreements.iter().map(|message| format!("other: {message}")).collect(),
    );
    found
}

/// What has no partner in the other list, each partner taken once.
fn unmatched<T: fmt::Debug>(study: &[T], other: &[T], same: fn(&T, &T) -> bool) -> Vec<String> {
    let mut taken = vec![false; other.len()];
    let mut messages = Vec::new();
    for item in study {
        match (0..other.len()).find(|&k| !taken[k] && same(item, &other[k])) {
            Some(partner) => taken[partner] = true,
            None => messages.push(format!("only in the study: {item:?}")),
        }
    }
    let left = other.iter().zip(&taken).filter(|(_, taken)| !**taken);
    messages.extend(left.map(|(item, _)| format!("only in the other: {item:?}")));
    messages
}

fn same_branch((multiple, span): &(u32, [f64; 2]), (other, its): &(u32, [f64; 2])) -> bool {
    // An end at a corner is known as well as the corner.
    multiple == other && span.iter().zip(its).all(|(a, b)| (a - b).abs() < 10.0 * SAME_PLACE)
}

fn same_event(event: &EventAnswer, other: &EventAnswer) -> bool {
    let known = SAME_PLACE + 2.0 * (event.uncertainty + other.uncertainty);
    event.period_multiple == other.period_multiple
        && event.kind == other.kind
        && (event.at - other.at).abs() < known
}

fn same_orbit(orbit: &OrbitAnswer, other: &OrbitAnswer) -> bool {
    let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= SAME * scale;
    let largest = orbit.multipliers.first().map_or(1.0, |modulus| modulus.max(1.0));
    orbit.period_multiple == other.period_multiple
        && orbit.contacts == other.contacts
        && orbit.maxima.iter().zip(other.maxima).all(|(a, b)| close(*a, b, a.abs()))
        && orbit.multipliers.iter().zip(&other.multipliers).all(|(a, b)| close(*a, *b, largest))
}
