//! `hammerbeam basins`: which attractor each of a grid of initial states leads to.

use hammerbeam_attractor::{Attractor, Axis, Basins, Class, Effort, Estimate, Grid, fractions};
use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::StoredBranches;
use hammerbeam_motion::exact::ExactSettings;
use hammerbeam_results::{Store, export::write_basins, store::RequestKind};
use hammerbeam_study::{Model, StudyFile};
use serde_json::{Value, json};

use super::{run::threads, simulate::folder};
use crate::{
    failure::Failure,
    interrupt::Interrupt,
    kept::{Kept, branches},
    motion_args::{AxisOption, BasinsOptions},
    output::Output,
    ticker::Ticker,
};

pub fn run(options: &BasinsOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    file.forced()?;
    let model = Model::build(&file)?;
    let grid = grid(options, &model)?;
    let effort = Effort::from(&options.effort);
    let mut basins =
        Basins::new(model.system.clone(), options.frequency, grid, effort, ExactSettings::default())?;
    let (results, out) = (options.results.as_deref(), options.out.as_deref());
    branches(results, out, &file)?;
    let total = basins.grid().cells();
    let request = (RequestKind::Basins, request(options));
    let mut kept = Kept::open(out, &file, (request.0, &request.1), total as u64)?;
    let (mut cells, attractors) = kept.read(Store::basins)?;
    basins.resume(cells.len(), attractors);
    let interrupt = Interrupt::listen(output)?;
    let mut ticker = Ticker::new(total as u64, "cells");
    let threads = threads(options.jobs);
    while !interrupt.raised() {
        let known = basins.attractors().len();
        let Some(round) = basins.round(threads, interrupt.flag()) else { break };
        kept.add(|store, request| store.append_round(request, &round, known))?;
        cells.extend(round.cells);
        ticker.at(cells.len() as u64, || format!("{} attractor(s)", basins.attractors().len()));
    }
    ticker.clear();
    interrupt.is_in_order();
    let fate = format!("{} of {total} cells {}", cells.len(), kept.fate(cells.len() as u64));
    if cells.len() < total {
        kept.finish()?;
        return Err(Failure::Interrupted(format!("interrupted; {fate}")));
    }
    // Under the lock of the folder: two commands do not write the same tables at once.
    let numbers = numbered_and_written(options, (&file, &model), (&basins, &cells));
    kept.finish()?;
    let branches = numbers.map_err(|failure| failure.and(&fate))?;
    let result = Outcome { options, basins: &basins, cells: &cells, branches };
    if result.lost() == total {
        return Err(Failure::NoResult(format!("no motion from any of the {total} cells: {NOT_COMPUTED}")));
    }
    output.give(&result.document(), || result.text(output.frequency_unit))?;
    Ok(())
}

/// Writes the tables.
///
/// # Returns
/// The branch that each attractor lies on. The branches are closed again here: a store that is read cannot be
/// finished.
fn numbered_and_written(
    options: &BasinsOptions,
    (file, model): (&StudyFile, &Model),
    (basins, cells): (&Basins, &[u32]),
) -> Result<Vec<Option<u32>>, Failure> {
    let attractors = basins.attractors();
    let numbers = match branches(options.results.as_deref(), options.out.as_deref(), file)? {
        Some(branches) => branch_numbers(&branches, model, options.frequency, attractors)?,
        None => vec![None; attractors.len()],
    };
    if let Some(folder) = &options.out {
        write_basins(folder, "", (basins.grid(), cells), attractors, &numbers)?;
    }
    Ok(numbers)
}

/// Why a cell has no attractor.
const NOT_COMPUTED: &str = "they begin behind a rigid stop or within a contact that remembers its impact, or settle with such a contact closed for good, or their motion could not be computed";

/// What is asked of the study.
fn request(options: &BasinsOptions) -> Vec<String> {
    let axis = |name: &str, axis: &AxisOption| {
        [
            format!("{name}.coordinate = {}", axis.name),
            format!("{name}.low = {:e}", axis.low),
            format!("{name}.high = {:e}", axis.high),
        ]
    };
    let mut words =
        vec![format!("frequency_hz = {:e}", options.frequency), format!("grid = {}", options.grid)];
    words.extend(axis("x", &options.x));
    words.extend(axis("y", &options.y));
    words.extend(options.effort.words());
    words
}

fn grid(options: &BasinsOptions, model: &Model) -> Result<Grid, Failure> {
    let axis = |option: &AxisOption, flag: &str| {
        let direction = direction(&option.name, flag, model)?;
        Ok::<_, Failure>(Axis { direction, low: option.low, high: option.high, count: options.grid as usize })
    };
    let (x, y) = (axis(&options.x, "--x")?, axis(&options.y, "--y")?);
    // Each coordinate is one entry of the state, under one name or another.
    if x.direction.iter().zip(&y.direction).any(|(x, y)| x * y != 0.0) {
        return Err(Failure::BadInput(format!(
            "--x and --y, {:?} and {:?}, are the same coordinate; two different ones are needed",
            options.x.name, options.y.name
        )));
    }
    Ok(Grid { base: vec![0.0; 2 * model.system.dof()], x, y })
}

