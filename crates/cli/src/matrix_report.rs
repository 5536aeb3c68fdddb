//! What was found in matrices, as text.

use hammerbeam_jobs::counted;
use hammerbeam_structure::MatrixReport;
use hammerbeam_study::readable_to;

/// A box with less than this mass for its volume [kg/m^3] is reported: units may be mixed.
const LIGHT: f64 = 0.1;
/// The same for more.
const HEAVY: f64 = 3e4;

/// Strain of a translation that is more than rounding.
const STRAINED: f64 = 1e-6;
/// Digits of masses and places.
const DIGITS: usize = 7;
/// A coordinate below this part of the size of the structure is zero.
const ROUNDING: f64 = 1e-9;

/// The lines of `check` and `import`.
pub fn lines(report: &MatrixReport) -> Vec<String> {
    let mut lines = vec![format!(
        "rows         {} of the matrices, {} left, {} of them without mass",
        report.rows,
        counted(report.coordinates as u64, "coordinate"),
        report.massless
    )];
    let removed = [
        (report.joined, "shared with another component"),
        (report.empty_rows, "without entries"),
        (report.lagrange_rows, "of Lagrange multipliers"),
        (report.fixed_rows, "held"),
    ];
    let removed: Vec<String> = removed
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    if !removed.is_empty() {
        lines.push(format!("left out     {}", removed.join(", ")));
    }
    lines.push(format!(
        "rigid body   {} in {}, |K phi| / (|K| |phi|) at most {:.1e}",
        counted(report.rigid_modes as u64, "motion"),
        counted(report.parts as u64, "part"),
        report.rigid_residual
    ));
    lines.extend(without_place(report));
    lines.extend(strained(report));
    if let Some(mass) = report.mass {
        let [x, y, z] = mass.map(|mass| readable_to(mass, "kg", DIGITS));
        lines.push(format!("mass         {x} along x, {y} along y, {z} along z"));
    }
    if let Some([x, y, z]) = report.centre {
        // Of what is zero only rounding is left.
        let longest = report.extent.map_or(0.0, |extent| extent.iter().fold(0.0, |a, b| b.max(a)));
        let [x, y, z] = [x, y, z].map(|at| if at.abs() < ROUNDING * longest { 0.0 } else { at });
        let [x, y, z] = [x, y, z].map(|at| readable_to(at, "m", DIGITS));
        lines.push(format!("centre       {x}, {y}, {z}"));
    }
    lines.extend(doubtful_units(report));
    lines
}

/// What rows of nodes without a place do when the structure is displaced.
fn without_place(report: &MatrixReport) -> Option<String> {
    match (report.internal_rows, report.unplaced_rows) {
        (0, 0) => None,
        (0, moving) => {
            Some(format!("no place     {moving} rows of nodes that have none, and move as the others"))
        }
        (internal, _) => Some(format!(
            "no place     {internal} rows of nodes that have none, internal freedoms of elements: gravity \
            and the base do not move them"
        )),
    }
}

/// What is not known of a translation that strains the matrices.
fn strained(report: &MatrixReport) -> Option<String> {
    let strain = report.translation_strain.filter(|strain| *strain > STRAINED)?;
    match (report.mass, report.extent) {
        (None, _) => Some(format!(
            "mass         not known: displacing all rows labelled x, y and z strains the structure \
            ({strain:.1e}), so that some are internal freedoms of elements; give `nodes` with the places of \
            all nodes"
        )),
        (Some(_), None) => Some(format!(
            "translation  strains the matrices ({strain:.1e}): so does what holds them, and so do rows that \
            are internal freedoms of elements (CalculiX C3D8I); with `nodes` these are told apart"
        )),
        (Some(_), Some(_)) => None,
    }
}

/// A mass that no material gives to a body of that size.
pub fn doubtful_units(report: &MatrixReport) -> Option<String> {
    let (mass, extent) = (report.mass?, report.extent?);
    let longest = extent.iter().fold(0.0_f64, |longest, length| longest.max(*length));
    let density = mass.iter().fold(0.0_f64, |largest, mass| largest.max(*mass)) / longest.powi(3);
    let is_usual = (LIGHT..=HEAVY).contains(&density);
    (!is_usual && density.is_finite()).then(|| {
        format!(
            "units        the mass is {density:.1e} kg/m^3 of a cube as long as the structure: are mass, \
            stiffness and \
             lengths in kg, N/m and m? `mass_factor`, `stiffness_factor` and `length_factor` bring them there"
        )
    })
}
