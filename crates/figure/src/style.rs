//! The look of every figure, in one place: sizes on paper, line widths, type sizes, colours.
//!
//! Colours are told apart by eyes of every kind and in grey print: those of neighbouring periods differ in
//! lightness as well as in hue. Nothing is said by colour alone where a line style or a mark can say it.

use crate::{Bifurcation, MotionKind};

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

/// Fills of areas, told apart in grey print by their lightness; later ones start again.
const FILLS: [&str; 6] = ["#2b4f87", "#f2c38a", "#5fae96", "#a0476b", "#dfe6ee", "#8c8c3a"];

/// Colour of the area with that number, from 0.
pub(crate) fn fill(number: usize) -> &'static str {
    FILLS[number % FILLS.len()]
}

/// Lines with that number, from 0: told apart by colour and by dashes.
pub(crate) fn line_pattern(number: usize) -> Pattern {
    const DASHES: [Option<(f64, f64)>; 6] =
        [None, Some((5.0, 1.6)), Some((2.6, 1.4)), Some((1.2, 1.2)), Some((7.0, 2.5)), Some((0.8, 2.0))];
    let place = number % DASHES.len();
    Pattern { colour: PERIOD_COLOURS[place], dashes: DASHES[place] }
}

/// Colour of a kind of motion: dark where it repeats, light where not.
pub(crate) fn kind_colour(kind: MotionKind) -> &'static str {
    match kind {
        MotionKind::Periodic { .. } => PERIOD_COLOURS[0],
        MotionKind::QuasiPeriodic => PERIOD_COLOURS[2],
        MotionKind::Chaotic => PERIOD_COLOURS[1],
        MotionKind::Doubtful => PALE_INK,
    }
}

/// Colour of what belongs to stable or to unstable solutions.
pub(crate) fn stability_colour(stable: bool) -> &'static str {
    PERIOD_COLOURS[usize::from(!stable)]
}

/// Colours of period multiples 1, 2, 3 and so on; later ones start again.
const PERIOD_COLOURS: [&str; 6] = ["#14356b", "#d1571b", "#3fb89b", "#7d2a8c", "#b98a10", "#6fb1e0"];

/// Colour of a line that is alone.
pub(crate) const PERIOD_COLOUR: &str = PERIOD_COLOURS[0];

/// Colour of the solutions that repeat after so many excitation periods.
pub(crate) fn period_colour(period_multiple: u32) -> &'static str {
    PERIOD_COLOURS[(period_multiple.max(1) as usize - 1) % PERIOD_COLOURS.len()]
}

/// Colours of period multiples on a dark page, in the same order: the same hues, lighter.
const PERIOD_COLOURS_DARK: [&str; 6] = ["#8db4ff", "#ff9a5e", "#56d6b8", "#d58cf0", "#e6bf4a", "#a9d4f7"];

/// Colours of the page by their names in its script.
pub(crate) fn page_colours(dark: bool) -> serde_json::Value {
    let (periods, ink, pale, grid, paper, panel, shade) = if dark {
        (PERIOD_COLOURS_DARK, "#e6e6e6", "#9a9a9a", "#33373d", "#15181c", "#1d2126", "#3a3120")
    } else {
        (PERIOD_COLOURS, INK, PALE_INK, GRID, PAPER, "#f6f7f8", SHADE)
    };
    serde_json::json!({
        "periods": periods, "ink": ink, "pale": pale, "grid": grid, "paper": paper, "panel": panel, "shade": shade,
    })
}

/// Colour and dashes of a line; `None` for a solid one, else the lengths of a dash and of the gap behind it (pt).
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
    /// Length of a dash and of the gap behind it (pt).
    pub dash: (f64, f64),
    /// Width of the frame and the ticks (pt).
    pub frame_width: f64,
    /// Length of a major tick (pt); a minor one has half of it.
    pub tick_length: f64,
    /// Radius of a mark (pt).
    pub mark_radius: f64,
    /// Least distance between two marks of a kind (pt); nearer ones are left out. Grazing marks keep half as
    /// much again.
    pub mark_distance: f64,
    /// Greatest distance of the drawn line from the stored points (pt).
    pub line_tolerance: f64,
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
            frame_width: 0.5,
            tick_length: 3.0,
            mark_radius: 1.3,
            mark_distance: 2.6,
            line_tolerance: 0.024, // a tenth of a pixel at 300 pixels per inch
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
mod tests {
    use super::*;

    /// CIE lightness L* of a colour, 0 (black) to 100 (white).
    fn lightness(colour: &str) -> f64 {
        let linear = |at: usize| {
            let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        };
        116.0 * (0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5)).cbrt() - 16.0
    }

    #[test]
    fn neighbouring_periods_differ_in_grey_print() {
        for pair in PERIOD_COLOURS.windows(2) {
            assert!((lightness(pair[0]) - lightness(pair[1])).abs() > 9.0, "{pair:?}");
        }
        for colour in PERIOD_COLOURS {
            assert!(lightness(colour) < 72.0, "{colour} is too pale for a thin line");
        }
    }

    #[test]
    fn every_colour_of_a_period_stands_out_on_a_dark_page() {
        for colour in PERIOD_COLOURS_DARK {
            assert!(lightness(colour) > 65.0, "{colour} is too dark for a thin line");
        }
    }

    #[test]
    fn every_period_has_a_colour() {
        assert_eq!(period_colour(0), period_colour(1));
        assert_eq!(period_colour(7), period_colour(1));
        assert_ne!(period_colour(2), period_colour(3));
    }
}
