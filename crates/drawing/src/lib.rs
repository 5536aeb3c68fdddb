//! Figures of a results folder, and the page that shows all of it.
//!
//! What is stored is read here and handed to the figure crate as plain rows. Orbits are computed again from
//! their stored states, as far as a figure shows their motion.
//!
//! | file | what it does |
//! |---|---|
//! | `selection.rs` | what of a folder is drawn, and in which formats |
//! | `drawn.rs` | files as they are drawn, on the threads of a pool |
//! | `linear.rs`, `structure.rs` | the structure, its modes, its reduction, its excitation |
//! | `varied.rs`, `multipliers.rs`, `motions.rs` | branches in other parameters, multipliers, motions |
//! | `parameter.rs` | parameters in words |
//! | [`orbit`] | one orbit over its period |
//! | `compare.rs` | measured points over branches |
//! | `page.rs`, `page/` | the page |
//!
//! # Example
//! ```no_run
//! use hammerbeam_drawing::{DrawSettings, DrawingError, FigureSelection, draw, draw_into};
//! use hammerbeam_jobs::{PreparedStudy, Quiet};
//! use hammerbeam_results::Store;
//!
//! let folder = std::path::Path::new("results");
//! let store = Store::open(folder)?;
//! let study = PreparedStudy::of_store(&store)?;
//! let selection = FigureSelection::of(&study.file);
//! let files = draw_into(folder, DrawSettings::default(), &mut Quiet, |drawn| {
//!     draw(&store, (&study.file, &study.model), &selection, drawn)
//! })?;
//! println!("{:?}", files.names);
//! # Ok::<(), DrawingError>(())
//! ```

mod compare;
mod drawn;
mod error;
mod linear;
mod motions;
mod multipliers;
pub mod orbit;
mod page;
mod parameter;
mod selection;
mod structure;
mod varied;

use hammerbeam_figure::{
    Bifurcation, BifurcationCurve, BifurcationCurvePoint, CurveDiagram, ResponseCurve, ResponseDiagram,
    ResponsePoint, ResponseQuantity, ResponseSettings, ScaleChoice,
};
use hammerbeam_orbit::{BranchEventKind, EventSet, Stability};
use hammerbeam_results::{
    Store, StoreError,
    row::Row,
    store::{PieceKind, PieceRecord},
};
use hammerbeam_structure::ModeTables;
use hammerbeam_study::{Model, StudyFile, file::CurveOf};

pub use compare::draw_compared;
pub use drawn::{Album, DrawSettings, Drawn, DrawnFiles, draw_into};
pub use error::DrawingError;
pub use selection::{FigureFormat, FigureKind, FigureScale, FigureSelection};

use parameter::{axis_label, file_name};

/// Resolution of the PNG files, in pixels per inch, where none is asked for.
pub const RESOLUTION: f64 = 300.0;

/// Quantities of response diagrams, with the words that files have for them.
const FIGURES: [(&str, ResponseQuantity); 4] = [
    ("displacement", ResponseQuantity::Displacement),
    ("acceleration", ResponseQuantity::Acceleration),
    ("force", ResponseQuantity::ContactForce),
    ("velocity", ResponseQuantity::ImpactVelocity),
];

/// Draws what is selected of a results folder, or some of it when the observer says stop.
///
/// The page comes first: it takes the longest, and while its file is put together the figures are drawn.
///
/// # Errors
/// [`DrawingError`].
pub fn draw(
    store: &Store,
    (file, model): (&StudyFile, &Model),
    selection: &FigureSelection,
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
    let (page, figures): (Vec<FigureKind>, Vec<FigureKind>) = FigureKind::ALL
        .into_iter()
        .filter(|kind| selection.kinds.contains(kind))
        .partition(|kind| *kind == FigureKind::Page);
    for kind in page.into_iter().chain(figures) {
        if drawn.is_stopped() {
            break;
        }
        let result = draw_kind(store, (file, model), (kind, selection), drawn);
        unless_damaged(result, &format!("{kind:?}").to_lowercase(), drawn)?;
    }
    Ok(())
}

