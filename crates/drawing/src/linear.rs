//! Figures of the linear structure and of its excitation: mode shapes, the error of the reduction, the
//! amplitude over the frequency.

use std::f64::consts::TAU;

use hammerbeam_figure::{
    DrawnMode, ExcitationDiagram, Figure, FigureError, MeshMode, MeshModeDiagram, ModeDiagram, ReducedMode,
    ReductionDiagram, Style,
};
use hammerbeam_structure::{FrequencyError, MeshShape, ModeTables};
use hammerbeam_study::{
    Model, Study, StudyFile,
    file::{
        ActingForce, End, ExcitationKind, HarmonicExcitation, Place, Side, StopLaw, StopRest, Structure,
        SupportDrive,
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
        Structure::Beam(beam) => beam.points.iter().map(|point| (point.at_m, point.name.clone())).collect(),
        Structure::Lumped(lumped) => {
            (0u32..).zip(&lumped.masses).map(|(k, mass)| (f64::from(k), mass.name.clone())).collect()
        }
        Structure::Matrices(matrices) => {
            (0u32..).zip(&matrices.points).map(|(k, point)| (f64::from(k), point.name.clone())).collect()
        }
    };
    let stops = study.stops.iter().flat_map(|stop| {
        let name = match &stop.place {
            Place::At { point, .. } | Place::Between { first: point, .. } => point,
        };
        let place = at(name);
        sides(&stop.law).iter().filter_map(move |above| place.map(|place| (place, *above)))
    });
    let reduced = &model.tables.frequency_errors;
    let rates = model.system.model().natural_frequencies.iter();
    let mode = |(number, rate): (usize, &f64)| DrawnMode {
        frequency_hz: rate / TAU,
        unreduced_hz: (!model.tables.reduced_hz.is_empty())
            .then(|| reduced.get(number).map(|error| error.full_hz))
            .flatten(),
        shape: model
            .outline
            .iter()
            .map(|place| place.shape.get(number).copied().unwrap_or(f64::NAN))
            .collect(),
    };
    let diagram = ModeDiagram {
        title: study.title.clone(),
        is_beam: matches!(study.structure, Structure::Beam(_)),
        places: model.outline.iter().map(|place| place.at).collect(),
        ends: match &study.structure {
            Structure::Beam(beam) => [beam.left, beam.right].map(held),
            Structure::Lumped(_) | Structure::Matrices(_) => [(false, false); 2],
        },
        points,
        stops: stops.collect(),
        modes: rates.enumerate().map(mode).collect(),
    };
    diagram.draw(style)
}

/// Whether an end is held, and whether it cannot turn.
fn held(end: End) -> (bool, bool) {
    match end {
        End::Clamped => (true, true),
        End::Pinned => (true, false),
        End::Sliding => (false, true),
        End::Free => (false, false),
    }
}

/// The sides on which a stop stands; a spring that always acts is none.
fn sides(law: &StopLaw) -> &'static [bool] {
    match law.rest() {
        StopRest::OneSided { side: Side::Above, .. } => &[true],
        StopRest::OneSided { side: Side::Below, .. } => &[false],
        StopRest::TwoSided { .. } => &[true, false],
        StopRest::Always => &[],
    }
}

fn position(study: &Study, name: &str) -> Option<f64> {
    match (&study.structure, name) {
        (Structure::Lumped(lumped), _) => {
            lumped.masses.iter().position(|mass| mass.name == name).map(|k| k as f64)
        }
        (Structure::Matrices(matrices), _) => {
            matrices.points.iter().position(|point| point.name == name).map(|k| k as f64)
        }
        (Structure::Beam(_), "left") => Some(0.0),
        (Structure::Beam(beam), "right") => Some(beam.length_m),
        (Structure::Beam(beam), _) => {
            beam.points.iter().find(|point| point.name == name).map(|point| point.at_m)
        }
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
