//! The path of a point in its round hole, seen along the axis of the hole, with its contacts.

use std::f64::consts::TAU;

use crate::{
    chart::{Chart, ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    style::{INK, PALE_INK, Pattern, Style, line_pattern},
    text::plain_number,
};

/// Room around the circle and the path, as a part of the larger radius.
const ROOM: f64 = 1.1;
/// Sides of the circle.
const SIDES: u32 = 360;

/// A round hole and the path of a point in it over the period of an orbit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HoleDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Orbit period over excitation period, from 1.
    pub period_multiple: u32,
    /// How far the point moves before it touches (m).
    pub clearance_m: f64,
    /// Names of the two displacements across the axis of the hole.
    pub names: [String; 2],
    /// These displacements at equal steps over the period from phase 0 on, its end left out (m).
    pub path_m: Vec<[f64; 2]>,
}

impl HoleDiagram {
    /// The path in the circle of the clearance, with the parts in contact and where contacts begin.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where there are no finite samples.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let radii = || self.path_m.iter().map(|at| radius(*at)).filter(|radius| radius.is_finite());
        let Some(largest) = radii().reduce(f64::max) else {
            let points = self.path_m.len();
            return Err(FigureError::Empty { quantity: "displacement in the hole", curves: 1, points });
        };
        let frame = 1e3 * ROOM * largest.max(self.clearance_m);
        let (pieces, touches) = (self.pieces(), self.touches());
        let circle = (0..=SIDES).map(|k| f64::from(k) / f64::from(SIDES) * TAU);
        let circle =
            circle.map(|angle| in_mm([self.clearance_m * angle.cos(), self.clearance_m * angle.sin()]));
        let wall = Pattern { colour: PALE_INK, dashes: None };
        let pressed = Pattern { dashes: None, ..line_pattern(1) };
        let touch = Dot { shape: Shape::Circle, colour: pressed.colour, full: false, radius: 1.6 };
        let start = Dot { shape: Shape::Circle, colour: INK, full: true, radius: 1.6 };
        let (count, multiple) = (self.path_m.len(), self.period_multiple.max(1) as usize);
        let at_phase_0 = (0..multiple).filter_map(|k| self.path_m.get(k * count / multiple));
        let layers = vec![
            Layer::Levels { at: vec![0.0] },
            Layer::Uprights { at: vec![0.0] },
            Layer::Line { points: circle.collect(), pattern: wall },
            Layer::Line { points: line(&pieces, false), pattern: line_pattern(0) },
            Layer::Line { points: line(&pieces, true), pattern: pressed },
            Layer::Dots { points: touches.iter().copied().map(in_mm).collect(), dot: touch },
            Layer::Dots { points: at_phase_0.copied().map(in_mm).collect(), dot: start },
        ];
        let has = |in_contact: bool| pieces.iter().any(|piece| piece.in_contact == in_contact);
        let of_line = |pattern| LegendSample::Pattern(pattern);
        let entries = [
            (true, of_line(wall), "clearance"),
            (has(false), of_line(line_pattern(0)), "path without contact"),
            (has(true), of_line(pressed), "path in contact"),
            (!touches.is_empty(), LegendSample::Dot(touch), "contact begins"),
            (true, LegendSample::Dot(start), "phase 0 of the excitation"),
        ];
        let legend = entries.into_iter().filter(|(is_there, ..)| *is_there);
        let legend = legend.map(|(_, sample, name)| LegendEntry { sample, name: name.to_owned() });
        let measure = |name: &str| Measure::new(format!("{name} (mm)")).between((-frame, frame));
        let [x, y] = self.names.each_ref().map(|name| measure(name));
        let panel = ChartPanel { quantity: "displacement in the hole", y, layers, heading: String::new() };
        let description = self.description(largest, touches.len(), has(false), style);
        Chart {
            title: self.title.clone(),
            x,
            panels: vec![panel],
            legend: vec![legend.collect()],
            description,
            aspect: Some(1.0),
        }
        .draw(style)
    }

    fn description(&self, largest: f64, touches: usize, is_ever_free: bool, style: &Style) -> String {
        let mm = |metres: f64| plain_number(format!("{:.3e}", 1e3 * metres).parse().unwrap_or(f64::NAN));
        let contacts = match (touches, is_ever_free) {
            (_, false) => "in contact all the time".to_owned(),
            (0, _) => "without contact".to_owned(),
            (1, _) => "1 contact".to_owned(),
            (count, _) => format!("{count} contacts"),
        };
        format!(
            "path of the centre in a round hole with a clearance of {} mm, at {}, period {}, {contacts}; \
             largest displacement {} mm",
            mm(self.clearance_m),
            style.frequency_unit.words(self.frequency_hz),
            self.period_multiple,
            mm(largest)
        )
    }

    /// The closed path in pieces with and without contact.
    fn pieces(&self) -> Vec<Piece> {
        let mut pieces: Vec<Piece> = Vec::new();
        let closed = self.path_m.iter().chain(self.path_m.first());
        let mut before: Option<[f64; 2]> = None;
        for &at in closed {
            let in_contact = self.is_contact(at);
            let crossing = before.filter(|other| self.is_contact(*other) != in_contact);
            let edge = crossing.map(|other| self.crossing(other, at));
            match pieces.last_mut() {
                Some(piece) if edge.is_none() => piece.points.push(at),
                last => {
                    if let (Some(piece), Some(edge)) = (last, edge) {
                        piece.points.push(edge);
                    }
                    pieces.push(Piece { in_contact, points: edge.into_iter().chain([at]).collect() });
                }
            }
            before = Some(at);
        }
        pieces
    }

    /// Where contacts begin.
    fn touches(&self) -> Vec<[f64; 2]> {
        let next = self.path_m.iter().skip(1).chain(self.path_m.first());
        let pairs = self.path_m.iter().zip(next);
        let begins = pairs.filter(|(from, to)| !self.is_contact(**from) && self.is_contact(**to));
        begins.map(|(from, to)| self.crossing(*from, *to)).collect()
    }

    fn is_contact(&self, at: [f64; 2]) -> bool {
        radius(at) > self.clearance_m
    }

    /// The point between two samples that is on the circle, as far as the radius changes evenly.
    fn crossing(&self, from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
        let part = (self.clearance_m - radius(from)) / (radius(to) - radius(from));
        std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))
    }
}

