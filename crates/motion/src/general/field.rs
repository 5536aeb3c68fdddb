//! What can be integrated: a vector field, its linearisation, and where it switches.

/// A point of the extended phase space, in one smooth region of the field.
#[derive(Debug, Clone, Copy)]
pub struct Point<'a> {
    /// The independent variable.
    pub time: f64,
    /// `z`, of length [`VectorField::dimension`].
    pub state: &'a [f64],
    /// For each switching function whether it is taken as positive; fixed within a step.
    pub inside: &'a [bool],
}

/// What a column of an integration holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// `z`.
    State,
    /// Derivative of `z` by an entry of the initial state.
    ByState,
    /// Derivative of `z` by the parameter.
    ByParameter,
}

/// A vector field `dz/dt = g(t, z; p)`, smooth within regions bounded by zeros of switching functions `s_k(t,
/// z)`.
///
/// Across a boundary `g` should be continuous (its derivatives may jump), so that sensitivities are
/// continuous too; where it is not, [`VectorField::jump`] tells how they jump. Within a step the field is
/// evaluated in one region, [`Point::inside`], even where a stage of the method lies beyond its boundary:
/// there the field continues smoothly, if it can.
///
/// [`VectorField::evaluate`] is called first at every point; [`VectorField::tangents`] and
/// [`VectorField::add_by_parameter`] follow at the same point, and may rely on what was stored by it.
pub trait VectorField {
    /// Length of the state.
    fn dimension(&self) -> usize;

    /// Number of equal parts of the state, each measured against its own magnitude: 2 for `[q; q']`.
    fn parts(&self) -> usize {
        1
    }

    /// Raises the magnitudes against which the errors of a column are measured, one for each part, where they
    /// may be zero for a while: behind a boundary what was zero grows like a low power of time, which no step
    /// from its zero resolves.
    fn raise_magnitudes(&self, column: Column, magnitudes: &mut [f64]) {
        let _ = (column, magnitudes);
    }

    /// Writes `g(t, z; p)`.
    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]);

    /// Writes `dg/dz y` for each column `y`; the columns, of length `dimension`, follow one another, by the
    /// initial state and, last, by the parameter.
    fn tangents(&mut self, at: Point<'_>, columns: &[f64], derivatives: &mut [f64]);

    /// Adds `dg/dp` to `sum`; a field without a parameter adds nothing.
    ///
    /// * `derivative`: `g` at the point, as [`VectorField::evaluate`] wrote it.
    fn add_by_parameter(&mut self, at: Point<'_>, derivative: &[f64], sum: &mut [f64]) {
        let _ = (at, derivative, sum);
    }

    /// Readies the field, its state, its sensitivities and its region at the start of a motion.
    fn begin(&mut self, time: f64, state: &mut [f64], columns: &mut [f64], inside: &mut [bool]) {
        let _ = (time, state, columns, inside);
    }

    /// Lets the state jump where a boundary was crossed, and sensitivities with it; the field may throw the
    /// motion back into the region that was left. A field with a memory puts down here what it keeps.
    ///
    /// * `(state, columns)`: to be changed; columns as in [`VectorField::jump`], which is called next.
    /// * `(inside, before)`: the new region, to be changed, and the one that was left.
    fn impact(
        &mut self,
        time: f64,
        (state, columns): (&mut [f64], &mut [f64]),
        (inside, before): (&mut [bool], &[bool]),
    ) {
        let _ = (time, state, columns, inside, before);
    }

    /// Lets sensitivities jump where a boundary was crossed at which `g` is not continuous.
    ///
    /// * `at`: the place, with the new region; `before`: the region that was left.
    /// * `columns`: as in [`VectorField::tangents`], the one by the parameter last; to be changed. Empty
    ///   where no sensitivities are wanted.
    fn jump(&mut self, at: Point<'_>, before: &[bool], columns: &mut [f64]) {
        let _ = (at, before, columns);
    }

    /// Number of switching functions.
    fn switches(&self) -> usize {
        0
    }

    /// Writes the switching functions `s_k(t, z)`.
    fn switching(&self, time: f64, state: &[f64], values: &mut [f64]) {
        let _ = (time, state, values);
    }
}
