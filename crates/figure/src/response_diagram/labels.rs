//! Names beside the lines: where branches of several periods are drawn, the longest line of each has its name
//! beside it if one fits between lines, marks and frame. The legend names them all the same.

use super::data::period_name;
use crate::{
    decimate::distance,
    font::CAPITAL_HEIGHT,
    plot::{Area, lettering},
    stretch::LineLook,
    style::Style,
    svg::{Anchor, PagePoint, SvgWriter},
    text::Text,
};

/// Distance of a name from its line, and from all else at least (pt).
const BESIDE: f64 = 3.2;
const FREE: f64 = 1.6;
/// Distance of the places on a line at which names are tried, and of the points that stand for a line (pt).
const STEP: f64 = 6.0;
const FINE: f64 = 1.5;
/// Distance from other lines beyond which a place is no better (pt).
const FAR: f64 = 24.0;

/// The lines of a branch on the page.
pub(super) struct LabelledLine {
    pub(super) period_multiple: u32,
    pub(super) stretches: Vec<(LineLook, Vec<PagePoint>)>,
}

/// A name with the left end of its baseline.
pub(super) struct DirectLabel {
    at: PagePoint,
    text: Text,
}

/// Draws a name.
pub(super) fn draw_label(svg: &mut SvgWriter, label: &DirectLabel, style: &Style) {
    svg.text(label.at, &label.text, lettering(style.tick_size, Anchor::Start));
}

/// The names that fit; none where all lines are of one period.
pub(super) fn direct_labels(
    lines: &[LabelledLine],
    marks: &[PagePoint],
    area: Area,
    style: &Style,
) -> Vec<DirectLabel> {
    let mut multiples: Vec<u32> = lines.iter().map(|line| line.period_multiple).collect();
    multiples.sort_unstable();
    multiples.dedup();
    if multiples.len() < 2 {
        return Vec::new();
    }
    let points: Vec<(u32, PagePoint)> = lines.iter().flat_map(fine_points).collect();
    let mut taken: Vec<Area> = Vec::new();
    let mut labels = Vec::new();
    for multiple in multiples {
        let text = Text::upright(period_name(multiple));
        let size = (text.width(style.tick_size), CAPITAL_HEIGHT * style.tick_size);
        let is_free = |found: &Area| {
            let is_within = found.left >= area.left + FREE
                && found.right <= area.right - FREE
                && found.top >= area.top + FREE
                && found.bottom <= area.bottom - FREE;
            is_within
                && !taken.iter().any(|other| overlap(found, other))
                && !points.iter().any(|(_, point)| holds(found, *point, FREE))
                && !marks.iter().any(|mark| holds(found, *mark, FREE + style.mark_radius))
        };
        let room = |found: &Area| {
            let others = points.iter().filter(|(other, _)| *other != multiple);
            others.map(|(_, point)| distance(*point, middle(found))).fold(FAR, f64::min)
        };
        // The longest line on which a name fits; there the place nearest to its middle that is far from other
        // lines, or the farthest from them.
        let best = anchors(lines, multiple).into_iter().find_map(|places| {
            let free = places.into_iter().flat_map(|at| around(at, size)).filter(is_free);
            let mut best: Option<(f64, Area)> = None;
            for (room, found) in free.map(|found| (room(&found), found)) {
                if best.is_none_or(|(most, _)| room > most) {
                    best = Some((room, found));
                }
                if room >= FAR {
                    break;
                }
            }
            best
        });
        if let Some((_, found)) = best {
            labels.push(DirectLabel { at: PagePoint { x: found.left, y: found.bottom }, text });
            taken.push(found);
        }
    }
    labels
}

/// Places on the lines of a period at which a name may stand, of each line those nearest to its middle first:
/// on stable lines, if there are any, the longest first.
fn anchors(lines: &[LabelledLine], multiple: u32) -> Vec<Vec<PagePoint>> {
    let own =
        || lines.iter().filter(|line| line.period_multiple == multiple).flat_map(|line| &line.stretches);
    let is_any_stable = own().any(|(look, line)| *look == LineLook::Stable && line.len() > 1);
    let wanted = own().filter(|(look, _)| !is_any_stable || *look == LineLook::Stable);
    let mut places: Vec<Vec<PagePoint>> = wanted.map(|(_, line)| spaced(line, STEP)).collect();
    let length = |places: &[PagePoint]| places.windows(2).map(|ends| distance(ends[0], ends[1])).sum::<f64>();
    places.sort_by(|one, other| length(other).total_cmp(&length(one)));
    for places in &mut places {
        let middle = places.len() / 2;
        let (before, after) = places.split_at(middle);
        *places = alternating(after, before);
    }
    places
}

