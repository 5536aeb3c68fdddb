//! Scales: from values to a share of an axis.

/// Range above which an axis that may choose becomes logarithmic: a linear one would show its lower half
/// decade as a line.
const LINEAR_UP_TO_RATIO: f64 = 40.0;

/// Part of the largest value up to which a range is rounding: nothing is to be seen in it.
const ROUNDING: f64 = 1e-9;

/// Values beyond this are as good as infinite: differences and ratios of those below it stay finite.
const LARGEST: f64 = 1e100;

/// The scale of an axis as it is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ScaleChoice {
    /// Logarithmic where all values are positive and span a factor of more than 40, else linear.
    #[default]
    Automatic,
    /// Linear.
    Linear,
    /// Logarithmic; values that are not positive are gaps.
    Logarithmic,
}

/// The scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ScaleKind {
    Linear,
    Logarithmic,
}

impl ScaleChoice {
    /// The scale for given finite values.
    pub(crate) fn decide(self, values: impl Iterator<Item = f64>) -> ScaleKind {
        match self {
            Self::Linear => ScaleKind::Linear,
            Self::Logarithmic => ScaleKind::Logarithmic,
            Self::Automatic => {
                let (least, greatest) = extent(values).unwrap_or((0.0, 0.0));
                let wide = least > 0.0 && greatest > LINEAR_UP_TO_RATIO * least;
                if wide { ScaleKind::Logarithmic } else { ScaleKind::Linear }
            }
        }
    }
}

impl ScaleKind {
    /// Whether a value has a place on such an axis.
    pub(crate) fn shows(self, value: f64) -> bool {
        let positive = self == Self::Linear || value > 1.0 / LARGEST;
        positive && value.abs() < LARGEST
    }
}

/// Least and greatest of finite values.
pub(crate) fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |extent, value| match extent {
        None => Some((value, value)),
        Some((least, greatest)) => Some((value.min(least), value.max(greatest))),
    })
}

/// The width of a linear range; zero where it is rounding.
pub(crate) fn span_of((least, greatest): (f64, f64)) -> f64 {
    let span = greatest - least;
    if span > ROUNDING * greatest.abs().max(least.abs()) { span } else { 0.0 }
}

/// A scale with its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    pub(crate) kind: ScaleKind,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl Scale {
    /// A scale with ends exactly there.
    pub(crate) fn exact(kind: ScaleKind, (from, to): (f64, f64)) -> Self {
        Self { kind, from, to }
    }

    /// A scale for data: a margin above, a margin below or, for a linear one that is near zero, zero; from -1
    /// to 1 where everything is zero.
    pub(crate) fn around(kind: ScaleKind, (least, greatest): (f64, f64)) -> Self {
        match kind {
            ScaleKind::Logarithmic => {
                let margin = (greatest / least).powf(0.06).max(1.15);
                Self::exact(kind, (least / margin, greatest * margin))
            }
            ScaleKind::Linear if least == 0.0 && greatest == 0.0 => Self::exact(kind, (-1.0, 1.0)),
            ScaleKind::Linear => {
                let span = match span_of((least, greatest)) {
                    0.0 => greatest.abs(),
                    span => span,
                };
                let span = span.max(1e-30);
                let from_zero = least >= 0.0 && least < 0.5 * greatest;
                let from = if from_zero { 0.0 } else { least - 0.06 * span };
                Self::exact(kind, (from, greatest + 0.06 * span))
            }
        }
    }

    /// Share of the axis below `value`, 0 to 1 between the ends.
    pub(crate) fn share(&self, value: f64) -> f64 {
        match self.kind {
            ScaleKind::Linear => (value - self.from) / (self.to - self.from),
            ScaleKind::Logarithmic => (value / self.from).ln() / (self.to / self.from).ln(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_of_two_decades_is_logarithmic_and_one_of_ten_is_not() {
        let decide = |values: &[f64]| ScaleChoice::Automatic.decide(values.iter().copied());
        assert_eq!(decide(&[0.1, 20.0]), ScaleKind::Logarithmic);
        assert_eq!(decide(&[1.0, 10.0]), ScaleKind::Linear);
        assert_eq!(decide(&[0.0, 10.0]), ScaleKind::Linear);
        assert_eq!(ScaleChoice::Logarithmic.decide([1.0].into_iter()), ScaleKind::Logarithmic);
    }

    #[test]
    fn ends_are_at_the_ends_and_data_inside() {
        for kind in [ScaleKind::Linear, ScaleKind::Logarithmic] {
            let scale = Scale::around(kind, (3.0, 80.0));
            assert_eq!(scale.share(scale.from), 0.0);
            assert!((scale.share(scale.to) - 1.0).abs() < 1e-15);
            assert!(scale.share(3.0) > 0.0 && scale.share(80.0) < 1.0);
        }
        assert_eq!(Scale::around(ScaleKind::Linear, (3.0, 80.0)).from, 0.0);
        let zero = Scale::around(ScaleKind::Linear, (0.0, 0.0));
        assert_eq!((zero.from, zero.to, zero.share(0.0)), (-1.0, 1.0, 0.5));
    }

    /// A motion that does not reach the stop is the same for every gap, up to rounding.
    #[test]
    fn a_range_of_rounding_is_no_range() {
        let size = 4.720_929_604_915_06e-9;
        let rounding = (size, size * (1.0 + 3e-13));
        assert_eq!(span_of(rounding), 0.0);
        let scale = Scale::around(ScaleKind::Linear, rounding);
        assert!((scale.share(rounding.1) - scale.share(rounding.0)).abs() < 1e-9, "{scale:?}");
        assert!(span_of((size, size * (1.0 + 3e-8))) > 0.0);
        assert!(span_of((-2.0, -1.0)) == 1.0 && span_of((0.0, 0.0)) == 0.0);
    }

    #[test]
    fn a_single_value_has_a_place_inside() {
        for kind in [ScaleKind::Linear, ScaleKind::Logarithmic] {
            let share = Scale::around(kind, (5.0, 5.0)).share(5.0);
            assert!((0.1..0.9).contains(&share), "{share}");
        }
        assert!(Scale::around(ScaleKind::Linear, (0.0, 0.0)).share(0.0).is_finite());
    }
}