/// What one unit of a coordinate adds to the modal state.
///
/// * `flag`: what named it, for the message where there is no such coordinate.
pub fn direction(name: &str, flag: &str, model: &Model) -> Result<Vec<f64>, Failure> {
    let n = model.system.dof();
    let mut direction = vec![0.0; 2 * n];
    let first = model.response.shape[0];
    let of_point = matches!(name, "displacement" | "velocity");
    if of_point && first == 0.0 {
        let point = "the first mode does not move the response point";
        return Err(Failure::BadInput(format!("{flag}: {point}; allowed: q1 to q{n}, v1 to v{n}")));
    }
    let Some(index) = place(name, n) else {
        let allowed = format!("q1 to q{n}, v1 to v{n}, displacement, velocity");
        return Err(Failure::BadInput(format!("{flag}: found the coordinate {name:?}; allowed: {allowed}")));
    };
    direction[index] = if of_point { 1.0 / first } else { 1.0 };
    Ok(direction)
}

/// Place of a coordinate in the modal state.
fn place(name: &str, n: usize) -> Option<usize> {
    match name {
        "displacement" => return Some(0),
        "velocity" => return Some(n),
        _ => {}
    }
    let (offset, number) = match name.split_at_checked(1)? {
        ("q", number) => (0, number),
        ("v", number) => (n, number),
        _ => return None,
    };
    let number = number.parse::<usize>().ok().filter(|number| (1..=n).contains(number))?;
    Some(offset + number - 1)
}

fn branch_numbers(
    branches: &StoredBranches,
    model: &Model,
    frequency_hz: f64,
    attractors: &[Attractor],
) -> Result<Vec<Option<u32>>, Failure> {
    let of = |attractor: &Attractor| match attractor.class {
        Class::Periodic { .. } => branches.branch_of(model, frequency_hz, &attractor.states),
        _ => Ok(None),
    };
    Ok(attractors.iter().map(of).collect::<Result<_, _>>()?)
}

struct Outcome<'a> {
    options: &'a BasinsOptions,
    basins: &'a Basins,
    cells: &'a [u32],
    branches: Vec<Option<u32>>,
}

impl Outcome<'_> {
    /// Number, attractor, fraction of the cells and branch of each attractor.
    fn attractors(&self) -> impl Iterator<Item = (usize, &Attractor, Estimate, Option<u32>)> {
        let found = self.basins.attractors();
        let fractions = fractions(self.cells, found.len());
        let all = found.iter().zip(fractions.into_iter().skip(1)).zip(&self.branches).enumerate();
        all.map(|(index, ((attractor, fraction), branch))| (index + 1, attractor, fraction, *branch))
    }

    fn lost(&self) -> usize {
        self.cells.iter().filter(|&&number| number == 0).count()
    }

    fn document(&self) -> Value {
        let attractor = |(index, attractor, fraction, branch): (usize, &Attractor, Estimate, Option<u32>)| {
            json!({
                "attractor": index,
                "class": attractor.class.name(),
                "period": attractor.class.period(),
                "fraction": fraction.value,
                "standard_error": fraction.half_width,
                "largest_exponent_per_s": attractor.largest_exponent.map(|exponent| exponent.value),
                "zero_one_k": attractor.zero_one,
                "branch": branch,
                "modal_state": attractor.states.last(),
            })
        };
        let axis = |option: &AxisOption| json!({ "coordinate": option.name, "low": option.low, "high": option.high });
        json!({
            "frequency_hz": self.options.frequency,
            "x": axis(&self.options.x),
            "y": axis(&self.options.y),
            "grid": self.options.grid,
            "cells": self.cells,
            "cells_not_computed": self.lost(),
            "attractors": self.attractors().map(attractor).collect::<Vec<_>>(),
            "results": folder(self.options.out.as_deref()),
        })
    }

    fn text(&self, unit: FrequencyUnit) -> String {
        let mut lines = vec![format!("{} cells at {}", self.cells.len(), unit.words(self.options.frequency))];
        for (index, attractor, fraction, branch) in self.attractors() {
            let class = attractor.class;
            let branch = branch.map_or_else(String::new, |branch| format!(", branch {branch}"));
            lines.push(format!(
                "  attractor {index}: {class}{branch}, fraction {:.4} +- {:.4}",
                fraction.value, fraction.half_width
            ));
        }
        if self.lost() > 0 {
            lines.push(format!("  {} cell(s) without an attractor: {NOT_COMPUTED}", self.lost()));
        }
        if let Some(folder) = &self.options.out {
            lines.push(format!("basins.csv and attractors.csv are in {}", folder.display()));
        }
        lines.join("\n")
    }
}
