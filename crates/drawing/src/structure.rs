//! The sketch of the structure of a study.

mod words;

use hammerbeam_figure::{
    Figure, FigureError, FrequencyUnit, SketchBeam, SketchCarrier, SketchEnd, SketchLayout, SketchLink,
    SketchLumped, SketchMotion, SketchPoint, SketchStop, StopKind, StructureDiagram, Style,
};
use hammerbeam_motion::law::LawSymbol;
use hammerbeam_study::{
    Study,
    file::{Approach, Beam, End, FixedTo, Lumped, Place, Side, Stop, StopRest, Structure},
};

/// Most masses that stand well in one column.
const NARROW: usize = 3;

/// The sketch.
pub fn sketch(study: &Study, unit: FrequencyUnit) -> Result<Figure, FigureError> {
    let (layout, style) = match &study.structure {
        Structure::Beam(beam) => (SketchLayout::Beam(sketched_beam(beam)), Style::single_column()),
        Structure::Lumped(lumped) => {
            let is_narrow = lumped.masses.len() <= NARROW;
            let style = if is_narrow { Style::single_column() } else { Style::double_column() };
            (SketchLayout::Lumped(sketched_masses(lumped)), style)
        }
        // Of matrices nothing is known but the points.
        Structure::Matrices(matrices) => {
            let masses = matrices.points.iter().map(|point| point.name.clone()).collect();
            let layout = SketchLumped { masses, links: Vec::new() };
            (SketchLayout::Lumped(layout), Style::double_column())
        }
    };
    let mut forces: Vec<String> = study.force_points().map(str::to_owned).collect();
    forces.sort_unstable();
    forces.dedup();
    let diagram = StructureDiagram {
        title: study.title.clone(),
        layout,
        stops: study.stops.iter().map(sketched_stop).collect(),
        moving: moving(study),
        forces,
        words: words::of(study, unit),
    };
    diagram.draw(&style)
}

/// The places that move, each with its support.
fn moving(study: &Study) -> Vec<SketchMotion> {
    let of_support = |(support, places): (usize, &[String])| -> Vec<SketchMotion> {
        places.iter().map(|place| SketchMotion { place: place.clone(), support }).collect()
    };
    study.excitation.supports().into_iter().enumerate().flat_map(of_support).collect()
}

fn sketched_beam(beam: &Beam) -> SketchBeam {
    let point = |point: &hammerbeam_study::file::BeamPoint| SketchPoint {
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

fn end(end: End) -> SketchEnd {
    match end {
        End::Clamped => SketchEnd::Clamped,
        End::Pinned => SketchEnd::Pinned,
        End::Sliding => SketchEnd::Sliding,
        End::Free => SketchEnd::Free,
    }
}

fn sketched_masses(lumped: &Lumped) -> SketchLumped {
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

fn sketched_stop(stop: &Stop) -> SketchStop {
    let (point, carrier) = match &stop.place {
        Place::At { point, fixed_to: FixedTo::Support(support) } => (point, SketchCarrier::Support(*support)),
        Place::At { point, fixed_to: FixedTo::Space } => (point, SketchCarrier::Space),
        Place::Between { first, second } => (first, SketchCarrier::Point(second.clone())),
    };
    let kind = match stop.law.description().symbol {
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
            (Side::Above, gap_above_m.max(gap_below_m) > 0.0)
        }
        StopRest::Always => (Side::Below, false),
    };
    SketchStop { point: point.clone(), carrier, kind, above: side == Side::Above, has_gap }
}
