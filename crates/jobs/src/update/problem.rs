//! Residuals of a study against its data, and their derivatives.
//!
//! Orbits are followed from an anchor: the parameters and orbits at which derivatives were taken last. What a
//! trial finds does not depend on the trials before it.

use faer::Mat;
use hammerbeam_fit::{Bounds, FitProblem};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_study::{Model, StudyFile, number::Number};

use super::{
    candidate::{CandidateError, built, candidate},
    data::{Datum, FrequencyTable, MeasuredDatum, UpdateData},
    exact::eigenfrequency_derivatives,
    observe::{damping_ratios, table},
    response::{Orbits, maximum},
};

/// Step of a central difference, relative to the parameter.
const STEP: f64 = 3e-4;
/// Smallest part of the way to other parameters in which orbits are followed.
const SHORTEST_WAY: f64 = 1.0 / 128.0;

/// A study with data: the residuals `(model - measured)/deviation` over the parameters.
#[derive(Debug)]
pub struct UpdateProblem<'a> {
    study: &'a StudyFile,
    data: &'a UpdateData,
    numbers: Vec<Number>,
    orbits: Orbits,
    anchor: Place,
    refusal: Option<String>,
}

/// Parameters, the orbits there, and what the model says.
#[derive(Debug, Clone)]
struct Place {
    parameters: Vec<f64>,
    orbits: Vec<PeriodicSolution>,
    values: Vec<f64>,
}

impl<'a> UpdateProblem<'a> {
    /// At these parameters.
    ///
    /// # Errors
    /// [`CandidateError`]: there is no model with them, or not what was measured.
    pub fn new(study: &'a StudyFile, data: &'a UpdateData, start: &[f64]) -> Result<Self, CandidateError> {
        let numbers: Vec<Number> = data.parameters.iter().map(|parameter| parameter.number.clone()).collect();
        let parameters = start.to_vec();
        let orbits = Orbits::new(&study.study);
        let model = built(study, &numbers, &parameters)?;
        let found = orbits.seek(&model, data)?;
        let values = values(&data.data, &model, &found)?;
        let anchor = Place { parameters, orbits: found, values };
        Ok(Self { study, data, numbers, orbits, anchor, refusal: None })
    }

    /// Bounds of the parameters.
    #[must_use]
    pub fn bounds(&self) -> Vec<Bounds> {
        self.data.parameters.iter().map(|parameter| parameter.bounds).collect()
    }

    /// What the model says to each of the data.
    ///
    /// # Errors
    /// [`CandidateError`]: there is no such model, or an orbit is lost on the way to it.
    pub fn values(&self, parameters: &[f64]) -> Result<Vec<f64>, CandidateError> {
        Ok(self.place(parameters)?.values)
    }

    /// The orbits where derivatives were taken last.
    #[must_use]
    pub fn orbits(&self) -> &[PeriodicSolution] {
        &self.anchor.orbits
    }

    /// Why the last trial was refused, if one was.
    #[must_use]
    pub fn refusal(&self) -> Option<&str> {
        self.refusal.as_deref()
    }

    /// Follows the orbits from the anchor to other parameters, in one step or in several.
    fn place(&self, parameters: &[f64]) -> Result<Place, CandidateError> {
        if parameters == self.anchor.parameters {
            return Ok(self.anchor.clone());
        }
        let from = &self.anchor.parameters;
        let mut orbits = self.anchor.orbits.clone();
        let (mut done, mut step) = (0.0, 1.0);
        loop {
            let next = f64::min(done + step, 1.0);
            let between = |(a, b): (&f64, &f64)| if next == 1.0 { *b } else { a + next * (b - a) };
            let at: Vec<f64> = from.iter().zip(parameters).map(between).collect();
            let model = built(self.study, &self.numbers, &at)?;
            match self.orbits.follow(&model, &orbits) {
                Ok(found) if next == 1.0 => {
                    let values = values(&self.data.data, &model, &found)?;
                    return Ok(Place { parameters: at, orbits: found, values });
                }
                Ok(found) => {
                    (orbits, done) = (found, next);
                    step *= 2.0;
                }
                Err(error) if step <= SHORTEST_WAY => return Err(error),
                Err(_) => step *= 0.5,
            }
        }
    }

