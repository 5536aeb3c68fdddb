//! The structure as a sketch: supports, masses, stops and excitation.
//!
//! Along a beam the sketch is to scale; its depth, the gaps and all symbols are not. A displacement is
//! positive upwards, that of lumped masses to the right. Further information is printed below the sketch,
//! with words given by the caller.

mod beam;
mod data;
mod layout;
mod lumped;
mod stop;

pub use data::{
    SketchBeam, SketchCarrier, SketchEnd, SketchLayout, SketchLink, SketchLumped, SketchMotion, SketchPoint,
    SketchStop, StopKind, StructureDiagram,
};

use layout::MARGIN;

use crate::{
    error::FigureError,
    figure::Figure,
    font::CAPITAL_HEIGHT,
    plot::lettering,
    style::Style,
    svg::{Anchor, PagePoint, SvgWriter, points},
    text::wrap,
};

/// Space between the sketch and its words (pt).
const GAP: f64 = 9.0;

impl StructureDiagram {
    /// The figure.
    ///
    /// # Errors
    /// [`FigureError::Crowded`] for more masses than a sketch has room for, [`FigureError::Empty`] for no
    /// mass or a beam without a length.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let width = points(style.width_mm);
        let title = wrap(&self.title, style.label_size, width - 2.0 * MARGIN);
        let top = MARGIN + 1.5 * style.label_size * title.len() as f64;
        let description = self.description();
        let sketch = match &self.layout {
            SketchLayout::Beam(beam) => beam::sketch(self, beam, top, style)?,
            SketchLayout::Lumped(lumped) => lumped::sketch(self, lumped, top, style)?,
        };
        let words: Vec<_> = self
            .words
            .iter()
            .flat_map(|line| wrap(line, style.tick_size, width - 2.0 * MARGIN - style.tick_size))
            .collect();
        let line = 1.4 * style.tick_size;
        let height = sketch.bottom + GAP + line * words.len() as f64 + MARGIN;
        let mut svg = SvgWriter::new(style.width_mm, height * 25.4 / 72.0, &self.title, &description);
        for (i, text) in title.iter().enumerate() {
            let y = MARGIN + 1.5 * i as f64 * style.label_size + CAPITAL_HEIGHT * style.label_size;
            svg.text(PagePoint { x: MARGIN, y }, text, lettering(style.label_size, Anchor::Start));
        }
        (sketch.draw)(&mut svg);
        for (i, text) in words.iter().enumerate() {
            let y = sketch.bottom + GAP + (i as f64 + 0.7) * line;
            svg.text(PagePoint { x: MARGIN, y }, text, lettering(style.tick_size, Anchor::Start));
        }
        Ok(Figure::new(svg.finish(), description, style.width_mm, height * 25.4 / 72.0))
    }

    fn description(&self) -> String {
        let counted = |count: usize, one: &str, several: &str| {
            format!("{count} {}", if count == 1 { one } else { several })
        };
        let what = match &self.layout {
            SketchLayout::Beam(beam) => {
                format!("a beam with {}", counted(beam.points.len(), "point", "points"))
            }
            SketchLayout::Lumped(lumped) => counted(lumped.masses.len(), "mass", "masses"),
        };
        let stops = counted(self.stops.len(), "stop", "stops");
        format!("sketch of {what} and {stops}; {}", self.words.join("; "))
    }
}
