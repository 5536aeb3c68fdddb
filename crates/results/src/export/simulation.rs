//! Motions in time as CSV: samples, contacts, and the section at a phase, chunk by chunk.
//!
//! The tables hold what the store holds; times and phases of samples follow from their numbers.

use std::path::{Path, PathBuf};

use super::{
    ExportError,
    table::{Table, header, number, word},
};
use crate::store::{RequestRecord, SimulatedChunk, SimulatedContact, SimulationLayout, Store};

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

fn sample_header(layout: &SimulationLayout) -> Vec<String> {
    let columns = ["time_s", "phase_cycles", "displacement_m", "velocity_m_s", "acceleration_m_s2"];
    let mut columns = header(&columns);
    for name in &layout.elements {
        let name = word(name);
        columns.extend([format!("{name}_relative_displacement_m"), format!("{name}_force_n")]);
    }
    columns
}

fn section_header(layout: &SimulationLayout) -> Vec<String> {
    let mut columns = header(&["time_s", "phase_cycles", "displacement_m", "velocity_m_s"]);
    columns.extend((1..=layout.dof).map(|i| format!("q{i}")));
    columns.extend((1..=layout.dof).map(|i| format!("v{i}")));
    columns
}

/// `samples.csv`, one row per sample, `contacts.csv`, one per contact, and `stroboscopic.csv`, one per
/// period, that are being written.
///
/// They are started with the first period that is written down: a transient leaves no tables.
#[derive(Debug)]
pub struct SimulationTables {
    layout: SimulationLayout,
    folder: PathBuf,
    suffix: String,
    tables: Option<Tables>,
    /// Periods written so far.
    periods: u64,
    /// Contacts that were closed at the end of the last chunk.
    unfinished: Vec<SimulatedContact>,
}

#[derive(Debug)]
struct Tables {
    samples: Table,
    contacts: Table,
    section: Table,
}

impl Tables {
    fn begin(folder: &Path, suffix: &str, layout: &SimulationLayout) -> Result<Self, ExportError> {
        let table =
            |name: &str, header: &[String]| Table::begin(folder, &format!("{name}{suffix}.csv"), header);
        Ok(Self {
            samples: table("samples", &sample_header(layout))?,
            contacts: table("contacts", &header(&CONTACT_COLUMNS))?,
            section: table("stroboscopic", &section_header(layout))?,
        })
    }
}

impl SimulationTables {
    /// The tables of a motion in a folder, which are not started yet.
    ///
    /// * `suffix`: follows the names of the files.
    #[must_use]
    pub fn new(folder: &Path, suffix: &str, layout: SimulationLayout) -> Self {
        let (folder, suffix) = (folder.to_owned(), suffix.to_owned());
        Self { layout, folder, suffix, tables: None, periods: 0, unfinished: Vec::new() }
    }

    /// Adds the next chunk.
    ///
    /// # Errors
    /// [`ExportError::Write`].
    pub fn take(&mut self, chunk: &SimulatedChunk) -> Result<(), ExportError> {
        if chunk.section.is_empty() {
            return Ok(());
        }
        let layout = &self.layout;
        let tables = match &mut self.tables {
            Some(tables) => tables,
            none => none.insert(Tables::begin(&self.folder, &self.suffix, layout)?),
        };
        let per_period = layout.numbers_of_sample() * layout.samples_per_period as usize;
        let samples = chunk.samples.chunks_exact(per_period);
        for (samples, section) in samples.zip(chunk.section.chunks_exact(layout.numbers_of_section())) {
            let start = self.periods as f64 / layout.frequency_hz;
            let row = |phase: f64, numbers: &[f64]| {
                let first = [start + phase / layout.frequency_hz, phase];
                first.iter().chain(numbers).map(|value| number(*value)).collect::<Vec<_>>()
            };
            for (sample, numbers) in (0..).zip(samples.chunks_exact(layout.numbers_of_sample())) {
                tables.samples.row(&row(layout.phase(sample), numbers))?;
            }
            tables.section.row(&row(layout.section_phase, section))?;
            self.periods += 1;
        }
        for contact in &chunk.contacts {
            tables.contacts.row(&contact_row(layout, contact))?;
        }
        self.unfinished.clone_from(&chunk.unfinished);
        Ok(())
    }

    /// Ends the tables with the contacts that are still closed.
    ///
    /// # Returns
    /// The files; none if no period was written down.
    /// # Errors
    /// [`ExportError::Write`].
    pub fn finish(self) -> Result<Vec<PathBuf>, ExportError> {
        let Some(Tables { samples, mut contacts, section }) = self.tables else { return Ok(Vec::new()) };
        for contact in &self.unfinished {
            contacts.row(&contact_row(&self.layout, contact))?;
        }
        [samples, contacts, section].into_iter().map(Table::finish).collect()
    }
}

/// The row is also a point of the section at this contact: displacement and velocity of the response point as
/// it closes.
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
    let layout = SimulationLayout::of(request)?;
    let mut tables = SimulationTables::new(folder, suffix, layout.clone());
    store.each_simulated::<ExportError>(request.id, &layout, |chunk| tables.take(&chunk))?;
    tables.finish()
}
