//! Stored orbits that are chosen by branch, frequency or event, with their motion over the period.

use std::path::Path;

use hammerbeam_orbit::{BranchEventKind, PeriodicSolution};
use hammerbeam_results::arrays::{ArrayTable, ArrayValues};
use hammerbeam_study::Model;

use crate::{
    CountedProgress, JobError, Observer, OrbitWaveform, PreparedStudy, StoredBranches, orbit_waveform,
};

/// Numbers of all motions that are held in memory at most, 0.4 GB, and as much again as tables.
const MOST_NUMBERS: u64 = 50_000_000;

/// Which orbits of a results folder are meant: those that fit everything that is given.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OrbitChoice {
    /// Numbers of branches; all if there are none.
    pub branches: Vec<u32>,
    /// Orbits in which branches cross these frequencies [Hz].
    pub frequencies_hz: Vec<f64>,
    /// Solutions with an event of these kinds.
    pub events: Vec<BranchEventKind>,
}

/// An orbit of a results folder.
#[derive(Debug, Clone, PartialEq)]
pub struct ChosenOrbit {
    /// The branch that holds it; `None` where it is not stored.
    pub branch: Option<u32>,
    /// Its events joined by `+`; none where a branch crosses a frequency between two rows.
    pub event: String,
    /// The solution.
    pub solution: PeriodicSolution,
}

/// Orbits that are chosen: at each frequency in the order of the branches, then those with events.
///
/// # Errors
/// [`JobError::Store`]: there are no results, or solutions are missing or damaged.
pub fn chosen_orbits(
    study: &PreparedStudy,
    results: &Path,
    choice: &OrbitChoice,
) -> Result<Vec<ChosenOrbit>, JobError> {
    let stored = StoredBranches::open(results, &study.file)?;
    let is_wanted = |id: u32| choice.branches.is_empty() || choice.branches.contains(&id);
    let mut found = Vec::new();
    for frequency_hz in &choice.frequencies_hz {
        let crossings = stored.crossings(&study.model, *frequency_hz, |record| is_wanted(record.id))?;
        found.extend(crossings.into_iter().map(|(branch, solution)| ChosenOrbit {
            branch: Some(branch),
            event: String::new(),
            solution,
        }));
    }
    for branch in stored.branches().iter().filter(|branch| is_wanted(branch.record.id)) {
        for placed in &branch.rows {
            let events = placed.row.events;
            if choice.events.iter().any(|wanted| events.has(*wanted)) {
                let event = events.label();
                let solution = stored.solution(branch, placed)?;
                found.push(ChosenOrbit { branch: Some(branch.record.id), event, solution });
            }
        }
    }
    Ok(found)
}

/// Orbits as two tables: `orbits`, one row for each with its numbers, state and multipliers, and `waveforms`,
/// one row for each sample, with the number of its orbit.
///
/// * `samples`: in each excitation period.
///
/// # Errors
/// [`JobError::Motion`]: a motion cannot be computed again; [`JobError::MotionsTooLarge`];
/// [`JobError::Interrupted`] with the number of orbits.
pub fn orbit_tables(
    model: &Model,
    orbits: &[ChosenOrbit],
    samples: usize,
    observer: &mut dyn Observer,
) -> Result<[ArrayTable; 2], JobError> {
    ensure_small(model, orbits, samples)?;
    let total = orbits.len() as u64;
    let mut waveforms = Vec::with_capacity(orbits.len());
    for (done, orbit) in (0..).zip(orbits) {
        observer.counted(&CountedProgress { done, total: Some(total), things: "orbits", place: &"" });
        if observer.interrupted() {
            return Err(JobError::Interrupted { done, part_s: None });
        }
        waveforms.push(orbit_waveform(model, &orbit.solution, samples)?);
    }
    Ok([orbit_table(orbits), waveform_table(model, &waveforms)])
}

/// Refuses motions that take too much of memory.
fn ensure_small(model: &Model, orbits: &[ChosenOrbit], samples: usize) -> Result<(), JobError> {
    let (points, forces) = (model.point_names().len(), model.system.elements().len());
    // Time and phase; displacement, velocity and acceleration of each point; forces; the state.
    let of_sample = (2 + 3 * points + forces + 2 * model.system.dof()) as u64;
    let periods: u64 = orbits.iter().map(|orbit| u64::from(orbit.solution.period_multiple)).sum();
    let of_all = periods * of_sample;
    let numbers = of_all.saturating_mul(samples as u64);
    if numbers > MOST_NUMBERS {
        let (orbits, most) = (orbits.len(), MOST_NUMBERS);
        return Err(JobError::MotionsTooLarge { orbits, numbers, most, most_samples: most / of_all });
    }
    Ok(())
}

