//! Branches over the frequency by columns: their rows, events, ends, states and multipliers.

use hammerbeam_orbit::{EventStatus, Events, LocatedEvent, PeriodicSolution, Side, Stability};

use super::{ColumnTable, ColumnValues, named};
use crate::store::{BranchRecord, Row, Store, StoreError, solution_key};

/// The branches that are wanted, all of them if none is named.
fn wanted(store: &Store, branches: &[u32]) -> Result<Vec<BranchRecord>, StoreError> {
    let mut stored = store.branches()?;
    stored.retain(|branch| branches.is_empty() || branches.contains(&branch.id));
    Ok(stored)
}

/// One row per solution, end to end along each branch: the columns of `branches.csv`, with `stability` in
/// words behind `stable`.
///
/// * `branches`: their numbers; all if there are none.
///
/// # Errors
/// [`StoreError`]: solutions are missing or damaged.
pub fn branch_table(store: &Store, branches: &[u32]) -> Result<ColumnTable, StoreError> {
    let (mut numbers, mut multiples, mut rows) = (Vec::new(), Vec::new(), Vec::new());
    for branch in wanted(store, branches)? {
        store.each_row::<StoreError>(&branch, |row| {
            rows.push(row);
            Ok(())
        })?;
        numbers.resize(rows.len(), i64::from(branch.id));
        multiples.resize(rows.len(), i64::from(branch.period_multiple));
    }
    let number = |of: fn(&Row) -> f64| ColumnValues::Numbers(rows.iter().map(of).collect());
    let stable = rows.iter().map(|row| row.stability == Stability::Stable);
    Ok(ColumnTable::new(
        "branches",
        named([
            ("branch", ColumnValues::Whole(numbers)),
            ("period_multiple", ColumnValues::Whole(multiples)),
            ("frequency_hz", number(|row| row.frequency_hz)),
            ("max_abs_displacement_m", number(|row| row.maxima.displacement)),
            ("max_abs_acceleration_m_s2", number(|row| row.maxima.acceleration)),
            ("max_contact_force_n", number(|row| row.maxima.contact_force)),
            ("max_impact_velocity_m_s", number(|row| row.maxima.impact_velocity)),
            ("contacts", ColumnValues::Whole(rows.iter().map(|row| row.maxima.contacts.into()).collect())),
            ("leading_multiplier_re", number(|row| row.leading_multiplier[0])),
            ("leading_multiplier_im", number(|row| row.leading_multiplier[1])),
            ("stable", ColumnValues::Flags(stable.collect())),
            ("stability", ColumnValues::Words(rows.iter().map(|row| row.stability.word().into()).collect())),
            ("event", ColumnValues::Words(rows.iter().map(|row| row.events.label().into()).collect())),
            ("impulse_n_s", number(|row| row.maxima.impulse)),
            ("residual", number(|row| row.residual)),
            ("error_estimate", number(|row| row.error_estimate)),
        ]),
    ))
}

/// The key of a row of a branch, counted from 0 end to end.
fn key_of(branch: &BranchRecord, row: u64) -> (Side, i64) {
    let down = branch.down.solutions;
    let (side, number) = if row < down { (Side::Down, down - 1 - row) } else { (Side::Up, row - down) };
    (side, solution_key(branch.start, side, number as u32))
}

/// One row per event: the columns of `events.csv`.
///
/// * `branches`: their numbers; all if there are none.
///
/// # Errors
/// [`StoreError`]: solutions are missing or damaged.
pub fn event_table(store: &Store, branches: &[u32]) -> Result<ColumnTable, StoreError> {
    let mut found = EventColumns::default();
    for branch in wanted(store, branches)? {
        let mut place = 0;
        store.each_row::<StoreError>(&branch, |row| {
            let number = place;
            place += 1;
            let (side, key) = key_of(&branch, number);
            let Some(event) = store.event(key)? else { return Ok(()) };
            // It was walked the other way than rows are counted.
            let event = if side == Side::Down { event.backwards() } else { event };
            found.branch.push(branch.id.into());
            found.multiple.push(branch.period_multiple.into());
            let name = Events { start: false, end: false, ..row.events }.label();
            found.add(number as i64, name, row.frequency_hz, &event);
            found.multipliers.push(store.multipliers(key)?);
            Ok(())
        })?;
    }
    Ok(found.table())
}

/// What is known of events, by columns.
#[derive(Default)]
struct EventColumns {
    branch: Vec<i64>,
    multiple: Vec<i64>,
    row: Vec<i64>,
    event: Vec<std::borrow::Cow<'static, str>>,
    frequency_hz: Vec<f64>,
    status: Vec<std::borrow::Cow<'static, str>>,
    uncertainty: Vec<f64>,
    critical: Vec<[f64; 2]>,
    change: Vec<std::borrow::Cow<'static, str>>,
    direction: Vec<Vec<f64>>,
    breaks_symmetry: Vec<bool>,
    multipliers: Vec<Vec<[f64; 2]>>,
}

