//! A plot: a frame with two axes, which map data to positions.

use crate::{
    axis::PlotAxis,
    font::CAPITAL_HEIGHT,
    scale::Scale,
    style::{GRID, INK, Style},
    svg::{Anchor, PagePoint, Stroke, SvgWriter, TextStyle, points},
    text::Text,
    ticks::Tick,
};

/// Space between a tick label and its tick (pt), and between it and the axis label.
const LABEL_GAP: f64 = 2.5;
const AXIS_LABEL_GAP: f64 = 5.0;

/// A rectangle on the page (pt).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Area {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) top: f64,
    pub(crate) bottom: f64,
}

/// A frame with two axes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Plot {
    pub(crate) area: Area,
    pub(crate) x: PlotAxis,
    pub(crate) y: PlotAxis,
    /// Whether the horizontal axis has numbers and a label; of stacked plots only the lowest has.
    pub(crate) labelled_below: bool,
}

/// Room below the frame for the numbers and the label of the horizontal axis (pt).
pub(crate) fn room_below(style: &Style) -> f64 {
    tick_label_depth(style) + AXIS_LABEL_GAP + CAPITAL_HEIGHT * style.label_size + 0.25 * style.label_size
}

/// Room left of the frame for numbers of a width and the label of the vertical axis (pt).
pub(crate) fn room_left(style: &Style, label_width: f64) -> f64 {
    style.tick_length + LABEL_GAP + label_width + AXIS_LABEL_GAP + style.label_size
}

/// Room right of the frame (pt) for the part of a number of the horizontal axis that extends beyond it.
///
/// * `scale`: of the axis, and the factor of its numbers.
/// * `left`: of the frame (pt).
/// * `spacing`: distance of the numbers of the axis (pt).
pub(crate) fn room_right(style: &Style, (scale, factor): (&Scale, f64), left: f64, spacing: f64) -> f64 {
    let length = points(style.width_mm) - left - style.tick_size;
    let axis = PlotAxis::in_unit((*scale, factor), Text::default(), length, spacing);
    let jut = |tick| 0.5 * number(tick).width(style.tick_size) - (1.0 - scale.share(tick.value)) * length;
    labelled(&axis).map(jut).fold(style.tick_size, f64::max)
}

fn tick_label_depth(style: &Style) -> f64 {
    style.tick_length + LABEL_GAP + CAPITAL_HEIGHT * style.tick_size
}

impl Plot {
    /// Where a pair of values is on the page.
    pub(crate) fn place(&self, x: f64, y: f64) -> PagePoint {
        PagePoint { x: self.across(x), y: self.up(y) }
    }

    fn across(&self, x: f64) -> f64 {
        self.area.left + self.x.scale.share(x) * (self.area.right - self.area.left)
    }

    fn up(&self, y: f64) -> f64 {
        self.area.bottom - self.y.scale.share(y) * (self.area.bottom - self.area.top)
    }

    /// Draws the pale lines behind the data, at the numbers of both axes.
    pub(crate) fn draw_grid(&self, svg: &mut SvgWriter, style: &Style) {
        let Area { left, right, top, bottom } = self.area;
        let upright = labelled(&self.x).map(|tick| self.across(tick.value));
        let upright = upright.map(|x| [PagePoint { x, y: top }, PagePoint { x, y: bottom }]);
        let level = labelled(&self.y).map(|tick| self.up(tick.value));
        let level = level.map(|y| [PagePoint { x: left, y }, PagePoint { x: right, y }]);
        draw_lines(svg, upright.chain(level), Stroke { colour: GRID, width: 0.7 * style.frame_width });
    }

    /// Draws frame, ticks, numbers and labels.
    pub(crate) fn draw_axes(&self, svg: &mut SvgWriter, style: &Style) {
        let Area { left, right, top, bottom } = self.area;
        let stroke = Stroke { colour: INK, width: style.frame_width };
        svg.rectangle(PagePoint { x: left, y: top }, PagePoint { x: right, y: bottom }, stroke);
        let below = self.x.ticks.iter().map(|tick| (self.across(tick.value), bottom + length(tick, style)));
        let below = below.map(|(x, y)| [PagePoint { x, y: bottom }, PagePoint { x, y }]);
        let beside = self.y.ticks.iter().map(|tick| (left - length(tick, style), self.up(tick.value)));
        let beside = beside.map(|(x, y)| [PagePoint { x, y }, PagePoint { x: left, y }]);
        draw_lines(svg, below.chain(beside), stroke);
        if self.labelled_below {
            self.letter_horizontal(svg, style);
        }
        self.letter_vertical(svg, style);
    }

    fn letter_horizontal(&self, svg: &mut SvgWriter, style: &Style) {
        let Area { left, right, bottom, .. } = self.area;
        let baseline = bottom + tick_label_depth(style);
        for tick in labelled(&self.x) {
            let at = PagePoint { x: self.across(tick.value), y: baseline };
            svg.text(at, &number(tick), lettering(style.tick_size, Anchor::Middle));
        }
        let below = baseline + AXIS_LABEL_GAP + CAPITAL_HEIGHT * style.label_size;
        let middle = PagePoint { x: 0.5 * (left + right), y: below };
        svg.text(middle, &self.x.label, lettering(style.label_size, Anchor::Middle));
    }

    fn letter_vertical(&self, svg: &mut SvgWriter, style: &Style) {
        let Area { left, top, bottom, .. } = self.area;
        for tick in labelled(&self.y) {
            let x = left - style.tick_length - LABEL_GAP;
            let at = PagePoint { x, y: self.up(tick.value) + 0.5 * CAPITAL_HEIGHT * style.tick_size };
            svg.text(at, &number(tick), lettering(style.tick_size, Anchor::End));
        }
        let x = 0.25 * style.label_size + CAPITAL_HEIGHT * style.label_size;
        let text = TextStyle { upwards: true, ..lettering(style.label_size, Anchor::Middle) };
        svg.text(PagePoint { x, y: 0.5 * (top + bottom) }, &self.y.label, text);
    }
}

fn draw_lines(svg: &mut SvgWriter, lines: impl Iterator<Item = [PagePoint; 2]>, stroke: Stroke<'_>) {
    let lines: Vec<[PagePoint; 2]> = lines.collect();
    svg.polylines(lines.iter().map(|line| (line.as_slice(), None)), stroke);
}

fn labelled(axis: &PlotAxis) -> impl Iterator<Item = &Tick> {
    axis.ticks.iter().filter(|tick| tick.label.is_some())
}

fn number(tick: &Tick) -> Text {
    Text::upright(tick.label.as_deref().unwrap_or_default())
}

fn length(tick: &Tick, style: &Style) -> f64 {
    if tick.label.is_some() { style.tick_length } else { 0.5 * style.tick_length }
}

/// Text in ink.
pub(crate) fn lettering(size: f64, anchor: Anchor) -> TextStyle<'static> {
    TextStyle { size, colour: INK, anchor, upwards: false }
}