/// Orbits in one row each, the table `orbits`.
#[must_use]
pub fn orbit_table(orbits: &[ChosenOrbit]) -> ArrayTable {
    let number = |of: fn(&PeriodicSolution) -> f64| {
        ArrayValues::Numbers(orbits.iter().map(|orbit| of(&orbit.solution)).collect())
    };
    let whole = |of: fn(&ChosenOrbit) -> u32| {
        ArrayValues::Whole(orbits.iter().map(|orbit| of(orbit).into()).collect())
    };
    let states: Vec<Vec<f64>> = orbits.iter().map(|orbit| orbit.solution.nodes[0].clone()).collect();
    let multipliers: Vec<Vec<[f64; 2]>> =
        orbits.iter().map(|orbit| orbit.solution.floquet_multipliers.clone()).collect();
    let stability = orbits.iter().map(|orbit| orbit.solution.stability().word().into());
    let columns = [
        ("orbit", ArrayValues::Whole((1..=orbits.len() as i64).collect())),
        (
            "branch",
            ArrayValues::Whole(orbits.iter().map(|orbit| orbit.branch.map_or(-1, i64::from)).collect()),
        ),
        ("event", ArrayValues::Words(orbits.iter().map(|orbit| orbit.event.clone().into()).collect())),
        ("period_multiple", whole(|orbit| orbit.solution.period_multiple)),
        ("frequency_hz", number(|orbit| orbit.frequency_hz)),
        ("max_abs_displacement_m", number(|orbit| orbit.maxima.displacement)),
        ("max_abs_acceleration_m_s2", number(|orbit| orbit.maxima.acceleration)),
        ("max_contact_force_n", number(|orbit| orbit.maxima.contact_force)),
        ("max_impact_velocity_m_s", number(|orbit| orbit.maxima.impact_velocity)),
        ("impulse_n_s", number(|orbit| orbit.maxima.impulse)),
        ("contacts", whole(|orbit| orbit.solution.maxima.contacts)),
        ("stable", ArrayValues::Flags(orbits.iter().map(|orbit| orbit.solution.stable()).collect())),
        ("stability", ArrayValues::Words(stability.collect())),
        ("residual", number(|orbit| orbit.residual)),
        ("error_estimate", number(|orbit| orbit.error_estimate)),
        ("phase_cycles", number(|orbit| orbit.phase)),
        ("state", ArrayValues::vectors(&states)),
        ("multipliers", ArrayValues::complex(&multipliers)),
    ];
    ArrayTable::new("orbits", columns.map(|(name, values)| (name.to_owned(), values)).into())
}

fn waveform_table(model: &Model, waveforms: &[OrbitWaveform]) -> ArrayTable {
    let joined = |of: &dyn Fn(&OrbitWaveform) -> &[f64]| {
        ArrayValues::Numbers(waveforms.iter().flat_map(of).copied().collect())
    };
    let numbers =
        waveforms.iter().zip(1..).flat_map(|(waveform, k)| std::iter::repeat_n(k, waveform.time.len()));
    let mut columns: Vec<(String, ArrayValues)> = vec![
        ("orbit".to_owned(), ArrayValues::Whole(numbers.collect())),
        ("time_s".to_owned(), joined(&|waveform| &waveform.time)),
        ("phase_cycles".to_owned(), joined(&|waveform| &waveform.phase_cycles)),
    ];
    for (k, point) in model.point_names().into_iter().enumerate() {
        columns
            .push((format!("{point}_displacement_m"), joined(&|waveform| &waveform.points[k].displacement)));
        columns.push((format!("{point}_velocity_m_s"), joined(&|waveform| &waveform.points[k].velocity)));
        columns.push((
            format!("{point}_acceleration_m_s2"),
            joined(&|waveform| &waveform.points[k].acceleration),
        ));
    }
    for (k, element) in model.system.elements().iter().enumerate() {
        columns.push((format!("{}_force_n", element.name), joined(&|waveform| &waveform.forces[k].1)));
    }
    let states: Vec<Vec<f64>> = waveforms.iter().flat_map(|waveform| waveform.states.clone()).collect();
    columns.push(("state".to_owned(), ArrayValues::vectors(&states)));
    ArrayTable::new("waveforms", columns)
}

#[cfg(test)]
mod tests {
    use hammerbeam_orbit::OrbitMaxima;

    use super::*;
    use crate::{FailureKind, Quiet};

    const STUDY: &str = include_str!("../../../studies/duffing.toml");

    fn orbit(period_multiple: u32) -> ChosenOrbit {
        let solution = PeriodicSolution {
            phase: 0.0,
            frequency_hz: 0.25,
            period_multiple,
            nodes: vec![vec![0.0; 2]],
            floquet_multipliers: Vec::new(),
            on_circle: Vec::new(),
            residual: 0.0,
            error_estimate: 0.0,
            maxima: OrbitMaxima::default(),
        };
        ChosenOrbit { branch: None, event: String::new(), solution }
    }

    /// A sample of one mass with one spring is eleven numbers: time, phase, three of each of its two points,
    /// the mass and the ground, a force, two of the state. In 25 periods 181 818 samples each are 49 999 950
    /// numbers.
    #[test]
    fn motions_are_as_large_as_is_allowed_and_no_larger() {
        let model = PreparedStudy::parse("duffing.toml", STUDY).unwrap().model;
        let orbits = vec![orbit(5), orbit(20)];
        ensure_small(&model, &orbits, 181_818).unwrap();
        let refused = orbit_tables(&model, &orbits, 181_819, &mut Quiet).unwrap_err();
        let words = "the motions of 2 orbits are 50000225 numbers, must be 50000000 at most; allowed: \
            fewer orbits, or at most 181818 samples in a period";
        assert_eq!(refused.to_string(), words);
        assert_eq!(refused.kind(), FailureKind::BadInput);
    }

    /// 120 orbits of 65 536 periods are 86 507 520 numbers with one sample in each.
    #[test]
    fn where_one_sample_in_a_period_is_too_much_fewer_orbits_are_allowed() {
        let model = PreparedStudy::parse("duffing.toml", STUDY).unwrap().model;
        let refused = orbit_tables(&model, &vec![orbit(1 << 16); 120], 1, &mut Quiet).unwrap_err();
        assert!(matches!(refused, JobError::MotionsTooLarge { orbits: 120, most_samples: 0, .. }));
        assert!(
            refused.to_string().ends_with("must be 50000000 at most; allowed: fewer orbits"),
            "{refused}"
        );
    }
}
