//! `hammerbeam sweep`: settled motions over the frequency.

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::{
    FrequencySeries, JobError, JobFolders, PreparedStudy, counted,
    pool::threads,
    sweep::{SweepReport, SweepRequest, SweepStarts, sweep},
};
use hammerbeam_results::store::SettledMotion;

use crate::{
    failure::Failure,
    initial,
    interrupt::Interrupt,
    kept::{unfinished, what_is_kept},
    motion_args::SweepOptions,
    output::Output,
    series::falling,
    watch::Watch,
};

pub fn run(options: &SweepOptions, output: Output) -> Result<(), Failure> {
    let file = options.study.read()?;
    let [low, high] = file.forced()?.frequency_hz;
    let study = PreparedStudy::new(file)?;
    let starts = match options.starts {
        Some(starts) => SweepStarts::Many(starts as usize),
        None => SweepStarts::CarriedOver {
            initial: initial::meant(&options.initial, 2 * study.dof())?,
            down: options.down,
        },
    };
    let request = SweepRequest {
        frequencies: FrequencySeries {
            from_hz: options.from.unwrap_or(low),
            to_hz: options.to.unwrap_or(high),
            step_hz: options.step,
        },
        starts,
        samples: options.samples as usize,
        effort: (&options.effort).into(),
    };
    let folders = JobFolders { results: options.results.as_deref(), out: options.out.as_deref() };
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let report = sweep(&study, &request, folders, threads(options.jobs), &mut watch);
    let report = report.map_err(|error| refused(options, &study, error))?;
    if report.motions.is_empty() {
        return Err(Failure::NoResult("no motion could be computed".to_owned()));
    }
    output.give(&report, || text(&report, study.dof(), output.frequency_unit))?;
    Ok(())
}

fn refused(options: &SweepOptions, study: &PreparedStudy, error: JobError) -> Failure {
    let what_is_kept =
        |number| format!("{} {}", counted(number, "motion"), what_is_kept(number, options.out.as_deref()));
    match initial::refused(&options.initial, 2 * study.dof(), error) {
        Ok(failure) => failure,
        Err(error) => falling(error, "--from").unwrap_or_else(|error| unfinished(error, what_is_kept)),
    }
}

fn text(report: &SweepReport, dof: usize, unit: FrequencyUnit) -> String {
    let mut lines = vec![format!(
        "{:>6} {:>12}  {:<16} {:>14} {:>9}  {:<24} {:>6}  branch",
        "from",
        unit.symbol(),
        "class",
        "max. displ. m",
        "contacts",
        "largest exponent 1/s",
        "K"
    )];
    for swept in &report.motions {
        let SettledMotion { origin, point } = &swept.motion;
        let class = point.class;
        let exponent = point.largest_exponent.map_or_else(String::new, |exponent| {
            format!("{:.3} +- {:.3}", exponent.value, exponent.half_width)
        });
        let k = point.zero_one.map_or_else(String::new, |k| format!("{k:.2}"));
        let branch = swept.branch.map_or_else(String::new, |branch| branch.to_string());
        lines.push(format!(
            "{origin:>6} {:>12.6}  {class:<16} {:>14.6e} {:>9.2}  {exponent:<24} {k:>6}  {branch}",
            unit.factor() * point.frequency_hz,
            point.max_abs_displacement,
            point.contacts_per_period
        ));
    }
    let doubtful = report.motions.iter().filter(|swept| swept.motion.point.class.doubt().is_some()).count();
    if doubtful > 0 {
        let motions = counted(doubtful as u64, "motion");
        lines.push(format!("doubtful: {motions} of {dof} modes; --json has the reasons"));
    }
    if let Some(folder) = &report.results {
        lines.push(format!("sweep.csv and sweep_samples.csv are in {folder}"));
    }
    lines.join("\n")
}
