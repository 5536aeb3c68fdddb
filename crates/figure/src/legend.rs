//! The legend: samples with their names, in rows above the plot, where they cover no data.

use crate::{
    dots::Dot,
    font::CAPITAL_HEIGHT,
    line::{draw_stretches, strokes},
    marks::{Mark, square},
    plot::lettering,
    stretch::LineLook,
    style::{INK, Pattern, PeriodLook, Style},
    svg::{Anchor, Dashes, PagePoint, Stroke, SvgWriter},
    text::Text,
};

/// A sample in a legend.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LegendSample {
    /// The line of a kind of solutions, stable or not.
    Line { look: PeriodLook, line: LineLook },
    /// The thin line of other results.
    Overlaid(PeriodLook),
    /// The look of all lines of a period, as a broad line.
    Period(PeriodLook),
    /// The line of a kind of curves.
    Pattern(Pattern),
    /// An event.
    Mark(Mark),
    /// A kind of dots.
    Dot(Dot),
    /// A colour that fills.
    Cell(&'static str),
}

/// A sample with its name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LegendEntry {
    pub(crate) sample: LegendSample,
    pub(crate) name: String,
}

const LINE_LENGTH: f64 = 20.0; // five dashes of the default pattern
const COLOUR_LENGTH: f64 = 9.0;
const COLOUR_WIDTH: f64 = 2.5;
const MARK_WIDTH: f64 = 4.0;
const CELL_WIDTH: f64 = 6.0;
const SAMPLE_RADIUS: f64 = 1.2;
const GAP_IN_ENTRY: f64 = 3.0;
const GAP_BETWEEN_ENTRIES: f64 = 11.0;

impl LegendEntry {
    fn sample_width(&self) -> f64 {
        match self.sample {
            LegendSample::Line { .. } | LegendSample::Overlaid(_) | LegendSample::Pattern(_) => LINE_LENGTH,
            LegendSample::Period(_) => COLOUR_LENGTH,
            LegendSample::Mark(_) | LegendSample::Dot(_) => MARK_WIDTH,
            LegendSample::Cell(_) => CELL_WIDTH,
        }
    }

    fn width(&self, style: &Style) -> f64 {
        self.sample_width() + GAP_IN_ENTRY + Text::upright(&self.name).width(style.tick_size)
    }

    fn draw(&self, svg: &mut SvgWriter, at: PagePoint, style: &Style) {
        let y = at.y - 0.5 * CAPITAL_HEIGHT * style.tick_size;
        let ends = [PagePoint { x: at.x, y }, PagePoint { x: at.x + self.sample_width(), y }];
        match self.sample {
            LegendSample::Line { look, line } => draw_stretches(svg, &[ends.to_vec()], line, look, style),
            LegendSample::Overlaid(look) => {
                draw_stretches(svg, &[ends.to_vec()], LineLook::Stable, look, &style.thin());
            }
            LegendSample::Pattern(Pattern { colour, dashes }) => {
                let dashes = dashes.map(|(dash, gap)| Dashes { dash, gap, offset: 0.0 });
                let stroke = Stroke { colour, width: style.stable_width };
                svg.polylines(std::iter::once((ends.as_slice(), dashes)), stroke);
            }
            LegendSample::Period(PeriodLook { colour, strokes: count }) => {
                svg.polyline(&ends, Stroke { colour, width: COLOUR_WIDTH });
                let style = Style { stroke_reach: COLOUR_WIDTH, ..style.clone() };
                let strokes = strokes(&ends, count, &style);
                let stroke = Stroke { colour, width: style.stable_width };
                svg.polylines(strokes.iter().map(|ends| (ends.as_slice(), None)), stroke);
            }
            LegendSample::Dot(dot) => {
                let radius = dot.radius.max(SAMPLE_RADIUS);
                Dot { radius, ..dot }.draw(svg, &[PagePoint { x: at.x + 0.5 * MARK_WIDTH, y }]);
            }
            LegendSample::Cell(colour) => {
                let half = 0.5 * CELL_WIDTH;
                let data = square(PagePoint { x: at.x + half, y }, half);
                svg.path(&data, colour, Stroke { colour: INK, width: 0.5 * style.frame_width });
            }
            LegendSample::Mark(mark) => {
                mark.draw(svg, &[PagePoint { x: at.x + 0.5 * MARK_WIDTH, y }], style.mark_radius);
            }
        }
        let text_at = PagePoint { x: ends[1].x + GAP_IN_ENTRY, y: at.y };
        svg.text(text_at, &Text::upright(&self.name), lettering(style.tick_size, Anchor::Start));
    }
}

/// Entries in rows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Legend {
    rows: Vec<Vec<LegendEntry>>,
}

impl Legend {
    /// Breaks the entries into rows no wider than `width` (pt); each group starts a new row if that needs no
    /// additional one.
    pub(crate) fn new(groups: Vec<Vec<LegendEntry>>, style: &Style, width: f64) -> Self {
        let flowing = flow(groups.concat(), style, width);
        let grouped: Vec<_> = groups.into_iter().flat_map(|group| flow(group, style, width)).collect();
        Self { rows: if grouped.len() > flowing.len() { flowing } else { grouped } }
    }

    /// Height of all rows (pt).
    pub(crate) fn height(&self, style: &Style) -> f64 {
        self.rows.len() as f64 * row_height(style)
    }

    /// Draws the legend with its upper left corner at `corner`.
    pub(crate) fn draw(&self, svg: &mut SvgWriter, corner: PagePoint, style: &Style) {
        for (i, row) in self.rows.iter().enumerate() {
            let baseline = corner.y + i as f64 * row_height(style) + CAPITAL_HEIGHT * style.tick_size;
            let mut x = corner.x;
            for entry in row {
                entry.draw(svg, PagePoint { x, y: baseline }, style);
                x += entry.width(style) + GAP_BETWEEN_ENTRIES;
            }
        }
    }
}

fn flow(entries: Vec<LegendEntry>, style: &Style, width: f64) -> Vec<Vec<LegendEntry>> {
    let mut rows: Vec<Vec<LegendEntry>> = Vec::new();
    let mut used = 0.0;
    for entry in entries {
        let needed = GAP_BETWEEN_ENTRIES + entry.width(style);
        match rows.last_mut().filter(|_| used + needed <= width) {
            Some(row) => {
                used += needed;
                row.push(entry);
            }
            None => {
                used = needed - GAP_BETWEEN_ENTRIES;
                rows.push(vec![entry]);
            }
        }
    }
    rows
}

fn row_height(style: &Style) -> f64 {
    1.5 * style.tick_size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_no_wider_than_the_plot_and_lose_nothing() {
        let style = Style::default();
        let entry = |i: u32| LegendEntry {
            sample: LegendSample::Cell("#000000"),
            name: format!("1/{i} subharmonic"),
        };
        let legend =
            Legend::new(vec![(1..=5).map(entry).collect(), (6..=9).map(entry).collect()], &style, 200.0);
        assert!(legend.rows.len() > 1);
        assert_eq!(
            legend.rows.iter().flatten().cloned().collect::<Vec<_>>(),
            (1..=9).map(entry).collect::<Vec<_>>()
        );
        assert!(legend.rows.iter().any(|row| row[0] == entry(5)), "the second group starts a row");
        for row in &legend.rows {
            let width: f64 = row.iter().map(|e| e.width(&style) + GAP_BETWEEN_ENTRIES).sum();
            assert!(width - GAP_BETWEEN_ENTRIES <= 200.0);
        }
    }
}
