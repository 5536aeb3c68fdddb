//! From SVG to PNG, with the bundled font alone and the resolution written into the file.

mod file;

use std::sync::{Arc, OnceLock};

use resvg::{
    tiny_skia::{Color, Pixmap, Transform},
    usvg::{Options, Tree, fontdb},
};

use crate::{error::FigureError, font};

const ALLOWED_PIXELS_PER_INCH: std::ops::RangeInclusive<f64> = 24.0..=1200.0;

/// Draws an SVG of a size (mm) as a PNG.
///
/// # Errors
/// [`FigureError::Resolution`] outside 24 to 1200 pixels per inch; [`FigureError::Rendering`] if the SVG is
/// not valid.
pub(crate) fn png(
    svg: &str,
    width_mm: f64,
    height_mm: f64,
    pixels_per_inch: f64,
) -> Result<Vec<u8>, FigureError> {
    if !ALLOWED_PIXELS_PER_INCH.contains(&pixels_per_inch) {
        return Err(FigureError::Resolution { pixels_per_inch });
    }
    let tree = tree(svg)?;
    let [width, height] = [width_mm, height_mm].map(|side| pixels(side, pixels_per_inch));
    let mut pixmap = Pixmap::new(width, height)
        .ok_or_else(|| FigureError::Rendering { reason: format!("no image of {width} x {height} pixels") })?;
    let scale_x = width as f32 / tree.size().width();
    let scale_y = height as f32 / tree.size().height();
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale_x, scale_y), &mut pixmap.as_mut());
    file::encode(pixmap.data(), width, pixels_per_inch).map_err(|error| rendering(&error))
}

/// The elements of an SVG, text with the bundled font alone.
pub(crate) fn tree(svg: &str) -> Result<Tree, FigureError> {
    Tree::from_str(svg, &options()).map_err(|error| rendering(&error))
}

fn rendering(error: &dyn std::error::Error) -> FigureError {
    FigureError::Rendering { reason: error.to_string() }
}

fn pixels(side_mm: f64, pixels_per_inch: f64) -> u32 {
    (side_mm / 25.4 * pixels_per_inch).round().max(1.0) as u32
}

fn options() -> Options<'static> {
    static FONTS: OnceLock<Arc<fontdb::Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = fontdb::Database::new();
        for face in [font::UPRIGHT, font::ITALIC] {
            fonts.load_font_source(fontdb::Source::Binary(Arc::new(face)));
        }
        fonts.set_sans_serif_family(font::BUNDLED_FAMILY);
        Arc::new(fonts)
    });
    Options { fontdb: Arc::clone(fonts), font_family: font::BUNDLED_FAMILY.to_owned(), ..Options::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn useless_resolutions_are_refused() {
        for pixels_per_inch in [0.0, -300.0, 1e9, f64::NAN] {
            assert!(matches!(
                png("<svg/>", 10.0, 10.0, pixels_per_inch),
                Err(FigureError::Resolution { .. })
            ));
        }
    }

    #[test]
    fn text_that_is_not_svg_is_refused() {
        assert!(matches!(png("no svg", 10.0, 10.0, 300.0), Err(FigureError::Rendering { .. })));
    }
}
