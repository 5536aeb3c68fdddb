//! Figures of the linear structure and of its excitation: mode shapes, the error of the reduction, the
//! amplitude over the frequency.

use std::f64::consts::TAU;

use hammerbeam_figure::{
    DrawnMode, ExcitationDiagram, Figure, FigureError, MeshMode, MeshModeDiagram, ModeDiagram, ReducedMode,
    ReductionDiagram, Style,
};
use hammerbeam_structure::{FrequencyError, MeshShape, ModeTables, OutlinePoint, Plane};
use hammerbeam_study::{
    Model, Study, StudyFile,
    file::{
        ActingForce, EndSupport, ExcitationKind, HarmonicExcitation, Place, StopLaw, StopRest, StopSide,
        StructureTable, SupportDrive,
    },
};

use crate::{Album, structure::sketch};

/// Rows of the amplitude over the frequency range.
const ROWS: u32 = 200;

/// Draws the structure, its modes, the error of its reduction if it is reduced, and its excitation.
pub fn draw_linear(drawn: &mut impl Album, file: &StudyFile, model: &Model) {
    let (study, tables) = (&file.study, &model.tables);
    drawn.add("structure", sketch(study, drawn.frequency_unit()));
    let shapes = match &model.mesh {
        Some(mesh) => mesh_modes(study, model, mesh, &drawn.narrow()),
        None => modes(study, model, &drawn.narrow()),
    };
    drawn.add("modes", shapes);
    if !tables.frequency_errors.is_empty() {
        drawn.add_unless_empty("reduction", reduction(&study.title, tables, &drawn.narrow()));
    }
    if let Some(harmonic) = study.excitation.harmonic() {
        drawn.add("excitation", excitation(&study.title, harmonic, &drawn.narrow()));
    }
}

/// The mode shapes of a mesh.
fn mesh_modes(study: &Study, model: &Model, mesh: &MeshShape, style: &Style) -> Result<Figure, FigureError> {
    let rates = model.system.model().natural_frequencies.iter();
    let mode = |(number, rate): (usize, &f64)| MeshMode {
        frequency_hz: rate / TAU,
        shape: mesh.nodes.iter().map(|node| [0, 1, 2].map(|axis: usize| node.shape[axis][number])).collect(),
    };
    let diagram = MeshModeDiagram {
        title: study.title.clone(),
        nodes: mesh.nodes.iter().map(|node| node.place).collect(),
        lines: mesh.lines.clone(),
        modes: rates.enumerate().map(mode).collect(),
    };
    diagram.draw(style)
}

/// The mode shapes.
fn modes(study: &Study, model: &Model, style: &Style) -> Result<Figure, FigureError> {
    let at = |name: &str| position(study, name);
    let points: Vec<(f64, String)> = match &study.structure {
        StructureTable::Beam(beam) => {
            beam.points.iter().map(|point| (point.at_m, point.name.clone())).collect()
        }
        StructureTable::Lumped(lumped) => {
            (0u32..).zip(&lumped.masses).map(|(k, mass)| (f64::from(k), mass.name.clone())).collect()
        }
        StructureTable::Matrices(matrices) => {
            (0u32..).zip(&matrices.points).map(|(k, point)| (f64::from(k), point.name.clone())).collect()
        }
    };
    let stops = study.stops.iter().flat_map(|stop| {
        let name = match &stop.place {
            Place::At { point, .. }
            | Place::Around { first: point, .. }
            | Place::Between { first: point, .. } => point,
        };
        let place = at(name);
        sides(&stop.law).iter().filter_map(move |above| place.map(|place| (place, *above)))
    });
    let reduced = &model.tables.frequency_errors;
    let rates = model.system.model().natural_frequencies.iter();
    let (places, shapes) = deflections(&model.outline);
    let mode = |(number, rate): (usize, &f64)| DrawnMode {
        frequency_hz: rate / TAU,
        unreduced_hz: (!model.tables.reduced_hz.is_empty())
            .then(|| reduced.get(number).map(|error| error.full_hz))
            .flatten(),
        shape: shapes.iter().map(|shape| shape.get(number).copied().unwrap_or(f64::NAN)).collect(),
    };
    let diagram = ModeDiagram {
        title: study.title.clone(),
        is_beam: matches!(study.structure, StructureTable::Beam(_)),
        places,
        ends: match &study.structure {
            StructureTable::Beam(beam) => [beam.left, beam.right].map(held),
            StructureTable::Lumped(_) | StructureTable::Matrices(_) => [(false, false); 2],
        },
        points,
        stops: stops.collect(),
        modes: rates.enumerate().map(mode).collect(),
    };
    diagram.draw(style)
}