    /// Derivatives of all values by one parameter: exact where they are known, else by differences.
    ///
    /// * `file`: the study at the anchor.
    fn derivatives(&self, file: &StudyFile, index: usize) -> Result<Vec<f64>, CandidateError> {
        let (number, value) = (&self.numbers[index], self.anchor.parameters[index]);
        let mut column: Vec<Option<f64>> = vec![None; self.data.data.len()];
        for table in [FrequencyTable::Clamped, FrequencyTable::FreeInterface] {
            let of_table = |datum: &Datum| match datum.observation {
                MeasuredDatum::Eigenfrequency(of) if of.table == table => Some(of.mode),
                _ => None,
            };
            if !self.data.data.iter().any(|datum| of_table(datum).is_some()) {
                continue;
            }
            if let Some(exact) = eigenfrequency_derivatives(file, number, value, table)? {
                for (entry, datum) in column.iter_mut().zip(&self.data.data) {
                    *entry = of_table(datum).map(|mode| exact[mode]).or(*entry);
                }
            }
        }
        if column.iter().any(Option::is_none) {
            let differences = self.differences(index)?;
            return Ok(column.iter().zip(differences).map(|(exact, by)| exact.unwrap_or(by)).collect());
        }
        Ok(column.into_iter().flatten().collect())
    }

    /// Derivatives of all values by one parameter, by differences: central ones, or of three points on the
    /// side that exists.
    fn differences(&self, index: usize) -> Result<Vec<f64>, CandidateError> {
        let size = self.anchor.parameters[index].abs().max(1e-3 * self.data.parameters[index].typical);
        let step = STEP * size;
        let at = |steps: f64| -> Result<Vec<f64>, CandidateError> {
            let mut parameters = self.anchor.parameters.clone();
            parameters[index] += steps * step;
            let model = built(self.study, &self.numbers, &parameters)?;
            let orbits = self.orbits.follow(&model, &self.anchor.orbits)?;
            values(&self.data.data, &model, &orbits)
        };
        let here = &self.anchor.values;
        match (at(-1.0), at(1.0)) {
            (Ok(low), Ok(high)) => {
                Ok(low.iter().zip(&high).map(|(low, high)| (high - low) / (2.0 * step)).collect())
            }
            (low, high) => {
                let (side, near) = match (low, high) {
                    (Ok(near), _) => (-1.0, near),
                    (_, Ok(near)) => (1.0, near),
                    (_, Err(error)) => return Err(error),
                };
                let far = at(2.0 * side)?;
                let three = |k: usize| (-3.0 * here[k] + 4.0 * near[k] - far[k]) / (2.0 * side * step);
                Ok((0..here.len()).map(three).collect())
            }
        }
    }
}

impl FitProblem for UpdateProblem<'_> {
    type Error = CandidateError;

    fn residuals(&mut self, parameters: &[f64]) -> Result<Vec<f64>, CandidateError> {
        let values = match self.values(parameters) {
            Ok(values) => values,
            Err(error) => {
                self.refusal = Some(error.to_string());
                return Err(error);
            }
        };
        let residual = |(value, datum): (&f64, &Datum)| (value - datum.value) / datum.deviation;
        Ok(values.iter().zip(&self.data.data).map(residual).collect())
    }

    fn jacobian(&mut self, parameters: &[f64]) -> Result<Mat<f64>, CandidateError> {
        self.anchor = self.place(parameters)?;
        let mut jacobian = Mat::zeros(self.data.data.len(), parameters.len());
        let file = candidate(self.study, &self.numbers, parameters)?;
        for j in 0..parameters.len() {
            let column = self.derivatives(&file, j)?;
            for (i, datum) in self.data.data.iter().enumerate() {
                jacobian[(i, j)] = column[i] / datum.deviation;
            }
        }
        Ok(jacobian)
    }
}

/// What a model says to each of the data.
fn values(data: &[Datum], model: &Model, orbits: &[PeriodicSolution]) -> Result<Vec<f64>, CandidateError> {
    let asks_for_damping = data.iter().any(|datum| matches!(datum.observation, MeasuredDatum::Damping(_)));
    let ratios = if asks_for_damping { damping_ratios(model.system.model()) } else { Vec::new() };
    let value = |datum: &Datum| {
        let (list, mode) = match datum.observation {
            MeasuredDatum::Eigenfrequency(of) => (table(&model.tables, of.table), of.mode),
            MeasuredDatum::Damping(of) => (ratios.as_slice(), of.mode),
            MeasuredDatum::Response(of) => return maximum(model, &orbits[of.orbit], of.of),
        };
        let (modes, place) = (list.len(), datum.place.clone());
        list.get(mode).copied().ok_or(CandidateError::NoMode { mode: mode + 1, modes, place })
    };
    data.iter().map(value).collect()
}
