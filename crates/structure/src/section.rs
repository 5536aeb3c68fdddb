//! Cross-sections of beams.

use crate::{StructureError, error::positive};

/// Cross-section of a uniform beam: area `A` [m^2] and second moment of area `I` [m^4].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    area: f64,
    second_moment: f64,
}

impl Section {
    /// Rectangle that bends about its width: `A = b h`, `I = b h^3 / 12`.
    ///
    /// * `width`: b [m], across the motion.
    /// * `height`: h [m], along the motion.
    ///
    /// # Errors
    /// A side that is not finite and positive.
    pub fn rectangle(width: f64, height: f64) -> Result<Self, StructureError> {
        positive("width of the section", width)?;
        positive("height of the section", height)?;
        Self::general(width * height, width * height.powi(3) / 12.0)
    }

    /// Section of any form.
    ///
    /// * `area`: A [m^2].
    /// * `second_moment`: I [m^4], about the neutral axis.
    ///
    /// # Errors
    /// A quantity that is not finite and positive.
    pub fn general(area: f64, second_moment: f64) -> Result<Self, StructureError> {
        let area = positive("area of the section", area)?;
        let second_moment = positive("second moment of area of the section", second_moment)?;
        Ok(Self { area, second_moment })
    }

    /// Area `A` [m^2].
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Second moment of area `I` [m^4].
    #[must_use]
    pub fn second_moment(&self) -> f64 {
        self.second_moment
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangle_bends_about_its_width() {
        let section = Section::rectangle(0.03, 0.002).unwrap();
        assert_eq!(section.area(), 0.03 * 0.002);
        assert_eq!(section.second_moment(), 0.03 * 0.002_f64.powi(3) / 12.0);
    }

    #[test]
    fn section_without_height_is_refused() {
        let error = Section::rectangle(0.03, 0.0).unwrap_err();
        assert_eq!(error.to_string(), "height of the section is 0, must be greater than 0");
        assert!(Section::general(f64::NAN, 1.0).is_err());
    }
}
