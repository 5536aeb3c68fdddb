//! Orbits as records that are decoded one at a time; what a record is says `record.rs`.
//!
//! Displacement and velocity are smooth at their distance of samples. A contact may be much shorter: of
//! acceleration and forces the least and the largest value in each step from one sample to the next are
//! carried, in their order in time, so that no peak is lost. An impact on a rigid stop is an impulse and a
//! jump of the velocity.

mod coder;
mod record;

use std::collections::BTreeMap;

/// What orbits get at least, however much else there is (bytes).
pub(super) const LEAST_BYTES: usize = 2_000_000;

/// An orbit over its period, from phase 0 of the excitation on, the end of the period left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageOrbit {
    /// Its period (s).
    pub duration_s: f64,
    /// Displacement of the response point at equal steps (m).
    pub displacement_m: Vec<f64>,
    /// Its velocity at the same instants (m/s).
    pub velocity_m_s: Vec<f64>,
    /// What happens within contacts, which may be shorter than the distance of samples: number of the sample
    /// before it, displacement (m) and velocity (m/s).
    pub in_contacts: Vec<(usize, f64, f64)>,
    /// Impacts on rigid stops, in their order in time.
    pub impulses: Vec<PageImpulse>,
    /// Least and largest acceleration from each sample to the next, in their order in time (m/s²).
    pub acceleration_m_s2: Vec<[f64; 2]>,
    /// The same of the force of each local element (N).
    pub forces_n: Vec<Vec<[f64; 2]>>,
    /// Displacements of the supports that move (m), one after the other, at equal steps of their own over one
    /// excitation period.
    pub support_m: Vec<f64>,
    /// Coordinates (kg^1/2 m) of the modes that are drawn, at equal steps of their own over the period of the
    /// orbit.
    pub modes: Vec<Vec<f64>>,
    /// Amplitudes of the harmonics 1, 2, ... of the orbit frequency in the acceleration (m/s²).
    pub spectrum_m_s2: Vec<f64>,
}

/// An impact on a rigid stop.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PageImpulse {
    /// Number of the local element.
    pub element: usize,
    /// When it is, in excitation periods from phase 0 on.
    pub cycles: f64,
    /// Impulse along the relative displacement of the element (N s).
    pub impulse_n_s: f64,
    /// Displacement of the response point (m).
    pub displacement_m: f64,
    /// Its velocity before and after (m/s).
    pub velocity_m_s: [f64; 2],
}

/// An orbit, packed.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitRecord(Vec<u8>);

impl PageOrbit {
    /// The orbit as it is carried.
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
    /// Adds the orbit of a solution unless all of them would be longer than `most` bytes; says whether it
    /// did.
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

    /// All records, one after the other.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.records.values().flatten().copied().collect()
    }
}

#[cfg(test)]
mod tests;
