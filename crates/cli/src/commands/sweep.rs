//! `hammerbeam sweep`: settled motions over the frequency.

use hammerbeam_attractor::{
    AttractorError, Class, Effort, Observable, Patience, SweepPoint, SweepSettings, Sweeper, SystemMap,
    frequencies, in_order,
};
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_study::{Model, StoredBranches, StudyFile};
use serde_json::{Value, json};

use super::{run::threads, simulate::folder};
use crate::{
    failure::Failure,
    initial,
    interrupt::Interrupt,
    motion_args::{EffortOptions, SweepOptions},
    output::Output,
    table::{Table, header, number},
    ticker::Ticker,
};

impl From<&EffortOptions> for Effort {
    fn from(options: &EffortOptions) -> Self {
        let patience = Patience {
            skipped: options.transient_periods,
            periods: options.patience_periods,
            longest: usize::from(options.longest_period),
        };
        Self { patience, averaged: options.averaged_periods, ..Self::default() }
    }
}

/// A motion of a sweep, and where it comes from.
struct Found {
    /// `up`, `down`, or the number of the start.
    from: String,
    point: SweepPoint,
    branch: Option<u32>,
}

pub fn run(options: &SweepOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    let model = Model::build(&file)?;
    let upward = upward(options, file.study.excitation.frequency_hz)?;
    let branches =
        options.results.as_deref().map(|folder| StoredBranches::open(folder, &file)).transpose()?;
    let observable =
        Observable { shape: model.response.shape.clone(), support_ratio: model.response.support_ratio };
    let motion = ExactSettings::default();
    let settings =
        SweepSettings { effort: (&options.effort).into(), sampled: options.samples as usize, motion };
    let make = || Sweeper::new(&model.system, &observable, settings);
    let mut first = SystemMap::new(model.system.clone(), upward[0], 1, motion)?;
    let state = initial::state(&options.initial, &mut first, (&file, &model), options.results.as_deref())?;
    let interrupt = Interrupt::listen()?;
    let mut work = Work { options, interrupt: &interrupt, found: Vec::new() };
    match options.starts {
        Some(starts) => work.diagram(&make, &upward, starts as usize)?,
        None => work.sweep(&mut make()?, &upward, state)?,
    }
    let mut found = work.found;
    if let Some(branches) = &branches {
        for motion in &mut found {
            motion.branch = branch(branches, &model, &motion.point)?;
        }
    }
    write(options, &found)?;
    if interrupt.raised() {
        let kept = if options.out.is_some() { "kept" } else { "computed" };
        return Err(Failure::Interrupted(format!("interrupted; {} motions are {kept}", found.len())));
    }
    if found.is_empty() {
        return Err(Failure::NoResult("no motion could be computed".to_owned()));
    }
    output.give(&document(options, &found), || text(options, &found, &model));
    Ok(())
}

/// Frequencies from low to high.
fn upward(options: &SweepOptions, range_hz: [f64; 2]) -> Result<Vec<f64>, Failure> {
    let (from, to) = (options.from.unwrap_or(range_hz[0]), options.to.unwrap_or(range_hz[1]));
    if to < from {
        let message = format!(
            "--to is {to} Hz, which is below --from, {from} Hz; --down sweeps down after the sweep up"
        );
        return Err(Failure::BadInput(message));
    }
    let step = options.step.unwrap_or(((to - from) / 100.0).max(f64::MIN_POSITIVE));
    Ok(frequencies(from, to, step)?)
}

struct Work<'a> {
    options: &'a SweepOptions,
    interrupt: &'a Interrupt,
    found: Vec<Found>,
}

impl Work<'_> {
    /// Up, and down again if that is wanted, with the state carried over.
    fn sweep(
        &mut self,
        sweeper: &mut Sweeper,
        upward: &[f64],
        mut state: Vec<f64>,
    ) -> Result<(), AttractorError> {
        let mut downward = upward.to_vec();
        downward.reverse();
        let passes = [("up", upward), ("down", &downward)];
        let passes = &passes[..1 + usize::from(self.options.down)];
        let mut ticker = Ticker::new((passes.len() * upward.len()) as u64, "frequencies");
        for (direction, frequencies) in passes {
            for &frequency_hz in *frequencies {
                if self.interrupt.raised() {
                    return Ok(());
                }
                // A sweep that cannot go on is told, and what it has found is kept.
                let point = match sweeper.at(frequency_hz, &state) {
                    Ok(point) => point,
                    Err(error @ AttractorError::Input { .. }) => return Err(error),
                    Err(error) => {
                        anstream::eprintln!("the sweep {direction} ends at {frequency_hz} Hz: {error}");
                        return Ok(());
                    }
                };
                state.clone_from(&point.state);
                self.found.push(Found { from: (*direction).to_owned(), point, branch: None });
                ticker.at(self.found.len() as u64, || format!("{direction} {frequency_hz:.4} Hz"));
            }
        }
        ticker.clear();
        Ok(())
    }

    /// From the same states at every frequency; motions that cannot be computed are left out and told.
    fn diagram(
        &mut self,
        make: &(impl Fn() -> Result<Sweeper, AttractorError> + Sync),
        frequencies: &[f64],
        starts: usize,
    ) -> Result<(), AttractorError> {
        let threads = threads(self.options.jobs);
        let mut ticker = Ticker::new(frequencies.len() as u64, "frequencies");
        for (done, &frequency_hz) in frequencies.iter().enumerate() {
            let states = make()?.starts(frequency_hz, starts)?;
            let at = |sweeper: &mut Result<Sweeper, AttractorError>, state: &Vec<f64>| match sweeper {
                Ok(sweeper) => sweeper.at(frequency_hz, state),
                Err(error) => Err(error.clone()),
            };
            let Some(points) = in_order(&states, threads, self.interrupt.flag(), make, at) else {
                return Ok(());
            };
            for (start, point) in points.into_iter().enumerate() {
                match point {
                    Ok(point) => {
                        self.found.push(Found { from: (start + 1).to_string(), point, branch: None });
                    }
                    Err(error) => anstream::eprintln!("{frequency_hz} Hz, start {}: {error}", start + 1),
                }
            }
            ticker.at(done as u64 + 1, || format!("{frequency_hz:.4} Hz"));
        }
        ticker.clear();
        Ok(())
    }
}

