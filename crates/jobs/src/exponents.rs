//! Lyapunov exponents of a motion, at one frequency or at a series of them.

use hammerbeam_attractor::{Lyapunov, LyapunovSettings, SectionMap, SystemMap, WATCHED_PERIODS, zero_one};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{
    Store,
    export::write_exponents,
    store::{ExponentRecord, RequestKind},
};
use serde::{Serialize, Serializer};

use crate::{
    CountedProgress, FrequencySeries, InitialState, JobError, JobFolders, Observer, PreparedStudy,
    request::{KeptRequest, state_words},
};

/// Periods over which tangent vectors turn into their directions.
const ALIGNING: u64 = 50;
/// Correlation of neighbouring blocks beyond which the confidence is not to be trusted: two standard errors
/// with 20 blocks.
const CORRELATED: f64 = 0.45;
/// Points of a stroboscopic section that are kept.
const MOST_POINTS: usize = 4096;

/// Values that the 0-1 test takes: its work grows with their square, and a thousand are usual.
const MOST_TESTED: usize = 10_000;

/// What is asked of exponents.
#[derive(Debug, Clone, PartialEq)]
pub struct ExponentsRequest {
    /// The frequencies; the motion begins anew at each.
    pub frequencies: FrequencySeries,
    /// Where the motion begins.
    pub initial: InitialState,
    /// Excitation periods that are run first.
    pub transient_periods: u64,
    /// Excitation periods averaged over; rounded up to a multiple of 20.
    pub periods: u64,
    /// Sections in a period.
    pub sections_per_period: u64,
}

/// Spectra of exponents, one for each frequency.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExponentsReport {
    /// In the order of the frequencies.
    pub spectra: Vec<SpectrumReport>,
    /// The folder that keeps them, with their tables.
    pub results: Option<String>,
}

/// The exponents at a frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumReport {
    /// As it is stored.
    pub record: ExponentRecord,
    /// Excitation periods that were run first.
    pub transient_periods: u64,
    /// The folder that keeps it.
    pub results: Option<String>,
}

impl SpectrumReport {
    /// What the sign of the largest exponent says: `positive`, `negative` or `not told from zero`.
    #[must_use]
    pub fn verdict(&self) -> &'static str {
        let largest = self.record.spectrum.exponents[0];
        if largest.low() > 0.0 {
            "positive"
        } else if largest.high() < 0.0 {
            "negative"
        } else {
            "not told from zero"
        }
    }

    /// Whether neighbouring blocks are correlated, so that the intervals are too small.
    #[must_use]
    pub fn is_correlated(&self) -> bool {
        self.record.spectrum.block_correlation.abs() > CORRELATED
    }
}

impl Serialize for SpectrumReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Place<'a> {
            time_s: f64,
            exponents_per_s: &'a [f64],
        }
        #[derive(Serialize)]
        struct Document<'a> {
            frequency_hz: f64,
            transient_periods: u64,
            averaged_periods: f64,
            time_s: f64,
            sections_per_period: u64,
            exponents_per_s: Vec<f64>,
            half_widths_per_s: Vec<f64>,
            confidence: f64,
            largest_exponent: &'static str,
            block_correlation: f64,
            blocks_are_independent: bool,
            sum_per_s: f64,
            divergence_per_s: f64,
            expected_sum_per_s: Option<f64>,
            kaplan_yorke_dimension: f64,
            zero_one_k: Option<f64>,
            convergence: Vec<Place<'a>>,
            results: Option<&'a str>,
        }
        let (record, spectrum) = (&self.record, &self.record.spectrum);
        let convergence = spectrum.convergence.iter();
        let document = Document {
            frequency_hz: record.frequency_hz,
            transient_periods: self.transient_periods,
            averaged_periods: (spectrum.time * record.frequency_hz).round(),
            time_s: spectrum.time,
            sections_per_period: record.sections_per_period,
            // Minus infinity, of directions that a rigid stop takes for good, is null in JSON.
            exponents_per_s: spectrum.exponents.iter().map(|exponent| exponent.value).collect(),
            half_widths_per_s: spectrum.exponents.iter().map(|exponent| exponent.half_width).collect(),
            confidence: 0.95,
            largest_exponent: self.verdict(),
            block_correlation: spectrum.block_correlation,
            blocks_are_independent: !self.is_correlated(),
            sum_per_s: spectrum.sum,
            divergence_per_s: record.divergence,
            expected_sum_per_s: spectrum.expected_sum,
            kaplan_yorke_dimension: spectrum.kaplan_yorke_dimension,
            zero_one_k: record.zero_one,
            convergence: convergence
                .map(|at| Place { time_s: at.time, exponents_per_s: &at.exponents })
                .collect(),
            results: self.results.as_deref(),
        };
        document.serialize(serializer)
    }
}

