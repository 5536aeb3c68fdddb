//! `[rig]`: a measurement made with another model, to be held against this one.

use crate::document::{TomlTable, Value, quantity};

use super::Excitation;

/// How a virtual rig is built and measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Rig {
    /// Ends of the sweeps [Hz].
    pub sweep_hz: [f64; 2],
    /// Their step [Hz].
    pub step_hz: f64,
    /// Excitation periods in which a motion settles at each frequency.
    pub settling_periods: u32,
    /// Excitation periods that are recorded.
    pub recorded_periods: u32,
    /// Sampling rate of the records [Hz].
    pub sampling_hz: f64,
    /// Cut-off of the low-pass filter of the accelerometers [Hz].
    pub low_pass_hz: f64,
    /// Order of the filter.
    pub low_pass_order: u32,
    /// Further cut-offs with which the branches are seen [Hz].
    pub other_low_pass_hz: Vec<f64>,
    /// Standard deviation of the noise of accelerometers [m/s²],
    pub noise_m_s2: f64,
    /// and of displacement sensors [m].
    pub noise_m: f64,
    /// Seed of the noise.
    pub seed: u32,
    /// Measured frequencies whose signals are compared, with the period multiple that is looked for.
    pub signals: Vec<(f64, u32)>,
}

/// Measured signals of figures 7 to 14 of the paper: frequency and period multiple.
const SIGNALS: [(f64, u32); 8] =
    [(31.0, 1), (31.5, 1), (33.6, 1), (34.5, 1), (50.8, 2), (61.65, 2), (63.7, 2), (66.5, 2)];

pub(super) fn read(root: &TomlTable<'_>, excitation: Option<&Excitation>) -> Option<Option<Rig>> {
    let Some(value) = root.optional("rig") else { return Some(None) };
    if excitation.is_some_and(Excitation::supports_differ) {
        let help = vec!["allowed: supports that all move alike, with `at = [...]`".to_owned()];
        value.problem("a rig has one table, but the supports move differently".to_owned(), help);
    }
    let has_no_amplitude = |excitation: &Excitation| {
        excitation.harmonic().is_some_and(|harmonic| harmonic.amplitude().is_none())
    };
    if excitation.is_some_and(|one| !one.supports_differ() && has_no_amplitude(one)) {
        let help = vec!["allowed: one force with `at` and `amplitude_n`".to_owned()];
        value.problem(
            "a rig has one table, but the forces are several, a pair or an unbalance".to_owned(),
            help,
        );
    }
    let table = value.table()?;
    // What differs from this study is read when the rig is built.
    let changes = table.required("changes").and_then(|value| value.table());
    let sweep = table.required("sweep_hz").and_then(|value| value.numbers::<2>(&quantity::FREQUENCY));
    let number = |key, quantity, default: f64| {
        table.optional(key).map_or(Some(default), |value| value.number(quantity))
    };
    let whole =
        |key, low, high, default| table.optional(key).map_or(Some(default), |value| value.whole(low, high));
    let step = number("step_hz", &quantity::STEP, 0.5);
    let settling = whole("settling_periods", 1, 1_000_000, 200);
    let recorded = whole("recorded_periods", 10, 10_000, 40);
    let sampling = number("sampling_hz", &quantity::FREQUENCY, 10_000.0);
    let low_pass = number("low_pass_hz", &quantity::FREQUENCY, 850.0);
    let order = whole("low_pass_order", 1, 32, 4);
    let others = table.optional("other_low_pass_hz").map_or(Some(vec![1500.0, 3000.0]), |value| list(&value));
    let noise_acceleration = number("noise_m_s2", &quantity::NOISE, 0.0);
    let noise_displacement = number("noise_m", &quantity::NOISE, 0.0);
    let seed = whole("seed", 0, u32::MAX, 1);
    let signals = table.optional("signals").map_or(Some(SIGNALS.to_vec()), |value| signals(&value));
    table.finish();
    changes?;
    let sweep_hz = sweep?;
    if sweep_hz[0] >= sweep_hz[1] {
        let help = vec!["allowed: [low, high] with low < high".to_owned()];
        root.problem("rig", format!("`sweep_hz` is [{}, {}]", sweep_hz[0], sweep_hz[1]), help);
        return None;
    }
    Some(Some(Rig {
        sweep_hz,
        step_hz: step?,
        settling_periods: settling?,
        recorded_periods: recorded?,
        sampling_hz: sampling?,
        low_pass_hz: low_pass?,
        low_pass_order: order?,
        other_low_pass_hz: others?,
        noise_m_s2: noise_acceleration?,
        noise_m: noise_displacement?,
        seed: seed?,
        signals: signals?,
    }))
}

fn list(value: &Value<'_>) -> Option<Vec<f64>> {
    let entries = value.array_of("frequencies")?;
    entries.iter().map(|entry| entry.number(&quantity::FREQUENCY)).collect()
}

fn signals(value: &Value<'_>) -> Option<Vec<(f64, u32)>> {
    let pair = |entry: &Value<'_>| {
        let entries = entry.array_of("[frequency in Hz, period multiple]")?;
        let [frequency, period] = &entries[..] else {
            let help = vec!["allowed: [frequency in Hz, period multiple]".to_owned()];
            entry.problem(format!("a signal has {} entries", entries.len()), help);
            return None;
        };
        Some((frequency.number(&quantity::FREQUENCY)?, period.whole(1, 64)?))
    };
    value.array_of("pairs [frequency in Hz, period multiple]")?.iter().map(pair).collect()
}