/// The branch that a periodic motion lies on.
fn branch(branches: &StoredBranches, model: &Model, point: &SweepPoint) -> Result<Option<u32>, Failure> {
    let Class::Periodic { period } = point.class else { return Ok(None) };
    let mut map = SystemMap::new(model.system.clone(), point.frequency_hz, 1, ExactSettings::default())?;
    let mut states = vec![point.state.clone()];
    for k in 1..period {
        states.push(hammerbeam_attractor::SectionMap::advance(&mut map, 0, &states[k - 1])?);
    }
    Ok(branches.branch_of(model, point.frequency_hz, &states)?)
}

fn write(options: &SweepOptions, found: &[Found]) -> Result<(), Failure> {
    let Some(folder) = &options.out else { return Ok(()) };
    let columns = [
        "from",
        "frequency_hz",
        "class",
        "period",
        "max_abs_displacement_m",
        "contacts_per_period",
        "largest_exponent_per_s",
        "half_width_per_s",
        "zero_one_k",
        "branch",
    ];
    let mut table = Table::begin(folder, "sweep.csv", &header(&columns))?;
    let mut samples = Table::begin(
        folder,
        "sweep_samples.csv",
        &header(&["from", "frequency_hz", "class", "displacement_m"]),
    )?;
    for Found { from, point, branch } in found {
        let optional = |value: Option<String>| value.unwrap_or_default();
        let class = point.class.name().to_owned();
        table.row(&[
            from.clone(),
            number(point.frequency_hz),
            class.clone(),
            optional(point.class.period().map(|period| period.to_string())),
            number(point.max_abs_displacement),
            number(point.contacts_per_period),
            number(point.largest_exponent.map(|exponent| exponent.value)),
            number(point.largest_exponent.map(|exponent| exponent.half_width)),
            number(point.zero_one),
            optional(branch.map(|branch| branch.to_string())),
        ])?;
        for sample in &point.samples {
            samples.row(&[from.clone(), number(point.frequency_hz), class.clone(), number(*sample)])?;
        }
    }
    table.finish()?;
    samples.finish()?;
    Ok(())
}

fn document(options: &SweepOptions, found: &[Found]) -> Value {
    let motion = |found: &Found| {
        let point = &found.point;
        json!({
            "from": found.from,
            "frequency_hz": point.frequency_hz,
            "class": point.class.name(),
            "period": point.class.period(),
            "doubt": point.class.doubt(),
            "max_abs_displacement_m": point.max_abs_displacement,
            "contacts_per_period": point.contacts_per_period,
            "largest_exponent_per_s": point.largest_exponent.map(|exponent| exponent.value),
            "half_width_per_s": point.largest_exponent.map(|exponent| exponent.half_width),
            "zero_one_k": point.zero_one,
            "branch": found.branch,
            "sampled_displacements_m": point.samples,
        })
    };
    json!({
        "kind": if options.starts.is_some() { "starts" } else { "sweep" },
        "motions": found.iter().map(motion).collect::<Vec<_>>(),
        "results": folder(options.out.as_deref()),
    })
}

fn text(options: &SweepOptions, found: &[Found], model: &Model) -> String {
    let mut lines = vec![format!(
        "{:>6} {:>12}  {:<16} {:>14} {:>9}  {:<24} {:>6}  branch",
        "from", "Hz", "class", "max. displ. m", "contacts", "largest exponent 1/s", "K"
    )];
    for Found { from, point, branch } in found {
        let class = point.class;
        let exponent = point.largest_exponent.map_or_else(String::new, |exponent| {
            format!("{:.3} +- {:.3}", exponent.value, exponent.half_width)
        });
        let k = point.zero_one.map_or_else(String::new, |k| format!("{k:.2}"));
        let branch = branch.map_or_else(String::new, |branch| branch.to_string());
        lines.push(format!(
            "{from:>6} {:>12.6}  {class:<16} {:>14.6e} {:>9.2}  {exponent:<24} {k:>6}  {branch}",
            point.frequency_hz, point.max_abs_displacement, point.contacts_per_period
        ));
    }
    let doubtful = found.iter().filter(|motion| motion.point.class.doubt().is_some()).count();
    if doubtful > 0 {
        lines.push(format!(
            "{doubtful} motion(s) of {} modes are doubtful; --json has the reasons",
            model.system.dof()
        ));
    }
    if let Some(folder) = &options.out {
        lines.push(format!("sweep.csv and sweep_samples.csv are in {}", folder.display()));
    }
    lines.join("\n")
}
