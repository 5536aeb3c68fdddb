//! A study and what can be asked of it: most methods are commands, with their options.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use hammerbeam::{
    Error, FrequencySeries, Quiet, Study, StudyError, StudyFile,
    basins::{BasinAxis, BasinsRequest, basins_with_parts},
    basins_part,
    check::check,
    chosen_orbits::ChosenOrbit,
    drawing::{DrawSettings, DrawingError, FigureSelection, draw, draw_into},
    exponents::{ExponentsRequest, exponents},
    modes_document,
    orbits::orbits,
    pool::threads,
    run::{RunOrigin, RunOutcome, RunRequest, WholeRun, run_study},
    simulate::{DurationTooLong, SimulationRequest, SimulationTime, simulate},
    study_file::Setting,
    sweep::{SweepRequest, SweepStarts, sweep_part, sweep_with_parts},
};
use pyo3::prelude::*;
use serde_json::json;

use crate::{
    asked::{Callback, EffortNumbers, ForcedTime, Parts, document, effort, folders, initial, job_part},
    failure::{bad_input, drawing_exception, exception, study_exception},
    numbers,
    observer::PythonObserver,
    orbits::NativeOrbits,
};

/// A run without its drawing, or with it.
fn run(
    study: &Study,
    (out, from, jobs, drawn): (&Path, &[RunOrigin], Option<u16>, bool),
    observer: &mut PythonObserver,
) -> Result<(String, bool), DrawingError> {
    let threads = threads(jobs);
    let WholeRun { store, mut report } = run_study(study, RunRequest { out, from, threads }, observer)?;
    let is_interrupted = report.outcome == RunOutcome::Interrupted;
    let figures = (drawn && !is_interrupted).then(|| {
        let settings = DrawSettings { threads, ..DrawSettings::default() };
        let selection = FigureSelection::of_run(&study.file);
        draw_into::<DrawingError>(out, settings, observer, |files| {
            draw(&store, (&study.file, &study.model), &selection, files)
        })
    });
    store.finish().map_err(Error::from)?;
    report.figures = figures.transpose()?.map(|files| files.names).unwrap_or_default();
    Ok((document(&report), is_interrupted))
}

/// A study with its model.
#[pyclass(frozen, module = "hammerbeam._native")]
pub struct NativeStudy {
    pub(crate) study: Arc<Study>,
}

