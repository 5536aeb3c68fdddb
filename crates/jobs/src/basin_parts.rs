//! Basins by parts: rounds of cells that several processes compute, and the whole put together from them.
//!
//! What a round gives depends on the attractors that are known before it. So every part first computes the
//! first [`SHARED_CELLS`](hammerbeam_attractor::SHARED_CELLS) cells, which find nearly all of them, and then
//! rounds of its own. Of a part the whole takes a round if the attractors known then are, bit for bit, those
//! that it knows itself. After an attractor that only a later cell has found they are not, and the whole
//! computes rounds again: it is always what one process computes.

use std::{collections::BTreeMap, ops::Range, path::PathBuf};

use hammerbeam_attractor::{Attractor, Basins, Round, SHARED_CELLS, rounds};
use hammerbeam_results::{
    Store, StoreError,
    store::{RequestKind, RequestRecord},
};
use hammerbeam_study::StudyFile;

use crate::part::{JobPart, read_parts};

/// The rounds of a part: those that all parts compute, then its own.
pub(crate) fn part_rounds(cells: usize, part: JobPart) -> Vec<Range<usize>> {
    let (shared, further): (Vec<_>, Vec<_>) = rounds(cells).partition(|range| range.start < SHARED_CELLS);
    let own = part.range(further.len());
    shared.into_iter().chain(further[own].iter().cloned()).collect()
}

/// What parts have computed of basins.
#[derive(Debug, Default)]
pub(crate) struct BasinParts {
    /// Of each part the attractors in the order in which it found them.
    attractors: Vec<Vec<Attractor>>,
    /// Rounds by their first cells: the part, and how many attractors it knew before.
    rounds: BTreeMap<usize, (usize, usize, Round)>,
}

impl BasinParts {
    pub fn read(
        folders: &[PathBuf],
        file: &StudyFile,
        (words, cells): (&[String], usize),
    ) -> Result<Self, StoreError> {
        let read = |store: &Store, request: &RequestRecord, part: JobPart| {
            Ok((part_rounds(cells, part), store.basins(request.id)?))
        };
        let mut parts = Self::default();
        for (order, (cells, attractors)) in read_parts(folders, file, (RequestKind::Basins, words), read)? {
            parts.add(&order, &cells, attractors);
        }
        Ok(parts)
    }

    fn add(&mut self, order: &[Range<usize>], mut cells: &[u32], attractors: Vec<Attractor>) {
        let mut known = 0;
        for range in order {
            let Some((of_round, rest)) = cells.split_at_checked(range.len()) else { break };
            cells = rest;
            // An attractor that is new has the next number, in the cell that found it.
            let after = of_round.iter().fold(known, |most, &number| most.max(number as usize));
            let found = attractors[known..after].to_vec();
            let round = Round { first: range.start, cells: of_round.to_vec(), found };
            self.rounds.entry(range.start).or_insert((self.attractors.len(), known, round));
            known = after;
        }
        self.attractors.push(attractors);
    }

    /// The next round, if a part computed it knowing the same attractors.
    pub fn round(&self, basins: &Basins) -> Option<&Round> {
        let (part, known, round) = self.rounds.get(&basins.done())?;
        (self.attractors[*part][..*known] == *basins.attractors()).then_some(round)
    }

    /// Whether there is a part that computed the next round, whatever it knew.
    pub fn has_round(&self, basins: &Basins) -> bool {
        self.rounds.contains_key(&basins.done())
    }
}
