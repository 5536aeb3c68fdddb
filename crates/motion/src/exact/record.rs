//! One record for each contact of a motion.
//!
//! The impulse is `sum_j w_j |F_j|`, the energy lost `-sum_j w_j F_j r'_j`, over the nodes of its steps: with Gauss' weights `w_j` both are exact
//! for the polynomials of the step. The largest force is taken from the law at the place where its polynomial is largest.

use super::{ExactIntegrator, collocation::NODES, flight::Touch, maxima::Peak, run::Run};

/// A contact of an element within a stretch.
///
/// It ends where its force does. A contact that has parted and presses again before its penetration has ended is one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactRecord {
    /// Number of the element.
    pub element: usize,
    /// Which of the contacts of its law.
    pub contact: usize,
    /// When it began, after the start of the stretch [s]; `None` if it was closed before.
    pub begin: Option<f64>,
    /// When it ended [s]; `None` if it was closed at the end of the stretch.
    pub end: Option<f64>,
    /// Speed with which it closed [m/s]; `None` if it was closed before.
    pub impact_velocity: Option<f64>,
    /// Impulse within the stretch [N s].
    pub impulse: f64,
    /// Largest force within the stretch [N].
    pub peak_force: f64,
    /// Energy that the structure has lost to it within the stretch [J], what is stored in it at the end included; 0 for a law that
    /// loses none.
    pub energy_lost: f64,
}

/// Records under way.
#[derive(Debug, Clone, Default)]
pub(super) struct Recorder {
    records: Vec<ContactRecord>,
    /// The step with the largest force of each record.
    peaks: Vec<Option<Peak>>,
    /// The present record of each element.
    present: Vec<Option<usize>>,
}

impl Recorder {
    /// A contact closes.
    pub fn strike(&mut self, touch: Touch, time: f64, speed: f64) {
        self.begin(touch.element, touch.contact, Some((time, speed)));
    }

    fn begin(&mut self, element: usize, contact: usize, impact: Option<(f64, f64)>) -> usize {
        if self.present.len() <= element {
            self.present.resize(element + 1, None);
        }
        let place = self.records.len();
        self.present[element] = Some(place);
        self.peaks.push(None);
        self.records.push(ContactRecord {
            element,
            contact,
            begin: impact.map(|(time, _)| time),
            end: None,
            impact_velocity: impact.map(|(_, speed)| speed.abs()),
            impulse: 0.0,
            peak_force: 0.0,
            energy_lost: 0.0,
        });
        place
    }
}

impl ExactIntegrator {
    /// Energy that the a-th active element takes in the solved step.
    pub(super) fn energy_taken(&self, a: usize) -> f64 {
        let step = &self.step;
        if !self.laws[step.active[a]].depends_on_velocity() {
            return 0.0;
        }
        let weights = &step.grading().rule().at_end[0];
        let power = |j: usize| step.force[a * NODES + j] * step.velocity[a * NODES + j];
        -step.weights.length * (0..NODES).map(|j| weights[j] * power(j)).sum::<f64>()
    }

    /// Notes the solved step of the a-th active element; `run` stands at its start.
    pub(super) fn record_step(&self, run: &Run, a: usize, impulse: f64, recorder: &mut Recorder) {
        let element = self.step.active[a];
        let Some(contact) = run.closed[element] else { return };
        let known = recorder.present.get(element).copied().flatten();
        let place = known.unwrap_or_else(|| recorder.begin(element, contact, None));
        let record = &mut recorder.records[place];
        record.impulse += impulse;
        record.energy_lost += self.energy_taken(a);
        record.end = Some(run.time + self.step.weights.length);
        let best = recorder.peaks[place].as_ref().map_or(0.0, Peak::value);
        let force = &self.step.force[a * NODES..(a + 1) * NODES];
        if let Some(largest) = self.largest(force, best) {
            recorder.peaks[place] = Some(self.peak(run, element, largest));
        }
    }

    /// The records of a motion that has come to its end.
    pub(super) fn finish_records(&mut self, run: &Run, recorder: Recorder) -> Vec<ContactRecord> {
        let Recorder { mut records, peaks, present } = recorder;
        for (record, peak) in records.iter_mut().zip(peaks) {
            record.peak_force = peak.map_or(0.0, |peak| self.largest_force(peak));
        }
        for (element, place) in present.iter().enumerate() {
            if let (Some(place), true) = (place, run.closed[element].is_some()) {
                records[*place].end = None;
            }
        }
        records
    }
}
