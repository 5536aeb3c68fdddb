//! A motion in few numbers.

use hammerbeam_results::store::{SimulatedChunk, SimulatedContact, SimulationLayout};
use serde::Serialize;

use super::MotionPieces;
use crate::JobFolders;

/// Contacts that a report lists; all of them are in `contacts.csv`.
const LISTED: usize = 1000;

/// A motion in few numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SimulationReport {
    /// Excitation frequency [Hz], if there is an excitation.
    pub frequency_hz: Option<f64>,
    /// Periods that were run first, if there is one.
    pub transient_periods: Option<u64>,
    /// Periods that are written down, if there is one.
    pub periods: Option<u64>,
    /// Intervals that are written down, if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intervals: Option<u64>,
    /// Samples in a second, if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sampling_hz: Option<f64>,
    /// Time that is written down [s].
    pub time_s: f64,
    /// Number of samples.
    pub samples: u64,
    /// Largest displacement of the response point among the samples [m].
    pub max_abs_sampled_displacement_m: f64,
    /// Number of contacts.
    pub contacts: u64,
    /// Largest contact force [N].
    pub max_contact_force_n: f64,
    /// Largest impact velocity [m/s].
    pub max_impact_velocity_m_s: f64,
    /// Impulse of all contacts [N s].
    pub impulse_n_s: f64,
    /// Energy lost in all contacts [J].
    pub energy_lost_j: f64,
    /// Whether that has the energy of a contact that is closed at the start or the end.
    #[serde(skip)]
    pub is_cut_in_contact: bool,
    /// The first thousand contacts.
    pub contact_list: Vec<ListedContact>,
    /// Whether those are all.
    pub contact_list_complete: bool,
    /// State `[q; q']` at the end.
    pub final_modal_state: Vec<f64>,
    /// The folder that keeps the motion, with its tables.
    pub results: Option<String>,
    /// Number of the motion in that folder, as the tables of an export have it.
    pub request: Option<i64>,
}

/// A contact of a motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ListedContact {
    /// Name of the local element.
    pub element: Option<String>,
    /// When it closed [s]; `None` if it was closed at the start.
    pub begin_s: Option<f64>,
    /// When it opened [s]; `None` if it is closed at the end.
    pub end_s: Option<f64>,
    /// Speed at which it closed [m/s].
    pub impact_velocity_m_s: Option<f64>,
    /// Impulse [N s].
    pub impulse_n_s: f64,
    /// Largest force [N].
    pub peak_force_n: f64,
    /// Energy lost [J].
    pub energy_lost_j: f64,
}

/// A motion in few numbers, gathered chunk by chunk.
#[derive(Default)]
pub(super) struct Summary {
    /// Periods written down.
    periods: u64,
    samples: u64,
    contacts: u64,
    largest_displacement: f64,
    largest_force: f64,
    largest_impact: f64,
    impulse: f64,
    energy_lost: f64,
    /// Whether a contact is closed at the start or the end, so that it has stored energy there.
    stores: bool,
    listed: Vec<ListedContact>,
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
            self.listed.push(listed(layout, contact));
        }
    }

    pub fn report(
        self,
        layout: &SimulationLayout,
        pieces: MotionPieces,
        folders: JobFolders<'_>,
    ) -> SimulationReport {
        let is_forced = pieces == MotionPieces::Periods;
        let sampling_hz = f64::from(layout.samples_per_period) * layout.frequency_hz;
        SimulationReport {
            frequency_hz: is_forced.then_some(layout.frequency_hz),
            transient_periods: is_forced.then_some(layout.transient_periods),
            periods: is_forced.then_some(layout.periods),
            intervals: (!is_forced).then_some(layout.periods),
            sampling_hz: (!is_forced).then_some(sampling_hz),
            time_s: self.periods as f64 / layout.frequency_hz,
            samples: self.samples,
            max_abs_sampled_displacement_m: self.largest_displacement,
            contacts: self.contacts,
            max_contact_force_n: self.largest_force,
            max_impact_velocity_m_s: self.largest_impact,
            impulse_n_s: self.impulse,
            energy_lost_j: self.energy_lost,
            is_cut_in_contact: self.stores,
            contact_list_complete: self.listed.len() as u64 == self.contacts,
            contact_list: self.listed,
            final_modal_state: self.state,
            results: folders.shown(),
            request: None,
        }
    }
}

fn listed(layout: &SimulationLayout, contact: &SimulatedContact) -> ListedContact {
    ListedContact {
        element: layout.elements.get(contact.element).cloned(),
        begin_s: contact.touch.as_ref().map(|touch| touch.time_s),
        end_s: contact.end_s,
        impact_velocity_m_s: contact.touch.as_ref().map(|touch| touch.speed),
        impulse_n_s: contact.impulse,
        peak_force_n: contact.peak_force,
        energy_lost_j: contact.energy_lost,
    }
}
