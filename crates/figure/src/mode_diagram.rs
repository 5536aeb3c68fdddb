//! The mode shapes of a structure, each in a band of its own with its frequency, its points and the stops.
//!
//! Shapes are relative to the support and scaled to the same largest displacement. Between the places of a
//! beam the line is a cubic with slopes by differences; at an end with fixed rotation the slope is zero.

use crate::{
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    font::CAPITAL_HEIGHT,
    frequency_unit::FrequencyUnit,
    plot::lettering,
    sketch::{Behind, at, wall},
    style::{GRID, INK, PALE_INK, PERIOD_COLOUR, Style},
    svg::{Anchor, Dashes, PagePoint, Stroke, SvgWriter, points},
    text::{Text, cut, decimal, wrap},
};

/// Largest number of modes that are drawn.
const MOST: usize = 8;
/// Height of a band without its heading, and largest displacement in it (pt).
const BAND: f64 = 34.0;
const LARGEST: f64 = 11.0;
const MARGIN: f64 = 3.0;
/// Distance of a stop from the largest displacement (pt).
const CLEAR: f64 = 4.0;
/// Room next to the outer masses of a lumped structure (pt).
const OUTER: f64 = 24.0;
/// Room next to the shape for the supports of its ends (pt).
const SIDE: f64 = 12.0;
/// Points drawn between two places of a beam.
const BETWEEN: usize = 6;

/// The modes of a structure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ModeDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// Whether a line joins the places: a beam, not masses.
    pub is_beam: bool,
    /// Places of the structure along it, ascending (m, or numbers of masses).
    pub places: Vec<f64>,
    /// For the left and the right end of a beam: whether it is supported, and whether its rotation is fixed.
    pub ends: [(bool, bool); 2],
    /// Named points: where, and the name.
    pub points: Vec<(f64, String)>,
    /// Stops: where, and whether on the side of positive displacements.
    pub stops: Vec<(f64, bool)>,
    /// The modes, the lowest first.
    pub modes: Vec<DrawnMode>,
}

/// A mode.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DrawnMode {
    /// Eigenfrequency (Hz); 0 for a motion as a rigid body.
    pub frequency_hz: f64,
    /// The same before the reduction (Hz), if there was one.
    pub unreduced_hz: Option<f64>,
    /// Displacement of each place, in any unit.
    pub shape: Vec<f64>,
}

