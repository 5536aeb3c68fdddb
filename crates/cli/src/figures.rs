//! Figures of a results folder.

mod motions;
mod multipliers;
pub mod orbit;
mod page;

use std::{fs, path::Path};

use anyhow::Context;
use hammerbeam_figure::{
    Bifurcation, BifurcationCurve, CurveDiagram, CurvePoint, Figure, FigureError, Quantity, ResponseCurve,
    ResponseDiagram, ResponsePoint, ResponseSettings, ScaleChoice, Style,
};
use hammerbeam_study::{
    Model, Store, StoreError, StudyFile,
    store::{PieceRecord, Row},
};

use crate::args::{FigureKind, FigureScale};

/// Resolution of the PNG files, in pixels per inch.
const RESOLUTION: f64 = 300.0;

const FIGURES: [(&str, Quantity); 2] =
    [("response_displacement", Quantity::Displacement), ("response_acceleration", Quantity::Acceleration)];

/// Files as they are drawn, and what cannot be.
#[derive(Debug)]
pub struct Drawn<'a> {
    folder: &'a Path,
    /// Names of the files.
    pub files: Vec<String>,
    /// Names of figures that cannot be drawn, each with the reason.
    pub refused: Vec<(String, String)>,
}

impl<'a> Drawn<'a> {
    /// Into a folder, made if it is not there.
    pub fn into(folder: &'a Path) -> anyhow::Result<Self> {
        fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
        Ok(Self { folder, files: Vec::new(), refused: Vec::new() })
    }

    /// Writes a figure as SVG and PNG, or notes why there is none.
    pub fn add(&mut self, name: &str, figure: Result<Figure, FigureError>) -> anyhow::Result<()> {
        let figure = match figure {
            Ok(figure) => figure,
            Err(reason) => {
                self.refused.push((name.to_owned(), reason.to_string()));
                return Ok(());
            }
        };
        for (suffix, bytes) in [("svg", figure.svg().as_bytes().to_vec()), ("png", figure.png(RESOLUTION)?)] {
            let file = format!("{name}.{suffix}");
            replace(&self.folder.join(&file), &bytes)?;
            self.files.push(file);
        }
        Ok(())
    }

    /// Writes a file that is no figure.
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> anyhow::Result<()> {
        replace(&self.folder.join(name), bytes)?;
        self.files.push(name.to_owned());
        Ok(())
    }

    /// Says on standard error what could not be drawn.
    pub fn tell_refused(&self) {
        for (name, reason) in &self.refused {
            anstream::eprintln!("{name}: {reason}");
        }
    }
}

/// Draws the response diagrams and the curves of bifurcations into the results folder, each as SVG and PNG, and the page.
///
/// # Returns
/// Names of the files.
pub fn draw(store: &Store, file: &StudyFile, model: &Model) -> anyhow::Result<Vec<String>> {
    let mut drawn = Drawn::into(store.folder())?;
    draw_response(store, file.study.excitation.frequency_hz, FigureScale::Automatic, &mut drawn)?;
    draw_curves(store, &mut drawn)?;
    page::draw(store, file, model, &mut drawn)?;
    match drawn.refused.first() {
        Some((name, reason)) => anyhow::bail!("cannot draw {name}: {reason}"),
        None => Ok(drawn.files),
    }
}

/// Draws the figures of a kind.
pub fn draw_kind(
    store: &Store,
    file: &StudyFile,
    (kind, scale): (FigureKind, FigureScale),
    drawn: &mut Drawn<'_>,
) -> anyhow::Result<()> {
    match kind {
        FigureKind::Response if store.branches()?.is_empty() => Ok(()),
        FigureKind::Response => draw_response(store, file.study.excitation.frequency_hz, scale, drawn),
        FigureKind::Curves => draw_curves(store, drawn),
        FigureKind::Multipliers => multipliers::draw(store, drawn),
        FigureKind::Sweeps => motions::draw_sweeps(store, drawn),
        FigureKind::Exponents => motions::draw_exponents(store, drawn),
        FigureKind::Basins => motions::draw_basins(store, file, drawn),
        FigureKind::Page => page::draw(store, file, &Model::build(file)?, drawn),
    }
}

