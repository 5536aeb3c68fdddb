//! Coordinates of a grid of initial states, by their names.

use hammerbeam_study::Model;

/// Which of the two coordinates of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GridAxis {
    /// The first one.
    X,
    /// The second one.
    Y,
}

/// Why a grid has no coordinate.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "each message names its fields")]
#[non_exhaustive]
pub enum CoordinateError {
    /// The response point stands still in the first mode.
    #[error("the first mode does not move the response point; allowed: q1 to q{modes}, v1 to v{modes}")]
    PointNotMoved { axis: GridAxis, modes: usize },
    /// A state has no such coordinate.
    #[error("found the coordinate {name:?}; allowed: q1 to q{modes}, v1 to v{modes}, displacement, velocity")]
    Unknown { axis: GridAxis, name: String, modes: usize },
    /// Both are the same entry of the state, under one name or another.
    #[error("{x:?} and {y:?} are the same coordinate; two different ones are needed")]
    Same { x: String, y: String },
}

/// What one unit of a coordinate adds to the modal state.
///
/// * `axis`: which it is of a grid, for the message where there is no such coordinate.
///
/// # Errors
/// [`CoordinateError`].
pub fn direction(name: &str, axis: GridAxis, model: &Model) -> Result<Vec<f64>, CoordinateError> {
    let modes = model.system.dof();
    let mut direction = vec![0.0; 2 * modes];
    let first = model.response.shape[0];
    let of_point = matches!(name, "displacement" | "velocity");
    if of_point && first == 0.0 {
        return Err(CoordinateError::PointNotMoved { axis, modes });
    }
    let Some(index) = place(name, modes) else {
        return Err(CoordinateError::Unknown { axis, name: name.to_owned(), modes });
    };
    direction[index] = if of_point { 1.0 / first } else { 1.0 };
    Ok(direction)
}

/// Place of a coordinate in the modal state.
fn place(name: &str, n: usize) -> Option<usize> {
    match name {
        "displacement" => return Some(0),
        "velocity" => return Some(n),
        _ => {}
    }
    let (offset, number) = match name.split_at_checked(1)? {
        ("q", number) => (0, number),
        ("v", number) => (n, number),
        _ => return None,
    };
    let number = number.parse::<usize>().ok().filter(|number| (1..=n).contains(number))?;
    Some(offset + number - 1)
}
