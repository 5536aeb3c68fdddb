//! The response diagram: maximum displacement and acceleration of the response point, contact force and
//! impact velocity over the excitation frequency, or over another parameter.
//!
//! Figures 3 and 4 of van de Vorst, Fey, de Kraker, van Campen are of this kind.

mod data;
mod drawing;
mod joined;
mod labels;
mod panel;
mod quantity;
mod spread;

pub use data::{
    MeasuredMark, MeasuredMotion, OutputAxis, OverlaidBranches, ResponseCurve, ResponseDiagram,
    ResponsePoint, ResponseQuantity, ResponseSettings,
};

use crate::{error::FigureError, figure::Figure};

impl ResponseDiagram {
    /// The figure of one quantity, in the default style.
    ///
    /// # Errors
    /// As [`Self::draw_with`].
    pub fn draw(&self, quantity: ResponseQuantity) -> Result<Figure, FigureError> {
        self.draw_with(&[quantity], &ResponseSettings::default())
    }

    /// The figure of displacement and acceleration with one frequency axis, in the default style.
    ///
    /// # Errors
    /// As [`Self::draw_with`].
    pub fn draw_both(&self) -> Result<Figure, FigureError> {
        self.draw_with(
            &[ResponseQuantity::Displacement, ResponseQuantity::Acceleration],
            &ResponseSettings::default(),
        )
    }

    /// One panel for each of `quantities`, from top to bottom, with one horizontal axis, and below them one
    /// for each that has values in the detail.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where no solution has a place in a panel of the whole;
    /// [`FigureError::NoQuantity`] where there is no panel; [`FigureError::AxisRange`] where the ends of the
    /// horizontal axis, or of the detail, are not in order.
    pub fn draw_with(
        &self,
        quantities: &[ResponseQuantity],
        settings: &ResponseSettings,
    ) -> Result<Figure, FigureError> {
        drawing::draw(self, quantities, settings)
    }
}
