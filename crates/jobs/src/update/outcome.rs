//! An update: the fit and everything that is known of its result.

use std::path::PathBuf;

use hammerbeam_fit::{
    FitEnd, FitError, Identifiability, Inference, Interval, LeastSquaresFit, LeastSquaresSettings,
    ProfileInterval, profile,
};
use hammerbeam_results::whole_file::WriteError;
use hammerbeam_study::{
    StudyFile,
    number::{Number, replaced},
};

use super::{
    candidate::CandidateError,
    data::{DataError, Datum, UpdateData},
    finding::{self, Finding},
    problem::UpdateProblem,
    starts::{Found, Starts, best},
};

/// Further starts that are tried where that is quick.
pub const FURTHER_STARTS: u32 = 6;

/// How an update is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpdateSettings {
    /// Probability that an interval holds its parameter.
    pub confidence: f64,
    /// Whether intervals are also taken from the profile of `chi^2`, which costs many more fits.
    pub profiles: bool,
    /// Further starts besides that of the data file; `None` for [`FURTHER_STARTS`] where no response was
    /// measured, and none where one was, since its orbits are sought at each.
    pub further_starts: Option<u32>,
    /// Most iterations of the fit.
    pub max_iterations: u32,
}

impl Default for UpdateSettings {
    fn default() -> Self {
        Self { confidence: 0.95, profiles: false, further_starts: None, max_iterations: 100 }
    }
}

/// A parameter with what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedParameter {
    /// Its key path.
    pub key: String,
    /// Value in the study.
    pub in_study: f64,
    /// Value from which the fit started.
    pub start: f64,
    /// Best value.
    pub value: f64,
    /// Standard error; `None` where the data do not determine it or a bound holds it.
    pub standard_error: Option<f64>,
    /// Interval to first order, as the standard error.
    pub interval: Option<Interval>,
    /// Interval of the profile, if it was asked for.
    pub profile: Option<ProfileInterval>,
    /// Whether a bound holds it.
    pub at_bound: bool,
}

/// A datum with what the model says to it.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedDatum {
    /// What was measured.
    pub datum: Datum,
    /// What the model says with the values of the start.
    pub at_start: f64,
    /// What it says with the best values.
    pub fitted: f64,
    /// `(fitted - measured)/deviation`.
    pub residual: f64,
}

/// What an update gives.
#[derive(Debug, Clone)]
pub struct Update {
    /// The parameters, in the order of the data file.
    pub parameters: Vec<FittedParameter>,
    /// The data, in the order of the data file.
    pub data: Vec<FittedDatum>,
    /// Standard errors, correlation, the chi-squared test.
    pub inference: Inference,
    /// What the data leave open.
    pub identifiability: Identifiability,
    /// How the fit ended.
    pub end: FitEnd,
    /// Why a trial was last refused, if one was.
    pub refusal: Option<String>,
    /// What the starts led to.
    pub starts: Starts,
    /// Iterations of the fit.
    pub iterations: u32,
    /// Everything that has to be said about it.
    pub findings: Vec<Finding>,
    /// The study file with the best values.
    pub study_text: String,
}

/// Why there is no update.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum UpdateError {
    /// The data ask for what the study does not have.
    #[error("{0}")]
    Data(#[from] DataError),
    /// There is no model at the start.
    #[error("{0}")]
    Start(CandidateError),
    /// The fit failed.
    #[error("{0}")]
    Fit(#[from] FitError<CandidateError>),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The updated study would take the place of an input.
    #[error("{} is an input of this update and is not overwritten: give another folder", study.display())]
    #[expect(missing_docs, reason = "the message names its fields")]
    OverInput { study: PathBuf },
}

/// Fits the parameters of a study to data.
///
/// # Errors
/// [`UpdateError`]; a fit that does not converge is a result, with the reason in its [`end`](Update::end).
pub fn update(
    study: &StudyFile,
    data: &UpdateData,
    settings: &UpdateSettings,
) -> Result<Update, UpdateError> {
    let start: Vec<f64> = data.parameters.iter().map(|parameter| parameter.start).collect();
    let problem = UpdateProblem::new(study, data, &start).map_err(|error| at_start(data, error))?;
    let at_start = problem.values(&start).map_err(UpdateError::Start)?;
    let bounds = problem.bounds();
    let fitting = LeastSquaresSettings {
        max_iterations: settings.max_iterations,
        ..LeastSquaresSettings::new(data.deviations)
    };
    let further = settings.further_starts.unwrap_or(if data.orbits.is_empty() { FURTHER_STARTS } else { 0 });
    let Found { mut problem, fit: found, starts, elsewhere } = best(study, data, problem, further, &fitting)?;
    let inference = Inference::of(&found, data.deviations, settings.confidence);
    let size = |(value, parameter): (&f64, &super::FittedKey)| {
        if *value == 0.0 { parameter.typical } else { value.abs() }
    };
    let typical: Vec<f64> = found.parameters.iter().zip(&data.parameters).map(size).collect();
    let identifiability = Identifiability::of(&found, &inference, &typical);
    let stable: Vec<bool> = problem.orbits().iter().map(|orbit| orbit.may_be_stable()).collect();
    let profiles: Vec<Option<ProfileInterval>> = (0..bounds.len())
        .map(|j| {
            let wanted = settings.profiles && found.end.converged();
            wanted.then(|| profile(&mut problem, &found, &inference, (j, &bounds), &fitting)).flatten()
        })
        .collect();
    let numbers: Vec<Number> = data.parameters.iter().map(|parameter| parameter.number.clone()).collect();
    Ok(Update {
        findings: finding::all(data, (&found, &elsewhere), &inference, &identifiability, &stable),
        parameters: parameters(data, &found, &inference, &profiles),
        data: fitted_data(data, &found, &at_start),
        end: found.end,
        refusal: problem.refusal().map(str::to_owned),
        iterations: found.iterations,
        starts,
        study_text: replaced(&study.text, &numbers, &found.parameters),
        inference,
        identifiability,
    })
}

/// What is missing at the start is a fault of the data file, where it stands there.
fn at_start(data: &UpdateData, error: CandidateError) -> UpdateError {
    let message = error.to_string();
    match error {
        CandidateError::NoMode { modes, place, .. } => {
            let help = match modes {
                0 => "allowed: another `table`; this study has none of these modes".to_owned(),
                _ => format!("allowed: 1 to {modes}, as `hammerbeam modes` counts them"),
            };
            UpdateError::Data(data.fault(&place, message, vec![help]))
        }
        error => UpdateError::Start(error),
    }
}

fn parameters(
    data: &UpdateData,
    found: &LeastSquaresFit,
    inference: &Inference,
    profiles: &[Option<ProfileInterval>],
) -> Vec<FittedParameter> {
    let of = |(j, parameter): (usize, &super::FittedKey)| FittedParameter {
        key: parameter.key.clone(),
        in_study: parameter.number.value,
        start: parameter.start,
        value: found.parameters[j],
        standard_error: inference.standard_errors[j],
        interval: inference.intervals[j],
        profile: profiles[j],
        at_bound: found.at_bound[j],
    };
    data.parameters.iter().enumerate().map(of).collect()
}

fn fitted_data(data: &UpdateData, found: &LeastSquaresFit, at_start: &[f64]) -> Vec<FittedDatum> {
    let of = |((datum, residual), at_start): ((&Datum, &f64), &f64)| FittedDatum {
        datum: datum.clone(),
        at_start: *at_start,
        fitted: datum.value + residual * datum.deviation,
        residual: *residual,
    };
    data.data.iter().zip(&found.residuals).zip(at_start).map(of).collect()
}