/// The places of an outline, and the deflection of each in every mode: of two planes that in which the mode
/// lies.
fn deflections(outline: &[OutlinePoint]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (first, second): (Vec<_>, Vec<_>) = outline.iter().partition(|place| place.plane == Plane::Y);
    let sum = |(index, place): (usize, &&OutlinePoint)| {
        let across = second.get(index).map_or(&[][..], |place| place.shape.as_slice());
        let own = place.shape.iter().enumerate();
        own.map(|(mode, own)| own + across.get(mode).copied().unwrap_or(0.0)).collect()
    };
    (first.iter().map(|place| place.at).collect(), first.iter().enumerate().map(sum).collect())
}

/// Whether an end is held, and whether it cannot turn.
fn held(end: EndSupport) -> (bool, bool) {
    match end {
        EndSupport::Clamped => (true, true),
        EndSupport::Pinned => (true, false),
        EndSupport::Sliding => (false, true),
        EndSupport::Free => (false, false),
    }
}

/// The sides on which a stop stands; a spring that always acts is none.
fn sides(law: &StopLaw) -> &'static [bool] {
    match law.rest() {
        StopRest::OneSided { side: StopSide::Above, .. } => &[true],
        StopRest::OneSided { side: StopSide::Below, .. } => &[false],
        StopRest::TwoSided { .. } | StopRest::Around { .. } => &[true, false],
        StopRest::Always => &[],
    }
}

fn position(study: &Study, name: &str) -> Option<f64> {
    match (&study.structure, name) {
        (StructureTable::Lumped(lumped), _) => {
            lumped.masses.iter().position(|mass| mass.name == name).map(|k| k as f64)
        }
        (StructureTable::Matrices(matrices), _) => {
            matrices.points.iter().position(|point| point.name == name).map(|k| k as f64)
        }
        (StructureTable::Beam(beam), _) => beam.place_of(name),
    }
}

/// The error of the reduction.
fn reduction(title: &str, tables: &ModeTables, style: &Style) -> Result<Figure, FigureError> {
    let mode = |error: &FrequencyError| ReducedMode {
        full_hz: error.full_hz,
        relative_error: error.relative,
        below_cut_off: error.below_cut_off,
    };
    let modes = tables.frequency_errors.iter().map(mode).collect();
    ReductionDiagram { title: title.to_owned(), modes }.draw(style)
}

/// The amplitude of the excitation: of the acceleration of supports, `A (2 pi m f)^2`, or of a force.
fn excitation(title: &str, excitation: &HarmonicExcitation, style: &Style) -> Result<Figure, FigureError> {
    let [low, high] = excitation.frequency_hz;
    let frequency = |k: u32| low + (high - low) * f64::from(k) / f64::from(ROWS);
    let frequencies: Vec<f64> = (0..=ROWS).map(frequency).collect();
    let rate = |frequency_hz: f64| (TAU * f64::from(excitation.order) * frequency_hz).powi(2);
    let mut names = Vec::new();
    let mut curves: Vec<Vec<f64>> = match &excitation.kind {
        ExcitationKind::SupportMotion { amplitude_m, .. } => {
            vec![frequencies.iter().map(|f| amplitude_m.at(*f) * rate(*f)).collect()]
        }
        ExcitationKind::SupportAcceleration { amplitude_m_s2, .. } => {
            vec![frequencies.iter().map(|f| amplitude_m_s2.at(*f)).collect()]
        }
        ExcitationKind::Forces { forces } => {
            if forces.len() > 1 {
                names.extend(forces.iter().map(|force| force.place.points().join("–")));
            }
            let of = |force: &ActingForce| {
                frequencies.iter().map(|f| force.size.at(excitation.order, *f)).collect()
            };
            forces.iter().map(of).collect()
        }
        ExcitationKind::SupportMotions { supports } => {
            names.extend(supports.iter().map(|support| support.at.join(", ")));
            let of = |drive: &SupportDrive| match drive {
                SupportDrive::Displacement(amplitude) => {
                    frequencies.iter().map(|f| amplitude.at(*f) * rate(*f)).collect()
                }
                SupportDrive::Acceleration(amplitude) => {
                    frequencies.iter().map(|f| amplitude.at(*f)).collect()
                }
            };
            supports.iter().map(|support| of(&support.drive)).collect()
        }
        ExcitationKind::Force { amplitude_n, .. } => {
            vec![frequencies.iter().map(|f| amplitude_n.at(*f)).collect()]
        }
    };
    let quantity = match excitation.kind {
        ExcitationKind::SupportMotion { .. } | ExcitationKind::SupportAcceleration { .. } => {
            "Acceleration of the support (m/s²)"
        }
        ExcitationKind::Forces { .. } => "Amplitudes of the forces (N)",
        ExcitationKind::SupportMotions { .. } => "Acceleration of the supports (m/s²)",
        ExcitationKind::Force { .. } => "Amplitude of the force (N)",
    };
    let further = curves.split_off(1);
    let first = curves.pop().unwrap_or_default();
    let diagram = ExcitationDiagram {
        title: title.to_owned(),
        quantity: quantity.to_owned(),
        rows: frequencies.into_iter().zip(first).collect(),
        further,
        names,
        measured: Vec::new(),
    };
    diagram.draw(style)
}
