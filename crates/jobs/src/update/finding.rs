//! What has to be said about a fit, in words.

use std::fmt;

use hammerbeam_fit::{
    COLLINEAR, Identifiability, Inference, Interval, LeastSquaresFit, ParameterDirection, UNDETERMINED,
};

use super::data::UpdateData;

/// Probability below which a model does not fit its data.
const POOR: f64 = 0.01;

/// Factor of the standard deviations beyond which it is reported.
const LARGE: f64 = 10.0;

/// Something that has to be said about a fit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// The data do not determine a parameter, or do not separate several.
    LeftOpen {
        /// Parameters with their parts of the direction, the largest first.
        direction: Vec<(String, f64)>,
        /// Half width of the interval along it, relative; infinite where the data see nothing.
        half_width: f64,
    },
    /// Parameters make up for each other; only the precision of the data separates them.
    Collinear {
        /// Parameters with their parts of the direction, the largest first.
        direction: Vec<(String, f64)>,
        /// Collinearity index.
        index: f64,
    },
    /// A bound holds a parameter.
    AtBound {
        /// Its key.
        key: String,
        /// Its value.
        value: f64,
    },
    /// Errors of the stated size alone would hardly leave such residuals.
    PoorFit {
        /// `chi^2`.
        chi_squared: f64,
        /// Data less parameters.
        freedoms: usize,
        /// Probability of as much or more.
        probability: f64,
    },
    /// The standard deviations come out many times as large as stated.
    LargeFactor {
        /// By what factor.
        factor: f64,
    },
    /// Other values of the parameters fit about as well.
    AnotherMinimum {
        /// Parameters with their values there.
        values: Vec<(String, f64)>,
        /// `chi^2` there.
        chi_squared: f64,
    },
    /// No datum is left to test the model.
    NothingToTest,
    /// A response that was measured is unstable with the best values.
    Unstable {
        /// Excitation frequency [Hz].
        frequency_hz: f64,
    },
}

/// All findings of a fit.
pub(super) fn all(
    data: &UpdateData,
    (found, elsewhere): (&LeastSquaresFit, &[LeastSquaresFit]),
    inference: &Inference,
    identifiability: &Identifiability,
    stable: &[bool],
) -> Vec<Finding> {
    let key = |j: usize| data.parameters[j].key.clone();
    let named = |direction: &ParameterDirection| -> Vec<(String, f64)> {
        direction.parameters.iter().map(|&j| (key(j), direction.parts[j])).collect()
    };
    let open = identifiability
        .undetermined
        .iter()
        .map(|direction| Finding::LeftOpen { direction: named(direction), half_width: direction.measure });
    let collinear = identifiability
        .collinear
        .iter()
        .map(|direction| Finding::Collinear { direction: named(direction), index: direction.measure });
    let mut findings: Vec<Finding> = open.chain(collinear).collect();
    let held = (0..found.parameters.len()).filter(|j| found.at_bound[*j]);
    findings.extend(held.map(|j| Finding::AtBound { key: key(j), value: found.parameters[j] }));
    let test = &inference.chi_squared;
    if let Some(probability) = test.probability.filter(|probability| *probability < POOR) {
        let (chi_squared, freedoms) = (test.value, test.degrees_of_freedom);
        findings.push(Finding::PoorFit { chi_squared, freedoms, probability });
    }
    let factor = inference.variance.map_or(0.0, f64::sqrt);
    if factor > LARGE {
        findings.push(Finding::LargeFactor { factor });
    }
    if identifiability.undetermined.is_empty() {
        findings.extend(another_minimum(data, found, elsewhere, inference));
    }
    if test.degrees_of_freedom == 0 {
        findings.push(Finding::NothingToTest);
    }
    let lost = data.orbits.iter().zip(stable).filter(|(_, stable)| !**stable);
    findings.extend(lost.map(|(orbit, _)| Finding::Unstable { frequency_hz: orbit.frequency_hz }));
    findings
}