/// Computes spectra of exponents, or what is left of them, and writes `spectra.csv`, `exponents.csv`,
/// `convergence.csv` and `section.csv`.
///
/// # Errors
/// [`JobError`]; [`JobError::Interrupted`] and [`JobError::Stopped`] with the number of whole spectra.
pub fn exponents(
    study: &PreparedStudy,
    request: &ExponentsRequest,
    folders: JobFolders<'_>,
    observer: &mut dyn Observer,
) -> Result<ExponentsReport, JobError> {
    study.file.forced()?;
    let frequencies = request.frequencies.frequencies()?;
    let mut motion = Motion::new(request, study)?;
    let states = motion.initial_states(folders, &frequencies)?;
    let words = words(request, &frequencies, &states);
    let identity = (RequestKind::Exponents, words.as_slice());
    let mut kept = KeptRequest::open(folders.out, &study.file, identity, frequencies.len() as u64)?;
    let mut records = kept.read(Store::exponents)?;
    let mut whole_ones = records.len();
    let periods = request.transient_periods + ALIGNING + request.periods;
    for piece in kept.done as usize..frequencies.len() {
        let mut counted = Counted {
            observer: &mut *observer,
            before: piece as u64 * periods,
            total: frequencies.len() as u64 * periods,
            frequency_hz: frequencies[piece],
        };
        let (record, whole) = motion.exponents(frequencies[piece], &states[piece], &mut counted)?;
        if whole && let Some(record) = &record {
            kept.add(|store, request| store.append_exponents(request, piece as u64, record))?;
        }
        whole_ones += usize::from(whole);
        records.extend(record);
        if !whole {
            break;
        }
    }
    observer.finishing();
    // Under the lock of the folder: two jobs do not write the same tables at once.
    let written = folders.out.map_or_else(|| Ok(vec![]), |folder| write_exponents(folder, "", &records));
    kept.finish()?;
    let done = whole_ones as u64;
    written.map_err(|error| JobError::from(error).stopped_after(done))?;
    if whole_ones < frequencies.len() {
        let part_s = records.get(whole_ones).map(|part| part.spectrum.time);
        return Err(JobError::Interrupted { done, part_s });
    }
    let report = |record: ExponentRecord| SpectrumReport {
        record,
        transient_periods: request.transient_periods,
        results: folders.shown(),
    };
    Ok(ExponentsReport { spectra: records.into_iter().map(report).collect(), results: folders.shown() })
}

/// What identifies the request in the store.
fn words(request: &ExponentsRequest, frequencies: &[f64], states: &[Vec<f64>]) -> Vec<String> {
    let mut words = vec![
        format!("from_hz = {:e}", request.frequencies.from_hz),
        format!("to_hz = {:e}", request.frequencies.to_hz),
        format!("frequencies = {}", frequencies.len()),
        format!("transient_periods = {}", request.transient_periods),
        format!("periods = {}", request.periods),
        format!("sections_per_period = {}", request.sections_per_period),
    ];
    words.extend(states.first().into_iter().flat_map(|state| state_words(state)));
    words
}

/// Counts the periods of one spectrum among those of all.
struct Counted<'a> {
    observer: &'a mut dyn Observer,
    /// Periods of the spectra before.
    before: u64,
    total: u64,
    frequency_hz: f64,
}

