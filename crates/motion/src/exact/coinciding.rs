//! Elements that read one and the same displacement, as twenty stops at one mass.
//!
//! Their displacements are equal in every step, so that the equations of the step have one unknown for all of
//! them: with `R` for the displacements that differ and `F_R` for the sums of the forces there,
//! `R = R_free + W F_R(R)`. Twenty stops at one mass are then solved for as one; the matrices of the step are
//! still made for each pair of them.
//!
//! Beside holes and for laws that depend on the velocity all elements are taken apart.

use std::borrow::Cow;

use super::{collocation::NODES, output::Output};

/// Which active elements of a step have the same displacement.
#[derive(Debug, Clone, Default)]
pub(super) struct Coinciding {
    /// Of each active element which of the displacements that differ is its own.
    unknown: Vec<usize>,
    /// Of each displacement the first of the active elements that have it.
    first: Vec<usize>,
}

impl Coinciding {
    pub fn set(&mut self, active: &[usize], outputs: &[Output], inputs: &[Vec<f64>]) {
        self.unknown.clear();
        self.first.clear();
        for (a, &e) in active.iter().enumerate() {
            let coincides = |&first: &usize| {
                let f = active[first];
                outputs[e].row == outputs[f].row
                    && outputs[e].support_ratios == outputs[f].support_ratios
                    && inputs[e] == inputs[f]
            };
            let found = self.first.iter().position(coincides);
            self.unknown.push(found.unwrap_or(self.first.len()));
            if found.is_none() {
                self.first.push(a);
            }
        }
    }

    /// Takes all elements apart.
    pub fn part(&mut self, active: usize) {
        self.unknown.clear();
        self.unknown.extend(0..active);
        self.first.clone_from(&self.unknown);
    }

    /// Of each displacement the first of the active elements that have it.
    pub fn first(&self) -> &[usize] {
        &self.first
    }

    /// Of each active element the place of its displacement among [`Coinciding::first`].
    pub fn unknown(&self) -> &[usize] {
        &self.unknown
    }

    pub fn any(&self) -> bool {
        self.first.len() < self.unknown.len()
    }

    /// Sums over coinciding elements of values at the nodes, `[a * NODES + k]`.
    pub fn summed<'a>(&self, values: &'a [f64]) -> Cow<'a, [f64]> {
        if !self.any() {
            return Cow::Borrowed(values);
        }
        let mut sums = vec![0.0; self.first.len() * NODES];
        for (&unknown, nodes) in self.unknown.iter().zip(values.as_chunks::<NODES>().0) {
            let target = &mut sums[unknown * NODES..][..NODES];
            target.iter_mut().zip(nodes).for_each(|(sum, value)| *sum += value);
        }
        Cow::Owned(sums)
    }

    /// Keeps of rows at the nodes of all active elements those of displacements that differ, at the front.
    pub fn gather(&self, rows: &mut [f64], columns: usize) {
        let block = NODES * columns;
        for (unknown, &a) in self.first.iter().enumerate().filter(|(unknown, a)| unknown != *a) {
            rows.copy_within(a * block..(a + 1) * block, unknown * block);
        }
    }

    /// The reverse of [`Coinciding::gather`].
    pub fn spread(&self, rows: &mut [f64], columns: usize) {
        let block = NODES * columns;
        // From the last one on, for no block lies behind the elements that it belongs to.
        for (a, &unknown) in self.unknown.iter().enumerate().rev().filter(|(a, unknown)| a != *unknown) {
            rows.copy_within(unknown * block..(unknown + 1) * block, a * block);
        }
    }
}
