//! `[rig]`: a measurement made with another model, to be held against this one.

use crate::document::{
    Key, KeyRow, Quantity, TomlTable, Value,
    key::{KeyRange, Whole},
    quantity,
};

use super::{Excitation, response::PERIOD_MULTIPLE};

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

/// Further filters [Hz].
const OTHER_LOW_PASS: [f64; 2] = [1500.0, 3000.0];

const STEP: Key<Quantity> = Key::new("step_hz", quantity::STEP, "their step").or(0.5);
const SETTLING_PERIODS: Key<Whole> =
    Key::new("settling_periods", Whole(1, 1_000_000), "excitation periods in which each motion settles")
        .or(200);
const RECORDED_PERIODS: Key<Whole> =
    Key::new("recorded_periods", Whole(10, 10_000), "excitation periods that are recorded").or(40);
const SAMPLING: Key<Quantity> =
    Key::new("sampling_hz", quantity::FREQUENCY, "sampling rate of the records").or(10_000.0);
const LOW_PASS: Key<Quantity> = Key::new(
    "low_pass_hz",
    quantity::FREQUENCY,
    "cut-off of the accelerometers' low-pass filter (Butterworth, causal)",
)
.or(850.0);
const LOW_PASS_ORDER: Key<Whole> = Key::new("low_pass_order", Whole(1, 32), "its order").or(4);
const ACCELERATION_NOISE: Key<Quantity> =
    Key::new("noise_m_s2", quantity::NOISE, "standard deviation of the noise of accelerometers").or(0.0);
const DISPLACEMENT_NOISE: Key<Quantity> =
    Key::new("noise_m", quantity::NOISE, "the same of displacement sensors").or(0.0);
const SEED: Key<Whole> = Key::new("seed", Whole(0, u32::MAX), "seed of the noise").or(1);

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let changes = KeyRow::read_apart(
        "changes",
        "table",
        "required",
        "what of the study is different on the rig, under the same keys: tables are merged, everything else, \
         lists of tables included, is replaced; `check` reads the result once the study itself has no fault",
    );
    let ends = "ends of the sweeps, up and then down again, each from rest";
    let sweep = KeyRow::read_apart("sweep_hz", "[low, high] in Hz", "required", ends);
    let others = KeyRow::read_apart(
        "other_low_pass_hz",
        "list of Hz",
        &format!("`{OTHER_LOW_PASS:?}`"),
        "further filters, of the same order, with which the branches are seen",
    );
    let signals = KeyRow::read_apart(
        "signals",
        "list of `[frequency in Hz, period multiple]`",
        "those of figures 7 to 14 of the paper",
        "measured signals for which the computed one that is most alike is sought",
    );
    let filters = [LOW_PASS.row(), LOW_PASS_ORDER.row(), others];
    let noise = [ACCELERATION_NOISE.row(), DISPLACEMENT_NOISE.row(), SEED.row()];
    let mut rows = vec![changes, sweep, STEP.row(), SETTLING_PERIODS.row()];
    rows.extend([RECORDED_PERIODS.row(), SAMPLING.row()]);
    rows.extend(filters.into_iter().chain(noise).chain([signals]));
    rows
}

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
    let step = STEP.read(&table);
    let settling = SETTLING_PERIODS.read(&table);
    let recorded = RECORDED_PERIODS.read(&table);
    let sampling = SAMPLING.read(&table);
    let low_pass = LOW_PASS.read(&table);
    let order = LOW_PASS_ORDER.read(&table);
    let others =
        table.optional("other_low_pass_hz").map_or(Some(OTHER_LOW_PASS.to_vec()), |value| list(&value));
    let noise_acceleration = ACCELERATION_NOISE.read(&table);
    let noise_displacement = DISPLACEMENT_NOISE.read(&table);
    let seed = SEED.read(&table);
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
        Some((frequency.number(&quantity::FREQUENCY)?, PERIOD_MULTIPLE.range.take(period)?))
    };
    value.array_of("pairs [frequency in Hz, period multiple]")?.iter().map(pair).collect()
}
