//! A motion in few numbers.

use std::path::Path;

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_results::store::{SimulatedChunk, SimulatedContact, SimulationLayout};
use serde_json::{Value, json};

use super::{folder, time::Pieces, told::Told};

/// Contacts that a document lists; all of them are in `contacts.csv`.
const LISTED: usize = 1000;

/// A motion in few numbers, gathered chunk by chunk.
#[derive(Default)]
pub struct Summary {
    /// Periods written down.
    pub periods: u64,
    samples: u64,
    contacts: u64,
    largest_displacement: f64,
    largest_force: f64,
    largest_impact: f64,
    impulse: f64,
    energy_lost: f64,
    /// Whether a contact is closed at the begin or the end, so that it has stored energy there.
    stores: bool,
    listed: Vec<Value>,
    state: Vec<f64>,
    unfinished: Vec<SimulatedContact>,
}

impl Summary {
    /// Adds the next chunk.
    pub fn take(&mut self, layout: &SimulationLayout, chunk: &SimulatedChunk) {
        for sample in chunk.samples.chunks_exact(layout.numbers_of_sample()) {
            self.samples += 1;
            self.largest_displacement = self.largest_displacement.max(sample[0].abs());
        }
        chunk.contacts.iter().for_each(|contact| self.contact(layout, contact));
        self.unfinished.clone_from(&chunk.unfinished);
        self.periods = chunk.checkpoint.periods;
        self.state.clone_from(&chunk.checkpoint.state);
    }

    /// Adds the contacts that are still closed at the end.
    pub fn finish(&mut self, layout: &SimulationLayout) {
        for contact in std::mem::take(&mut self.unfinished) {
            self.contact(layout, &contact);
        }
    }

    fn contact(&mut self, layout: &SimulationLayout, contact: &SimulatedContact) {
        self.contacts += 1;
        self.largest_force = self.largest_force.max(contact.peak_force);
        let speed = contact.touch.as_ref().map_or(0.0, |touch| touch.speed);
        self.largest_impact = self.largest_impact.max(speed);
        self.impulse += contact.impulse;
        self.energy_lost += contact.energy_lost;
        self.stores |= contact.touch.is_none() || contact.end_s.is_none();
        if self.listed.len() < LISTED {
            self.listed.push(contact_document(layout, contact));
        }
    }

    pub fn document(&self, told: &Told<'_>, out: Option<&Path>) -> Value {
        let layout = told.layout;
        let mut document = json!({
            "frequency_hz": layout.frequency_hz,
            "transient_periods": layout.transient_periods,
            "periods": layout.periods,
            "time_s": self.seconds(layout),
            "samples": self.samples,
            "max_abs_sampled_displacement_m": self.largest_displacement,
            "contacts": self.contacts,
            "max_contact_force_n": self.largest_force,
            "max_impact_velocity_m_s": self.largest_impact,
            "impulse_n_s": self.impulse,
            "energy_lost_j": self.energy_lost,
            "contact_list": self.listed,
            "contact_list_complete": self.listed.len() as u64 == self.contacts,
            "final_modal_state": self.state,
            "results": folder(out),
        });
        if told.pieces == Pieces::Intervals {
            for key in ["frequency_hz", "transient_periods", "periods"] {
                document[key] = Value::Null;
            }
            document["intervals"] = layout.periods.into();
            document["sampling_hz"] = sampling_hz(layout).into();
        }
        document
    }

    pub fn text(&self, told: &Told<'_>, (out, unit): (Option<&Path>, FrequencyUnit)) -> String {
        let layout = told.layout;
        let seconds = self.seconds(layout);
        let mut lines = vec![
            match told.pieces {
                Pieces::Periods => {
                    let at = unit.words(layout.frequency_hz);
                    format!("{} periods at {at}, {seconds:.6} s", layout.periods)
                }
                Pieces::Intervals => {
                    format!("{seconds:.6} s of free vibration, {} samples in a second", sampling_hz(layout))
                }
            },
            format!(
                "  largest sampled displacement  {:.6e} m ({} samples)",
                self.largest_displacement, self.samples
            ),
            format!("  contacts                      {}", self.contacts),
            format!("  largest contact force         {:.6e} N", self.largest_force),
            format!("  largest impact velocity       {:.6e} m/s", self.largest_impact),
            format!("  impulse of all contacts       {:.6e} N s", self.impulse),
            format!("  energy lost in all contacts   {:.3e} J", self.energy_lost),
        ];
        if self.stores {
            lines.push("    (with what a contact holds that is closed at the begin or the end)".to_owned());
        }
        if let Some(folder) = out {
            let folder = folder.display();
            lines.push(format!("samples.csv, contacts.csv and stroboscopic.csv are in {folder}"));
        }
        lines.join("\n")
    }

    fn seconds(&self, layout: &SimulationLayout) -> f64 {
        self.periods as f64 / layout.frequency_hz
    }
}

fn sampling_hz(layout: &SimulationLayout) -> f64 {
    f64::from(layout.samples_per_period) * layout.frequency_hz
}

fn contact_document(layout: &SimulationLayout, contact: &SimulatedContact) -> Value {
    json!({
        "element": layout.elements.get(contact.element),
        "begin_s": contact.touch.as_ref().map(|touch| touch.time_s),
        "end_s": contact.end_s,
        "impact_velocity_m_s": contact.touch.as_ref().map(|touch| touch.speed),
        "impulse_n_s": contact.impulse,
        "peak_force_n": contact.peak_force,
        "energy_lost_j": contact.energy_lost,
    })
}
