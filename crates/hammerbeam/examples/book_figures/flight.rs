//! The settled motion of the paper's beam over a period, with the closed form on it; its one contact.

use hammerbeam::{
    Study,
    attractor::{Sample, Simulation},
    figure::{DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries, Figure, LabelSide},
    motion::exact::ExactSettings,
};

use super::{
    Outcome,
    beam::{Beam, Free},
    compared, style,
};

const STUDY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studies/beam-with-stop.toml");
const FREQUENCY_HZ: f64 = 36.2;
const TRANSIENT: usize = 300;
const SAMPLES: usize = 2000;

/// One period of the settled motion.
pub struct SettledMotion {
    /// Times (s) and displacements of the contact against its stop, upwards (m).
    pub displacement: Vec<(f64, f64)>,
    /// Times (s) and contact forces (N) from a little before the touch to a little after the release.
    pub force: Vec<(f64, f64)>,
    /// When the contact closes and opens (s).
    pub contact: [f64; 2],
    /// The equations of the book.
    pub beam: Beam,
    /// The free part of the state at time 0.
    pub free: Free,
}

impl SettledMotion {
    /// Starts at rest, and takes the period after the transient.
    pub fn new() -> Outcome<Self> {
        let study = Study::read(STUDY)?;
        let system = study.model.system;
        let rest = vec![0.0; 2 * system.dof()];
        let mut simulation = Simulation::new(system.clone(), FREQUENCY_HZ, &rest, ExactSettings::default())?;
        for _ in 0..TRANSIENT {
            simulation.skip_period()?;
        }
        let settled = simulation.checkpoint();
        let (samples, contacts) = simulation.period(SAMPLES)?;
        let [contact] = contacts.as_slice() else { return Err("the motion has one contact".into()) };
        let begin = contact.begin.as_ref().ok_or("the contact closes within the period")?.time;
        let end = contact.end.ok_or("the contact opens within the period")?;
        let beam = Beam::new(system.model(), FREQUENCY_HZ);
        let free = beam.without_particular(&settled.state);
        // The element of the stop takes displacements downwards, and its force is one upwards.
        let upwards = |sample: &Sample| {
            let [towards_stop, ..] = system.relative_motion(0, FREQUENCY_HZ, sample.phase, &sample.state);
            (sample.time, -towards_stop)
        };
        let displacement = samples.iter().map(upwards).collect();
        let around = |k: u32| FREQUENCY_HZ * (begin - 2e-5 + f64::from(k) / 400.0 * (end - begin + 4e-5));
        let phases: Vec<f64> = (0..=400).map(around).collect();
        let mut again = Simulation::resume(system.clone(), FREQUENCY_HZ, settled, ExactSettings::default())?;
        let (closely, _) = again.period_at(&phases)?;
        let force = phases.iter().zip(&closely);
        let force = force.map(|(phase, sample)| (phase / FREQUENCY_HZ, -sample.forces[0])).collect();
        Ok(Self { displacement, force, contact: [begin, end], beam, free })
    }

    /// The contact force over the time from the touch (us).
    pub fn force_over_microseconds(&self) -> Vec<(f64, f64)> {
        self.force.iter().map(|(time, force)| (1e6 * (time - self.contact[0]), *force)).collect()
    }
}

/// Draws the motion, and compares it with the closed form.
pub fn draw(motion: &SettledMotion) -> Outcome<Figure> {
    let [begin, end] = motion.contact;
    let in_flight: Vec<(f64, f64)> =
        motion.displacement.iter().copied().filter(|(time, _)| *time < begin).collect();
    let closed = |time: f64| motion.beam.jet(&motion.free, time)[0];
    let off = in_flight.iter().map(|(time, found)| (closed(*time) - found).abs()).fold(0.0, f64::max);
    compared(&format!("flight: closed form off by {off:.1e} m"));
    assert!(off < 1e-13, "the equations (F2) to (F5) are those of the motion: {off:e} m");

    let millimetres = |&(time, displacement): &(f64, f64)| (1e3 * time, 1e3 * displacement);
    let hammerbeam = motion.displacement.iter().map(millimetres);
    let equations = in_flight.iter().step_by(60).map(|(time, _)| (1e3 * time, 1e3 * closed(*time)));
    let period = 1e3 / FREQUENCY_HZ;
    let history = DataPanel {
        width: 2.1,
        shaded: vec![[0.0, period, -0.6, 0.0]],
        uprights: vec![1e3 * begin],
        labels: vec![
            DataLabel { at: (0.0, -0.3), text: "stop".into(), side: LabelSide::Right },
            DataLabel { at: (1e3 * begin, 4.6), text: "contact,".into(), side: LabelSide::Right },
            DataLabel {
                at: (1e3 * begin, 4.1),
                text: format!("{:.2} ms", 1e3 * (end - begin)),
                side: LabelSide::Right,
            },
        ],
        ..DataPanel::new(
            DataAxis::linear("Time (ms)").between(0.0, period),
            DataAxis::linear("Displacement against the stop (mm)").between(-0.6, 7.0),
            vec![
                DataSeries::new("motion by Hammerbeam", DataLook::Line(0), hammerbeam),
                DataSeries::new("equations (F2) to (F5)", DataLook::Circles(1), equations),
            ],
        )
    };
    let touch = DataPanel::new(
        DataAxis::linear("Time from the touch (µs)").between(-20.0, 1e6 * (end - begin) + 20.0),
        DataAxis::linear("Contact force (N)").between(0.0, 1400.0),
        vec![DataSeries::new("", DataLook::Line(0), motion.force_over_microseconds())],
    );
    let description =
        "displacement of the beam over one period with the closed form on it, and the force of \
                       its contact"
            .to_owned();
    Ok(DataDiagram { panels: vec![history, touch], description }.draw(&style())?)
}