/// The lowest of the other minima, if its `chi^2` lies within the level of the intervals and its parameters
/// beyond them.
fn another_minimum(
    data: &UpdateData,
    found: &LeastSquaresFit,
    elsewhere: &[LeastSquaresFit],
    inference: &Inference,
) -> Option<Finding> {
    let level = found.chi_squared() + inference.variance? * inference.quantile.powi(2);
    let beyond = |other: &&LeastSquaresFit| {
        let outside = |(value, interval): (&f64, &Option<Interval>)| {
            interval.is_some_and(|interval| *value < interval.low || *value > interval.high)
        };
        other.chi_squared() <= level && other.parameters.iter().zip(&inference.intervals).any(outside)
    };
    let lowest =
        elsewhere.iter().filter(beyond).min_by(|a, b| a.chi_squared().total_cmp(&b.chi_squared()))?;
    let values = data.parameters.iter().map(|parameter| parameter.key.clone());
    let values = values.zip(lowest.parameters.iter().copied()).collect();
    Some(Finding::AnotherMinimum { values, chi_squared: lowest.chi_squared() })
}

/// `a +1 %, b -0.5 %`: a step along a direction, the largest part one percent.
fn steps(direction: &[(String, f64)]) -> String {
    let largest = direction.first().map_or(1.0, |(_, part)| part.abs());
    let step = |(key, part): &(String, f64)| format!("{key} {:+.2} %", part / largest);
    direction.iter().map(step).collect::<Vec<_>>().join(", ")
}

fn names(direction: &[(String, f64)]) -> String {
    let keys: Vec<&str> = direction.iter().map(|(key, _)| key.as_str()).collect();
    match keys.as_slice() {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LeftOpen { direction, half_width } => {
                let verb = if direction.len() == 1 { "determine" } else { "separate" };
                write!(formatter, "the data do not {verb} {}", names(direction))?;
                if let ([_], true) = (&direction[..], half_width.is_finite()) {
                    return write!(
                        formatter,
                        ": its interval reaches {:.0} % of its value either way (reported from {:.0} % on)",
                        100.0 * half_width,
                        100.0 * UNDETERMINED
                    );
                }
                if half_width.is_infinite() {
                    write!(formatter, ": a step of {} changes nothing that was measured", steps(direction))
                } else {
                    write!(
                        formatter,
                        ": changed together by steps of {}, they stay within the interval up to {:.0} % of \
                        their values either way (reported from {:.0} % on)",
                        steps(direction),
                        100.0 * half_width,
                        100.0 * UNDETERMINED
                    )
                }
            }
            Self::Collinear { direction, index } => write!(
                formatter,
                "{} nearly make up for each other: of a step of {} only one part in {index:.0} is seen \
                (reported from {COLLINEAR:.0} on); \
                 only the precision of the data separates them",
                names(direction),
                steps(direction)
            ),
            Self::AtBound { key, value } => {
                write!(
                    formatter,
                    "{key} is held at its bound, {value}; the intervals are those of the other parameters \
                    with it there"
                )
            }
            Self::PoorFit { chi_squared, freedoms, probability } => write!(
                formatter,
                "the model does not fit: chi-squared is {chi_squared:.1} with {freedoms} degrees of \
                freedom, which errors of the stated size exceed with a probability of {probability:.1e}; \
                 the intervals count on the model and are too narrow"
            ),
            Self::LargeFactor { factor } => write!(
                formatter,
                "the residuals are {factor:.0} times as large as stated: the model does not fit, or the fit \
                ended in a minimum that is not the lowest (try another start)"
            ),
            Self::AnotherMinimum { values, chi_squared } => {
                let values: Vec<String> =
                    values.iter().map(|(key, value)| format!("{key} = {value:.6e}")).collect();
                write!(
                    formatter,
                    "other values fit about as well: {}, with chi-squared {chi_squared:.4e}; `low` and \
                    `high` in the data file exclude what cannot be",
                    values.join(", ")
                )
            }
            Self::NothingToTest => {
                write!(
                    formatter,
                    "there are as many parameters as data: the model goes through the data whether it is \
                    right or not"
                )
            }
            Self::Unstable { frequency_hz } => {
                write!(
                    formatter,
                    "the response at {frequency_hz} Hz is unstable with the best values, so it could not \
                    have been measured"
                )
            }
        }
    }
}
