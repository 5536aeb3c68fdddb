//! `hammerbeam compare`: measured points over computed branches.

mod document;
mod figure;
mod measured;
mod records;
mod table;
mod text;

use std::path::PathBuf;

use hammerbeam_drawing::{DrawSettings, draw_into};
use hammerbeam_jobs::{
    StoredBranches,
    comparison::{Comparison, Curves, Filter, FitSettings, Fixed, Observation, compare, curves},
};
use hammerbeam_results::{Store, whole_file::subfolder};
use hammerbeam_signal::{Quantity, points::MeasuredPoint};
use hammerbeam_study::{Model, StudyFile};

pub use document::comparison_document;
pub use figure::draw;
pub use records::frequency_in_name;
pub use table::write_points;
pub use text::{estimate, fit_notes, gaps};

use crate::{
    compare_args::{CompareOptions, QuantityName},
    failure::Failure,
    output::Output,
    watch::Notices,
};

/// Distance of orbits that are computed again as a part of the middle of the frequency range, and their
/// samples in an excitation period.
const SPACING: f64 = 1e-3;
const SAMPLES: usize = 4096;

/// A quantity with its curves and what came of it.
pub struct Compared {
    pub curves: Curves,
    pub comparison: Comparison,
    /// Cut-off of the filter that the curves are behind (Hz), if there is one.
    pub low_pass_hz: Option<f64>,
    /// The point that was measured, if it is not the response point of the study.
    pub point: Option<String>,
    /// Range of the frequency of the study (Hz).
    pub range_hz: [f64; 2],
}

impl Compared {
    /// How many points are shifted beyond the range of the study, where nothing is computed or drawn.
    fn beyond(&self) -> usize {
        let [low, high] = self.range_hz;
        self.comparison.points.iter().filter(|point| !(low..=high).contains(&point.shifted_hz)).count()
    }
}

pub fn run(options: &CompareOptions, output: Output) -> Result<(), Failure> {
    let store = Store::open(&options.results)?;
    let file = StudyFile::parse("study.toml", store.about("study")?)?;
    drop(store);
    let range_hz @ [low, high] = file.forced()?.frequency_hz;
    let (model, point) = observed(&file, options.point.as_deref())?;
    let at_response_point = point == file.study.response.point;
    let folder = folder(options)?;
    let measured = measured::read(&options.measured, options.reference.as_deref())?;
    let quantities = quantities(options, &measured.points)?;
    let branches = StoredBranches::open(&options.results, &file)?;
    if branches.branches().is_empty() {
        let results = options.results.display();
        return Err(Failure::NoResult(format!("{results} holds no branch to compare with")));
    }
    let filter = options.low_pass.map(|cut_off_hz| Filter { order: options.order as usize, cut_off_hz });
    let spacing_hz = SPACING * 0.5 * (low + high);
    let mut compared = Vec::new();
    for quantity in quantities {
        let filter = filter.filter(|_| quantity != Quantity::Force);
        let observation = Observation { quantity, at_response_point, filter, spacing_hz, samples: SAMPLES };
        let curves = curves(&branches, &model, &observation)?;
        let comparison = compare(&measured.points, &curves, quantity, &settings(options, &measured.points))?;
        let low_pass_hz = filter.map(|filter| filter.cut_off_hz);
        let of_point = quantity != Quantity::Force && !at_response_point;
        let point = of_point.then(|| point.clone());
        compared.push(Compared { curves, comparison, low_pass_hz, point, range_hz });
    }
    let settings = DrawSettings { frequency_unit: output.frequency_unit, ..DrawSettings::default() };
    let mut notes = Vec::new();
    let drawn = draw_into::<Failure>(&folder, settings, &mut Notices, |drawn| {
        for one in &compared {
            let name = format!("points_{}.csv", one.comparison.quantity.word());
            write_points(&folder, &name, (&one.comparison, one.low_pass_hz))?;
            drawn.files.push(name);
            let name = format!("compare_{}", one.comparison.quantity.word());
            draw(&file, one, &name, drawn);
        }
        if let Some(amplitudes) = table::write_amplitudes(&folder, &measured.points)? {
            drawn.files.push(amplitudes.name);
            notes = amplitudes.notes;
        }
        Ok(())
    });
    let files = drawn?.names;
    let mut document = document::document(options, &measured, (&compared, &point), (&folder, &files));
    document["excitation_notes"] = serde_json::json!(notes);
    output.give(&document, || {
        let mut text = text::text(options, &measured, (&compared, &point), (&folder, &files));
        notes.iter().for_each(|note| text.push_str(&format!("\nnote: {note}")));
        text
    })?;
    Ok(())
}

/// The model with a point observed, that of the study if none is told, and its name.
pub fn observed(file: &StudyFile, point: Option<&str>) -> Result<(Model, String), Failure> {
    let model = Model::build(file)?;
    let Some(name) = point else { return Ok((model, file.study.response.point.clone())) };
    let observed = model.observed_at(name).ok_or_else(|| {
        let names = model.point_names().join(", ");
        Failure::BadInput(format!("--point: the structure has no point {name}; it has {names}"))
    })?;
    Ok((observed, name.to_owned()))
}

/// Where to write: not into the results folder itself, whose tables of points are those of `rig`.
fn folder(options: &CompareOptions) -> Result<PathBuf, Failure> {
    let Some(folder) = &options.out else { return Ok(subfolder(&options.results, "compare")?) };
    let same = match (folder.canonicalize(), options.results.canonicalize()) {
        (Ok(folder), Ok(results)) => folder == results,
        _ => false,
    };
    if same {
        let message = "--out is the results folder itself, where the tables of `rig` have the same names; without --out they go into its folder compare";
        return Err(Failure::BadInput(message.to_owned()));
    }
    Ok(folder.clone())
}

/// How the comparison is done.
fn settings(options: &CompareOptions, points: &[MeasuredPoint]) -> FitSettings {
    let usual = FitSettings::default();
    let offset = options.fit_offset || options.frequency_offset.is_some();
    let frequency = match (options.frequency_factor, options.frequency_offset) {
        (Some(given), _) | (_, Some(given)) => Fixed::Given(given),
        (None, None) if offset => Fixed::offsets(points),
        (None, None) => usual.frequency,
    };
    let amplitude = options.amplitude_factor.map_or(usual.amplitude, Fixed::Given);
    FitSettings { offset, frequency, amplitude, reach: options.reach }
}

/// Those asked for, else those measured.
fn quantities(options: &CompareOptions, points: &[MeasuredPoint]) -> Result<Vec<Quantity>, Failure> {
    let all = [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration, Quantity::Force];
    let is_measured = |quantity: &Quantity| points.iter().any(|p| p.maxima.of(*quantity).is_some());
    if options.quantity.is_empty() {
        return Ok(all.into_iter().filter(is_measured).collect());
    }
    let asked: Vec<Quantity> = options.quantity.iter().map(|name| (*name).into()).collect();
    match asked.iter().find(|quantity| !is_measured(quantity)) {
        Some(missing) => {
            let found: Vec<&str> = all.iter().filter(|q| is_measured(q)).map(|q| q.word()).collect();
            let (missing, found) = (missing.word(), found.join(", "));
            Err(Failure::BadInput(format!("--quantity: no {missing} was measured; there is {found}")))
        }
        None => Ok(asked),
    }
}

impl From<QuantityName> for Quantity {
    fn from(name: QuantityName) -> Self {
        match name {
            QuantityName::Displacement => Self::Displacement,
            QuantityName::Velocity => Self::Velocity,
            QuantityName::Acceleration => Self::Acceleration,
            QuantityName::Force => Self::Force,
        }
    }
}
