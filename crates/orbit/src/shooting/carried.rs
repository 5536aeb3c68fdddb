//! Nodes with their parts of a tangent, carried along the motion: `t' = dZ/dz t + dZ/df t_f`.

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, MotionError},
};

use crate::ContinuationParameter;

/// A node and its part of a tangent, scaled.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NodeSlope {
    pub node: Vec<f64>,
    pub slope: Vec<f64>,
}

/// A node at the end of a stretch.
#[derive(Debug)]
pub(super) struct Carried {
    pub at: NodeSlope,
    /// Fundamental matrix over the stretch, by rows, scaled.
    pub matrix: Vec<f64>,
}

/// In which units nodes are measured, what varies, and the tangent there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Along<'a> {
    pub scales: &'a [f64],
    pub varied: ContinuationParameter,
    /// Entry of the tangent that belongs to the last unknown.
    pub last_slope: f64,
}

impl NodeSlope {
    /// At the end of a stretch that begins at the node.
    ///
    /// # Errors
    /// [`MotionError`] where the motion cannot be computed.
    pub(super) fn flown(
        &self,
        integrator: &mut ExactIntegrator,
        stretch: &Stretch,
        along: Along<'_>,
    ) -> Result<Carried, MotionError> {
        let Along { scales, varied, last_slope } = along;
        let state: Vec<f64> = self.node.iter().zip(scales).map(|(x, s)| x * s).collect();
        let flow = integrator.flow(stretch, &state)?;
        let by_last = varied.column_of(&flow);
        let (mut node, mut slope, mut matrix) = (Vec::new(), Vec::new(), Vec::new());
        for (i, scale) in scales.iter().enumerate() {
            let row = matrix.len();
            matrix.extend(scales.iter().enumerate().map(|(j, s)| flow.by_state[(i, j)] / scale * s));
            let carried: f64 = matrix[row..].iter().zip(&self.slope).map(|(entry, t)| entry * t).sum();
            node.push(flow.state[i] / scale);
            slope.push(carried + by_last[i] / scale * last_slope);
        }
        Ok(Carried { at: Self { node, slope }, matrix })
    }
}
