//! The structure as a page draws it.

use hammerbeam_figure::{PageLink, PageMesh, PagePlace, PageStop, PageStructure};
use hammerbeam_motion::LocalElement;
use hammerbeam_structure::{MeshShape, Plane};
use hammerbeam_study::{
    Model, Study, StudyFile,
    file::{FixedTo, MatrixPointEntry, Place, PointPlaceEntry, StructureTable},
};

/// Places, stops and springs of a study.
pub fn structure(file: &StudyFile, model: &Model) -> PageStructure {
    let study = &file.study;
    let name_at = |at: f64| match &study.structure {
        StructureTable::Beam(beam) => beam
            .points
            .iter()
            .find(|point| (point.at_m - at).abs() <= 1e-9 * beam.length_m)
            .map(|point| &point.name),
        StructureTable::Lumped(lumped) => lumped.masses.get(at as usize).map(|mass| &mass.name),
        StructureTable::Matrices(matrices) => matrices.points.get(at as usize).map(|point| &point.name),
    };
    let shown = model.outline.iter().filter(|place| place.plane == Plane::Y);
    let places = shown.map(|place| PagePlace {
        name: name_at(place.at).cloned().unwrap_or_default(),
        at: place.at,
        shape: place.shape.clone(),
        support_ratios: place.support_ratios.clone(),
    });
    let links = match &study.structure {
        StructureTable::Beam(_) | StructureTable::Matrices(_) => Vec::new(),
        StructureTable::Lumped(lumped) => {
            let mass = |name: &String| lumped.masses.iter().position(|mass| mass.name == *name);
            let ends =
                |between: &[String; 2]| [&between[0], &between[1]].map(|name| mass(name).map(|at| at as u32));
            let springs = lumped.springs.iter().map(|spring| (&spring.between, false));
            let dampers = lumped.dampers.iter().map(|damper| (&damper.between, true));
            let link = |(between, is_damper)| PageLink { ends: ends(between), is_damper };
            springs.chain(dampers).map(link).collect()
        }
    };
    let frequencies = model.system.model().natural_frequencies.iter();
    PageStructure {
        is_beam: matches!(study.structure, StructureTable::Beam(_)),
        places: places.collect(),
        stops: stops(file, model),
        links,
        eigenfrequencies_hz: frequencies.map(|rate| rate / std::f64::consts::TAU).collect(),
        supports: study.excitation.supports().iter().map(|places| places.join(", ")).collect(),
        ground: study.excitation.support_at("ground").map(|support| support as u32),
        mesh: model.mesh.as_ref().map(|shape| mesh(study, shape)),
    }
}

/// The mesh with the nodes of the points of the study.
fn mesh(study: &Study, shape: &MeshShape) -> PageMesh {
    let node_of = |point: &MatrixPointEntry| match point.place {
        PointPlaceEntry::Node { node, .. } => {
            shape.nodes.iter().position(|known| known.number == i64::from(node)).map(|place| place as u32)
        }
        _ => None,
    };
    let places = match &study.structure {
        StructureTable::Matrices(matrices) => matrices.points.iter().map(node_of).collect(),
        _ => Vec::new(),
    };
    PageMesh {
        nodes: shape.nodes.iter().map(|node| node.place).collect(),
        shapes: shape.nodes.iter().map(|node| node.shape.clone()).collect(),
        support_ratios: shape.nodes.iter().map(|node| node.support_ratios.clone()).collect(),
        lines: shape.lines.clone(),
        places,
    }
}

/// Stops with at least one contact; a stop of two elements is two stops here.
fn stops(file: &StudyFile, model: &Model) -> Vec<PageStop> {
    let mut drawn = Vec::new();
    for (number, element) in model.system.elements().iter().enumerate() {
        let of = |name: &str| {
            element.name == name || element.name.strip_prefix(name).is_some_and(|rest| rest.starts_with(" ("))
        };
        if element.law.is_across_hole() {
            continue;
        }
        let Some(stop) = file.study.stops.iter().find(|stop| of(&stop.name)) else { continue };
        let (name, other, rides) = match &stop.place {
            Place::At { point, fixed_to } => (point, None, riding(*fixed_to)),
            Place::Around { first, fixed_to: [fixed_to, _], .. } => (first, None, riding(*fixed_to)),
            Place::Between { first, second } => (first, Some(second), None),
        };
        let Some(place) = place(file, model, name) else { continue };
        drawn.push(PageStop {
            name: element.name.clone(),
            element: number as u32,
            place,
            other: other.and_then(|other| self::place(file, model, other)),
            rides,
            levels: levels(element, model, name, other),
        });
    }
    drawn
}

fn riding(fixed_to: FixedTo) -> Option<u32> {
    match fixed_to {
        FixedTo::Support(support) => Some(support as u32),
        FixedTo::Space => None,
    }
}

/// Displacements of the point relative to what carries the stop at which contacts begin, and whether the stop
/// lies above.
fn levels(element: &LocalElement, model: &Model, name: &str, other: Option<&String>) -> Vec<(f64, bool)> {
    let shape =
        |name: &str| model.system.model().point(name).map(|point| point.shape.clone()).unwrap_or_default();
    let carrier = other.map(|other| shape(other.as_str())).unwrap_or_default();
    let along = |k: usize, own: f64| own - carrier.get(k).copied().unwrap_or(0.0);
    let relative = shape(name).into_iter().enumerate().map(|(k, own)| along(k, own));
    let sign = relative.zip(&element.shape).map(|(a, b)| a * b).sum::<f64>().signum();
    if let Some(hole) = element.law.round_hole() {
        return vec![(hole.clearance(), true), (-hole.clearance(), false)];
    }
    let contacts = element.law.contacts().iter();
    contacts.map(|contact| (sign * contact.level, sign * contact.sign > 0.0)).collect()
}

/// Number of the place of a point in the outline; none for the ground.
fn place(file: &StudyFile, model: &Model, name: &str) -> Option<u32> {
    let at = match (&file.study.structure, name) {
        (StructureTable::Lumped(lumped), _) => {
            lumped.masses.iter().position(|mass| mass.name == name)? as f64
        }
        (StructureTable::Matrices(matrices), _) => {
            matrices.points.iter().position(|point| point.name == name)? as f64
        }
        (StructureTable::Beam(beam), _) => beam.place_of(name)?,
    };
    let shown: Vec<f64> =
        model.outline.iter().filter(|place| place.plane == Plane::Y).map(|place| place.at).collect();
    let distance = |place: usize| (shown[place] - at).abs();
    (0..shown.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b))).map(|place| place as u32)
}
