//! One mark for each kind of event on a branch.

use crate::{
    style::{INK, PALE_INK, PAPER, Style},
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

    /// Room around the place of a mark (pt): two marks are no nearer to each other than theirs together.
    pub(crate) fn room(self, style: &Style) -> f64 {
        let radius = style.mark_radius;
        let reach = match self {
            Self::Flip => 1.6 * radius,
            Self::NeimarkSacker => 1.3 * radius,
            Self::BranchPoint => 1.4 * radius,
            Self::Fold => 0.8 * radius,
            Self::FoldAtGrazing => 1.1 * radius,
            Self::OfUnstable => 0.7 * radius,
            Self::Grazing => 1.3 * radius,
        };
        let least = if self.is_behind() { 0.75 } else { 0.5 } * style.mark_distance;
        (reach + 0.25).max(least)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mark_has_its_own_outline() {
        let outlines = Mark::ALL.map(|mark| mark.outline(PagePoint { x: 10.0, y: 10.0 }, 1.3));
        for (i, outline) in outlines.iter().enumerate() {
            assert!(!outlines[..i].contains(outline));
        }
    }
}
