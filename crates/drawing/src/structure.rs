//! The sketch of the structure of a study.

mod words;

pub use words::raised;

use hammerbeam_figure::{
    Figure, FigureError, FrequencyUnit, SketchBeam, SketchCarrier, SketchEnd, SketchLayout, SketchLink,
    SketchLumped, SketchMotion, SketchPoint, SketchStop, StopKind, StructureDiagram, Style,
};
use hammerbeam_motion::law::LawSymbol;
use hammerbeam_structure::Plane;
use hammerbeam_study::{
    Study,
    file::{
        Approach, BeamTable, EndSupport, FixedTo, LumpedTable, Place, Stop, StopRest, StopSide,
        StructureTable,
    },
};

/// Most masses that stand well in one column.
const NARROW: usize = 3;

/// The sketch.
pub fn sketch(study: &Study, unit: FrequencyUnit) -> Result<Figure, FigureError> {
    let (layout, style) = match &study.structure {
        StructureTable::Beam(beam) => (SketchLayout::Beam(sketched_beam(beam)), Style::single_column()),
        StructureTable::Lumped(lumped) => {
            let is_narrow = lumped.masses.len() <= NARROW;
            let style = if is_narrow { Style::single_column() } else { Style::double_column() };
            (SketchLayout::Lumped(sketched_masses(lumped)), style)
        }
        // Of matrices nothing is known but the points.
        StructureTable::Matrices(matrices) => {
            let masses = matrices.points.iter().map(|point| point.name.clone()).collect();
            let layout = SketchLumped { masses, links: Vec::new() };
            (SketchLayout::Lumped(layout), Style::double_column())
        }
    };
    let mut forces: Vec<String> = study.force_points().map(|name| place_name(study, name)).collect();
    forces.sort_unstable();
    forces.dedup();
    let diagram = StructureDiagram {
        title: study.title.clone(),
        layout,
        stops: study.stops.iter().map(|stop| sketched_stop(study, stop)).collect(),
        moving: moving(study),
        forces,
        words: words::of(study, unit),
    };
    diagram.draw(&style)
}

/// What a point is called in the sketch: a beam that bends in two planes is drawn in one.
fn place_name(study: &Study, name: &str) -> String {
    let in_two = matches!(&study.structure, StructureTable::Beam(beam) if !beam.planes.is_one());
    Plane::split(name).filter(|_| in_two).map_or(name, |(point, _)| point).to_owned()
}

/// The places that move, each with its support.
fn moving(study: &Study) -> Vec<SketchMotion> {
    let of_support = |(support, places): (usize, &[String])| -> Vec<SketchMotion> {
        let motion = |place: &String| SketchMotion { place: place_name(study, place), support };
        places.iter().map(motion).collect()
    };
    study.excitation.supports().into_iter().enumerate().flat_map(of_support).collect()
}

fn sketched_beam(beam: &BeamTable) -> SketchBeam {
    let point = |point: &hammerbeam_study::file::BeamPointTable| SketchPoint {
        name: point.name.clone(),
        at_m: point.at_m,
        has_mass: point.mass_kg > 0.0 || point.rotary_inertia_kg_m2 > 0.0,
        has_spring: point.spring_n_m > 0.0,
        has_damper: point.damper_n_s_m > 0.0,
        has_rotational: point.rotational_spring_n_m_rad > 0.0 || point.rotational_damper_n_m_s_rad > 0.0,
        support: end(point.support),
    };
    SketchBeam {
        length_m: beam.length_m,
        left: end(beam.left),
        right: end(beam.right),
        points: beam.points.iter().map(point).collect(),
    }
}

fn end(end: EndSupport) -> SketchEnd {
    match end {
        EndSupport::Clamped => SketchEnd::Clamped,
        EndSupport::Pinned => SketchEnd::Pinned,
        EndSupport::Sliding => SketchEnd::Sliding,
        EndSupport::Free => SketchEnd::Free,
    }
}

fn sketched_masses(lumped: &LumpedTable) -> SketchLumped {
    let number = |name: &String| lumped.masses.iter().position(|mass| mass.name == *name);
    let link = |between: &[String; 2], is_damper| SketchLink {
        between: [number(&between[0]), number(&between[1])],
        is_damper,
    };
    let springs = lumped.springs.iter().map(|spring| link(&spring.between, false));
    let dampers = lumped.dampers.iter().map(|damper| link(&damper.between, true));
    SketchLumped {
        masses: lumped.masses.iter().map(|mass| mass.name.clone()).collect(),
        links: springs.chain(dampers).collect(),
    }
}

fn sketched_stop(study: &Study, stop: &Stop) -> SketchStop {
    let (point, carrier) = match &stop.place {
        Place::At { point, fixed_to: FixedTo::Support(support) } => (point, SketchCarrier::Support(*support)),
        Place::At { point, fixed_to: FixedTo::Space } => (point, SketchCarrier::Space),
        Place::Around { first, fixed_to: [FixedTo::Support(support), _], .. } => {
            (first, SketchCarrier::Support(*support))
        }
        Place::Around { first, .. } => (first, SketchCarrier::Space),
        Place::Between { first, second } => (first, SketchCarrier::Point(place_name(study, second))),
    };
    let kind = match stop.law.description().symbol {
        // In the plane of the drawing it is one.
        _ if matches!(stop.law.rest(), StopRest::Around { .. }) => StopKind::TwoSided,
        LawSymbol::Sphere => StopKind::Sphere { loses: false },
        LawSymbol::LossySphere => StopKind::Sphere { loses: true },
        LawSymbol::Spring => StopKind::Spring,
        LawSymbol::Wall => StopKind::Rigid,
        LawSymbol::TwoSprings => StopKind::TwoSided,
        LawSymbol::ActiveSpring => StopKind::Always,
    };
    let (side, has_gap) = match stop.law.rest() {
        StopRest::OneSided { approach, side } => {
            (side, matches!(approach, Approach::Gap { gap_m, .. } if gap_m > 0.0))
        }
        StopRest::TwoSided { gap_above_m, gap_below_m, .. } => {
            (StopSide::Above, gap_above_m.max(gap_below_m) > 0.0)
        }
        StopRest::Around { .. } => (StopSide::Above, true),
        StopRest::Always => (StopSide::Below, false),
    };
    SketchStop { point: place_name(study, point), carrier, kind, above: side == StopSide::Above, has_gap }
}
