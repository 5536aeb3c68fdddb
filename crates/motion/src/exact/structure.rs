//! What the integrator computes with, the free structure or one that is held on rigid stops (`held.rs`), and
//! all that follows from its blocks.

use std::{collections::HashMap, sync::Arc};

use super::{
    ExactIntegrator, block::Blocks, collocation::Grading, drive::Drive, enclosure::InCommon, output::Output,
    series::Series, weights::StepWeights,
};

/// Matrices of steps beyond the reach of the series, by their active elements, grading and place on the grid
/// of lengths.
pub(super) type KeptWeights = HashMap<(Vec<usize>, Grading, i32), Arc<StepWeights>>;

/// A structure in its blocks.
#[derive(Debug, Clone)]
pub(super) struct Structure {
    pub blocks: Blocks,
    /// Relative displacements of the elements, the response, then the pressing forces of held elements.
    pub outputs: Vec<Output>,
    pub inputs: Vec<Vec<f64>>,
    pub series: Series,
    pub mobility: Vec<Vec<f64>>,
    pub rates: Vec<f64>,
    pub shares: Vec<Vec<f64>>,
    pub in_common: Vec<InCommon>,
    pub kept_weights: KeptWeights,
    pub drive: Drive,
}

impl Structure {
    /// * `inputs`: of the elements, which come first among the outputs.
    pub fn new(blocks: Blocks, outputs: Vec<Output>, inputs: Vec<Vec<f64>>, drive: Drive) -> Self {
        Self {
            series: Series::new(&blocks, &outputs, &inputs),
            mobility: mobility(&outputs, &inputs),
            rates: blocks.rates(),
            shares: shares(blocks.count(), &outputs, &inputs),
            in_common: outputs[..inputs.len()].iter().map(|o| InCommon::new(&blocks, o, &inputs)).collect(),
            kept_weights: HashMap::new(),
            blocks,
            outputs,
            inputs,
            drive,
        }
    }
}

impl ExactIntegrator {
    /// Computes with the other structure, and keeps the present one in its place.
    pub(super) fn exchange(&mut self, other: &mut Structure) {
        std::mem::swap(&mut self.blocks, &mut other.blocks);
        std::mem::swap(&mut self.outputs, &mut other.outputs);
        std::mem::swap(&mut self.inputs, &mut other.inputs);
        std::mem::swap(&mut self.series, &mut other.series);
        std::mem::swap(&mut self.mobility, &mut other.mobility);
        std::mem::swap(&mut self.rates, &mut other.rates);
        std::mem::swap(&mut self.shares, &mut other.shares);
        std::mem::swap(&mut self.in_common, &mut other.in_common);
        std::mem::swap(&mut self.kept_weights, &mut other.kept_weights);
        std::mem::swap(&mut self.drive, &mut other.drive);
    }
}

/// `C A B`: the rate of the rate of each output per force of each element, `[output][element]`.
fn mobility(outputs: &[Output], inputs: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(a, b)| a * b).sum::<f64>();
    outputs.iter().map(|o| inputs.iter().map(|b| dot(&o.velocity_row, b)).collect()).collect()
}

/// Part of each of n blocks in the mobility of each element, `[element][block]`.
fn shares(n: usize, outputs: &[Output], inputs: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let of_element = |(o, b): (&Output, &Vec<f64>)| {
        let part = |i: usize| (o.velocity_row[i] * b[i] + o.velocity_row[n + i] * b[n + i]).abs();
        let parts: Vec<f64> = (0..n).map(part).collect();
        let total: f64 = parts.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        parts.into_iter().map(|part| part / total).collect()
    };
    outputs.iter().zip(inputs).map(of_element).collect()
}
