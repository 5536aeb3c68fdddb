//! Figures of a results folder.

use std::{fs, path::Path};

use anyhow::Context;
use hammerbeam_figure::{Quantity, ResponseCurve, ResponseDiagram, ResponsePoint};
use hammerbeam_study::{Store, StoreError, store::Row};

/// Resolution of the PNG files, in pixels per inch.
const RESOLUTION: f64 = 300.0;

const FIGURES: [(&str, Quantity); 2] =
    [("response_displacement", Quantity::Displacement), ("response_acceleration", Quantity::Acceleration)];

/// Draws the response diagrams into the results folder, each as SVG and PNG.
///
/// # Returns
/// Names of the files.
pub fn draw(store: &Store, range_hz: [f64; 2]) -> anyhow::Result<Vec<String>> {
    let diagram = diagram(store, range_hz)?;
    let mut names = Vec::new();
    for (name, quantity) in FIGURES {
        let figure = diagram.draw(quantity).context("cannot draw the response")?;
        for (suffix, bytes) in [("svg", figure.svg().as_bytes().to_vec()), ("png", figure.png(RESOLUTION)?)] {
            let file = format!("{name}.{suffix}");
            replace(&store.folder().join(&file), &bytes)?;
            names.push(file);
        }
    }
    Ok(names)
}

fn diagram(store: &Store, [low, high]: [f64; 2]) -> anyhow::Result<ResponseDiagram> {
    let mut curves = Vec::new();
    for branch in store.branches()? {
        let mut points = Vec::new();
        store.each_row::<StoreError>(&branch, |row| {
            points.push(point(&row));
            Ok(())
        })?;
        curves.push(ResponseCurve { period_multiple: branch.period_multiple, points });
    }
    Ok(ResponseDiagram { title: store.about("title")?, curves, frequency_range_hz: Some((low, high)) })
}

fn point(row: &Row) -> ResponsePoint {
    ResponsePoint {
        frequency_hz: row.frequency_hz,
        displacement_m: row.maxima.displacement,
        acceleration_m_s2: row.maxima.acceleration,
        stable: row.stable,
        fold: row.events.fold,
        grazing: row.events.grazing,
        flip: row.events.flip,
        neimark_sacker: row.events.neimark_sacker,
        branch_point: row.events.branch_point,
    }
}

/// Writes a file so that it is there complete or not at all.
fn replace(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    let unfinished = path.with_extension("part");
    fs::write(&unfinished, bytes)
        .and_then(|()| fs::rename(&unfinished, path))
        .with_context(|| format!("cannot write {}", path.display()))
}
