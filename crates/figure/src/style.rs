//! The look of every figure, in one place: sizes on paper, line widths, type sizes, colours.
//!
//! Colours are told apart by eyes of every kind and in grey print: the nine of the periods have three steps
//! of lightness, and what has one step has another number of strokes across its line. Nothing is said by
//! colour alone where a line style or a mark can say it.

use crate::{Bifurcation, FrequencyUnit, MotionKind, stretch::LineLook};

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

/// Colour of a kind of motion that is not certain.
const DOUBTFUL: &str = "#898989";

/// Colours of initial states that no motion was computed from, and of those that cannot be: they lie behind a
/// rigid stop.
pub(crate) const NOT_COMPUTED: &str = INK;
pub(crate) const IMPOSSIBLE: &str = "#b6b4be";

/// Colour of a kind of motion: dark where it repeats, light where not.
pub(crate) fn kind_colour(kind: MotionKind) -> &'static str {
    match kind {
        MotionKind::Periodic { .. } => PERIOD_COLOURS[0],
        MotionKind::QuasiPeriodic => PERIOD_COLOURS[2],
        MotionKind::Chaotic => PERIOD_COLOURS[1],
        MotionKind::Doubtful => DOUBTFUL,
    }
}

/// Colour of what belongs to stable, marginal or unstable solutions.
pub(crate) fn stability_colour(line: LineLook) -> &'static str {
    PERIOD_COLOURS[match line {
        LineLook::Stable => 0,
        LineLook::Unstable => 1,
        LineLook::Marginal => 2,
    }]
}

/// Colours of period multiples 1, 2, 3 and so on; later ones start again. Dark, medium and light by turns.
const PERIOD_COLOURS: [&str; 9] = [
    "#262d72", "#b24b13", "#4bb897", // without strokes
    "#681505", "#726587", "#cd8ee3", // with one
    "#512834", "#3864d1", "#86b361", // with two
];

/// Steps of lightness among the colours of periods.
const LIGHTNESSES: usize = 3;

/// Colour of a line that is alone.
pub(crate) const PERIOD_COLOUR: &str = PERIOD_COLOURS[0];

/// How the lines of a period look, stable or not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PeriodLook {
    pub(crate) colour: &'static str,
    /// Short strokes across the line, in groups of so many along it.
    pub(crate) strokes: usize,
}

/// The look of the solutions that repeat after so many excitation periods.
pub(crate) fn period_look(period_multiple: u32) -> PeriodLook {
    let place = (period_multiple.max(1) as usize - 1) % PERIOD_COLOURS.len();
    PeriodLook { colour: PERIOD_COLOURS[place], strokes: place / LIGHTNESSES }
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
        "periods": periods, "strokes": strokes, "ink": ink, "pale": pale, "grid": grid, "paper": paper, "panel": panel, "shade": shade,
    })
}

