//! How a motion is written down: what its request was asked for, and so the lengths of what is stored of it.

use std::{ops::RangeInclusive, str::FromStr};

use super::{RequestRecord, StoreError};

/// Degrees of freedom and samples in a period at most, of what is read.
const MOST: u32 = 1_000_000;

/// How a motion is written down.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulationLayout {
    /// Periods that are run first; nothing but the state behind them is kept.
    pub transient_periods: u64,
    /// Periods that are written down.
    pub periods: u64,
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Samples in a period, at equal steps from its start.
    pub samples_per_period: u32,
    /// Phase of the section [cycles].
    pub section_phase: f64,
    /// Degrees of freedom n.
    pub dof: usize,
    /// Names of the local elements, which have no end of line.
    pub elements: Vec<String>,
}

impl SimulationLayout {
    /// The layout as words of a request.
    #[must_use]
    pub fn words(&self) -> Vec<String> {
        let mut words = vec![
            format!("transient_periods = {}", self.transient_periods),
            format!("periods = {}", self.periods),
            format!("frequency_hz = {:e}", self.frequency_hz),
            format!("samples_per_period = {}", self.samples_per_period),
            format!("section_phase = {:e}", self.section_phase),
            format!("dof = {}", self.dof),
        ];
        let named = self.elements.iter().enumerate();
        words.extend(named.map(|(index, name)| format!("element[{index}] = {}", crate::export::word(name))));
        words
    }

    /// That of a request.
    ///
    /// # Errors
    /// A word is missing, is no number, or is none that can be asked for.
    pub fn of(request: &RequestRecord) -> Result<Self, StoreError> {
        let name = |index: usize| request.word(&format!("element[{index}]")).map(str::to_owned);
        let any = 0..=u64::from(u32::MAX);
        Ok(Self {
            transient_periods: value(request, "transient_periods", any.clone())?,
            periods: value(request, "periods", any)?,
            frequency_hz: value(request, "frequency_hz", f64::MIN_POSITIVE..=f64::MAX)?,
            samples_per_period: value(request, "samples_per_period", 1..=MOST)?,
            section_phase: value(request, "section_phase", 0.0..=1.0)?,
            dof: value(request, "dof", 1..=MOST as usize)?,
            elements: (0..).map_while(name).collect(),
        })
    }

    /// Phase of a sample of a period [cycles].
    #[must_use]
    pub fn phase(&self, sample: u32) -> f64 {
        f64::from(sample) / f64::from(self.samples_per_period)
    }

    /// Numbers of a sample in the store.
    #[must_use]
    pub fn numbers_of_sample(&self) -> usize {
        3 + 2 * self.elements.len()
    }

    /// Numbers of a point of the section in the store.
    #[must_use]
    pub fn numbers_of_section(&self) -> usize {
        2 + 2 * self.dof
    }

    /// Numbers of a period in the store, without its contacts.
    #[must_use]
    pub fn numbers_of_period(&self) -> u64 {
        u64::from(self.samples_per_period) * self.numbers_of_sample() as u64
            + self.numbers_of_section() as u64
    }

    /// Refuses the number of an element that there is not.
    pub(super) fn check_element(&self, number: usize) -> Result<(), StoreError> {
        let unknown =
            || StoreError::Unknown { what: "local element of a contact", found: number.to_string() };
        self.elements.get(number).map(|_| ()).ok_or_else(unknown)
    }
}

/// Refuses another length in numbers than expected, reported in bytes.
pub(super) fn check_length(what: &'static str, found: usize, expected: usize) -> Result<(), StoreError> {
    if found == expected {
        return Ok(());
    }
    Err(StoreError::Damaged { what, found: 8 * found, expected: expected.saturating_mul(8) })
}

/// The number behind a key of the words.
fn value<T: FromStr + PartialOrd>(
    request: &RequestRecord,
    key: &str,
    range: RangeInclusive<T>,
) -> Result<T, StoreError> {
    let found = request.word(key).unwrap_or_default();
    let unknown = || StoreError::Unknown { what: "layout of a motion", found: format!("{key} = {found}") };
    found.parse().ok().filter(|number| range.contains(number)).ok_or_else(unknown)
}
