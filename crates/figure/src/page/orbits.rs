//! Orbits as records that are decoded individually; `record.rs` specifies the format.
//!
//! Displacement and velocity are smooth between samples. A contact may be much shorter: of acceleration and
//! forces the least and the largest value between successive samples are stored, in their order in time, so
//! that no peak is lost. An impact on a rigid stop is an impulse and a jump of the velocity.

mod coder;
mod content;
#[cfg(test)]
mod decoder;
mod record;

pub use content::{PageImpulse, PageOrbit};

use std::collections::BTreeMap;

/// Length that is reserved for orbits in any case (bytes).
pub(super) const LEAST_BYTES: usize = 1_000_000;

/// An orbit, packed.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitRecord(Vec<u8>);

impl PageOrbit {
    /// The orbit in its stored format.
    #[must_use]
    pub fn record(&self) -> OrbitRecord {
        OrbitRecord(record::packed(self))
    }
}

/// Orbits of some solutions, packed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitRecords {
    records: BTreeMap<u32, Vec<u8>>,
    length: usize,
}

impl OrbitRecords {
    /// Adds the orbit of a solution unless all of them would be longer than `most` bytes.
    ///
    /// # Returns
    /// Whether there was room.
    ///
    /// * `solution`: its number, counted from 0 over all branches end to end.
    pub fn insert(&mut self, solution: u32, record: OrbitRecord, most: usize) -> bool {
        let fits = self.length + record.0.len() <= most;
        if fits && !self.records.contains_key(&solution) {
            self.length += record.0.len();
            self.records.insert(solution, record.0);
        }
        fits
    }

    /// Number of orbits.
    #[must_use]
    pub fn count(&self) -> usize {
        self.records.len()
    }

    /// Solutions that have an orbit.
    pub(super) fn solutions(&self) -> Vec<u32> {
        self.records.keys().copied().collect()
    }

    /// Length of each record (bytes), in the order of the solutions.
    pub(super) fn lengths(&self) -> Vec<usize> {
        self.records.values().map(Vec::len).collect()
    }

    /// All records in sequence.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.records.values().flatten().copied().collect()
    }
}

#[cfg(test)]
mod tests;
