//! Response diagrams over the frequency.

use std::path::PathBuf;

use hammerbeam_figure::{
    ResponseCurve, ResponseDiagram, ResponsePoint, ResponseQuantity, ResponseSettings, ScaleChoice,
};
use hammerbeam_results::{Store, StoreError};
use hammerbeam_study::StudyFile;

use crate::{
    Album, DrawingError, Drawn, FigureScale, FigureSelection,
    branches::curves,
    motions::chaotic_ranges,
    outputs::shown_outputs,
    overlaid::{Overlaid, names},
};

/// Quantities of response diagrams, with the words that files have for them.
const FIGURES: [(&str, ResponseQuantity); 4] = [
    ("displacement", ResponseQuantity::Displacement),
    ("acceleration", ResponseQuantity::Acceleration),
    ("force", ResponseQuantity::ContactForce),
    ("velocity", ResponseQuantity::ImpactVelocity),
];

/// Draws the branches, one figure for each quantity.
pub fn draw(
    store: &Store,
    file: &StudyFile,
    selection: &FigureSelection,
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
    let overlaid = overlaid(store, file, selection)?;
    let mut diagram = diagram(store, file.study.excitation.range_hz(), &overlaid)?;
    if diagram.curves.is_empty() {
        return Ok(());
    }
    if !overlaid.is_empty() {
        diagram.name = names_of(store, selection).remove(0);
    }
    let settings = settings(selection.scale, selection.detail_over(None), drawn);
    let others = diagram.overlaid.iter().flat_map(|other| &other.curves);
    let all: Vec<ResponseCurve> = diagram.curves.iter().chain(others).cloned().collect();
    for (word, quantity) in quantities(&all) {
        drawn.add(&format!("response_{word}"), diagram.draw_with(&[quantity], &settings));
    }
    let branches = store.branches()?;
    for shown in shown_outputs(store, file)? {
        let name = format!("response_output_{}", shown.file_name());
        let with_output = overlaid.iter().filter_map(|other| other.with_output(&shown).transpose());
        diagram.overlaid = with_output.collect::<Result<_, _>>()?;
        let figure = shown.draw(store, &branches, &diagram, &settings)?;
        drawn.add_unless_empty(&name, figure);
    }
    Ok(())
}

/// What there is to draw of branches, with the words that files have for it: where nothing is ever touched
/// neither contact forces nor impact velocities.
pub fn quantities(curves: &[ResponseCurve]) -> impl Iterator<Item = (&'static str, ResponseQuantity)> {
    let has = |value: fn(&ResponsePoint) -> f64| {
        curves.iter().flat_map(|curve| &curve.points).any(|point| value(point) > 0.0)
    };
    let (has_forces, has_impacts) =
        (has(|point| point.contact_force_n), has(|point| point.impact_velocity_m_s));
    FIGURES.into_iter().filter(move |(_, quantity)| match quantity {
        ResponseQuantity::ContactForce => has_forces,
        ResponseQuantity::ImpactVelocity => has_impacts,
        _ => true,
    })
}

pub fn settings(scale: FigureScale, detail: Option<(f64, f64)>, album: &impl Album) -> ResponseSettings {
    let choice = match scale {
        FigureScale::Automatic => ScaleChoice::Automatic,
        FigureScale::Linear => ScaleChoice::Linear,
        FigureScale::Logarithmic => ScaleChoice::Logarithmic,
    };
    ResponseSettings {
        style: album.wide(),
        displacement_scale: choice,
        acceleration_scale: choice,
        contact_scale: choice,
        detail,
    }
}

/// What the folders are called, that of the store first.
fn names_of(store: &Store, selection: &FigureSelection) -> Vec<String> {
    let further = selection.with.iter().map(PathBuf::as_path);
    names(&std::iter::once(store.folder()).chain(further).collect::<Vec<_>>())
}

/// The further folders.
fn overlaid(
    store: &Store,
    file: &StudyFile,
    selection: &FigureSelection,
) -> Result<Vec<Overlaid>, DrawingError> {
    let names = names_of(store, selection).into_iter().skip(1);
    let folders = selection.with.iter().zip(names);
    folders.map(|(folder, name)| Overlaid::open(folder, &name, &file.study)).collect()
}

fn diagram(
    store: &Store,
    [low, high]: [f64; 2],
    overlaid: &[Overlaid],
) -> Result<ResponseDiagram, StoreError> {
    let low = overlaid.iter().map(|other| other.range_hz[0]).fold(low, f64::min);
    let high = overlaid.iter().map(|other| other.range_hz[1]).fold(high, f64::max);
    Ok(ResponseDiagram {
        title: store.about("title")?,
        curves: curves(store)?,
        frequency_range_hz: Some((low, high)),
        chaotic_ranges_hz: chaotic_ranges(store)?,
        overlaid: overlaid.iter().map(|other| other.branches.clone()).collect(),
        ..ResponseDiagram::default()
    })
}
