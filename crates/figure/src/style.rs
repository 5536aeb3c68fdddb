//! The look of every figure, in one place: sizes on paper, line widths, type sizes, colours.
//!
//! Colours are distinguishable with any colour vision and in grey print: the nine colours of the periods have
//! three levels of lightness, and those of equal lightness differ in the strokes across their lines. Each has
//! a contrast of at least 3:1 with the paper (WCAG 2.2, 1.4.11). Colour is never the only distinction where a
//! line style or a mark can be used.

use crate::{bifurcation::Bifurcation, frequency_unit::FrequencyUnit, motion::MotionKind, stretch::LineLook};

/// Colour of text, frames and marks.
pub(crate) const INK: &str = "#222222";
/// Colour of marks behind the data.
pub(crate) const PALE_INK: &str = "#7d7d7d";
/// Colour of lines that must not compete with data.
pub(crate) const GRID: &str = "#e3e3e3";
/// Colour of the paper, inside open marks.
pub(crate) const PAPER: &str = "#ffffff";

/// Colour of shaded ranges behind the data.
pub(crate) const SHADE: &str = "#f8ebd5";

/// Fills of areas, distinguishable in grey print by their lightness; repeated from the start after the last.
const FILLS: [&str; 6] = ["#2b4f87", "#f2c38a", "#5fae96", "#a0476b", "#dfe6ee", "#8c8c3a"];

/// Colour of the area with that number, from 0.
pub(crate) fn fill(number: usize) -> &'static str {
    FILLS[number % FILLS.len()]
}

/// Pattern of the line with a number, from 0: distinguished by colour and dashes.
pub(crate) fn line_pattern(number: usize) -> Pattern {
    const DASHES: [Option<(f64, f64)>; 6] =
        [None, Some((5.0, 1.6)), Some((2.6, 1.4)), Some((1.2, 1.2)), Some((7.0, 2.5)), Some((0.8, 2.0))];
    let place = number % DASHES.len();
    Pattern { colour: PERIOD_COLOURS[place], dashes: DASHES[place] }
}

/// Colour of a doubtful motion.
const DOUBTFUL: &str = "#757575";

/// Colours of initial states without a computed motion, and of impossible ones behind a rigid stop.
pub(crate) const NOT_COMPUTED: &str = INK;
pub(crate) const IMPOSSIBLE: &str = "#b6b4be";

/// Colour of a kind of motion: dark if it repeats, light otherwise.
pub(crate) fn kind_colour(kind: MotionKind) -> &'static str {
    match kind {
        MotionKind::Periodic { .. } => PERIOD_COLOURS[0],
        MotionKind::QuasiPeriodic => PERIOD_COLOURS[2],
        MotionKind::Chaotic => PERIOD_COLOURS[1],
        MotionKind::Doubtful => DOUBTFUL,
    }
}

/// Colour of stable, marginal or unstable solutions.
pub(crate) fn stability_colour(line: LineLook) -> &'static str {
    PERIOD_COLOURS[match line {
        LineLook::Stable => 0,
        LineLook::Unstable => 1,
        LineLook::Marginal => 2,
    }]
}

/// Colours of period multiples 1, 2, 3 and so on, repeated after the last: dark, medium and light alternate.
const PERIOD_COLOURS: [&str; 9] = [
    "#23276a", "#ae3509", "#2ca68a", // without strokes
    "#5f1301", "#69587b", "#b87ecf", // with one
    "#492331", "#045bc5", "#7b9f59", // with two
];

/// Steps of lightness among the colours of periods.
const LIGHTNESSES: usize = 3;

/// Colour of a single line.
pub(crate) const PERIOD_COLOUR: &str = PERIOD_COLOURS[0];

/// How the lines of a period look, stable or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PeriodLook {
    pub(crate) colour: &'static str,
    /// Number of short strokes in each group across the line.
    pub(crate) strokes: usize,
}

/// The look of solutions with a period multiple.
pub(crate) fn period_look(period_multiple: u32) -> PeriodLook {
    let place = (period_multiple.max(1) as usize - 1) % PERIOD_COLOURS.len();
    PeriodLook { colour: PERIOD_COLOURS[place], strokes: place / LIGHTNESSES }
}

/// Colours of other results behind the branches, in the order in which they are given: those of the page.
const OVERLAID_COLOURS: [&str; 4] = [PALE_INK, PERIOD_COLOURS[7], PERIOD_COLOURS[3], PERIOD_COLOURS[5]];

/// The look of the lines of other results with a place in their list: after the last colour the first comes
/// again, with one stroke more.
pub(crate) fn overlaid_look(place: usize) -> PeriodLook {
    PeriodLook {
        colour: OVERLAID_COLOURS[place % OVERLAID_COLOURS.len()],
        strokes: place / OVERLAID_COLOURS.len(),
    }
}

/// Colours of period multiples on a dark page, in the same order: the same hues, lighter.
const PERIOD_COLOURS_DARK: [&str; 9] =
    ["#71a1fb", "#fcc155", "#91fbd1", "#fd7962", "#f7d3f9", "#ba9ab4", "#f79694", "#9eb0e8", "#d7f197"];

