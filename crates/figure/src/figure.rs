//! A finished figure.

use crate::{error::FigureError, pdf, png, svg::SvgDocument};

/// A finished figure: an SVG document and its size on paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    svg: SvgDocument,
    description: String,
    width_mm: f64,
    height_mm: f64,
}

impl Figure {
    pub(crate) fn new(svg: SvgDocument, description: String, width_mm: f64, height_mm: f64) -> Self {
        Self { svg, description, width_mm, height_mm }
    }

    /// The figure as an SVG document, in UTF-8, with the glyphs that it uses.
    #[must_use]
    pub fn svg(&self) -> String {
        self.svg.with_fonts()
    }

    /// The figure as a PNG file; 300 pixels per inch is what journals ask for.
    ///
    /// # Errors
    /// [`FigureError::Resolution`] outside 24 to 1200 pixels per inch.
    pub fn png(&self, pixels_per_inch: f64) -> Result<Vec<u8>, FigureError> {
        png::png(&self.svg.text, self.width_mm, self.height_mm, pixels_per_inch)
    }

    /// The figure as a PDF file of one page; text is text, in the glyphs that it uses.
    ///
    /// # Errors
    /// [`FigureError::Rendering`] if a figure has elements unknown to the writer, which is a bug of this
    /// crate.
    pub fn pdf(&self) -> Result<Vec<u8>, FigureError> {
        let (svg, size_mm) = (&self.svg, [self.width_mm, self.height_mm]);
        pdf::pdf(&svg.text, &svg.characters, &self.description, size_mm)
    }

    /// Description of the figure, with the number of solutions and of overlapping marks that were left out.
    #[must_use]
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Characters of its texts that are missing in the bundled font, in the order of their codes; each is
    /// drawn as the replacement character �.
    pub fn characters_lacking(&self) -> impl Iterator<Item = char> + '_ {
        self.svg.lacking.iter().copied()
    }

    /// Width on paper (mm).
    #[must_use]
    pub fn width_mm(&self) -> f64 {
        self.width_mm
    }

    /// Height on paper (mm).
    #[must_use]
    pub fn height_mm(&self) -> f64 {
        self.height_mm
    }
}
