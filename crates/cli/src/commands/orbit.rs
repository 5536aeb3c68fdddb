//! `hammerbeam orbit`: the periodic solutions at one frequency.

use hammerbeam_drawing::{DrawSettings, draw_into, orbit};
use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::{Observer, PreparedStudy, counted, orbits::orbits};
use hammerbeam_orbit::PeriodicSolution;
use hammerbeam_study::readable_to;

use crate::{
    args::OrbitOptions,
    failure::Failure,
    interrupt::Interrupt,
    output::{Output, notify, readable_frequency, six_decimals},
    watch::Watch,
};

/// Digits of maxima.
const DIGITS: usize = 10;

pub fn run(options: &OrbitOptions, output: Output) -> Result<(), Failure> {
    let file = options.study.read()?;
    file.forced()?;
    let study = PreparedStudy::new(file)?;
    let (frequency_hz, multiple) = (options.frequency, options.period_multiple);
    let shown = (study.file.study.response.point.as_str(), output.frequency_unit);
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let mut report = orbits(&study, frequency_hz, multiple, &mut watch)?;
    if report.orbits.is_empty() {
        let nothing = format!(
            "no periodic solution of {} was found at {}",
            counted(multiple.into(), "excitation period"),
            output.frequency_unit.words(frequency_hz)
        );
        let why = report.incomplete.map_or(String::new(), |reason| format!(": {reason}"));
        return Err(Failure::NoResult(nothing + &why));
    }
    if report.is_interrupted() {
        // What is left is short: it is neither drawn nor are motions computed again.
        watch.finishing();
        output.give(&report, || text(&report.orbits, shown))?;
        let drawn = if options.out.is_some() { ", and nothing is drawn" } else { "" };
        let message = format!("interrupted; these are the periodic solutions that were found by then{drawn}");
        return Err(Failure::InterruptedWithResult(message));
    }
    if let Some(reason) = &report.incomplete {
        notify(&format!("the search is not complete: {reason}"));
    }
    if let Some(folder) = &options.out {
        let low_pass_hz = options.low_pass.or(study.file.study.figures.low_pass_hz);
        let settings = DrawSettings { frequency_unit: output.frequency_unit, ..DrawSettings::default() };
        let drawn = draw_into::<Failure>(folder, settings, &mut watch, |drawn| {
            Ok(orbit::draw((&study.file, &study.model), &report.orbits, low_pass_hz, drawn)?)
        });
        report.figures = Some(drawn?.names);
    }
    if output.json {
        report.add_waveforms(&study)?;
    }
    output.give(&report, || text(&report.orbits, shown))
}

fn text(orbits: &[PeriodicSolution], shown: (&str, FrequencyUnit)) -> String {
    let shown: Vec<String> = orbits.iter().map(|solution| solution_text(solution, shown)).collect();
    let count = match shown.len() {
        1 => "One periodic solution was found.".to_owned(),
        count => format!("{count} periodic solutions were found."),
    };
    format!("{count}\n\n{}", shown.join("\n\n"))
}

fn solution_text(solution: &PeriodicSolution, (point, unit): (&str, FrequencyUnit)) -> String {
    let maxima = &solution.maxima;
    let multipliers: Vec<String> = solution.floquet_multipliers.iter().take(4).map(|m| complex(*m)).collect();
    let more = if solution.floquet_multipliers.len() > 4 { ", ..." } else { "" };
    let shown = |value: f64, of: &str| readable_to(value, of, DIGITS);
    [
        format!(
            "{}, period of {}, {}",
            readable_frequency(unit, solution.frequency_hz),
            counted(solution.period_multiple.into(), "excitation period"),
            solution.stability().word()
        ),
        format!("  maximum displacement of {point}   {}", shown(maxima.displacement, "m")),
        format!("  maximum acceleration of {point}   {}", shown(maxima.acceleration, "m/s^2")),
        format!("  maximum contact force       {}", shown(maxima.contact_force, "N")),
        format!("  maximum impact velocity     {}", shown(maxima.impact_velocity, "m/s")),
        format!("  impulse of all contacts     {}", shown(maxima.impulse, "N s")),
        format!("  contacts in an orbit period {}", maxima.contacts),
        format!("  Floquet multipliers         {}{more}", multipliers.join(", ")),
        format!("  residual                    {:.1e}", solution.residual),
    ]
    .join("\n")
}

fn complex([re, im]: [f64; 2]) -> String {
    let real = six_decimals(re);
    if im == 0.0 { real } else { format!("{real}{im:+.6}i") }
}
