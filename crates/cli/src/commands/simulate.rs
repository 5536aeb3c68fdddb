//! `hammerbeam simulate`: a motion in time, with every contact.

use std::path::Path;

use hammerbeam_attractor::{ContactRecord, Sample, Simulation, SystemMap};
use hammerbeam_motion::{PointMotion, exact::ExactSettings};
use hammerbeam_study::{
    Model, StudyFile,
    export::{Table, number, word},
};
use serde_json::{Value, json};

use crate::{
    failure::Failure, initial, interrupt::Interrupt, motion_args::SimulateOptions, output::Output,
    ticker::Ticker,
};

/// Samples in a table at most, some 500 GB of text.
const MOST_SAMPLES: u64 = 10_000_000_000;
/// Contacts that a document lists; all of them are in `contacts.csv`.
const LISTED: usize = 1000;

pub fn run(options: &SimulateOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    let model = Model::build(&file)?;
    let samples = options.periods * u64::from(options.samples_per_period);
    if options.out.is_some() && samples > MOST_SAMPLES {
        return Err(Failure::BadInput(format!(
            "--periods {} times --samples-per-period {} is {samples} samples, must be {MOST_SAMPLES} at most with --out",
            options.periods, options.samples_per_period
        )));
    }
    let frequency_hz = options.frequency;
    let motion = ExactSettings::default();
    let mut map = SystemMap::new(model.system.clone(), frequency_hz, 1, motion)?;
    let state = initial::state(&options.initial, &mut map, (&file, &model), options.results.as_deref())?;
    let mut simulation = Simulation::new(model.system.clone(), frequency_hz, &state, motion)?;
    let interrupt = Interrupt::listen()?;
    let mut ticker = Ticker::new(options.transient_periods + options.periods, "periods");
    for period in 0..options.transient_periods {
        if interrupt.raised() {
            return Err(Failure::Interrupted("interrupted before anything was written down".to_owned()));
        }
        simulation.skip_period()?;
        ticker.at(period, String::new);
    }
    let phases = Phases::of(options);
    // A motion that cannot be computed leaves no tables.
    let mut next = Some(simulation.period_at(&phases.all)?);
    let mut record = Record::begin(options, &model)?;
    let mut failure = None;
    for period in 0..options.periods {
        if interrupt.raised() {
            break;
        }
        let (samples, contacts) = match next.take().map_or_else(|| simulation.period_at(&phases.all), Ok) {
            Ok(observed) => observed,
            Err(error) => {
                failure = Some(error);
                break;
            }
        };
        record.take(&model, (options, &phases), &samples, &contacts)?;
        ticker.at(options.transient_periods + period, String::new);
    }
    ticker.clear();
    record.take(&model, (options, &phases), &[], &simulation.unfinished())?;
    let periods = record.periods;
    let summary = record.finish(&simulation)?;
    let kept = if options.out.is_some() { "are kept" } else { "were computed" };
    if let Some(error) = failure {
        return Err(Failure::NoResult(format!("{error}; {periods} periods {kept}")));
    }
    if interrupt.raised() {
        return Err(Failure::Interrupted(format!("interrupted; {periods} periods {kept}")));
    }
    output.give(&summary.document(options), || summary.text(options));
    Ok(())
}

/// Phases of a period at which the state is wanted: equal steps, and that of the section.
struct Phases {
    all: Vec<f64>,
    /// Index of that of the section,
    section: usize,
    /// and whether it is one of the equal steps.
    shared: bool,
}

impl Phases {
    fn of(options: &SimulateOptions) -> Self {
        let samples = f64::from(options.samples_per_period);
        let mut all: Vec<f64> = (0..options.samples_per_period).map(|k| f64::from(k) / samples).collect();
        let section = all.partition_point(|phase| *phase < options.section_phase);
        let shared = all.get(section) == Some(&options.section_phase);
        if !shared {
            all.insert(section, options.section_phase);
        }
        Self { all, section, shared }
    }
}

/// What is written down.
struct Record {
    response: PointMotion,
    samples: Option<Table>,
    contacts: Option<Table>,
    section: Option<Table>,
    summary: Summary,
    periods: u64,
}

/// A motion in few numbers.
#[derive(Default)]
struct Summary {
    samples: u64,
    contacts: u64,
    largest_displacement: f64,
    largest_force: f64,
    largest_impact: f64,
    impulse: f64,
    energy_lost: f64,
    listed: Vec<Value>,
    state: Vec<f64>,
    seconds: f64,
}

impl Record {
    fn begin(options: &SimulateOptions, model: &Model) -> Result<Self, Failure> {
        let table = |name: &str, header: Vec<String>| match &options.out {
            Some(folder) => Table::begin(folder, name, &header).map(Some),
            None => Ok(None),
        };
        Ok(Self {
            response: model.response_motion(options.frequency),
            samples: table("samples.csv", sample_header(model))?,
            contacts: table("contacts.csv", contact_header())?,
            section: table("stroboscopic.csv", section_header(model))?,
            summary: Summary::default(),
            periods: 0,
        })
    }

    fn take(
        &mut self,
        model: &Model,
        (options, phases): (&SimulateOptions, &Phases),
        samples: &[Sample],
        contacts: &[ContactRecord],
    ) -> Result<(), Failure> {
        for (index, sample) in samples.iter().enumerate() {
            if index != phases.section || phases.shared {
                self.sample(model, options.frequency, sample)?;
            }
            if index == phases.section
                && let Some(table) = &mut self.section
            {
                table.row(&section_row(&self.response, sample))?;
            }
        }
        for contact in contacts {
            self.contact(model, options.frequency, contact)?;
        }
        self.periods += u64::from(!samples.is_empty());
        Ok(())
    }

