//! `hammerbeam lyapunov`: the exponents of a motion.

use hammerbeam_attractor::{Lyapunov, LyapunovSettings, SectionMap, SystemMap, WATCHED_PERIODS, zero_one};
use hammerbeam_figure::FrequencyUnit;
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{
    Store,
    export::write_exponents,
    store::{ExponentRecord, RequestKind},
};
use hammerbeam_study::{Model, StudyFile};
use serde_json::{Value, json};

use super::simulate::folder;
use crate::{
    failure::Failure,
    initial,
    interrupt::Interrupt,
    kept::{Kept, state_words},
    motion_args::LyapunovOptions,
    output::Output,
    series::series,
    ticker::Ticker,
};

/// Periods over which tangent vectors turn into their directions.
const ALIGNING: u64 = 50;
/// What contacts take is told where it is more than this share of what dampers take.
const ROUNDING: f64 = 1e-12;
/// Correlation of neighbouring blocks beyond which the confidence is not to be trusted: two standard errors
/// with 20 blocks.
const CORRELATED: f64 = 0.45;
/// Points of a stroboscopic section that are kept.
const MOST_POINTS: usize = 4096;

pub fn run(options: &LyapunovOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    file.forced()?;
    let model = Model::build(&file)?;
    let ends = (options.frequency, options.to.unwrap_or(options.frequency));
    let frequencies = series(ends, options.step, "--frequency")?;
    let mut motion = Motion::new(options, &model)?;
    let states = motion.initial_states(&file, &frequencies)?;
    let words = words(options, &frequencies, &states);
    let request = (RequestKind::Exponents, words.as_slice());
    let mut kept = Kept::open(options.out.as_deref(), &file, request, frequencies.len() as u64)?;
    let mut records = kept.read(Store::exponents)?;
    let mut whole_ones = records.len();
    let interrupt = Interrupt::listen(output)?;
    let periods = options.transient_periods + ALIGNING + options.periods;
    let mut ticker = Ticker::new(frequencies.len() as u64 * periods, "periods");
    for piece in kept.done as usize..frequencies.len() {
        let tell = |period: u64| {
            ticker.at(piece as u64 * periods + period, || format!("{:.4} Hz", frequencies[piece]));
        };
        let (record, whole) = motion.exponents(frequencies[piece], &states[piece], &interrupt, tell)?;
        if whole && let Some(record) = &record {
            kept.add(|store, request| store.append_exponents(request, piece as u64, record))?;
        }
        whole_ones += usize::from(whole);
        records.extend(record);
        if !whole {
            break;
        }
    }
    ticker.clear();
    interrupt.is_in_order();
    // Under the lock of the folder: two commands do not write the same tables at once.
    let written =
        options.out.as_ref().map_or_else(|| Ok(vec![]), |folder| write_exponents(folder, "", &records));
    kept.finish()?;
    let fate = format!("{whole_ones} of {} spectra {}", frequencies.len(), kept.fate(whole_ones as u64));
    written.map_err(|error| Failure::from(error).and(&fate))?;
    if whole_ones < frequencies.len() {
        let mut message = format!("interrupted; {fate}");
        if let Some(part) = records.get(whole_ones) {
            message +=
                &format!("; the tables have what was averaged over {:.6} s of one more", part.spectrum.time);
        }
        return Err(Failure::Interrupted(message));
    }
    let results: Vec<Outcome> = records.iter().map(|record| Outcome { options, record }).collect();
    output.give(&document(options, &results), || text(&results, output.frequency_unit))?;
    Ok(())
}

/// What is asked of the study.
fn words(options: &LyapunovOptions, frequencies: &[f64], states: &[Vec<f64>]) -> Vec<String> {
    let mut words = vec![
        format!("from_hz = {:e}", options.frequency),
        format!("to_hz = {:e}", options.to.unwrap_or(options.frequency)),
        format!("frequencies = {}", frequencies.len()),
        format!("transient_periods = {}", options.transient_periods),
        format!("periods = {}", options.periods),
        format!("sections_per_period = {}", options.sections_per_period),
    ];
    words.extend(states.first().into_iter().flat_map(|state| state_words(state)));
    words
}

