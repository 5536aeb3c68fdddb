//! `hammerbeam modes`: eigenfrequencies before and after the reduction, and the shapes at the points.

use hammerbeam_drawing::{DrawSettings, draw_into, draw_linear};
use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::modes_document;
use hammerbeam_study::Model;
use serde_json::json;

use crate::{
    args::ModesOptions,
    failure::Failure,
    interrupt::Interrupt,
    matrix_report,
    output::{Output, decimals, six_decimals},
    watch::Watch,
};

/// Rows of the table that are always shown, when there are so many.
const SHOWN: usize = 12;

pub fn run(options: &ModesOptions, output: Output) -> Result<(), Failure> {
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let file = options.study.read()?;
    let model = Model::build(&file)?;
    let mut document = modes_document(&model);
    if let Some(folder) = &options.out {
        let settings = DrawSettings { frequency_unit: output.frequency_unit, ..DrawSettings::default() };
        let drawn = draw_into::<Failure>(folder, settings, &mut watch, |drawn| {
            draw_linear(drawn, &file, &model);
            Ok(())
        });
        document["figures"] = json!(drawn?.names);
    }
    output.give(&document, || text(&model, output.frequency_unit))?;
    Ok(())
}

/// The shape of each mode at the points, divided by its largest entry there; signs are those of the modal
/// coordinates.
fn shapes_text(model: &Model) -> Vec<String> {
    let points = &model.system.model().points;
    let names: String = points.iter().map(|point| format!(" {:>12}", point.name)).collect();
    let mut lines = vec![
        "Shapes of the reduced modes at the points, 1 where they are largest:".to_owned(),
        format!("mode{names}"),
    ];
    for mode in 0..model.system.dof().min(SHOWN) {
        let largest = points
            .iter()
            .map(|point| point.shape[mode])
            .fold(0.0, |largest: f64, entry| if entry.abs() > largest.abs() { entry } else { largest });
        let size = if largest == 0.0 { 1.0 } else { largest.abs() };
        let entry = |shape: &[f64]| format!(" {:>12}", six_decimals(shape[mode] / size));
        let entries: String = points.iter().map(|point| entry(&point.shape)).collect();
        lines.push(format!("{:>4}{entries}", mode + 1));
    }
    lines
}

fn text(model: &Model, unit: FrequencyUnit) -> String {
    let tables = &model.tables;
    let interface = if tables.fixed_interface_hz.is_empty() {
        ("free interface", &tables.free_interface_hz)
    } else {
        ("fixed interface", &tables.fixed_interface_hz)
    };
    let mut lines = vec![
        format!(
            "Eigenfrequencies in {}; clamped means as supported, with the moving support held still.",
            unit.symbol()
        ),
        format!("mode {:>16} {:>16} {:>16} {:>12}", "clamped", interface.0, "reduced", "error"),
    ];
    let known = tables.clamped_hz.len();
    let shown = if model.matrices.is_some() { known } else { SHOWN };
    let rows = tables.reduced_hz.len().max(interface.1.len()).max(shown).min(known);
    let cell = |values: &[f64], row: usize| {
        values.get(row).map_or(String::new(), |value| decimals(unit.factor() * value, 6))
    };
    for row in 0..rows {
        let error =
            tables.frequency_errors.get(row).map_or(String::new(), |e| format!("{:+.2e}", e.relative));
        lines.push(format!(
            "{:>4} {:>16} {:>16} {:>16} {error:>12}",
            row + 1,
            cell(&tables.clamped_hz, row),
            cell(interface.1, row),
            cell(&tables.reduced_hz, row),
        ));
    }
    if rows < tables.clamped_hz.len() {
        lines.push(format!("  and {} more unreduced modes, with --json", tables.clamped_hz.len() - rows));
    }
    for error in &tables.flexibility_errors {
        lines.push(format!(
            "static flexibility at {}: {:.6e} m/N unreduced, {:.6e} m/N reduced, error {:+.2e}",
            error.point, error.full, error.reduced, error.relative
        ));
    }
    if let Some(report) = &model.matrices {
        lines.extend(matrix_report::lines(report));
    }
    lines.extend(shapes_text(model));
    lines.join("\n")
}
