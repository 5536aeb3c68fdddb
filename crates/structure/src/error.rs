//! What can be wrong with a structure or with the reduction asked for.

use crate::{
    MatrixPart,
    sparse::{MemoryNeed, in_gigabytes},
};

/// Why a description is no structure, or a structure cannot be reduced as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum StructureError {
    /// A number is infinite or not a number.
    #[error("{what} is {found}, must be finite")]
    NotFinite { what: String, found: f64 },
    /// A quantity that must be positive is not.
    #[error("{what} is {found}, must be greater than 0")]
    NotPositive { what: String, found: f64 },
    /// A quantity that must not be negative is.
    #[error("{what} is {found}, must be 0 or greater")]
    Negative { what: String, found: f64 },
    /// A point lies beyond the ends of the beam.
    #[error("point \"{name}\" is at {at} m, must be between 0 and {length} m")]
    PointOffBeam { name: String, at: f64, length: f64 },
    /// Two points are too close for an element between them, and too far apart to be one.
    #[error(
        "points \"{first}\" and \"{second}\" are {distance:e} m apart, must be 0 or at least {allowed:e} m"
    )]
    PointsTooClose { first: String, second: String, distance: f64, allowed: f64 },
    /// Each stretch between ends and points needs an element of its own.
    #[error("the beam has {found} elements, its points divide it into {needed} stretches and each needs one")]
    TooFewElements { found: usize, needed: usize },
    /// Dense matrices of this size take too long.
    #[error("the beam has {found} elements, at most {allowed} are allowed")]
    TooManyElements { found: usize, allowed: usize },
    /// A name is used twice.
    #[error("the name \"{name}\" is used twice")]
    DuplicateName { name: String },
    /// A name has a meaning of its own.
    #[error("the name \"{name}\" is reserved, choose another one")]
    ReservedName { name: String },
    /// A name is empty.
    #[error("a {what} has an empty name")]
    EmptyName { what: &'static str },
    /// No point of the structure has this name.
    #[error("{what} refers to \"{name}\", the structure has {}", known.join(", "))]
    UnknownPoint { what: String, name: String, known: Vec<String> },
    /// A spring or damper has both its ends at one place.
    #[error("{what} connects \"{name}\" to itself")]
    ConnectedToItself { what: String, name: String },
    /// A lumped structure without masses.
    #[error("the structure has no mass")]
    NoMass,
    /// Ends, supports and prescribed motion hold every coordinate.
    #[error("every coordinate is fixed or prescribed, nothing is left to vibrate")]
    NothingFree,
    /// A place is a point of two supports that move differently.
    #[error("two supports that move differently move one place, {}", names.join(", "))]
    MovedTwice { names: Vec<String> },
    /// A lumped structure is taken as it is.
    #[error("a lumped structure is not reduced, choose the reduction \"none\"")]
    LumpedIsNotReduced,
    /// The reduction would keep no elastic mode.
    #[error(
        "the cut-off frequency is {cut_off_hz} Hz, below the first elastic mode at {} Hz",
        six(*first_hz)
    )]
    CutOffBelowFirstMode { cut_off_hz: f64, first_hz: f64 },
    /// A damping ratio is missing or too much.
    #[error("{found} modal damping ratios are given, the structure has {modes} modes")]
    DampingRatioCount { found: usize, modes: usize },
    /// A constant load drives a motion that nothing holds back.
    #[error("a constant load has no static answer: rigid-body mode {mode} is not restrained")]
    RigidBodyModeNotRestrained { mode: usize },
    /// Masses so different that their matrix is not positive in floating point.
    #[error("the mass matrix of {size} coordinates is not positive definite")]
    MassNotPositive { size: usize },
    /// Matrices, factors and vectors do not fit into the memory that is allowed.
    #[error(
        "the modes of {size} coordinates take up to {need} of memory, allowed are {} GB",
        in_gigabytes(*limit_bytes)
    )]
    TooMuchMemory { size: usize, need: MemoryNeed, limit_bytes: u64 },
    /// Factors have more entries than their numbers can count.
    #[error("the factors of {size} coordinates have more than 2e9 entries, 17 GB")]
    TooManyEntries { size: usize },
    /// A larger structure has to say up to which frequency its modes are kept.
    #[error(
        "all modes of {found} coordinates are asked for, allowed are {allowed}; give a reduction with a \
        cut-off"
    )]
    TooManyCoordinates { found: usize, allowed: usize },
    /// So many modes are no reduction.
    #[error("{found} modes lie below the cut-off frequency, allowed are {allowed}; choose a lower one")]
    TooManyModes { found: usize, allowed: usize },
    /// The stiffness matrix has negative eigenvalues, by more than rounding.
    #[error(
        "the stiffness matrix is not positive semi-definite: {negative} modes grow faster than \
        {below_hz:.3} Hz \
         would oscillate"
    )]
    StiffnessNotPositive { negative: usize, below_hz: f64 },
    /// A motion that has neither mass nor stiffness.
    #[error("coordinate {coordinate} can move without mass and without stiffness: a mechanism")]
    Mechanism { coordinate: usize },
    /// The same with the row by its label.
    #[error("{row} can move without mass and without stiffness: a mechanism, or a row to be held")]
    MasslessMechanism { row: String },
    /// More motions without strain than rigid bodies have.
    #[error(
        "{found} motions bend nothing, but rigid bodies have {} (parts: {parts}): a mechanism that moves \
        {row}",
        6 * parts
    )]
    TooManyRigidModes { found: usize, parts: usize, row: String },
    /// A motion of one coordinate would have negative kinetic energy, or be driven by its damper.
    #[error("{matrix} on the diagonal of {row} is {found}, must be 0 or greater")]
    NegativeDiagonal { matrix: &'static str, row: String, found: f64 },
    /// The mass matrix has negative eigenvalues, by more than rounding.
    #[error("the mass matrix has {negative} negative eigenvalues, must have none")]
    MassNegative { negative: usize },
    /// Matrices of one structure must have the same rows.
    #[error("the {what} has {found} rows, the stiffness has {expected}")]
    RowCount { what: &'static str, found: usize, expected: usize },
    /// A row beyond the last one.
    #[error("{part} is at row {row}, there are {rows} rows")]
    NoSuchRow { part: MatrixPart, row: usize, rows: usize },
    /// Nodes that no row has.
    #[error("{part} is at nodes that no row has: {}", nodes.join(", "))]
    NoSuchNodes { part: MatrixPart, nodes: Vec<String> },
    /// A label that no row has.
    #[error("{part} is at {label}, which no row has")]
    NoSuchLabel { part: MatrixPart, label: String },
    /// A label that several rows have.
    #[error("{label} of {part} stands for several rows, {}; name the one by its row", counted(rows))]
    LabelTwice { part: MatrixPart, label: String, rows: Vec<usize> },
    /// A row that components share is several rows of one of them.
    #[error(
        "{label} of {part} stands for several rows, {}, and joins it to another component",
        counted(rows)
    )]
    JoinedTwice { part: MatrixPart, label: String, rows: Vec<usize> },
    /// Nodes and directions can only be found with labels.
    #[error(
        "{}it is not known which node and direction each row is; give `dofs`",
        part.as_ref().map_or(String::new(), |part| format!("{part} is at a node, but "))
    )]
    NoLabels { part: Option<MatrixPart> },
    /// Rows are not the displacements that their labels say.
    #[error(
        "nothing holds the matrices, and yet displacing all rows that are labelled x, y or z strains them \
        ({strain:.1e} of what the entries could give): some of these rows are no displacements of nodes, \
        such as internal freedoms of elements (CalculiX C3D8I); give `nodes` with the places of all nodes of \
        the mesh, and rows of others are left at rest"
    )]
    TranslationStrains { strain: f64 },
    /// A structure of matrices is no beam.
    #[error("the structure is given as matrices")]
    NotForMatrices,
    /// Two interface points move alike, whatever happens.
    #[error("points of the interface depend on one another, or do not move")]
    DependentInterface,
    /// Static condensation keeps what moves at the interface alone.
    #[error("Guyan's reduction needs a point with a stop or a force that can move, there is none")]
    NoInterface,
    /// Constraint modes need a structure that is held.
    #[error(
        "fixed-interface reduction needs a structure without rigid-body modes, this one has {rigid_modes}"
    )]
    NotHeld { rigid_modes: usize },
    /// The singular value iteration did not end.
    #[error("the eigenmodes of {size} coordinates did not converge")]
    ModesNotConverged { size: usize },
}

/// Six decimals, or as many digits of what would be rounded to next to nothing.
fn six(value: f64) -> String {
    if value.abs() < 1e-3 { format!("{value:.6e}") } else { format!("{value:.6}") }
}

fn counted(rows: &[usize]) -> String {
    rows.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// `value`, if finite and positive.
pub(crate) fn positive(what: &str, value: f64) -> Result<f64, StructureError> {
    match finite(what, value)? {
        found if found > 0.0 => Ok(found),
        found => Err(StructureError::NotPositive { what: what.into(), found }),
    }
}

/// `value`, if finite and not negative.
pub(crate) fn not_negative(what: &str, value: f64) -> Result<f64, StructureError> {
    match finite(what, value)? {
        found if found >= 0.0 => Ok(found),
        found => Err(StructureError::Negative { what: what.into(), found }),
    }
}

/// `value`, if finite.
pub(crate) fn finite(what: &str, value: f64) -> Result<f64, StructureError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(StructureError::NotFinite { what: what.into(), found: value })
    }
}