#[pymethods]
impl NativeStudy {
    /// Reads a study file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let study = py.detach(|| Study::read(path)).map_err(|error| study_exception(py, error))?;
        Ok(Self { study: Arc::new(study) })
    }

    /// Reads a study from a text.
    #[staticmethod]
    fn parse(py: Python<'_>, name: &str, text: String) -> PyResult<Self> {
        let study = py.detach(|| Study::parse(name, text)).map_err(|error| study_exception(py, error))?;
        Ok(Self { study: Arc::new(study) })
    }

    #[getter]
    fn text(&self) -> &str {
        &self.study.file.text
    }

    /// The text of this study with other values of keys, in the form of `--set`, which can stand in another
    /// folder. It is read again; of files of matrices only whether they are there.
    fn text_with(&self, py: Python<'_>, settings: Vec<String>) -> PyResult<String> {
        let file = &self.study.file;
        let text = file.text_with_whole_paths();
        let written = || -> Result<String, StudyError> {
            let settings = settings.iter().map(|text| text.parse()).collect::<Result<Vec<Setting>, _>>();
            let text = settings.and_then(|settings| Setting::written_into(&settings, &text));
            let text = text.map_err(StudyError::Setting)?;
            StudyFile::parse(&file.name, text.clone())?;
            Ok(text)
        };
        written().map_err(|error| study_exception(py, error))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.study.file.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.study.file.study.title
    }

    #[getter]
    fn dof(&self) -> usize {
        self.study.dof()
    }

    #[getter]
    fn points(&self) -> Vec<&str> {
        self.study.model.point_names()
    }

    /// The range of the excitation frequency [Hz]; `None` without an excitation.
    #[getter]
    fn range_hz(&self) -> Option<(f64, f64)> {
        self.study.file.study.excitation.harmonic().map(|harmonic| harmonic.frequency_hz.into())
    }

    /// What `check --json` says.
    fn check(&self, py: Python<'_>) -> PyResult<String> {
        let report = check(&self.study, &mut Quiet).map_err(|error| exception(py, error))?;
        Ok(document(&report))
    }

    /// What `modes --json` says.
    fn modes(&self) -> String {
        modes_document(&self.study.model).to_string()
    }

    /// Runs what is left of the study: its report, and whether it was stopped.
    fn run(
        &self,
        py: Python<'_>,
        asked: (PathBuf, Vec<String>, Option<u16>, bool),
        callbacks: (Callback, Callback),
    ) -> PyResult<(String, bool)> {
        let (out, from, jobs, drawn) = asked;
        let from: Vec<RunOrigin> = from.iter().map(|text| RunOrigin::of(text)).collect();
        let asked = (out.as_path(), from.as_slice(), jobs, drawn);
        let done = PythonObserver::run(py, callbacks, |observer| run(&self.study, asked, observer))?;
        done.map_err(|error| drawing_exception(py, error))
    }

    /// All periodic solutions at a frequency, and why the search is not complete, if it is not.
    fn orbits(
        &self,
        py: Python<'_>,
        frequency_hz: f64,
        period_multiple: u32,
        callbacks: (Callback, Callback),
    ) -> PyResult<(NativeOrbits, Option<String>)> {
        let found = PythonObserver::run(py, callbacks, |observer| {
            orbits(&self.study, frequency_hz, period_multiple, observer)
        })?;
        let found = found.map_err(|error| exception(py, error))?;
        let chosen = |solution| ChosenOrbit { branch: None, event: String::new(), solution };
        let all = found.orbits.into_iter().map(chosen).collect();
        let incomplete = found.incomplete.map(|error| error.to_string());
        Ok((NativeOrbits::new(self.study.clone(), all), incomplete))
    }

    /// A motion in time: of a study with an excitation `(frequency_hz, transient, periods, duration_s,
    /// samples)`, where a duration counts before periods; of one without `(duration_s, sampling_hz)`.
    fn simulate(
        &self,
        py: Python<'_>,
        asked: (Option<ForcedTime>, Option<(f64, Option<f64>)>),
        motion: (f64, &str),
        kept_in: (Option<PathBuf>, Option<PathBuf>),
        callbacks: (Callback, Callback),
    ) -> PyResult<String> {
        let (forced, free) = asked;
        let (section_phase, start) = motion;
        let (results, out) = kept_in;
        let too_long = |error: DurationTooLong| {
            bad_input(py, "SimulationTooLarge", error.to_string(), numbers::of_duration(&error))
        };
        let time = match (forced, free) {
            (_, Some((duration, sampling))) => {
                SimulationTime::free(duration, sampling, &self.study.model).map_err(too_long)?
            }
            (Some((hz, transient, periods, duration, samples)), None) => {
                let whole = |duration| SimulationTime::periods_in(duration, hz).map_err(too_long);
                let periods = duration.map_or(Ok(periods), whole)?;
                SimulationTime::periods(hz, transient, periods, samples)
            }
            (None, None) => {
                let message = "neither periods nor a duration are given".to_owned();
                return Err(bad_input(py, "BadInput", message, json!({})));
            }
        };
        let request = SimulationRequest { time, section_phase, initial: initial(py, start, &self.study)? };
        let report = PythonObserver::run(py, callbacks, |observer| {
            simulate(&self.study, &request, folders(&results, &out), observer)
        })?;
        Ok(document(&report.map_err(|error| exception(py, error))?))
    }

    /// Settled motions over `(from_hz, to_hz, step_hz)`: carried over from a state, or from so many states;
    /// of the last also a part.
    fn sweep(
        &self,
        py: Python<'_>,
        asked: (f64, f64, Option<f64>),
        motion: (&str, bool, Option<usize>, usize),
        spent_on: (EffortNumbers, Option<u16>),
        kept_in: (Option<PathBuf>, Option<PathBuf>, Parts),
        callbacks: (Callback, Callback),
    ) -> PyResult<String> {
        let (from_hz, to_hz, step_hz) = asked;
        let (start, down, starts, samples) = motion;
        let (spent, jobs) = spent_on;
        let (results, out, (part, parts)) = kept_in;
        let part = part.map(|text| job_part(py, &text)).transpose()?;
        let starts = match starts {
            Some(starts) => SweepStarts::Many(starts),
            None => SweepStarts::CarriedOver { initial: initial(py, start, &self.study)?, down },
        };
        let frequencies = FrequencySeries { from_hz, to_hz, step_hz };
        let request = SweepRequest { frequencies, starts, samples, effort: effort(spent) };
        let folders = folders(&results, &out);
        let report = PythonObserver::run(py, callbacks, |observer| match part {
            Some(part) => {
                let report = sweep_part(&self.study, (&request, part), folders, threads(jobs), observer);
                report.map(|report| document(&report))
            }
            None => {
                let asked = (&request, parts.as_slice());
                let report = sweep_with_parts(&self.study, asked, folders, threads(jobs), observer);
                report.map(|report| document(&report))
            }
        })?;
        report.map_err(|error| exception(py, error))
    }

    /// Lyapunov exponents over `(from_hz, to_hz, step_hz)`.
    fn lyapunov(
        &self,
        py: Python<'_>,
        asked: (f64, f64, Option<f64>),
        motion: (&str, u64, u64, u64),
        kept_in: (Option<PathBuf>, Option<PathBuf>),
        callbacks: (Callback, Callback),
    ) -> PyResult<String> {
        let (from_hz, to_hz, step_hz) = asked;
        let (start, transient_periods, periods, sections_per_period) = motion;
        let (results, out) = kept_in;
        let request = ExponentsRequest {
            frequencies: FrequencySeries { from_hz, to_hz, step_hz },
            initial: initial(py, start, &self.study)?,
            transient_periods,
            periods,
            sections_per_period,
        };
        let report = PythonObserver::run(py, callbacks, |observer| {
            exponents(&self.study, &request, folders(&results, &out), observer)
        })?;
        Ok(document(&report.map_err(|error| exception(py, error))?))
    }

    /// Basins over a grid of two coordinates `(name, low, high)`, or a part of them.
    fn basins(
        &self,
        py: Python<'_>,
        frequency_hz: f64,
        asked: ((String, f64, f64), (String, f64, f64), u32),
        spent_on: (EffortNumbers, Option<u16>),
        kept_in: (Option<PathBuf>, Option<PathBuf>, Parts),
        callbacks: (Callback, Callback),
    ) -> PyResult<String> {
        let (x, y, grid) = asked;
        let (spent, jobs) = spent_on;
        let (results, out, (part, parts)) = kept_in;
        let part = part.map(|text| job_part(py, &text)).transpose()?;
        let axis = |(coordinate, low, high)| BasinAxis { coordinate, low, high };
        let request = BasinsRequest { frequency_hz, x: axis(x), y: axis(y), grid, effort: effort(spent) };
        let folders = folders(&results, &out);
        let report = PythonObserver::run(py, callbacks, |observer| match part {
            Some(part) => {
                let report = basins_part(&self.study, (&request, part), folders, threads(jobs), observer);
                report.map(|report| document(&report))
            }
            None => {
                let asked = (&request, parts.as_slice());
                let report = basins_with_parts(&self.study, asked, folders, threads(jobs), observer);
                report.map(|report| document(&report))
            }
        })?;
        report.map_err(|error| exception(py, error))
    }
}
