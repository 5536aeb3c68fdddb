//! The mode shapes of a mesh, each in a field of its own: at rest in grey, deformed in ink.
//!
//! The mesh is seen from a corner, in parallel: with the directions x, y and z of space a place is drawn at
//! `(x - y) cos 30 deg` to the right and `z + (x + y) sin 30 deg/2` upwards. Displacements are scaled so that
//! the largest one of each mode is a fifth of the size of the mesh.

use crate::{
    error::FigureError,
    figure::Figure,
    font::CAPITAL_HEIGHT,
    plot::lettering,
    sketch::at,
    style::{GRID, INK, Style},
    svg::{Anchor, PagePoint, Stroke, SvgWriter, points},
    text::{Text, wrap},
};

/// Largest number of modes that are drawn, in so many columns.
const MOST: usize = 8;
const COLUMNS: usize = 2;
const MARGIN: f64 = 3.0;
/// Part of a field that the mesh at rest may fill, and the largest displacement of its size.
const FILLED: f64 = 0.7;
const LARGEST: f64 = 0.2;

/// A mesh with its modes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshModeDiagram {
    /// Title above the figure; may be empty.
    pub title: String,
    /// Places of the nodes (m).
    pub nodes: Vec<[f64; 3]>,
    /// Numbers of nodes that are joined, from 0.
    pub lines: Vec<[usize; 2]>,
    /// The modes, the lowest first.
    pub modes: Vec<MeshMode>,
}

/// A mode of a mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeshMode {
    /// Eigenfrequency (Hz).
    pub frequency_hz: f64,
    /// Displacement of each node, in any unit.
    pub shape: Vec<[f64; 3]>,
}

/// Where a place of space is seen.
pub(crate) fn projected([x, y, z]: [f64; 3]) -> [f64; 2] {
    [(x - y) * 0.866, z + 0.25 * (x + y)]
}

/// A drawing of a mesh in a field.
struct Field {
    /// Middle of what is seen, and points per metre.
    middle: [f64; 2],
    scale: f64,
}

impl MeshModeDiagram {
    /// The figure; of many modes the lowest eight.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where there is no line, or no mode with a displacement for each node.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let is_whole = |mode: &&MeshMode| mode.shape.len() == self.nodes.len();
        let modes: Vec<&MeshMode> = self.modes.iter().filter(is_whole).take(MOST).collect();
        let inside = |line: &[usize; 2]| line.iter().all(|node| *node < self.nodes.len());
        if modes.is_empty() || self.lines.is_empty() || !self.lines.iter().all(inside) {
            let (curves, points) = (self.modes.len(), self.nodes.len());
            return Err(FigureError::Empty { quantity: "mode shape of the mesh", curves, points });
        }
        let width = points(style.width_mm);
        let size = (width - 2.0 * MARGIN) / COLUMNS as f64;
        let title = wrap(&self.title, style.label_size, width - 2.0 * MARGIN);
        let heading = 1.5 * style.tick_size;
        let top = MARGIN + 1.5 * style.label_size * title.len() as f64;
        let rows = modes.len().div_ceil(COLUMNS);
        let height = top + rows as f64 * (0.8 * size + heading) + MARGIN;
        let unit = style.frequency_unit;
        let words = |number: usize, mode: &MeshMode| format!("{number}: {}", unit.words(mode.frequency_hz));
        let all: Vec<String> = (1..).zip(&modes).map(|(number, mode)| words(number, mode)).collect();
        let description = format!("shapes of {} modes of a mesh: {}", modes.len(), all.join("; "));
        let mut svg = SvgWriter::new(style.width_mm, height * 25.4 / 72.0, &self.title, &description);
        for (i, line) in title.iter().enumerate() {
            let y = MARGIN + 1.5 * i as f64 * style.label_size + CAPITAL_HEIGHT * style.label_size;
            svg.text(at(MARGIN, y), line, lettering(style.label_size, Anchor::Start));
        }
        let field = self.field(size);
        for (place, (mode, text)) in modes.iter().zip(all).enumerate() {
            let left = MARGIN + (place % COLUMNS) as f64 * size;
            let y = top + (place / COLUMNS) as f64 * (0.8 * size + heading);
            let label = Text::upright(text);
            svg.text(at(left, y + 0.75 * heading), &label, lettering(style.tick_size, Anchor::Start));
            let centre = at(left + 0.5 * size, y + heading + 0.4 * size);
            self.draw_mode(&mut svg, (&field, centre), mode);
        }
        Ok(Figure::new(svg.finish(), description, style.width_mm, height * 25.4 / 72.0))
    }

    /// The scale at which the mesh fills a field of this width.
    fn field(&self, size: f64) -> Field {
        let seen = || self.nodes.iter().map(|place| projected(*place));
        let ends = [0, 1].map(|axis| {
            let values = || seen().map(|place| place[axis]);
            (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
        });
        let extent = ends.iter().map(|(low, high)| high - low).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        Field { middle: ends.map(|(low, high)| 0.5 * (low + high)), scale: FILLED * 0.8 * size / extent }
    }

    fn draw_mode(&self, svg: &mut SvgWriter, (field, centre): (&Field, PagePoint), mode: &MeshMode) {
        let length = |v: &[f64; 3]| v.iter().map(|part| part * part).sum::<f64>().sqrt();
        let largest = mode.shape.iter().map(length).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let size = self.size();
        let deformed = |factor: f64| {
            let node = |(place, shape): (&[f64; 3], &[f64; 3])| {
                let moved = std::array::from_fn(|axis| place[axis] + factor * shape[axis]);
                let [x, y] = projected(moved);
                at(
                    centre.x + field.scale * (x - field.middle[0]),
                    centre.y - field.scale * (y - field.middle[1]),
                )
            };
            self.nodes.iter().zip(&mode.shape).map(node).collect::<Vec<PagePoint>>()
        };
        for (factor, colour, width) in [(0.0, GRID, 0.6), (LARGEST * size / largest, INK, 0.5)] {
            let places = deformed(factor);
            let lines: Vec<[PagePoint; 2]> =
                self.lines.iter().map(|[from, to]| [places[*from], places[*to]]).collect();
            svg.polylines(lines.iter().map(|line| (line.as_slice(), None)), Stroke { colour, width });
        }
    }

    /// Largest extent in space (m).
    fn size(&self) -> f64 {
        let extent = |axis: usize| {
            let values = || self.nodes.iter().map(|place| place[axis]);
            values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
        };
        (0..3).map(extent).fold(0.0, f64::max)
    }
}
