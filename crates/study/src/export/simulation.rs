//! Motions in time as CSV: samples, contacts, and the section at a phase, chunk by chunk.
//!
//! The tables hold what the store holds; times and phases of samples follow from their numbers.

use std::path::{Path, PathBuf};

use super::{
    ExportError,
    table::{Table, header, number, word},
};
use crate::store::{RequestRecord, SimulatedChunk, SimulatedContact, Store, StoreError};

/// How a motion is written down.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulationLayout {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Samples in a period, at equal steps from its start.
    pub samples_per_period: u32,
    /// Phase of the section [cycles].
    pub section_phase: f64,
    /// Degrees of freedom n.
    pub dof: usize,
    /// Names of the local elements.
    pub elements: Vec<String>,
}

impl SimulationLayout {
    /// The layout as words of a request.
    #[must_use]
    pub fn words(&self) -> Vec<String> {
        let mut words = vec![
            format!("frequency_hz = {:e}", self.frequency_hz),
            format!("samples_per_period = {}", self.samples_per_period),
            format!("section_phase = {:e}", self.section_phase),
            format!("dof = {}", self.dof),
        ];
        let named = self.elements.iter().enumerate();
        words.extend(named.map(|(index, name)| format!("element[{index}] = {}", word(name))));
        words
    }

    /// That of a request.
    ///
    /// # Errors
    /// A word is missing or is no number.
    pub fn of(request: &RequestRecord) -> Result<Self, StoreError> {
        fn value<T: std::str::FromStr>(request: &RequestRecord, key: &str) -> Result<T, StoreError> {
            let found = request.word(key).unwrap_or_default();
            let unknown =
                || StoreError::Unknown { what: "layout of a motion", found: format!("{key} = {found}") };
            found.parse().map_err(|_| unknown())
        }
        let name = |index: usize| request.word(&format!("element[{index}]")).map(str::to_owned);
        Ok(Self {
            frequency_hz: value(request, "frequency_hz")?,
            samples_per_period: value(request, "samples_per_period")?,
            section_phase: value(request, "section_phase")?,
            dof: value(request, "dof")?,
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

    fn sample_header(&self) -> Vec<String> {
        let columns = ["time_s", "phase_cycles", "displacement_m", "velocity_m_s", "acceleration_m_s2"];
        let mut columns = header(&columns);
        for name in &self.elements {
            let name = word(name);
            columns.extend([format!("{name}_relative_displacement_m"), format!("{name}_force_n")]);
        }
        columns
    }

    fn section_header(&self) -> Vec<String> {
        let mut columns = header(&["time_s", "phase_cycles", "displacement_m", "velocity_m_s"]);
        columns.extend((1..=self.dof).map(|i| format!("q{i}")));
        columns.extend((1..=self.dof).map(|i| format!("v{i}")));
        columns
    }
}

const CONTACT_COLUMNS: [&str; 10] = [
    "element",
    "begin_s",
    "end_s",
    "phase_cycles",
    "impact_velocity_m_s",
    "impulse_n_s",
    "peak_force_n",
    "energy_lost_j",
    "displacement_m",
    "velocity_m_s",
];

/// `samples.csv`, one row per sample, `contacts.csv`, one per contact, and `stroboscopic.csv`, one per period, that are being written.
#[derive(Debug)]
pub struct SimulationTables {
    layout: SimulationLayout,
    samples: Table,
    contacts: Table,
    section: Table,
    /// Periods written so far.
    periods: u64,
    /// Contacts that were closed at the end of the last chunk.
    unfinished: Vec<SimulatedContact>,
}

impl SimulationTables {
    /// Begins the tables of a motion in a folder.
    ///
    /// * `suffix`: follows the names of the files.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn begin(folder: &Path, suffix: &str, layout: SimulationLayout) -> Result<Self, ExportError> {
        let table =
            |name: &str, header: &[String]| Table::begin(folder, &format!("{name}{suffix}.csv"), header);
        Ok(Self {
            samples: table("samples", &layout.sample_header())?,
            contacts: table("contacts", &header(&CONTACT_COLUMNS))?,
            section: table("stroboscopic", &layout.section_header())?,
            layout,
            periods: 0,
            unfinished: Vec::new(),
        })
    }

    /// Adds the next chunk.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn take(&mut self, chunk: &SimulatedChunk) -> Result<(), ExportError> {
        let layout = &self.layout;
        let per_period = layout.numbers_of_sample() * layout.samples_per_period as usize;
        let samples = chunk.samples.chunks_exact(per_period);
        for (samples, section) in samples.zip(chunk.section.chunks_exact(2 + 2 * layout.dof)) {
            let begun = self.periods as f64 / layout.frequency_hz;
            let row = |phase: f64, numbers: &[f64]| {
                let first = [begun + phase / layout.frequency_hz, phase];
                first.iter().chain(numbers).map(|value| number(*value)).collect::<Vec<_>>()
            };
            for (sample, numbers) in (0..).zip(samples.chunks_exact(layout.numbers_of_sample())) {
                self.samples.row(&row(layout.phase(sample), numbers))?;
            }
            self.section.row(&row(layout.section_phase, section))?;
            self.periods += 1;
        }
        for contact in &chunk.contacts {
            self.contacts.row(&contact_row(layout, contact))?;
        }
        self.unfinished.clone_from(&chunk.unfinished);
        Ok(())
    }

    /// Ends the tables with the contacts that are still closed.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn finish(mut self) -> Result<Vec<PathBuf>, ExportError> {
        for contact in &self.unfinished {
            self.contacts.row(&contact_row(&self.layout, contact))?;
        }
        [self.samples, self.contacts, self.section].into_iter().map(Table::finish).collect()
    }
}

/// The row is also a point of the section at this contact: displacement and velocity of the response point as it closes.
fn contact_row(layout: &SimulationLayout, contact: &SimulatedContact) -> Vec<String> {
    let touch = contact.touch.as_ref();
    vec![
        layout.elements.get(contact.element).map_or_else(String::new, |name| word(name)),
        number(touch.map(|touch| touch.time_s)),
        number(contact.end_s),
        number(touch.map(|touch| touch.phase)),
        number(touch.map(|touch| touch.speed)),
        number(contact.impulse),
        number(contact.peak_force),
        number(contact.energy_lost),
        number(touch.map(|touch| touch.response[0])),
        number(touch.map(|touch| touch.response[1])),
    ]
}

/// Writes the tables of a motion in the store, as far as it has come.
pub(super) fn export_simulation(
    store: &Store,
    folder: &Path,
    (request, suffix): (&RequestRecord, &str),
) -> Result<Vec<PathBuf>, ExportError> {
    let mut tables = SimulationTables::begin(folder, suffix, SimulationLayout::of(request)?)?;
    store.each_simulated::<ExportError>(request.id, |chunk| tables.take(&chunk))?;
    tables.finish()
}