impl ModeDiagram {
    /// The figure; of many modes the lowest eight.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no mode has a finite shape over the places.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let is_whole = |mode: &&DrawnMode| {
            mode.shape.len() == self.places.len() && mode.shape.iter().all(|value| value.is_finite())
        };
        let modes: Vec<(usize, &DrawnMode)> =
            (1..).zip(&self.modes).filter(|(_, mode)| is_whole(mode)).take(MOST).collect();
        if modes.is_empty() || self.places.is_empty() {
            return Err(FigureError::Empty {
                quantity: "mode shape",
                curves: self.modes.len(),
                points: self.places.len(),
            });
        }
        let width = points(style.width_mm);
        let title = wrap(&self.title, style.label_size, width - 2.0 * MARGIN);
        let heading = 1.5 * style.tick_size;
        let names = if self.points.is_empty() { 0.0 } else { heading };
        let top = MARGIN + 1.5 * style.label_size * title.len() as f64 + names;
        let more = if self.modes.len() > modes.len() {
            format!("The lowest {} of {} modes.", modes.len(), self.modes.len())
        } else {
            String::new()
        };
        let foot = if more.is_empty() { 0.0 } else { heading };
        let height = top + modes.len() as f64 * (BAND + heading) + foot + MARGIN;
        let description = self.description(&modes, style.frequency_unit);
        let mut svg = SvgWriter::new(style.width_mm, height * 25.4 / 72.0, &self.title, &description);
        for (i, line) in title.iter().enumerate() {
            let y = MARGIN + 1.5 * i as f64 * style.label_size + CAPITAL_HEIGHT * style.label_size;
            svg.text(at(MARGIN, y), line, lettering(style.label_size, Anchor::Start));
        }
        self.draw_names(&mut svg, top, style);
        for (row, (number, mode)) in modes.iter().enumerate() {
            let y = top + row as f64 * (BAND + heading);
            svg.text(
                at(MARGIN, y + 0.75 * heading),
                &Text::upright(words(*number, mode, style.frequency_unit)),
                lettering(style.tick_size, Anchor::Start),
            );
            self.draw_mode(&mut svg, mode, y + heading + 0.5 * BAND, style);
        }
        let y = height - MARGIN;
        svg.text(at(MARGIN, y), &Text::upright(more), lettering(style.tick_size, Anchor::Start));
        Ok(Figure::new(svg.finish(), description, style.width_mm, height * 25.4 / 72.0))
    }

    fn description(&self, modes: &[(usize, &DrawnMode)], unit: FrequencyUnit) -> String {
        let of: Vec<String> = modes.iter().map(|(number, mode)| words(*number, mode, unit)).collect();
        format!("shapes of {} modes: {}", modes.len(), of.join("; "))
    }

    /// Where a place is across the page.
    fn across(&self, place: f64, style: &Style) -> f64 {
        let side = MARGIN + SIDE + if self.is_beam { 0.0 } else { OUTER };
        let (left, right) = (side, points(style.width_mm) - side);
        let (first, last) = (self.places[0], self.places[self.places.len() - 1]);
        if last > first {
            left + (right - left) * (place - first) / (last - first)
        } else {
            0.5 * (left + right)
        }
    }

    /// Names above the first band; a name that would overlap another is left out.
    fn draw_names(&self, svg: &mut SvgWriter, top: f64, style: &Style) {
        let mut taken = f64::NEG_INFINITY;
        let mut sorted: Vec<&(f64, String)> =
            self.points.iter().filter(|point| point.0.is_finite()).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (place, name) in sorted {
            let x = self.across(*place, style);
            let name = cut(name, style.tick_size, points(style.width_mm) - 2.0 * MARGIN);
            let half = 0.5 * name.width(style.tick_size);
            let middle = x.min(points(style.width_mm) - MARGIN - half).max(MARGIN + half);
            if middle - half > taken + 2.0 {
                svg.text(at(middle, top - 2.0), &name, lettering(style.tick_size, Anchor::Middle));
                taken = middle + half;
            }
        }
    }

    fn draw_mode(&self, svg: &mut SvgWriter, mode: &DrawnMode, middle: f64, style: &Style) {
        let largest = mode.shape.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let factor = if largest > 0.0 { LARGEST / largest } else { 0.0 };
        let up = |value: f64| middle - factor * value;
        let first = self.across(self.places[0], style);
        let last = self.across(self.places[self.places.len() - 1], style);
        let guide = |place: f64| {
            let x = self.across(place, style);
            [at(x, middle - 0.5 * BAND), at(x, middle + 0.5 * BAND)]
        };
        let guides: Vec<[PagePoint; 2]> = self.points.iter().map(|(place, _)| guide(*place)).collect();
        let pale = Stroke { colour: GRID, width: 0.7 };
        svg.polylines(guides.iter().map(|guide| (guide.as_slice(), None)), pale);
        let rest = Some(Dashes { dash: 1.5, gap: 1.5, offset: 0.0 });
        let ends = if self.is_beam {
            [at(first, middle), at(last, middle)]
        } else {
            [at(first - OUTER, middle), at(last + OUTER, middle)]
        };
        svg.polylines([(ends.as_slice(), rest)], Stroke { colour: PALE_INK, width: style.frame_width });
        for (place, above) in &self.stops {
            let x = self.across(*place, style);
            let (y, shape) = if *above {
                (middle - LARGEST - CLEAR, Shape::TriangleDown)
            } else {
                (middle + LARGEST + CLEAR, Shape::TriangleUp)
            };
            Dot { shape, colour: PALE_INK, full: true, radius: 2.0 }.draw(svg, &[at(x, y)]);
        }
        let places: Vec<PagePoint> = self
            .places
            .iter()
            .zip(&mode.shape)
            .map(|(place, value)| at(self.across(*place, style), up(*value)))
            .collect();
        let stroke = Stroke { colour: PERIOD_COLOUR, width: 1.2 };
        if self.is_beam {
            svg.polyline(&curve(&places, [self.ends[0].1, self.ends[1].1]), stroke);
            self.draw_ends(svg, (first, last), middle);
        } else {
            let stems: Vec<[PagePoint; 2]> =
                places.iter().map(|place| [at(place.x, middle), *place]).collect();
            svg.polylines(stems.iter().map(|stem| (stem.as_slice(), None)), stroke);
        }
        let dot = Dot { shape: Shape::Circle, colour: INK, full: true, radius: 1.7 };
        let named: Vec<PagePoint> =
            self.points.iter().filter_map(|(place, _)| self.nearest(*place).map(|k| places[k])).collect();
        dot.draw(svg, if self.is_beam { &named } else { &places });
    }

    fn draw_ends(&self, svg: &mut SvgWriter, (first, last): (f64, f64), middle: f64) {
        for (x, (is_held, _), behind) in
            [(first, self.ends[0], Behind::Left), (last, self.ends[1], Behind::Right)]
        {
            if is_held {
                wall(svg, at(x, middle - 6.0), at(x, middle + 6.0), behind);
            }
        }
    }

    /// The place nearest to a position.
    fn nearest(&self, position: f64) -> Option<usize> {
        let distance = |k: &usize| (self.places[*k] - position).abs();
        (0..self.places.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }
}