/// Where a stored solution is missing or cannot be read, the figures that need it are named with the reason,
/// and the others are drawn.
fn unless_damaged<T>(
    result: Result<T, impl Into<DrawingError>>,
    name: &str,
    drawn: &mut Drawn<'_>,
) -> Result<Option<T>, DrawingError> {
    match result.map_err(Into::into) {
        Ok(found) => Ok(Some(found)),
        Err(error) if error.is_of_solutions() => {
            drawn.refuse(name, error.to_string());
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

fn draw_kind(
    store: &Store,
    (file, model): (&StudyFile, &Model),
    (kind, selection): (FigureKind, &FigureSelection),
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
    match kind {
        FigureKind::Structure => draw_linear(drawn, file, model),
        FigureKind::Response => draw_response(store, file, selection, drawn)?,
        FigureKind::Vary => varied::draw(store, selection.scale, drawn)?,
        FigureKind::Curves => draw_curves(store, drawn)?,
        FigureKind::Multipliers => multipliers::draw(store, drawn)?,
        FigureKind::Orbits => {
            let asked = (selection.orbits.as_slice(), selection.low_pass_hz);
            orbit::draw_stored(store.folder(), (file, model), asked, drawn)?;
        }
        FigureKind::Sweeps => motions::draw_sweeps(store, drawn)?,
        FigureKind::Exponents => {
            motions::draw_exponents(store, drawn)?;
            motions::draw_convergence(store, drawn)?;
            motions::draw_sections(store, drawn)?;
        }
        FigureKind::Basins => motions::draw_basins(store, (file, model), drawn)?,
        FigureKind::Page => page::draw(store, file, model, drawn)?,
    }
    Ok(())
}

/// Draws the structure, its modes, the error of its reduction if it is reduced, and its excitation.
pub fn draw_linear(drawn: &mut impl Album, file: &StudyFile, model: &Model) {
    let (study, tables): (_, &ModeTables) = (&file.study, &model.tables);
    drawn.add("structure", structure::sketch(study, drawn.frequency_unit()));
    drawn.add("modes", linear::modes(study, model, &drawn.narrow()));
    if !tables.frequency_errors.is_empty() {
        drawn.add_unless_empty("reduction", linear::reduction(&study.title, tables, &drawn.narrow()));
    }
    if let Some(excitation) = study.excitation.harmonic() {
        drawn.add("excitation", linear::excitation(&study.title, excitation, &drawn.narrow()));
    }
}

fn draw_response(
    store: &Store,
    file: &StudyFile,
    selection: &FigureSelection,
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
    let diagram = diagram(store, file.study.excitation.range_hz())?;
    if diagram.curves.is_empty() {
        return Ok(());
    }
    for (word, quantity) in quantities(&diagram.curves) {
        let settings =
            ResponseSettings { detail_hz: selection.detail_hz, ..settings(selection.scale, drawn) };
        drawn.add(&format!("response_{word}"), diagram.draw_with(&[quantity], &settings));
    }
    Ok(())
}

/// What there is to draw of branches, with the words that files have for it: where nothing is ever touched
/// neither contact forces nor impact velocities.
fn quantities(curves: &[ResponseCurve]) -> impl Iterator<Item = (&'static str, ResponseQuantity)> {
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

fn settings(scale: FigureScale, album: &impl Album) -> ResponseSettings {
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
        detail_hz: None,
    }
}

/// Draws the curves of bifurcations, one figure for each parameter that they are over.
fn draw_curves(store: &Store, drawn: &mut impl Album) -> Result<(), DrawingError> {
    let pieces: Vec<PieceRecord> =
        store.pieces()?.into_iter().filter(|piece| piece.kind.is_curve()).collect();
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
        drawn.add(&format!("curves_{}", file_name(parameter)), diagram.draw(&drawn.wide()));
    }
    Ok(())
}

fn curves_of(store: &Store, piece: &PieceRecord) -> Result<Vec<BifurcationCurve>, StoreError> {
    let mut curves = Vec::new();
    for branch in &piece.branches {
        let bifurcation = match piece.kind {
            PieceKind::Curve(CurveOf::Flip) => Bifurcation::Flip,
            PieceKind::Curve(CurveOf::NeimarkSacker) => Bifurcation::NeimarkSacker,
            PieceKind::Curve(CurveOf::Grazing) => Bifurcation::Grazing,
            PieceKind::Curve(CurveOf::Fold) | PieceKind::Vary => Bifurcation::Fold,
        };
        let mut points = Vec::new();
        store.each_row::<StoreError>(branch, |row| {
            points.push(BifurcationCurvePoint {
                parameter: row.parameter,
                frequency_hz: row.frequency_hz,
                name: codimension_two(row.events),
            });
            Ok(())
        })?;
        curves.push(BifurcationCurve { bifurcation, period_multiple: branch.period_multiple, points });
    }
    Ok(curves)
}

/// Names of the points of codimension two among the events of a row.
fn codimension_two(events: EventSet) -> String {
    let name = |kind: BranchEventKind| match kind {
        BranchEventKind::Cusp => Some("cusp"),
        BranchEventKind::FoldFlip => Some("fold–flip"),
        BranchEventKind::FoldNeimarkSacker => Some("fold–Neimark-Sacker"),
        BranchEventKind::FlipNeimarkSacker => Some("flip–Neimark-Sacker"),
        BranchEventKind::DoubleNeimarkSacker => Some("double Neimark-Sacker"),
        BranchEventKind::DegenerateFlip => Some("degenerate flip"),
        BranchEventKind::DegenerateBranchPoint => Some("degenerate branch point"),
        BranchEventKind::DegenerateNeimarkSacker => Some("degenerate Neimark-Sacker"),
        BranchEventKind::GrazingFold => Some("grazing–fold"),
        BranchEventKind::GrazingFlip => Some("grazing–flip"),
        BranchEventKind::GrazingNeimarkSacker => Some("grazing–Neimark-Sacker"),
        BranchEventKind::DoubleGrazing => Some("double grazing"),
        BranchEventKind::DegenerateGrazing => Some("degenerate grazing"),
        BranchEventKind::Resonance11 => Some("1:1"),
        BranchEventKind::Resonance12 => Some("1:2"),
        BranchEventKind::Resonance13 => Some("1:3"),
        BranchEventKind::Resonance14 => Some("1:4"),
        _ => None,
    };
    events.kinds().filter_map(name).collect::<Vec<_>>().join(", ")
}

fn diagram(store: &Store, [low, high]: [f64; 2]) -> Result<ResponseDiagram, StoreError> {
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
        parameter: String::new(),
        curves,
        frequency_range_hz: Some((low, high)),
        chaotic_ranges_hz: motions::chaotic_ranges(store)?,
        measured: Vec::new(),
    })
}

/// A row as a point of a response diagram, over what varies.
fn point(row: &Row) -> ResponsePoint {
    let has = |kind| row.events.has(kind);
    ResponsePoint {
        frequency_hz: row.parameter,
        displacement_m: row.maxima.displacement,
        acceleration_m_s2: row.maxima.acceleration,
        contact_force_n: row.maxima.contact_force,
        impact_velocity_m_s: row.maxima.impact_velocity,
        stable: row.stability.may_be_stable(),
        marginal: row.stability == Stability::Marginal,
        fold: has(BranchEventKind::Fold),
        grazing: has(BranchEventKind::Grazing),
        flip: has(BranchEventKind::Flip),
        neimark_sacker: has(BranchEventKind::NeimarkSacker),
        branch_point: has(BranchEventKind::BranchPoint),
    }
}
