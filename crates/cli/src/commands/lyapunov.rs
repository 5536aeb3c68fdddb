//! `hammerbeam lyapunov`: the exponents of a motion.

use hammerbeam_attractor::{
    Lyapunov, LyapunovSettings, SectionMap, Spectrum, SystemMap, sections_needed, zero_one,
};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_study::{Model, StudyFile};
use serde_json::{Value, json};

use super::simulate::folder;
use crate::{
    failure::Failure,
    initial,
    interrupt::Interrupt,
    motion_args::LyapunovOptions,
    output::Output,
    table::{Table, header, number},
    ticker::Ticker,
};

/// Periods over which tangent vectors turn into their directions.
const ALIGNING: u64 = 50;
/// Correlation of neighbouring blocks beyond which the confidence is not to be trusted: two standard errors with 20 blocks.
const CORRELATED: f64 = 0.45;

pub fn run(options: &LyapunovOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    let model = Model::build(&file)?;
    let mut map = SystemMap::new(model.system.clone(), options.frequency, 1, ExactSettings::default())?;
    let mut state = initial::state(&options.initial, &mut map, (&file, &model), options.results.as_deref())?;
    let interrupt = Interrupt::listen()?;
    let mut ticker = Ticker::new(options.transient_periods + ALIGNING + options.periods, "periods");
    for period in 0..options.transient_periods {
        if interrupt.raised() {
            return Err(Failure::Interrupted("interrupted before anything was averaged".to_owned()));
        }
        state = map.advance(period, &state)?;
        ticker.at(period, String::new);
    }
    let parts = match options.sections_per_period {
        Some(parts) => parts,
        None => sections_needed(&mut map, &state)?,
    };
    map.set_parts(parts);
    let settings = LyapunovSettings {
        aligning: ALIGNING * parts,
        averaged: options.periods.next_multiple_of(20) * parts,
    };
    let mut average = Lyapunov::new(&map, 0, &state, settings)?;
    let mut series = Vec::new();
    while !interrupt.raised() && average.step(&mut map)? {
        let sections = average.progress().0;
        if sections > settings.aligning && sections.is_multiple_of(parts) {
            series.push(average.state()[0]);
        }
        ticker.at(options.transient_periods + sections / parts, String::new);
    }
    ticker.clear();
    let Some(spectrum) = average.spectrum() else {
        return Err(Failure::Interrupted("interrupted before two blocks were averaged".to_owned()));
    };
    let result = Outcome { spectrum, parts, divergence: map.divergence(), zero_one: zero_one(&series) };
    result.write(options)?;
    if interrupt.raised() {
        let kept = if options.out.is_some() { "kept" } else { "computed" };
        return Err(Failure::Interrupted(format!(
            "interrupted; the average over {:.6} s is {kept}",
            result.spectrum.time
        )));
    }
    output.give(&result.document(options), || result.text(options));
    Ok(())
}

struct Outcome {
    spectrum: Spectrum,
    parts: u64,
    divergence: f64,
    zero_one: Option<f64>,
}

impl Outcome {
    fn write(&self, options: &LyapunovOptions) -> Result<(), Failure> {
        let Some(folder) = &options.out else { return Ok(()) };
        let mut table = Table::begin(
            folder,
            "exponents.csv",
            &header(&["number", "exponent_per_s", "half_width_per_s"]),
        )?;
        for (index, exponent) in self.spectrum.exponents.iter().enumerate() {
            table.row(&[(index + 1).to_string(), number(exponent.value), number(exponent.half_width)])?;
        }
        table.finish()?;
        let mut words = vec!["time_s".to_owned()];
        words.extend((1..=self.spectrum.exponents.len()).map(|i| format!("exponent_{i}_per_s")));
        let mut table = Table::begin(folder, "convergence.csv", &words)?;
        for place in &self.spectrum.convergence {
            let entries = std::iter::once(&place.time).chain(&place.exponents);
            table.row(&entries.map(|value| number(*value)).collect::<Vec<_>>())?;
        }
        table.finish()?;
        Ok(())
    }

    /// What the sign of the largest exponent says.
    fn verdict(&self) -> &'static str {
        let largest = self.spectrum.exponents[0];
        if largest.low() > 0.0 {
            "positive"
        } else if largest.high() < 0.0 {
            "negative"
        } else {
            "not told from zero"
        }
    }

    fn correlated(&self) -> bool {
        self.spectrum.block_correlation.abs() > CORRELATED
    }

    fn document(&self, options: &LyapunovOptions) -> Value {
        let spectrum = &self.spectrum;
        let convergence = spectrum
            .convergence
            .iter()
            .map(|place| json!({ "time_s": place.time, "exponents_per_s": place.exponents }));
        json!({
            "frequency_hz": options.frequency,
            "transient_periods": options.transient_periods,
            "averaged_periods": (spectrum.time * options.frequency).round(),
            "time_s": spectrum.time,
            "sections_per_period": self.parts,
            // Minus infinity, of directions that a rigid stop takes for good, is null in JSON.
            "exponents_per_s": spectrum.exponents.iter().map(|exponent| exponent.value).collect::<Vec<_>>(),
            "half_widths_per_s": spectrum.exponents.iter().map(|exponent| exponent.half_width).collect::<Vec<_>>(),
            "confidence": 0.95,
            "largest_exponent": self.verdict(),
            "block_correlation": spectrum.block_correlation,
            "blocks_are_independent": !self.correlated(),
            "sum_per_s": spectrum.sum,
            "divergence_per_s": self.divergence,
            "expected_sum_per_s": spectrum.expected_sum,
            "kaplan_yorke_dimension": spectrum.kaplan_yorke_dimension,
            "zero_one_k": self.zero_one,
            "convergence": convergence.collect::<Vec<_>>(),
            "results": folder(options.out.as_deref()),
        })
    }

    fn text(&self, options: &LyapunovOptions) -> String {
        let spectrum = &self.spectrum;
        let mut lines = vec![format!(
            "exponents at {} Hz over {:.6} s, {} section(s) in a period, with intervals of 95 %",
            options.frequency, spectrum.time, self.parts
        )];
        for exponent in &spectrum.exponents {
            lines.push(format!("  {:>14.6} +- {:.6} 1/s", exponent.value, exponent.half_width));
        }
        lines.push(format!("  sum            {:.9} 1/s", spectrum.sum));
        lines.push(format!("  -tr(M^-1 C)    {:.9} 1/s", self.divergence));
        if let Some(expected) = spectrum.expected_sum.filter(|expected| *expected != self.divergence) {
            lines.push(format!("  with contacts  {expected:.9} 1/s"));
        }
        if spectrum.sum == f64::NEG_INFINITY {
            lines.push("  a rigid stop sticks: what is minus infinity was forgotten there".to_owned());
        }
        lines.push(format!(
            "  Kaplan-Yorke dimension of the stroboscopic section {:.4}",
            spectrum.kaplan_yorke_dimension
        ));
        if let Some(k) = self.zero_one {
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
