//! Marks that do not cover each other.
//!
//! Marks take their places one after the other: those of stable solutions before all others, since only these
//! are observed, then by kind, then along the branches. One that would be nearer to another than both have
//! room is left out; the description of the figure counts it.

use super::joined::{EventPlace, JoinedEvents};
use crate::{decimate::distance, marks::Mark, plot::Plot, style::Style, svg::PagePoint};

/// The kinds in the order in which they take their places.
const ORDER: [Mark; 7] = [
    Mark::Flip,
    Mark::NeimarkSacker,
    Mark::BranchPoint,
    Mark::FoldAtGrazing,
    Mark::Fold,
    Mark::OfUnstable,
    Mark::Grazing,
];

/// The marks that are drawn, by kind in the order of `events`, and where.
pub(super) fn spread(events: &JoinedEvents, plot: &Plot, style: &Style) -> Vec<(Mark, Vec<PagePoint>)> {
    let mut taken: Vec<(f64, PagePoint)> = Vec::new();
    let mut drawn: Vec<(Mark, Vec<PagePoint>)> =
        events.events.iter().map(|(mark, ..)| (*mark, Vec::new())).collect();
    for of_stable in [true, false] {
        for mark in ORDER {
            let Some(kind) = events.events.iter().position(|(present, ..)| *present == mark) else {
                continue;
            };
            let room = mark.room(style);
            for place in events.events[kind].1.iter().filter(|place| is_first(mark, place) == of_stable) {
                let at = plot.place(place.x, place.y);
                if taken.iter().all(|&(other, there)| distance(at, there) >= room + other) {
                    taken.push((room, at));
                    drawn[kind].1.push(at);
                }
            }
        }
    }
    drawn
}

/// Whether an event comes with those of stable solutions: grazings are too many.
fn is_first(mark: Mark, place: &EventPlace) -> bool {
    place.of_stable && !matches!(mark, Mark::Grazing | Mark::OfUnstable)
}
