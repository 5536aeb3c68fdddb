//! Cross-sections of beams.

use std::f64::consts::PI;

use crate::{StructureError, error::positive};

/// Cross-section of a beam: area `A` [m^2] and second moment of area `I` [m^4].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Section {
    area: f64,
    second_moment: f64,
    form: SectionForm,
}

/// What is known of the form of a section.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SectionForm {
    Rectangle,
    /// A circle with a concentric hole: inner diameter over outer, 0 without a hole.
    Round {
        bore: f64,
    },
    General,
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
        let section = Self::general(width * height, width * height.powi(3) / 12.0)?;
        Ok(Self { form: SectionForm::Rectangle, ..section })
    }

    /// Solid circle: `A = pi d^2 / 4`, `I = A d^2 / 16`.
    ///
    /// * `diameter`: d [m].
    ///
    /// # Errors
    /// A diameter that is not finite and positive.
    pub fn round(diameter: f64) -> Result<Self, StructureError> {
        let diameter = positive("outer diameter of the section", diameter)?;
        let area = PI * diameter * diameter / 4.0;
        let section = Self::general(area, area * diameter * diameter / 16.0)?;
        Ok(Self { form: SectionForm::Round { bore: 0.0 }, ..section })
    }

    /// Tube: `A = pi t (D - t)`, `I = A (D^2 + d^2) / 16` with `d = D - 2 t`.
    ///
    /// * `outer_diameter`: D [m].
    /// * `wall`: t [m], less than half of the diameter.
    ///
    /// # Errors
    /// A length that is not finite and positive, a wall without a hole.
    pub fn tube(outer_diameter: f64, wall: f64) -> Result<Self, StructureError> {
        let outer = positive("outer diameter of the section", outer_diameter)?;
        let wall = positive("wall of the section", wall)?;
        let inner = positive("inner diameter of the section", outer - 2.0 * wall)?;
        let area = PI * wall * (outer - wall);
        let section = Self::general(area, area * (outer * outer + inner * inner) / 16.0)?;
        Ok(Self { form: SectionForm::Round { bore: inner / outer }, ..section })
    }

    /// Whether it is a rectangle that is not a square, and so bends in one direction more easily than in the
    /// other.
    #[must_use]
    pub fn is_oblong(&self) -> bool {
        let is_square = (12.0 * self.second_moment / (self.area * self.area) - 1.0).abs() < 1e-9;
        self.form == SectionForm::Rectangle && !is_square
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
        Ok(Self { area, second_moment, form: SectionForm::General })
    }

    /// Shear coefficient `kappa`: the shear force is `kappa G A` times the mean shear angle. `None` where
    /// only area and second moment are known.
    ///
    /// * `poisson_ratio`: of the material [-].
    ///
    /// # Source
    /// Cowper, J. Appl. Mech. 33 (1966), 335-340.
    #[must_use]
    pub fn shear_coefficient(&self, poisson_ratio: f64) -> Option<f64> {
        let nu = poisson_ratio;
        match self.form {
            SectionForm::Rectangle => Some(10.0 * (1.0 + nu) / (12.0 + 11.0 * nu)),
            SectionForm::Round { bore } => {
                let (hole, sum) = (bore * bore, (1.0 + bore * bore).powi(2));
                Some(6.0 * (1.0 + nu) * sum / ((7.0 + 6.0 * nu) * sum + (20.0 + 12.0 * nu) * hole))
            }
            SectionForm::General => None,
        }
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
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn rectangle_bends_about_its_width() {
        let section = Section::rectangle(0.03, 0.002).unwrap();
        assert_eq!(section.area(), 0.03 * 0.002);
        assert_eq!(section.second_moment(), 0.03 * 0.002_f64.powi(3) / 12.0);
    }

    /// Outer 0.05 m, inner 0.04 m: `pi/4 (D^2 - d^2)` and `pi/64 (D^4 - d^4)`.
    #[test]
    fn tube_is_a_circle_without_its_hole() {
        let tube = Section::tube(0.05, 0.005).unwrap();
        let (outer, inner): (f64, f64) = (0.05, 0.04);
        assert_relative_eq!(tube.area(), PI / 4.0 * (outer.powi(2) - inner.powi(2)), max_relative = 1e-14);
        let moment = PI / 64.0 * (outer.powi(4) - inner.powi(4));
        assert_relative_eq!(tube.second_moment(), moment, max_relative = 1e-14);
        let round = Section::round(outer).unwrap();
        assert_relative_eq!(round.area(), PI / 4.0 * outer.powi(2), max_relative = 1e-14);
        assert_relative_eq!(round.second_moment(), PI / 64.0 * outer.powi(4), max_relative = 1e-14);
    }

    /// At a Poisson ratio of 0.3: 0.850 of a rectangle, 0.886 of a circle, 0.531 of a thin tube, whose
    /// formula is `2 (1 + nu)/(4 + 3 nu)`.
    #[test]
    fn shear_coefficients_are_those_of_cowper() {
        let rectangle = Section::rectangle(0.03, 0.002).unwrap();
        assert_relative_eq!(rectangle.shear_coefficient(0.3).unwrap(), 0.850, max_relative = 1e-3);
        let round = Section::round(0.01).unwrap();
        assert_relative_eq!(round.shear_coefficient(0.3).unwrap(), 0.886, max_relative = 1e-3);
        let thin = Section::tube(0.01, 1e-7).unwrap();
        assert_relative_eq!(thin.shear_coefficient(0.3).unwrap(), 2.6 / 4.9, max_relative = 1e-6);
        assert_eq!(Section::general(1.0, 1.0).unwrap().shear_coefficient(0.3), None);
    }

    #[test]
    fn tube_without_a_hole_is_refused() {
        let error = Section::tube(0.01, 0.005).unwrap_err();
        assert_eq!(error.to_string(), "inner diameter of the section is 0, must be greater than 0");
    }

    #[test]
    fn section_without_height_is_refused() {
        let error = Section::rectangle(0.03, 0.0).unwrap_err();
        assert_eq!(error.to_string(), "height of the section is 0, must be greater than 0");
        assert!(Section::general(f64::NAN, 1.0).is_err());
    }
}
