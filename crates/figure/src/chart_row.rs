//! Charts side by side, with their frames on one height.

use crate::{
    chart::Chart,
    error::FigureError,
    figure::Figure,
    plot::{Plot, room_below},
    style::Style,
    svg::{SvgWriter, points},
};

/// Space between two charts (pt).
const COLUMN_GAP: f64 = 8.0;

/// A chart with its place in the row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChartColumn {
    pub(crate) chart: Chart,
    /// Its width relative to the others.
    pub(crate) width: f64,
    /// Whether units of both axes have the same length: the frame is made narrower, or lower from above.
    pub(crate) equal_units: bool,
}

/// Draws charts from left to right; those of several panels stand at the top.
///
/// # Errors
/// [`FigureError::NoQuantity`] without a chart, else see [`Chart::draw`].
pub(crate) fn draw_row(
    columns: &[ChartColumn],
    description: &str,
    style: &Style,
) -> Result<Figure, FigureError> {
    let whole: f64 = columns.iter().map(|column| column.width).sum();
    let gaps = COLUMN_GAP * columns.len().saturating_sub(1) as f64 * 25.4 / 72.0;
    let styles: Vec<Style> = columns
        .iter()
        .map(|column| Style { width_mm: (style.width_mm - gaps) * column.width / whole, ..style.clone() })
        .collect();
    let tops = columns.iter().zip(&styles).map(|(column, style)| {
        let plots = column.chart.plots(style, 0.0)?;
        Ok(plots.first().map_or(0.0, |plot| plot.area.top))
    });
    let top = tops.collect::<Result<Vec<f64>, FigureError>>()?.into_iter().fold(0.0, f64::max);
    let laid = columns.iter().zip(&styles).map(|(column, style)| {
        let mut plots = column.chart.plots(style, top)?;
        if column.equal_units {
            plots.iter_mut().for_each(equalise);
        }
        Ok(plots)
    });
    let laid: Vec<Vec<Plot>> = laid.collect::<Result<_, FigureError>>()?;
    let bottoms = laid.iter().flatten().map(|plot| plot.area.bottom);
    let bottom = bottoms.reduce(f64::max).ok_or(FigureError::NoQuantity)?;
    let height_mm = (bottom + room_below(style)) * 25.4 / 72.0;
    let mut svg = SvgWriter::new(style.width_mm, height_mm, "", description);
    let mut left = 0.0;
    for ((column, plots), style) in columns.iter().zip(&laid).zip(&styles) {
        svg.moved(left, |svg| column.chart.paint(svg, plots, style));
        left += points(style.width_mm) + COLUMN_GAP;
    }
    Ok(Figure::new(svg.finish(), description.to_owned(), style.width_mm, height_mm))
}

/// Makes units of both axes equally long, within the frame as it is.
fn equalise(plot: &mut Plot) {
    let (x, y) = (&plot.x.scale, &plot.y.scale);
    let ratio = (x.to - x.from) / (y.to - y.from);
    let area = &mut plot.area;
    let (width, height) = (area.right - area.left, area.bottom - area.top);
    area.right = area.left + width.min(height * ratio);
    area.top = area.bottom - height.min(width / ratio);
}
