//! One mark for each kind of event on a branch, and thinning of marks.

use std::collections::HashMap;

use crate::{
    decimate::distance,
    style::{INK, PALE_INK, PAPER},
    svg::{PagePoint, Stroke, SvgWriter, number},
};

/// An event on a branch that has a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    Fold,
    Flip,
    NeimarkSacker,
    BranchPoint,
    Grazing,
    /// A fold that is a corner of its branch, at a grazing.
    FoldAtGrazing,
    /// A flip or Neimark-Sacker point of solutions that are unstable on both sides.
    OfUnstable,
}

impl Mark {
    /// All marks, in the order of the legend.
    pub(crate) const ALL: [Self; 7] = [
        Self::Fold,
        Self::FoldAtGrazing,
        Self::Flip,
        Self::NeimarkSacker,
        Self::BranchPoint,
        Self::OfUnstable,
        Self::Grazing,
    ];

    /// Whether the mark is drawn behind the lines: some events are so frequent that they would cover them.
    pub(crate) fn is_behind(self) -> bool {
        matches!(self, Self::Grazing | Self::OfUnstable)
    }

    /// The places of the marks that are drawn.
    pub(crate) fn thin_out(self, places: &[PagePoint], least_distance: f64) -> Vec<PagePoint> {
        thin_out(places, if self.is_behind() { 1.5 * least_distance } else { least_distance })
    }

    /// The name in the legend.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Grazing => "grazing",
            Self::Fold => "fold",
            Self::FoldAtGrazing => "fold at a grazing",
            Self::Flip => "flip",
            Self::NeimarkSacker => "Neimark–Sacker",
            Self::BranchPoint => "branch point",
            Self::OfUnstable => "flip or Neimark–Sacker of unstable solutions",
        }
    }

    /// Draws the mark at each place.
    pub(crate) fn draw(self, svg: &mut SvgWriter, places: &[PagePoint], radius: f64) {
        if places.is_empty() {
            return;
        }
        let data: String = places.iter().map(|&place| self.outline(place, radius)).collect();
        let (fill, stroke) = match self {
            Self::Fold | Self::FoldAtGrazing => (INK, Stroke { colour: PAPER, width: 0.3 }),
            Self::Grazing => ("none", Stroke { colour: PALE_INK, width: 0.45 }),
            Self::OfUnstable => (PAPER, Stroke { colour: PALE_INK, width: 0.45 }),
            _ => (PAPER, Stroke { colour: INK, width: 0.6 }),
        };
        svg.path(&data, fill, stroke);
    }

    fn outline(self, at: PagePoint, radius: f64) -> String {
        match self {
            Self::Grazing => triangle(at, 1.4 * radius),
            Self::Fold => circle(at, 0.8 * radius),
            Self::FoldAtGrazing => triangle(at, 1.2 * radius),
            Self::Flip => diamond(at, 1.6 * radius),
            Self::NeimarkSacker => circle(at, 1.3 * radius),
            Self::BranchPoint => square(at, 1.1 * radius),
            Self::OfUnstable => circle(at, 0.7 * radius),
        }
    }
}

pub(crate) fn circle(at: PagePoint, radius: f64) -> String {
    let (r, diameter) = (number(radius), number(2.0 * radius));
    format!(
        "M{} {}a{r} {r} 0 1 0 {diameter} 0a{r} {r} 0 1 0 -{diameter} 0z",
        number(at.x - radius),
        number(at.y)
    )
}

/// Upright and equilateral, its centre at the place.
pub(crate) fn triangle(at: PagePoint, radius: f64) -> String {
    let (half, height) = (radius * 0.75f64.sqrt(), 1.5 * radius);
    let start = format!("M{} {}", number(at.x), number(at.y - radius));
    format!("{start}l{} {}h-{}z", number(half), number(height), number(2.0 * half))
}

fn diamond(at: PagePoint, radius: f64) -> String {
    let r = number(radius);
    format!("M{} {}l{r} {r}l-{r} {r}l-{r} -{r}z", number(at.x), number(at.y - radius))
}

pub(crate) fn square(at: PagePoint, half: f64) -> String {
    let side = number(2.0 * half);
    format!("M{} {}h{side}v{side}h-{side}z", number(at.x - half), number(at.y - half))
}

/// The places at least `least_distance` from all earlier ones that stay.
fn thin_out(places: &[PagePoint], least_distance: f64) -> Vec<PagePoint> {
    let cell_of = |place: PagePoint| {
        ((place.x / least_distance).floor() as i64, (place.y / least_distance).floor() as i64)
    };
    let mut cells: HashMap<(i64, i64), Vec<PagePoint>> = HashMap::new();
    let mut kept = Vec::new();
    for &place in places {
        let (column, row) = cell_of(place);
        let near = (column - 1..=column + 1)
            .flat_map(|column| (row - 1..=row + 1).map(move |row| (column, row)))
            .filter_map(|cell| cells.get(&cell))
            .flatten()
            .any(|&other| distance(place, other) < least_distance);
        if !near {
            cells.entry((column, row)).or_default().push(place);
            kept.push(place);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn marks_that_stay_are_apart_and_cover_those_that_go(
            places in prop::collection::vec((-20.0..20.0, -20.0..20.0), 0..200),
        ) {
            let places: Vec<PagePoint> = places.into_iter().map(|(x, y)| PagePoint { x, y }).collect();
            let kept = thin_out(&places, 3.0);
            for (i, &a) in kept.iter().enumerate() {
                prop_assert!(kept[..i].iter().all(|&b| distance(a, b) >= 3.0));
            }
            prop_assert!(places.iter().all(|&a| kept.iter().any(|&b| distance(a, b) < 3.0)));
        }
    }

    #[test]
    fn every_mark_has_its_own_outline() {
        let outlines = Mark::ALL.map(|mark| mark.outline(PagePoint { x: 10.0, y: 10.0 }, 1.3));
        for (i, outline) in outlines.iter().enumerate() {
            assert!(!outlines[..i].contains(outline));
        }
    }
}
