//! `hammerbeam compare`: measured points over computed branches.

mod text;

use std::path::PathBuf;

use hammerbeam_drawing::{DrawSettings, draw_compared, draw_into};
use hammerbeam_jobs::{
    PreparedStudy,
    comparison::{
        CompareReport, Filter, FitSettings, Fixed, MeasuredPoints, compare_output, compare_results,
        read_measured, write_amplitudes, write_compared,
    },
};
use hammerbeam_results::{Store, whole_file::subfolder};
use hammerbeam_signal::{MeasuredQuantity, points::MeasuredPoint};
use hammerbeam_study::{Model, StudyFile};

pub use text::{estimate, fit_notes, gaps};

use crate::{
    compare_args::{CompareOptions, QuantityName},
    failure::Failure,
    output::Output,
    watch::Notices,
};

pub fn run(options: &CompareOptions, output: Output) -> Result<(), Failure> {
    let store = Store::open(&options.results)?;
    let file = StudyFile::parse("study.toml", store.about("study")?)?;
    drop(store);
    file.forced()?;
    let (model, point) = observed(&file, options.point.as_deref())?;
    let study = PreparedStudy { file, model };
    let folder = folder(options)?;
    let measured = read_measured(&options.measured, options.reference.as_deref())?;
    let filter = options.low_pass.map(|cut_off_hz| Filter { order: options.order as usize, cut_off_hz });
    let settings = settings(options, &measured.points);
    let compared = match &options.output {
        Some(output) => {
            vec![compare_output((&study.file, output), &options.results, &measured, &settings)?]
        }
        None => {
            let quantities = quantities(options, &measured)?;
            let of = (&measured, quantities.as_slice());
            compare_results((&study, &point), &options.results, of, filter, &settings)?
        }
    };
    let point = options.output.clone().unwrap_or(point);
    let mut report = CompareReport {
        results: options.results.clone(),
        point,
        files_measured: options.measured.clone(),
        measured,
        filter,
        reach: options.reach,
        compared,
        folder: folder.clone(),
        files: Vec::new(),
        excitation_notes: Vec::new(),
    };
    let settings = DrawSettings { frequency_unit: output.frequency_unit, ..DrawSettings::default() };
    let mut notes = Vec::new();
    let drawn = draw_into::<Failure>(&folder, settings, &mut Notices, |drawn| {
        for one in &report.compared {
            let name = write_compared(&folder, one)?;
            drawn.files.push(name);
            let name = format!("compare_{}", one.comparison.quantity.word());
            draw_compared(&study.file, one, &name, drawn);
        }
        if let Some(amplitudes) = write_amplitudes(&folder, &report.measured.points)? {
            drawn.files.push(amplitudes.name);
            notes = amplitudes.notes;
        }
        Ok(())
    });
    (report.files, report.excitation_notes) = (drawn?.names, notes);
    output.give(&report, || text::text(&report, options.out.is_some()))?;
    Ok(())
}

/// The model with a point observed, that of the study if none is named, and its name.
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
fn quantities(options: &CompareOptions, measured: &MeasuredPoints) -> Result<Vec<MeasuredQuantity>, Failure> {
    let all = measured.quantities();
    if options.quantity.is_empty() {
        return Ok(all);
    }
    let asked: Vec<MeasuredQuantity> = options.quantity.iter().map(|name| (*name).into()).collect();
    match asked.iter().find(|quantity| !all.contains(quantity)) {
        Some(missing) => {
            let found: Vec<&str> = all.iter().map(|quantity| quantity.word()).collect();
            let (missing, found) = (missing.word(), found.join(", "));
            Err(Failure::BadInput(format!("--quantity: no {missing} was measured; there is {found}")))
        }
        None => Ok(asked),
    }
}

impl From<QuantityName> for MeasuredQuantity {
    fn from(name: QuantityName) -> Self {
        match name {
            QuantityName::Displacement => Self::Displacement,
            QuantityName::Velocity => Self::Velocity,
            QuantityName::Acceleration => Self::Acceleration,
            QuantityName::Force => Self::Force,
        }
    }
}