/// A stretch of the path.
struct Piece {
    in_contact: bool,
    points: Vec<[f64; 2]>,
}

fn radius([y, z]: [f64; 2]) -> f64 {
    y.hypot(z)
}

fn in_mm([y, z]: [f64; 2]) -> (f64, f64) {
    (1e3 * y, 1e3 * z)
}

/// The pieces of one kind, with gaps between them.
fn line(pieces: &[Piece], in_contact: bool) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for piece in pieces.iter().filter(|piece| piece.in_contact == in_contact) {
        points.extend(piece.points.iter().copied().map(in_mm));
        points.push((f64::NAN, f64::NAN));
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `(3 cos t, 2 sin t)` leaves a circle of the radius 2.5 where `5 cos^2 t = 2.25`.
    #[test]
    fn an_ellipse_touches_twice_where_its_radius_is_the_clearance() {
        let at = |k: u32| {
            let t = f64::from(k) / 1000.0 * TAU;
            [3.0 * t.cos(), 2.0 * t.sin()]
        };
        let path_m: Vec<[f64; 2]> = (0..1000).map(at).collect();
        let hole = HoleDiagram { clearance_m: 2.5, path_m, period_multiple: 1, ..HoleDiagram::default() };
        let cos = (2.25_f64 / 5.0).sqrt();
        let sin = (1.0 - cos * cos).sqrt();
        let touches = hole.touches();
        let expected = [[-3.0 * cos, 2.0 * sin], [3.0 * cos, -2.0 * sin]];
        assert_eq!(touches.len(), 2);
        for (touch, expected) in touches.iter().zip(expected) {
            assert!(radius([touch[0] - expected[0], touch[1] - expected[1]]) < 1e-4, "{touch:?}");
        }
        // Contact at the ends of the long axis, that on the right cut in two by phase 0.
        let pieces = hole.pieces();
        let in_contact: Vec<bool> = pieces.iter().map(|piece| piece.in_contact).collect();
        assert_eq!(in_contact, [true, false, true, false, true]);
        for pair in pieces.windows(2) {
            assert_eq!(pair[0].points.last(), pair[1].points.first(), "pieces are joined");
        }
        assert_eq!(pieces[4].points.last(), Some(&[3.0, 0.0]), "the path is closed");
    }

    #[test]
    fn figures_say_what_the_path_does() {
        let circle = |radius_m: f64| HoleDiagram {
            frequency_hz: 12.0,
            period_multiple: 1,
            clearance_m: 0.5e-3,
            names: ["tube.y".to_owned(), "tube.z".to_owned()],
            path_m: (0..64)
                .map(|k| f64::from(k) / 64.0 * TAU)
                .map(|t| [radius_m * t.cos(), radius_m * t.sin()])
                .collect(),
            ..HoleDiagram::default()
        };
        let style = Style::single_column();
        let (free, whirl) = (circle(0.4e-3).draw(&style).unwrap(), circle(0.52e-3).draw(&style).unwrap());
        assert!(free.description().contains("clearance of 0.5 mm, at 12 Hz, period 1, without contact"));
        assert!(free.description().ends_with("largest displacement 0.4 mm"), "{}", free.description());
        assert!(whirl.description().contains("in contact all the time"), "{}", whirl.description());
        let (free, whirl) = (free.svg(), whirl.svg());
        assert!(free.contains(">tube.y (mm)<") && free.contains(">path without contact<"));
        assert!(!free.contains(">path in contact<") && !free.contains(">contact begins<"));
        assert!(whirl.contains(">path in contact<") && !whirl.contains(">path without contact<"));
        let empty = HoleDiagram { path_m: vec![[f64::NAN; 2]], ..circle(1.0) };
        assert!(empty.draw(&style).unwrap_err().to_string().contains("no finite displacement in the hole"));
    }
}