impl EventColumns {
    fn add(&mut self, row: i64, name: String, frequency_hz: f64, event: &LocatedEvent) {
        self.row.push(row);
        self.event.push(name.into());
        self.frequency_hz.push(frequency_hz);
        self.status.push(match event.status {
            EventStatus::Located => "located".into(),
            EventStatus::Bracketed => "bracketed".into(),
        });
        self.uncertainty.push(event.uncertainty);
        self.critical.push(event.multiplier.unwrap_or([f64::NAN; 2]));
        let sign = |appears| if appears { '+' } else { '-' };
        let changes =
            event.contacts.iter().map(|change| format!("{}{}", sign(change.appears), change.contact + 1));
        self.change.push(changes.collect::<Vec<_>>().join(" ").into());
        self.direction.push(event.direction.clone());
        self.breaks_symmetry.push(event.breaks_symmetry);
    }

    fn table(self) -> ColumnTable {
        let part = |part: usize| ColumnValues::Numbers(self.critical.iter().map(|pair| pair[part]).collect());
        ColumnTable::new(
            "events",
            named([
                ("branch", ColumnValues::Whole(self.branch)),
                ("period_multiple", ColumnValues::Whole(self.multiple)),
                ("row", ColumnValues::Whole(self.row)),
                ("event", ColumnValues::Words(self.event)),
                ("frequency_hz", ColumnValues::Numbers(self.frequency_hz)),
                ("status", ColumnValues::Words(self.status)),
                ("uncertainty_hz", ColumnValues::Numbers(self.uncertainty)),
                ("multiplier_re", part(0)),
                ("multiplier_im", part(1)),
                ("contact_change", ColumnValues::Words(self.change)),
                ("direction", ColumnValues::vectors(&self.direction)),
                ("symmetry_breaking", ColumnValues::Flags(self.breaks_symmetry)),
                ("multipliers", ColumnValues::complex(&self.multipliers)),
            ]),
        )
    }
}

/// One row per end of a branch: the columns of `ends.csv`.
///
/// * `branches`: their numbers; all if there are none.
///
/// # Errors
/// [`StoreError`]: solutions are missing or damaged.
pub fn end_table(store: &Store, branches: &[u32]) -> Result<ColumnTable, StoreError> {
    let (mut sides, mut ends, mut messages) = (Vec::new(), Vec::new(), Vec::new());
    let mut last = SolutionColumns::default();
    for branch in wanted(store, branches)? {
        for (side, name, walk) in [(Side::Down, "down", &branch.down), (Side::Up, "up", &branch.up)] {
            // A side without solutions ends at the start, which is the first of the up side.
            let solution = match (walk.solutions, branch.up.solutions) {
                (0, 0) => continue,
                (0, _) => store.solution(branch.start, Side::Up, 0)?,
                (count, _) => store.solution(branch.start, side, count as u32 - 1)?,
            };
            sides.push(name.into());
            let (kind, message) = match &walk.reason {
                Some(reason) => (reason.kind.clone(), reason.message.clone()),
                None => ("not-finished".into(), "not finished: the same run goes on from here".into()),
            };
            ends.push(kind.into());
            messages.push(message.into());
            last.add(branch.id, solution);
        }
    }
    Ok(ColumnTable::new(
        "ends",
        named([
            ("branch", ColumnValues::Whole(last.branch)),
            ("period_multiple", ColumnValues::Whole(last.multiple)),
            ("side", ColumnValues::Words(sides)),
            ("end", ColumnValues::Words(ends)),
            ("frequency_hz", ColumnValues::Numbers(last.frequency_hz)),
            ("message", ColumnValues::Words(messages)),
            ("phase_cycles", ColumnValues::Numbers(last.phase)),
            ("state", ColumnValues::vectors(&last.state)),
        ]),
    ))
}

/// States and multipliers of solutions, by columns.
#[derive(Default)]
struct SolutionColumns {
    branch: Vec<i64>,
    multiple: Vec<i64>,
    frequency_hz: Vec<f64>,
    phase: Vec<f64>,
    state: Vec<Vec<f64>>,
    multipliers: Vec<Vec<[f64; 2]>>,
}

impl SolutionColumns {
    fn add(&mut self, branch: u32, mut solution: PeriodicSolution) {
        self.branch.push(branch.into());
        self.multiple.push(solution.period_multiple.into());
        self.frequency_hz.push(solution.frequency_hz);
        self.phase.push(solution.phase);
        self.state.push(solution.nodes.swap_remove(0));
        self.multipliers.push(solution.floquet_multipliers);
    }
}

/// One row per solution with its state and all multipliers: the columns of `states.csv`.
///
/// * `branches`: their numbers; all if there are none.
///
/// # Errors
/// [`StoreError`]: solutions are missing or damaged.
pub fn state_table(store: &Store, branches: &[u32]) -> Result<ColumnTable, StoreError> {
    let (mut rows, mut all) = (Vec::new(), SolutionColumns::default());
    for branch in wanted(store, branches)? {
        for row in 0..branch.up.solutions + branch.down.solutions {
            all.add(branch.id, store.solution_of_key(key_of(&branch, row).1)?);
            rows.push(row as i64);
        }
    }
    Ok(ColumnTable::new(
        "states",
        named([
            ("branch", ColumnValues::Whole(all.branch)),
            ("period_multiple", ColumnValues::Whole(all.multiple)),
            ("row", ColumnValues::Whole(rows)),
            ("frequency_hz", ColumnValues::Numbers(all.frequency_hz)),
            ("phase_cycles", ColumnValues::Numbers(all.phase)),
            ("state", ColumnValues::vectors(&all.state)),
            ("multipliers", ColumnValues::complex(&all.multipliers)),
        ]),
    ))
}
