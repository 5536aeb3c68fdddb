//! Why a figure cannot be drawn.

/// Why a figure cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum FigureError {
    /// Nothing to draw: no branch, or no finite point inside the frequency range.
    #[error(
        "nothing to draw: no finite {quantity} inside the axes (points given: {points}, branches: {curves})"
    )]
    Empty { quantity: &'static str, curves: usize, points: usize },
    /// A figure needs at least one panel.
    #[error("nothing to draw: no quantity was asked for")]
    NoQuantity,
    /// The ends of the horizontal axis, or of its detail, are not finite numbers in rising order.
    #[error("the horizontal axis must run from a lower to a higher finite number, not from {from} to {to}")]
    AxisRange { from: f64, to: f64 },
    /// More masses than a sketch can show.
    #[error("a sketch has room for {most} masses, the structure has {masses}")]
    Crowded { masses: usize, most: usize },
    /// The PNG would be useless or too large for memory.
    #[error("{pixels_per_inch} pixels per inch is outside the allowed 24 to 1200")]
    Resolution { pixels_per_inch: f64 },
    /// The renderer rejected the SVG, which is a bug of this crate.
    #[error("the renderer refused the figure: {reason}")]
    Rendering { reason: String },
}