    fn sample(&mut self, model: &Model, frequency_hz: f64, sample: &Sample) -> Result<(), Failure> {
        let row = sample_row(model, (&self.response, frequency_hz), sample);
        let summary = &mut self.summary;
        summary.samples += 1;
        summary.largest_displacement = summary.largest_displacement.max(row[2].abs());
        if let Some(table) = &mut self.samples {
            table.row(&row.into_iter().map(number).collect::<Vec<_>>())?;
        }
        Ok(())
    }

    fn contact(&mut self, model: &Model, frequency_hz: f64, contact: &ContactRecord) -> Result<(), Failure> {
        let summary = &mut self.summary;
        summary.contacts += 1;
        summary.largest_force = summary.largest_force.max(contact.peak_force);
        let speed = contact.begin.as_ref().map_or(0.0, |touch| touch.velocity.abs());
        summary.largest_impact = summary.largest_impact.max(speed);
        summary.impulse += contact.impulse;
        summary.energy_lost += contact.energy_lost;
        if summary.listed.len() < LISTED {
            summary.listed.push(contact_document(model, contact));
        }
        if let Some(table) = &mut self.contacts {
            table.row(&contact_row(model, (&self.response, frequency_hz), contact))?;
        }
        Ok(())
    }

    fn finish(self, simulation: &Simulation) -> Result<Summary, Failure> {
        for table in [self.samples, self.contacts, self.section].into_iter().flatten() {
            table.finish()?;
        }
        Ok(Summary { state: simulation.state().to_vec(), seconds: simulation.time(), ..self.summary })
    }
}

impl Summary {
    fn document(&self, options: &SimulateOptions) -> Value {
        json!({
            "frequency_hz": options.frequency,
            "transient_periods": options.transient_periods,
            "periods": options.periods,
            "time_s": self.seconds,
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
            "results": folder(options.out.as_deref()),
        })
    }

    fn text(&self, options: &SimulateOptions) -> String {
        let mut lines = vec![
            format!("{} periods at {} Hz, {:.6} s", options.periods, options.frequency, self.seconds),
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
        if let Some(folder) = &options.out {
            let folder = folder.display();
            lines.push(format!("samples.csv, contacts.csv and stroboscopic.csv are in {folder}"));
        }
        lines.join("\n")
    }
}

pub fn folder(path: Option<&Path>) -> Option<String> {
    path.map(|path| path.display().to_string())
}

fn sample_header(model: &Model) -> Vec<String> {
    let mut header: Vec<String> =
        ["time_s", "phase_cycles", "displacement_m", "velocity_m_s", "acceleration_m_s2"]
            .map(str::to_owned)
            .into();
    for element in model.system.elements() {
        let name = word(&element.name);
        header.extend([format!("{name}_relative_displacement_m"), format!("{name}_force_n")]);
    }
    header
}

fn sample_row(model: &Model, (response, frequency_hz): (&PointMotion, f64), sample: &Sample) -> Vec<f64> {
    let mut row = vec![sample.time, sample.phase];
    row.extend(response.at(sample.phase, &sample.state, &sample.forces));
    for (e, force) in sample.forces.iter().enumerate() {
        let [r, ..] = model.system.relative_motion(e, frequency_hz, sample.phase, &sample.state);
        row.extend([r, *force]);
    }
    row
}

fn section_header(model: &Model) -> Vec<String> {
    let mut header: Vec<String> =
        ["time_s", "phase_cycles", "displacement_m", "velocity_m_s"].map(str::to_owned).into();
    let n = model.system.dof();
    header.extend((1..=n).map(|i| format!("q{i}")));
    header.extend((1..=n).map(|i| format!("v{i}")));
    header
}

fn section_row(response: &PointMotion, sample: &Sample) -> Vec<String> {
    let [displacement, velocity, _] = response.at(sample.phase, &sample.state, &sample.forces);
    let first = [sample.time, sample.phase, displacement, velocity];
    first.iter().chain(&sample.state).map(|value| number(*value)).collect()
}

fn contact_header() -> Vec<String> {
    [
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
    ]
    .map(str::to_owned)
    .into()
}

/// The row is also a point of the section at this contact: displacement and velocity of the response point as it closes.
fn contact_row(
    model: &Model,
    (response, frequency_hz): (&PointMotion, f64),
    contact: &ContactRecord,
) -> Vec<String> {
    let begin = contact.begin.as_ref();
    let phase = begin.map(|touch| (touch.time * frequency_hz).fract());
    let response = begin.zip(phase).map(|(touch, phase)| response.at(phase, &touch.state, &[]));
    vec![
        word(&model.system.elements()[contact.element].name),
        number(begin.map(|touch| touch.time)),
        number(contact.end),
        number(phase),
        number(begin.map(|touch| touch.velocity.abs())),
        number(contact.impulse),
        number(contact.peak_force),
        number(contact.energy_lost),
        number(response.map(|response| response[0])),
        number(response.map(|response| response[1])),
    ]
}

fn contact_document(model: &Model, contact: &ContactRecord) -> Value {
    json!({
        "element": model.system.elements()[contact.element].name,
        "begin_s": contact.begin.as_ref().map(|touch| touch.time),
        "end_s": contact.end,
        "impact_velocity_m_s": contact.begin.as_ref().map(|touch| touch.velocity.abs()),
        "impulse_n_s": contact.impulse,
        "peak_force_n": contact.peak_force,
        "energy_lost_j": contact.energy_lost,
    })
}
