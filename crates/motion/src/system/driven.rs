//! Loads that a factor of the frequency multiplies, by the orders of the system.

use std::f64::consts::TAU;

use faer::c64;

use crate::FrequencyFactor;

/// Support motions and forces for each order, with the factor that all of them have.
#[derive(Debug, Clone)]
pub(super) struct DrivenLoad {
    pub supports: Vec<Vec<c64>>,
    pub forces: Vec<Vec<c64>>,
    pub factor: FrequencyFactor,
}

/// All of them.
#[derive(Debug, Clone, Default)]
pub(super) struct DrivenLoads(Vec<DrivenLoad>);

/// A load at a frequency: times the factor, and its derivative by the circular frequency times the slope.
pub(super) struct DrivenAt<'a> {
    pub load: &'a DrivenLoad,
    pub factor: f64,
    pub slope: f64,
}

impl DrivenLoads {
    pub fn push(&mut self, load: DrivenLoad) {
        self.0.push(load);
    }

    /// Puts supports and forces into the places of other orders.
    pub fn rearrange(&mut self, place: impl Fn(&[Vec<c64>]) -> Vec<Vec<c64>>) {
        for load in &mut self.0 {
            load.supports = place(&load.supports);
            load.forces = place(&load.forces);
        }
    }

    /// All of them at a circular frequency, under the scale of the excitation.
    pub fn at(&self, circular_frequency: f64, scale: f64) -> impl Iterator<Item = DrivenAt<'_>> {
        self.0.iter().map(move |load| {
            let (factor, slope) = load.factor.at(circular_frequency / TAU);
            DrivenAt { load, factor: scale * factor, slope: scale * slope / TAU }
        })
    }

    /// Every amplitude of the order with that index.
    pub fn amplitudes(&self, order_index: usize) -> impl Iterator<Item = &c64> {
        self.0.iter().flat_map(move |load| load.forces[order_index].iter().chain(&load.supports[order_index]))
    }
}