fn draw_response(
    store: &Store,
    range_hz: [f64; 2],
    scale: FigureScale,
    drawn: &mut Drawn<'_>,
) -> anyhow::Result<()> {
    let diagram = diagram(store, range_hz)?;
    let choice = match scale {
        FigureScale::Automatic => ScaleChoice::Automatic,
        FigureScale::Linear => ScaleChoice::Linear,
        FigureScale::Logarithmic => ScaleChoice::Logarithmic,
    };
    let settings = ResponseSettings {
        displacement_scale: choice,
        acceleration_scale: choice,
        ..ResponseSettings::default()
    };
    for (name, quantity) in FIGURES {
        drawn.add(name, diagram.draw_with(&[quantity], &settings))?;
    }
    Ok(())
}

/// Draws the curves of bifurcations, one figure for each parameter that they are over.
fn draw_curves(store: &Store, drawn: &mut Drawn<'_>) -> anyhow::Result<()> {
    let pieces: Vec<PieceRecord> = store.pieces()?.into_iter().filter(|piece| piece.is_curve).collect();
    let mut parameters: Vec<&str> = pieces.iter().map(|piece| piece.parameter.as_str()).collect();
    parameters.sort_unstable();
    parameters.dedup();
    for parameter in parameters {
        let mut curves = Vec::new();
        for piece in pieces.iter().filter(|piece| piece.parameter == parameter) {
            curves.extend(curves_of(store, piece)?);
        }
        if curves.iter().all(|curve| curve.points.is_empty()) {
            continue;
        }
        let diagram = CurveDiagram { title: store.about("title")?, parameter: axis_label(parameter), curves };
        let name = parameter.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
        drawn.add(&format!("curves_{name}"), diagram.draw(&Style::default()))?;
    }
    Ok(())
}

fn curves_of(store: &Store, piece: &PieceRecord) -> anyhow::Result<Vec<BifurcationCurve>> {
    let mut curves = Vec::new();
    for branch in &piece.branches {
        let bifurcation = match branch.kind.as_str() {
            "flip" => Bifurcation::Flip,
            "neimark-sacker" => Bifurcation::NeimarkSacker,
            "grazing" => Bifurcation::Grazing,
            _ => Bifurcation::Fold,
        };
        let mut points = Vec::new();
        store.each_varied_row::<StoreError>((piece.id, branch.branch), |row| {
            let name = codimension_two(&row.event);
            points.push(CurvePoint { parameter: row.parameter, frequency_hz: row.frequency_hz, name });
            Ok(())
        })?;
        curves.push(BifurcationCurve { bifurcation, period_multiple: branch.period_multiple, points });
    }
    Ok(curves)
}

/// Names of the points of codimension two among the events of a row.
fn codimension_two(events: &str) -> String {
    let name = |event: &str| match event {
        "cusp" => Some("cusp".to_owned()),
        "fold-flip" => Some("fold–flip".to_owned()),
        "grazing-fold" => Some("grazing–fold".to_owned()),
        "grazing-flip" => Some("grazing–flip".to_owned()),
        "degenerate-grazing" => Some("degenerate grazing".to_owned()),
        event => event.strip_prefix("resonance-").map(str::to_owned),
    };
    events.split('+').filter_map(name).collect::<Vec<String>>().join(", ")
}

/// A parameter in words, with its unit.
fn axis_label(parameter: &str) -> String {
    let (owner, key) = parameter.rsplit_once('.').unwrap_or(("", parameter));
    let stop = owner.strip_prefix("stop.").map_or(String::new(), |stop| format!(" of stop {stop}"));
    match key {
        "amplitude_m" => "Excitation amplitude (m)".to_owned(),
        "amplitude_n" => "Excitation amplitude (N)".to_owned(),
        "gap_m" => format!("Gap{stop} (m)"),
        "stiffness_n_m" => format!("Stiffness{stop} (N/m)"),
        "stiffness_n_m15" => format!("Stiffness{stop} (N/m^1.5)"),
        "stiffness_n_m3" => format!("Stiffness{stop} (N/m³)"),
        "modal_ratio" => "Modal damping ratio (–)".to_owned(),
        _ => parameter.to_owned(),
    }
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
    Ok(ResponseDiagram {
        title: store.about("title")?,
        curves,
        frequency_range_hz: Some((low, high)),
        chaotic_ranges_hz: motions::chaotic_ranges(store)?,
        measured: Vec::new(),
    })
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
pub(crate) fn replace(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    let unfinished = path.with_extension("part");
    fs::write(&unfinished, bytes)
        .and_then(|()| fs::rename(&unfinished, path))
        .with_context(|| format!("cannot write {}", path.display()))
}