/// Colour and dashes of a line; `None` for a solid one, else the lengths of a dash and of the gap behind it
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
    /// Length of a dash and of the gap behind it (pt).
    pub dash: (f64, f64),
    /// The same of marginal lines, which are dotted (pt).
    pub dots: (f64, f64),
    /// Width of the frame and the ticks (pt).
    pub frame_width: f64,
    /// Length of a major tick (pt); a minor one has half of it.
    pub tick_length: f64,
    /// Radius of a mark (pt).
    pub mark_radius: f64,
    /// Least distance between two marks of a kind (pt); nearer ones are left out. Grazing marks keep half as
    /// much again.
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

    /// Linear red, green and blue of a colour in sRGB (IEC 61966-2-1).
    fn linear(colour: &str) -> [f64; 3] {
        [1, 3, 5].map(|at| {
            let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        })
    }

    fn times(matrix: &[[f64; 3]; 3], [a, b, c]: [f64; 3]) -> [f64; 3] {
        matrix.map(|[x, y, z]| x * a + y * b + z * c)
    }

    /// CIE L*, a*, b* of linear red, green and blue, white being that of sRGB (D65).
    fn lab(linear: [f64; 3]) -> [f64; 3] {
        const TO_XYZ: [[f64; 3]; 3] = [
            [0.412_456_4, 0.357_576_1, 0.180_437_5],
            [0.212_672_9, 0.715_152_2, 0.072_175_0],
            [0.019_333_9, 0.119_192_0, 0.950_304_1],
        ];
        let (xyz, white) = (times(&TO_XYZ, linear), times(&TO_XYZ, [1.0; 3]));
        let [x, y, z] = std::array::from_fn(|k| {
            let share: f64 = xyz[k] / white[k];
            if share > 216.0 / 24389.0 { share.cbrt() } else { (24389.0 / 27.0 * share + 16.0) / 116.0 }
        });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// CIE lightness L* of a colour, 0 (black) to 100 (white).
    fn lightness(colour: &str) -> f64 {
        lab(linear(colour))[0]
    }

    /// What eyes see: all three kinds of cones, without those for long, medium or short waves. Machado,
    /// Oliveira and Fernandes, IEEE Trans. Visualization and Computer Graphics 15 (2009), 1291-1298,
    /// severity 1.
    const EYES: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    ];

    /// Least distance of two colours in CIE L*a*b* (1976) to any eyes; about 2 is the least that can be seen
    /// side by side.
    fn distance(one: &str, other: &str) -> f64 {
        let seen = |eyes: &[[f64; 3]; 3], colour| {
            lab(times(eyes, linear(colour)).map(|part: f64| part.clamp(0.0, 1.0)))
        };
        let apart = EYES.iter().map(|eyes| {
            let [a, b] = [seen(eyes, one), seen(eyes, other)];
            (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
        });
        apart.fold(f64::INFINITY, f64::min)
    }

    fn pairs(count: u32) -> impl Iterator<Item = (u32, u32)> {
        (1..=count).flat_map(|one| (1..one).map(move |other| (other, one)))
    }

    #[test]
    fn lightness_and_distance_are_those_of_the_standard() {
        for (colour, wanted) in [("#000000", 0.0), ("#ffffff", 100.0), ("#777777", 50.03)] {
            assert!((lightness(colour) - wanted).abs() < 0.02, "{colour}"); // as printed in tables of sRGB
        }
        assert!((distance("#000000", "#ffffff") - 100.0).abs() < 0.02);
        // Red and green of one lightness, which dichromats without red cones confuse.
        let (normal, confused) = (lab(linear("#c04040")), distance("#c04040", "#757520"));
        assert!(normal[1] > 40.0 && confused < 30.0);
    }

    /// In grey print a period is known by its lightness or by its strokes, to all eyes by its colour.
    #[test]
    fn every_two_of_nine_periods_are_told_apart_in_grey_print_and_by_all_eyes() {
        for (one, other) in pairs(9) {
            let [a, b] = [one, other].map(period_look);
            let apart = (lightness(a.colour) - lightness(b.colour)).abs();
            assert!(a.strokes != b.strokes || apart > 20.0, "{one} and {other}: {apart}");
            assert!(distance(a.colour, b.colour) > 20.0, "{one} and {other}");
        }
        for colour in PERIOD_COLOURS {
            assert!(lightness(colour) < 72.0, "{colour} is too pale for a thin line");
        }
    }

    /// Numbered lines differ in their dashes, curves of bifurcations as well.
    #[test]
    fn no_two_numbered_lines_have_the_same_dashes() {
        let kinds = [Bifurcation::Fold, Bifurcation::Flip, Bifurcation::NeimarkSacker, Bifurcation::Grazing];
        for (one, other) in pairs(6) {
            let [a, b] = [one, other].map(|number| line_pattern(number as usize - 1));
            assert!(a.dashes != b.dashes && distance(a.colour, b.colour) > 20.0, "{one} and {other}");
        }
        for (one, other) in pairs(4) {
            let [a, b] = [one, other].map(|number| bifurcation_pattern(kinds[number as usize - 1]));
            assert!(a.dashes != b.dashes && distance(a.colour, b.colour) > 20.0, "{one} and {other}");
        }
    }

    /// Kinds of motion and areas are told by a colour alone: by its lightness.
    #[test]
    fn fills_are_told_apart_in_grey_print() {
        let kinds = MotionKind::ALL.map(kind_colour);
        let cells = [&FILLS[..], &[NOT_COMPUTED, IMPOSSIBLE]].concat();
        for colours in [&kinds[..], &cells[..]] {
            for (one, other) in pairs(colours.len() as u32) {
                let [a, b] = [one, other].map(|number| colours[number as usize - 1]);
                let apart = (lightness(a) - lightness(b)).abs();
                assert!(apart > 7.5 && distance(a, b) > 10.0, "{a} and {b}: {apart}, {}", distance(a, b));
            }
        }
    }

    #[test]
    fn every_colour_of_a_period_stands_out_on_a_dark_page() {
        for colour in PERIOD_COLOURS_DARK {
            assert!(lightness(colour) > 65.0, "{colour} is too dark for a thin line");
        }
        for (one, other) in pairs(9) {
            let [a, b] = [one, other].map(|number| PERIOD_COLOURS_DARK[number as usize - 1]);
            assert!(distance(a, b) > 15.0, "{a} and {b}");
        }
    }

    #[test]
    fn every_period_has_a_look() {
        assert_eq!(period_look(0), period_look(1));
        assert_eq!(period_look(10), period_look(1));
        assert_ne!(period_look(2), period_look(3));
    }
}