/// Those after a place and those before it by turns, away from it.
fn alternating(after: &[PagePoint], before: &[PagePoint]) -> Vec<PagePoint> {
    let mut back = before.iter().rev();
    let mut places = Vec::with_capacity(after.len() + before.len());
    for &place in after {
        places.push(place);
        places.extend(back.next());
    }
    places.extend(back);
    places
}

/// Boxes of a name around a place on its line: above, right, left, below.
fn around(at: PagePoint, (width, height): (f64, f64)) -> [Area; 4] {
    let area = |left: f64, top: f64| Area { left, right: left + width, top, bottom: top + height };
    [
        area(at.x - 0.5 * width, at.y - BESIDE - height),
        area(at.x + BESIDE, at.y - 0.5 * height),
        area(at.x - BESIDE - width, at.y - 0.5 * height),
        area(at.x - 0.5 * width, at.y + BESIDE),
    ]
}

fn fine_points(line: &LabelledLine) -> impl Iterator<Item = (u32, PagePoint)> {
    let multiple = line.period_multiple;
    line.stretches.iter().flat_map(|(_, points)| spaced(points, FINE)).map(move |point| (multiple, point))
}

/// Places along a line, no farther apart than that (pt), from its start to its end.
fn spaced(line: &[PagePoint], step: f64) -> Vec<PagePoint> {
    let mut places: Vec<PagePoint> = line.first().copied().into_iter().collect();
    for ends in line.windows(2) {
        let parts = (distance(ends[0], ends[1]) / step).ceil().clamp(1.0, 1e4) as usize;
        places.extend((1..=parts).map(|part| {
            let share = part as f64 / parts as f64;
            let between = |from: f64, to: f64| from + share * (to - from);
            PagePoint { x: between(ends[0].x, ends[1].x), y: between(ends[0].y, ends[1].y) }
        }));
    }
    places
}

fn middle(area: &Area) -> PagePoint {
    PagePoint { x: 0.5 * (area.left + area.right), y: 0.5 * (area.top + area.bottom) }
}

/// Whether a point is in a box, or nearer to it than that.
fn holds(area: &Area, point: PagePoint, margin: f64) -> bool {
    (area.left - margin..=area.right + margin).contains(&point.x)
        && (area.top - margin..=area.bottom + margin).contains(&point.y)
}

fn overlap(one: &Area, other: &Area) -> bool {
    one.left < other.right + FREE
        && other.left < one.right + FREE
        && one.top < other.bottom + FREE
        && other.top < one.bottom + FREE
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(period_multiple: u32, y: f64) -> LabelledLine {
        let ends = [10.0, 190.0].map(|x| PagePoint { x, y });
        LabelledLine { period_multiple, stretches: vec![(LineLook::Stable, ends.to_vec())] }
    }

    const AREA: Area = Area { left: 0.0, right: 200.0, top: 0.0, bottom: 100.0 };

    #[test]
    fn a_name_stands_beside_its_line_and_covers_nothing() {
        let lines = [level(1, 80.0), level(2, 30.0)];
        let marks = [PagePoint { x: 100.0, y: 24.0 }];
        let labels = direct_labels(&lines, &marks, AREA, &Style::default());
        assert_eq!(labels.len(), 2);
        for (label, line) in labels.iter().zip(&lines) {
            let y = line.stretches[0].1[0].y;
            assert!((label.at.y - y).abs() < 12.0, "{} beside {y}", label.at.y);
        }
        let second = &labels[1];
        let size = (second.text.width(7.0), CAPITAL_HEIGHT * 7.0);
        let found = Area {
            left: second.at.x,
            right: second.at.x + size.0,
            top: second.at.y - size.1,
            bottom: second.at.y,
        };
        assert!(!holds(&found, marks[0], 1.0));
    }

    #[test]
    fn one_period_needs_no_name_and_a_crowd_has_room_for_none() {
        assert!(direct_labels(&[level(1, 80.0)], &[], AREA, &Style::default()).is_empty());
        let crowd: Vec<LabelledLine> = (1..20).map(|k| level(1 + k % 2, 5.0 * f64::from(k))).collect();
        assert!(direct_labels(&crowd, &[], AREA, &Style::default()).is_empty());
    }
}