/// The motion whose exponents are taken.
struct Motion<'a> {
    options: &'a LyapunovOptions,
    model: &'a Model,
    map: SystemMap,
}

impl<'a> Motion<'a> {
    fn new(options: &'a LyapunovOptions, model: &'a Model) -> Result<Self, Failure> {
        let map = SystemMap::new(model.system.clone(), options.frequency, 1, ExactSettings::default())?;
        Ok(Self { options, model, map })
    }

    /// Where the motion begins at each frequency.
    fn initial_states(&mut self, file: &StudyFile, frequencies: &[f64]) -> Result<Vec<Vec<f64>>, Failure> {
        let (options, model) = (self.options, self.model);
        let mut at = |frequency_hz: &f64| {
            self.map.set_frequency(*frequency_hz);
            initial::state(&options.initial, &mut self.map, (file, model), options.results.as_deref())
        };
        frequencies.iter().map(&mut at).collect()
    }

    /// The exponents at a frequency, and whether they are averaged as long as they should be: if the user
    /// stops it they are not, or there are none.
    fn exponents(
        &mut self,
        frequency_hz: f64,
        initial: &[f64],
        interrupt: &Interrupt,
        mut tell: impl FnMut(u64),
    ) -> Result<(Option<ExponentRecord>, bool), Failure> {
        let map = &mut self.map;
        map.set_frequency(frequency_hz);
        map.set_parts(1);
        let mut state = initial.to_vec();
        for period in 0..self.options.transient_periods {
            if interrupt.raised() {
                return Ok((None, false));
            }
            state = map.advance(period, &state)?;
            tell(period);
        }
        map.check_opens(&state, WATCHED_PERIODS)?;
        let parts = self.options.sections_per_period;
        map.set_parts(parts);
        let settings = LyapunovSettings {
            aligning: ALIGNING * parts,
            averaged: self.options.periods.next_multiple_of(20) * parts,
        };
        let mut average = Lyapunov::new(map, 0, &state, settings)?;
        let mut states = Vec::new();
        let mut whole = false;
        while !interrupt.raised() {
            if !average.step(map)? {
                whole = true;
                break;
            }
            let sections = average.progress().0;
            if sections > settings.aligning && sections.is_multiple_of(parts) {
                states.push(average.state().to_vec());
            }
            tell(self.options.transient_periods + sections / parts);
        }
        if whole {
            map.check_opens(average.state(), WATCHED_PERIODS)?;
        }
        let Some(spectrum) = average.spectrum() else { return Ok((None, false)) };
        let series: Vec<f64> = states.iter().map(|state| state[0]).collect();
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
        let response = &self.model.response;
        let [carried, speed, ..] = self.model.system.carried(&response.support_ratios, frequency_hz, 0.0);
        let (displacements, velocities) = state.split_at(state.len() / 2);
        let read = |values: &[f64]| response.shape.iter().zip(values).map(|(a, b)| a * b).sum::<f64>();
        [read(displacements) + carried, read(velocities) + speed]
    }
}

/// The exponents at one frequency, for the user.
struct Outcome<'a> {
    options: &'a LyapunovOptions,
    record: &'a ExponentRecord,
}

