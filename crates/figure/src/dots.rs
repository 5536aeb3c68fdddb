//! Dots: solutions and motions without lines, distinguished by shape and colour.

use std::collections::HashSet;

use crate::{
    marks::{circle, square, triangle},
    style::PAPER,
    svg::{PagePoint, Stroke, SvgWriter, number},
};

/// Shape of a dot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// The smallest visible dot, for clouds of thousands.
    Speck,
    Circle,
    Square,
    TriangleUp,
    TriangleDown,
}

/// How a dot looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dot {
    pub(crate) shape: Shape,
    pub(crate) colour: &'static str,
    /// Full, or an outline on paper.
    pub(crate) full: bool,
    /// Radius (pt).
    pub(crate) radius: f64,
}

impl Dot {
    /// Draws the dot at each place; of dots that coincide to the pixel one is drawn.
    pub(crate) fn draw(self, svg: &mut SvgWriter, places: &[PagePoint]) {
        let mut taken = HashSet::new();
        let apart = 0.25 * self.radius;
        let is_new =
            |at: &&PagePoint| taken.insert(((at.x / apart).round() as i64, (at.y / apart).round() as i64));
        let data: String = places.iter().filter(is_new).map(|&at| self.outline(at)).collect();
        if data.is_empty() {
            return;
        }
        let fill = if self.full { self.colour } else { PAPER };
        let width = if self.shape == Shape::Speck { 0.0 } else { 0.5 };
        svg.path(&data, fill, Stroke { colour: self.colour, width });
    }

    fn outline(self, at: PagePoint) -> String {
        let r = self.radius;
        match self.shape {
            Shape::Speck => square(at, r),
            Shape::Circle => circle(at, r),
            Shape::Square => square(at, 0.9 * r),
            Shape::TriangleUp => triangle(at, 1.25 * r),
            Shape::TriangleDown => triangle_down(at, 1.25 * r),
        }
    }
}

fn triangle_down(at: PagePoint, radius: f64) -> String {
    let (half, height) = (radius * 0.75f64.sqrt(), 1.5 * radius);
    let start = format!("M{} {}", number(at.x), number(at.y + radius));
    format!("{start}l-{} -{}h{}z", number(half), number(height), number(2.0 * half))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_that_cover_each_other_are_drawn_once() {
        let dot = Dot { shape: Shape::Speck, colour: "#000000", full: true, radius: 0.4 };
        let mut svg = SvgWriter::new(10.0, 10.0, "", "");
        let at = |x: f64| PagePoint { x, y: 1.0 };
        dot.draw(&mut svg, &[at(1.0), at(1.0), at(1.001), at(2.0)]);
        assert_eq!(svg.finish().text.matches('M').count(), 2);
    }
}