fn words(number: usize, mode: &DrawnMode, unit: FrequencyUnit) -> String {
    let unit = unit.up_to(mode.frequency_hz);
    let (symbol, shown) = (unit.symbol, |hertz: f64| five_digits(unit.factor * hertz));
    let unreduced = match mode.unreduced_hz {
        Some(full) if mode.frequency_hz > 0.0 => format!(" (unreduced {} {symbol})", shown(full)),
        _ => String::new(),
    };
    if mode.frequency_hz == 0.0 {
        format!("Mode {number}: 0 {symbol}, moves as a rigid body")
    } else {
        format!("Mode {number}: {} {symbol}{unreduced}", shown(mode.frequency_hz))
    }
}

/// A number with five significant digits.
fn five_digits(value: f64) -> String {
    let whole = if value > 0.0 { value.log10().floor() as i32 + 1 } else { 1 };
    decimal(value, (5 - whole).clamp(0, 6) as usize)
}

/// A smooth line through places.
fn curve(places: &[PagePoint], is_level: [bool; 2]) -> Vec<PagePoint> {
    let last = places.len() - 1;
    let slope = |k: usize| {
        if (k == 0 && is_level[0]) || (k == last && is_level[1]) {
            return 0.0;
        }
        let (before, after) = (places[k.saturating_sub(1)], places[(k + 1).min(last)]);
        (after.y - before.y) / (after.x - before.x).max(1e-9)
    };
    let mut line = vec![places[0]];
    for k in 0..last {
        let (from, to) = (places[k], places[k + 1]);
        let (length, slopes) = (to.x - from.x, [slope(k), slope(k + 1)]);
        for step in 1..=BETWEEN {
            let s = step as f64 / BETWEEN as f64;
            let r = 1.0 - s;
            let value = from.y * r * r * (1.0 + 2.0 * s)
                + to.y * s * s * (1.0 + 2.0 * r)
                + length * s * r * (slopes[0] * r - slopes[1] * s);
            line.push(at(from.x + s * length, value));
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic whose slopes are known at both ends is met at the places and has the slope asked for.
    #[test]
    fn the_line_meets_every_place_and_is_level_where_it_cannot_turn() {
        let places: Vec<PagePoint> = (0..9).map(|k| at(f64::from(k), f64::from(k).powi(2))).collect();
        let line = curve(&places, [true, false]);
        for place in &places {
            assert!(
                line.iter()
                    .any(|point| (point.x - place.x).abs() < 1e-12 && (point.y - place.y).abs() < 1e-12)
            );
        }
        // Inside, central differences of a parabola are its slopes, so the line is the parabola.
        assert!(line.iter().filter(|p| p.x >= 1.0 && p.x <= 7.0).all(|p| (p.y - p.x * p.x).abs() < 1e-12));
        assert!((line[1].y - line[0].y).abs() < 0.1, "level at the clamp");
    }

    #[test]
    fn frequencies_have_five_digits() {
        assert_eq!(five_digits(17.495_46), "17.495");
        assert_eq!(five_digits(1538.8499), "1538.8");
        assert_eq!(five_digits(0.159_154_9), "0.15915");
    }
}
