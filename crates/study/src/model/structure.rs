//! The structure of a study in the terms of the structure crate.

use hammerbeam_structure as linear;
use linear::{Connection, LumpedMass, MatrixReport, ModalRatios, Reduced, StructureError, TwoPlanes};

use crate::file::{
    DampingTable, LumpedTable, MatricesTable, MatrixProblem, ModalRatio, Place, ReductionMethod,
    StructureTable, Study,
};

/// Why there is no reduced structure.
#[derive(Debug)]
pub(super) enum ReduceError {
    /// The structure, its supports or its reduction are wrong.
    Structure(StructureError),
    /// A file of matrices is.
    Files(MatrixProblem),
}

impl From<StructureError> for ReduceError {
    fn from(error: StructureError) -> Self {
        Self::Structure(error)
    }
}

/// Names of the points at which local or exciting forces act, each once.
pub(super) fn interface(study: &Study) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for stop in &study.stops {
        match &stop.place {
            Place::At { point, .. } => names.push(point.clone()),
            Place::Around { first, second, .. } | Place::Between { first, second } => {
                names.extend([first.clone(), second.clone()]);
            }
        }
    }
    names.extend(study.force_points().map(str::to_owned));
    let mut seen = std::collections::BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names
}

/// Assembles, supports and reduces the structure of a study.
pub(super) fn reduce(study: &Study, interface: &[String]) -> Result<Reduced, ReduceError> {
    reduce_and_report(study, interface).map(|(reduced, _)| reduced)
}

/// The same, with what is to be said of matrices.
pub(super) fn reduce_and_report(
    study: &Study,
    interface: &[String],
) -> Result<(Reduced, Option<MatrixReport>), ReduceError> {
    if let StructureTable::Matrices(matrices) = &study.structure {
        return reduce_matrices(study, matrices, interface);
    }
    let structure = linear_structure(study)?;
    let in_two_planes = matches!(&study.structure, StructureTable::Beam(beam) if !beam.planes.is_one());
    let supports = study.excitation.supports();
    let moving: Vec<Vec<&str>> =
        supports.into_iter().map(|places| places.iter().map(String::as_str).collect()).collect();
    let moving: Vec<&[&str]> = moving.iter().map(Vec::as_slice).collect();
    let interface: Vec<&str> = interface.iter().map(String::as_str).collect();
    let (reduction, damping) = (reduction(study), damping(&study.damping));
    if in_two_planes {
        let both = TwoPlanes::new(structure);
        return Ok((both.reduce(&moving, &reduction, &damping, &interface)?, None));
    }
    let supported = structure.with_support_motions(&moving)?;
    Ok((supported.reduce(&reduction, &damping, &interface)?, None))
}

/// The beam or the masses of a study; of a beam that bends in two planes, one of them.
///
/// # Errors
/// [`StructureError`], also of a study that has matrices.
pub(super) fn linear_structure(study: &Study) -> Result<linear::Structure, StructureError> {
    match &study.structure {
        StructureTable::Beam(beam) => beam.descriptor()?.structure(),
        StructureTable::Lumped(lumped) => lumped_descriptor(lumped).structure(),
        StructureTable::Matrices(_) => Err(StructureError::NotForMatrices),
    }
}

fn reduce_matrices(
    study: &Study,
    matrices: &MatricesTable,
    interface: &[String],
) -> Result<(Reduced, Option<MatrixReport>), ReduceError> {
    let linear = matrices.descriptor().map_err(ReduceError::Files)?;
    let groups: Vec<Vec<&str>> = study
        .excitation
        .supports()
        .into_iter()
        .map(|names| names.iter().map(String::as_str).collect())
        .collect();
    let groups: Vec<&[&str]> = groups.iter().map(Vec::as_slice).collect();
    let interface: Vec<&str> = interface.iter().map(String::as_str).collect();
    let (reduced, report) =
        linear.reduce(&groups, &reduction(study), &damping(&study.damping), &interface)?;
    Ok((reduced, Some(report)))
}

fn lumped_descriptor(lumped: &LumpedTable) -> linear::Lumped {
    let link = |between: &[String; 2], constant: f64| Connection { between: between.clone(), constant };
    linear::Lumped {
        masses: lumped
            .masses
            .iter()
            .map(|mass| LumpedMass { name: mass.name.clone(), mass: mass.mass_kg })
            .collect(),
        springs: lumped.springs.iter().map(|spring| link(&spring.between, spring.stiffness_n_m)).collect(),
        dampers: lumped.dampers.iter().map(|damper| link(&damper.between, damper.damping_n_s_m)).collect(),
    }
}

fn reduction(study: &Study) -> linear::Reduction {
    let cut_off_hz = study.reduction.cut_off_hz;
    match study.reduction.method {
        ReductionMethod::FreeInterface => linear::Reduction::FreeInterface { cut_off_hz },
        ReductionMethod::Truncation => linear::Reduction::Truncation { cut_off_hz },
        ReductionMethod::FixedInterface => linear::Reduction::FixedInterface { cut_off_hz },
        ReductionMethod::MacNeal => linear::Reduction::MacNeal { cut_off_hz },
        ReductionMethod::Guyan => linear::Reduction::Guyan { cut_off_hz },
        ReductionMethod::None | ReductionMethod::Given => linear::Reduction::None,
    }
}

fn damping(damping: &DampingTable) -> linear::Damping {
    match damping {
        DampingTable::Modal(ModalRatio::Every(ratio)) => linear::Damping::modal(*ratio),
        DampingTable::Modal(ModalRatio::Each(ratios)) => {
            linear::Damping { modal: ModalRatios::PerMode(ratios.clone()), ..linear::Damping::none() }
        }
        DampingTable::Rayleigh { mass_per_s, stiffness_s } => {
            linear::Damping::rayleigh(*mass_per_s, *stiffness_s)
        }
    }
}