impl Outcome<'_> {
    /// What the sign of the largest exponent says.
    fn verdict(&self) -> &'static str {
        let largest = self.record.spectrum.exponents[0];
        if largest.low() > 0.0 {
            "positive"
        } else if largest.high() < 0.0 {
            "negative"
        } else {
            "not told from zero"
        }
    }

    fn correlated(&self) -> bool {
        self.record.spectrum.block_correlation.abs() > CORRELATED
    }

    fn document(&self) -> Value {
        let (options, spectrum) = (self.options, &self.record.spectrum);
        let convergence = spectrum
            .convergence
            .iter()
            .map(|place| json!({ "time_s": place.time, "exponents_per_s": place.exponents }));
        json!({
            "frequency_hz": self.record.frequency_hz,
            "transient_periods": options.transient_periods,
            "averaged_periods": (spectrum.time * self.record.frequency_hz).round(),
            "time_s": spectrum.time,
            "sections_per_period": self.record.sections_per_period,
            // Minus infinity, of directions that a rigid stop takes for good, is null in JSON.
            "exponents_per_s": spectrum.exponents.iter().map(|exponent| exponent.value).collect::<Vec<_>>(),
            "half_widths_per_s": spectrum.exponents.iter().map(|exponent| exponent.half_width).collect::<Vec<_>>(),
            "confidence": 0.95,
            "largest_exponent": self.verdict(),
            "block_correlation": spectrum.block_correlation,
            "blocks_are_independent": !self.correlated(),
            "sum_per_s": spectrum.sum,
            "divergence_per_s": self.record.divergence,
            "expected_sum_per_s": spectrum.expected_sum,
            "kaplan_yorke_dimension": spectrum.kaplan_yorke_dimension,
            "zero_one_k": self.record.zero_one,
            "convergence": convergence.collect::<Vec<_>>(),
            "results": folder(options.out.as_deref()),
        })
    }

    fn text(&self, unit: FrequencyUnit) -> String {
        let spectrum = &self.record.spectrum;
        let mut lines = vec![format!(
            "exponents at {} over {:.6} s, {} section(s) in a period, with intervals of 95 %",
            unit.words(self.record.frequency_hz),
            spectrum.time,
            self.record.sections_per_period
        )];
        for exponent in &spectrum.exponents {
            lines.push(format!("  {:>14.6} +- {:.6} 1/s", exponent.value, exponent.half_width));
        }
        lines.push(format!("  sum            {:.9} 1/s", spectrum.sum));
        lines.push(format!("  -tr(M^-1 C)    {:.9} 1/s", self.record.divergence));
        let adds = |expected: &f64| (expected / self.record.divergence - 1.0).abs() > ROUNDING;
        if let Some(expected) = spectrum.expected_sum.filter(adds) {
            lines.push(format!("  with contacts  {expected:.9} 1/s"));
        }
        if spectrum.sum == f64::NEG_INFINITY {
            lines.push("  a rigid stop sticks: what is minus infinity was forgotten there".to_owned());
        }
        lines.push(format!(
            "  Kaplan-Yorke dimension of the stroboscopic section {:.4}",
            spectrum.kaplan_yorke_dimension
        ));
        if let Some(k) = self.record.zero_one {
            lines.push(format!("  K of the 0-1 test {k:.3}"));
        }
        lines.push(format!("the largest exponent is {}", self.verdict()));
        if self.correlated() {
            let correlation = spectrum.block_correlation;
            lines.push(format!("neighbouring blocks are correlated ({correlation:.2}): the intervals are too small; take more periods"));
        }
        lines.join("\n")
    }
}

/// The document of the only spectrum, or of a series.
fn document(options: &LyapunovOptions, results: &[Outcome<'_>]) -> Value {
    match results {
        [only] if options.to.is_none() => only.document(),
        _ => json!({
            "spectra": results.iter().map(Outcome::document).collect::<Vec<_>>(),
            "results": folder(options.out.as_deref()),
        }),
    }
}

/// All of the only spectrum, or a row for each of a series.
fn text(results: &[Outcome<'_>], unit: FrequencyUnit) -> String {
    if let [only] = results {
        return only.text(unit);
    }
    let mut lines = vec![format!(
        "{:>12} {:>28} {:>10} {:>6}  {}",
        unit.symbol(),
        "largest exponent 1/s",
        "dimension",
        "K",
        "which is"
    )];
    for result in results {
        let (record, spectrum) = (result.record, &result.record.spectrum);
        let largest = spectrum.exponents[0];
        let k = record.zero_one.map_or_else(String::new, |k| format!("{k:.2}"));
        lines.push(format!(
            "{:>12.6} {:>14.6} +- {:<10.6} {:>10.4} {k:>6}  {}",
            unit.factor() * record.frequency_hz,
            largest.value,
            largest.half_width,
            spectrum.kaplan_yorke_dimension,
            result.verdict()
        ));
    }
    lines.join("\n")
}