impl Counted<'_> {
    fn at(&mut self, period: u64) {
        self.observer.counted(&CountedProgress {
            done: self.before + period,
            total: Some(self.total),
            things: "periods",
            place: &format_args!("{:.4} Hz", self.frequency_hz),
        });
    }

    fn interrupted(&mut self) -> bool {
        self.observer.interrupted()
    }
}

/// The motion whose exponents are taken.
struct Motion<'a> {
    request: &'a ExponentsRequest,
    study: &'a PreparedStudy,
    map: SystemMap,
}

impl<'a> Motion<'a> {
    fn new(request: &'a ExponentsRequest, study: &'a PreparedStudy) -> Result<Self, JobError> {
        let system = study.model.system.clone();
        let map = SystemMap::new(system, request.frequencies.from_hz, 1, ExactSettings::default())?;
        Ok(Self { request, study, map })
    }

    /// Where the motion begins at each frequency.
    fn initial_states(
        &mut self,
        folders: JobFolders<'_>,
        frequencies: &[f64],
    ) -> Result<Vec<Vec<f64>>, JobError> {
        let (request, study) = (self.request, self.study);
        let mut at = |frequency_hz: &f64| {
            self.map.set_frequency(*frequency_hz);
            request.initial.at(&mut self.map, study, folders.results)
        };
        frequencies.iter().map(&mut at).collect()
    }

    /// The exponents at a frequency, and whether they are averaged as long as they should be: when the
    /// observer says stop they are not, or there are none.
    fn exponents(
        &mut self,
        frequency_hz: f64,
        initial: &[f64],
        counted: &mut Counted<'_>,
    ) -> Result<(Option<ExponentRecord>, bool), JobError> {
        let (request, map) = (self.request, &mut self.map);
        map.set_frequency(frequency_hz);
        map.set_parts(1);
        let mut state = initial.to_vec();
        for period in 0..request.transient_periods {
            if counted.interrupted() {
                return Ok((None, false));
            }
            state = map.advance(period, &state)?;
            counted.at(period);
        }
        map.check_opens(&state, WATCHED_PERIODS)?;
        let parts = request.sections_per_period;
        map.set_parts(parts);
        let settings = LyapunovSettings {
            aligning: ALIGNING * parts,
            averaged: request.periods.next_multiple_of(20) * parts,
        };
        let mut average = Lyapunov::new(map, 0, &state, settings)?;
        let mut states = Vec::new();
        let mut whole = false;
        while !counted.interrupted() {
            if !average.step(map)? {
                whole = true;
                break;
            }
            let sections = average.progress().0;
            if sections > settings.aligning && sections.is_multiple_of(parts) {
                states.push(average.state().to_vec());
            }
            counted.at(request.transient_periods + sections / parts);
        }
        if whole {
            map.check_opens(average.state(), WATCHED_PERIODS)?;
        }
        let Some(spectrum) = average.spectrum() else { return Ok((None, false)) };
        let series: Vec<f64> = states.iter().take(MOST_TESTED).map(|state| state[0]).collect();
        let record = ExponentRecord {
            frequency_hz,
            sections_per_period: parts,
            spectrum,
            divergence: map.divergence(),
            zero_one: zero_one(&series),
            section: states.iter().take(MOST_POINTS).map(|state| self.point(frequency_hz, state)).collect(),
        };
        Ok((Some(record), whole))
    }

    /// Displacement and velocity of the response point at phase 0.
    fn point(&self, frequency_hz: f64, state: &[f64]) -> [f64; 2] {
        let response = &self.study.model.response;
        let system = &self.study.model.system;
        let [carried, speed, ..] = system.carried(&response.support_ratios, frequency_hz, 0.0);
        let (displacements, velocities) = state.split_at(state.len() / 2);
        let read = |values: &[f64]| response.shape.iter().zip(values).map(|(a, b)| a * b).sum::<f64>();
        [read(displacements) + carried, read(velocities) + speed]
    }
}
