//! `hammerbeam orbit`: the periodic solutions at one frequency.

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::OrbitSolver;
use hammerbeam_orbit::{FoundOrbits, PeriodicSolution};
use hammerbeam_study::{Model, StudyFile};
use serde_json::{Value, json};

use crate::{
    args::OrbitOptions,
    drift,
    failure::Failure,
    figures::{self, Drawn},
    interrupt::Interrupt,
    output::{Output, six_decimals, tell},
};

pub fn run(options: &OrbitOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    file.forced()?;
    let model = Model::build(&file)?;
    drift::heed(&model)?;
    let solver = OrbitSolver::new(&model, &file.study);
    let (frequency_hz, multiple) = (options.frequency, options.period_multiple);
    let interrupt = Interrupt::listen(output)?;
    let found = solver.find_orbits(frequency_hz, multiple, &mut || interrupt.raised());
    if interrupt.raised() {
        return Err(Failure::Interrupted("interrupted".to_owned()));
    }
    let FoundOrbits { orbits, incomplete } = found.map_err(Failure::NoResult)?;
    let incomplete = incomplete.map(|reason| format!("the search is not complete: {reason}"));
    let Some((first, others)) = orbits.split_first() else {
        let nothing = format!(
            "no periodic solution of {multiple} excitation period(s) was found at {}",
            output.frequency_unit.words(frequency_hz)
        );
        return Err(Failure::NoResult(incomplete.map_or(nothing.clone(), |why| format!("{nothing}; {why}"))));
    };
    let complete = incomplete.is_none();
    if let Some(why) = incomplete {
        tell(&why);
    }
    let mut document = document(first, others, complete);
    if let Some(folder) = &options.out {
        let low_pass_hz = options.low_pass.or(file.study.figures.low_pass_hz);
        let mut drawn = Drawn::into(folder)?.on(1, interrupt);
        drawn.frequency_unit = output.frequency_unit;
        figures::orbit::draw((&file, &model), &orbits, low_pass_hz, &mut drawn)?;
        document["figures"] = json!(drawn.finish()?.names);
    }
    output.give(&document, || text(first, others, (&file.study.response.point, output.frequency_unit)))?;
    Ok(())
}

fn document(first: &PeriodicSolution, others: &[PeriodicSolution], complete: bool) -> Value {
    let mut document = quantities(first);
    document["search_complete"] = complete.into();
    document["others"] = others.iter().map(quantities).collect();
    document
}

fn quantities(solution: &PeriodicSolution) -> Value {
    let maxima = &solution.maxima;
    json!({
        "frequency_hz": solution.frequency_hz,
        "period_multiple": solution.period_multiple,
        "max_abs_displacement_m": maxima.displacement,
        "max_abs_acceleration_m_s2": maxima.acceleration,
        "max_contact_force_n": maxima.contact_force,
        "max_impact_velocity_m_s": maxima.impact_velocity,
        "impulse_n_s": maxima.impulse,
        "contacts": maxima.contacts,
        "phase_cycles": solution.phase,
        "state": solution.nodes[0],
        "floquet_multipliers": solution.floquet_multipliers,
        "stable": solution.stable(),
        "stability": solution.stability().word(),
        "residual": solution.residual,
        "error_estimate": solution.error_estimate,
    })
}

fn text(first: &PeriodicSolution, others: &[PeriodicSolution], shown: (&str, FrequencyUnit)) -> String {
    let shown: Vec<String> =
        std::iter::once(first).chain(others).map(|solution| solution_text(solution, shown)).collect();
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
    [
        format!(
            "{}, period {} excitation period(s), {}",
            unit.words(solution.frequency_hz),
            solution.period_multiple,
            solution.stability().word()
        ),
        format!("  maximum displacement of {point}   {:.9e} m", maxima.displacement),
        format!("  maximum acceleration of {point}   {:.9e} m/s^2", maxima.acceleration),
        format!("  maximum contact force       {:.9e} N", maxima.contact_force),
        format!("  maximum impact velocity     {:.9e} m/s", maxima.impact_velocity),
        format!("  impulse of all contacts     {:.9e} N s", maxima.impulse),
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