/// Colours of the page by their names in its script.
pub(crate) fn page_colours(dark: bool) -> serde_json::Value {
    let (periods, ink, pale, grid, paper, panel, shade) = if dark {
        (PERIOD_COLOURS_DARK, "#e6e6e6", "#9a9a9a", "#33373d", "#15181c", "#1d2126", "#3a3120")
    } else {
        (PERIOD_COLOURS, INK, PALE_INK, GRID, PAPER, "#f6f7f8", SHADE)
    };
    let strokes: Vec<usize> = (1..=periods.len() as u32).map(|period| period_look(period).strokes).collect();
    serde_json::json!({
        "periods": periods, "strokes": strokes, "ink": ink, "pale": pale,
        "grid": grid, "paper": paper, "panel": panel, "shade": shade,
    })
}

/// Colour and dashes of a line; `None` for a solid one, else the lengths of a dash and of the gap after it
/// (pt).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pattern {
    pub(crate) colour: &'static str,
    pub(crate) dashes: Option<(f64, f64)>,
}

/// The line of a curve of bifurcations.
pub(crate) fn bifurcation_pattern(bifurcation: Bifurcation) -> Pattern {
    match bifurcation {
        Bifurcation::Fold => Pattern { colour: PERIOD_COLOURS[0], dashes: None },
        Bifurcation::Flip => Pattern { colour: PERIOD_COLOURS[1], dashes: Some((5.0, 1.6)) },
        Bifurcation::NeimarkSacker => Pattern { colour: PERIOD_COLOURS[3], dashes: Some((1.2, 1.2)) },
        Bifurcation::Grazing => Pattern { colour: PERIOD_COLOURS[2], dashes: Some((2.6, 1.4)) },
    }
}

/// The size of a figure and of everything in it. Lengths on paper; all but width and height in points of 1/72
/// inch.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Style {
    /// Width of the figure (mm).
    pub width_mm: f64,
    /// Height of a figure of one panel (mm); more where the label of its vertical axis would not fit.
    pub height_mm: f64,
    /// Type size of axis labels and legend (pt).
    pub label_size: f64,
    /// Type size of tick labels (pt).
    pub tick_size: f64,
    /// Width of stable lines (pt).
    pub stable_width: f64,
    /// Width of unstable lines (pt).
    pub unstable_width: f64,
    /// Length of a dash and of the gap after it (pt).
    pub dash: (f64, f64),
    /// The same for marginal lines, which are dotted (pt).
    pub dots: (f64, f64),
    /// Width of the frame and the ticks (pt).
    pub frame_width: f64,
    /// Length of a major tick (pt); a minor one has half of it.
    pub tick_length: f64,
    /// Radius of a mark (pt).
    pub mark_radius: f64,
    /// Least distance between two marks (pt); closer ones are left out. Larger marks keep more, so that none
    /// covers another; for pale marks it is half as much again.
    pub mark_distance: f64,
    /// Distance of two groups of strokes across a line, and of two strokes of a group (pt).
    pub stroke_spacing: (f64, f64),
    /// Half the length of a stroke across a line (pt).
    pub stroke_reach: f64,
    /// Greatest distance of the drawn line from the stored points (pt).
    pub line_tolerance: f64,
    /// Unit in which frequencies are shown.
    pub frequency_unit: FrequencyUnit,
}

impl Style {
    /// For two columns of a journal: 174 mm wide.
    #[must_use]
    pub fn double_column() -> Self {
        Self {
            width_mm: 174.0,
            height_mm: 95.0,
            label_size: 8.0,
            tick_size: 7.0,
            stable_width: 0.9,
            unstable_width: 0.6,
            dash: (2.6, 1.4),
            dots: (0.9, 1.3),
            frame_width: 0.5,
            tick_length: 3.0,
            mark_radius: 1.3,
            mark_distance: 2.6,
            stroke_spacing: (24.0, 1.6),
            stroke_reach: 2.2,
            line_tolerance: 0.024, // a tenth of a pixel at 300 pixels per inch
            frequency_unit: FrequencyUnit::Hertz,
        }
    }

    /// The same with frequencies in that unit.
    #[must_use]
    pub fn showing(self, frequency_unit: FrequencyUnit) -> Self {
        Self { frequency_unit, ..self }
    }

    /// With the lines of other results.
    pub(crate) fn thin(&self) -> Self {
        Self {
            stable_width: 0.6 * self.stable_width,
            unstable_width: 0.6 * self.unstable_width,
            ..self.clone()
        }
    }

    /// For one column of a journal: 84 mm wide.
    #[must_use]
    pub fn single_column() -> Self {
        Self { width_mm: 84.0, height_mm: 66.0, label_size: 7.5, tick_size: 6.5, ..Self::double_column() }
    }
}

impl Default for Style {
    fn default() -> Self {
        Self::double_column()
    }
}

#[cfg(test)]
mod tests;
