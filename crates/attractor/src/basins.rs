//! Basins of attraction over a grid of two coordinates of the initial state.
//!
//! From the middle of every cell the motion is followed until it repeats (`settle.rs`), or until it comes
//! near an attractor that is known: within [`NEAR`] of one of its states, and closer than a period of it
//! before. A motion that does not repeat is examined (`classify.rs`); it belongs to a known attractor without
//! a period if most of its further states lie among the states of that attractor, as close as these lie to
//! one another.
//!
//! **The same bits for any number of threads.** Cells are done in rounds whose sizes depend on the number of
//! cells done alone. Within a round every cell knows the attractors of the rounds before, and no other;
//! afterwards those that are new are numbered in the order of their cells. So a round can be computed on any
//! number of threads, and again after it was lost.
//!
//! **Fractions.** Of N cells a basin with k of them has the fraction `p = k/N`, with the standard error
//! `sqrt(p (1 - p)/N)` of a sample of N random states. A grid samples a basin with smooth borders better than
//! that.

use std::ops::Range;

use hammerbeam_motion::{System, exact::ExactSettings};

use crate::{
    AttractorError, Class, Classified, Effort, Estimate, Grid, InOrder, MotionDoubt, SectionMap, SystemMap,
    classify::periodic,
    examine,
    settle::{Patience, Settled, advance_period, distance, settle_unless},
};

/// Distance, relative to the motion, from a known periodic attractor at which a motion that comes closer
/// belongs to it.
const NEAR: f64 = 1e-4;
/// Distance of two periodic attractors up to which they are the same.
const SAME: f64 = 1e-5;
/// States of a motion without a period that are compared with the states of a known attractor.
const PROBES: u64 = 64;
/// Part of them that has to lie among the others.
const MOST: f64 = 0.5;
/// States of an attractor without a period whose distances from the others are taken.
const SAMPLED: usize = 100;
/// The golden section: its multiples are spread evenly over the states, and over every band of them.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Cells in a round.
const ROUND: usize = 256;
/// Cells at the start of a grid that each of several parts of it computes, so that it knows the attractors.
pub const SHARED_CELLS: usize = 256;

/// An attractor that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractor {
    /// What it is.
    pub class: Class,
    /// States at phase 0: all of a periodic one, many of another.
    pub states: Vec<Vec<f64>>,
    /// Largest exponent [1/s], if it was needed.
    pub largest_exponent: Option<Estimate>,
    /// K of the 0-1 test, if it was needed.
    pub zero_one: Option<f64>,
}

impl From<Classified> for Attractor {
    fn from(found: Classified) -> Self {
        let Classified { class, states, largest_exponent, zero_one } = found;
        Self { class, states, largest_exponent, zero_one }
    }
}

/// Where the motion from a cell leads.
enum Destination {
    /// To the attractor of that index.
    Known(usize),
    /// To one that was not known when its round started.
    New(Attractor),
    /// No motion starts at the state, or it cannot be computed, or it keeps a contact of an
    /// impact-speed-dependent law closed.
    Lost,
}

/// What one more round of cells has brought.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// The first cell of the round.
    pub first: usize,
    /// Number of the attractor of each of its cells, counted from 1; 0 where no motion starts or leads to an
    /// attractor: behind a rigid stop, within a contact of an impact-speed-dependent law, where a motion
    /// settles with such a contact closed, or cannot be computed.
    pub cells: Vec<u32>,
    /// Attractors that are new; the first one has the number `known + 1`.
    pub found: Vec<Attractor>,
}

/// Basins under way.
#[derive(Debug)]
pub struct Basins {
    system: System,
    frequency_hz: f64,
    motion: ExactSettings,
    effort: Effort,
    grid: Grid,
    attractors: Vec<Attractor>,
    done: usize,
}

impl Basins {
    /// Over a grid, at a frequency.
    ///
    /// # Errors
    /// [`AttractorError::Input`], [`AttractorError::StateLength`], or the damping has no block form.
    pub fn new(
        system: System,
        frequency_hz: f64,
        grid: Grid,
        effort: Effort,
        motion: ExactSettings,
    ) -> Result<Self, AttractorError> {
        grid.check(2 * system.dof())?;
        SystemMap::new(system.clone(), frequency_hz, 1, motion)?;
        Ok(Self { system, frequency_hz, motion, effort, grid, attractors: Vec::new(), done: 0 })
    }

    /// Takes up what was done before: whole rounds from the first cell on, and the attractors found in them.
    pub fn resume(&mut self, cells_done: usize, attractors: Vec<Attractor>) {
        self.done = cells_done;
        self.attractors = attractors;
    }

    /// Goes on at a later round, which starts at that cell: what a part of a grid leaves out.
    pub fn skip_to(&mut self, cell: usize) {
        self.done = cell;
    }

    /// Takes the next round as another process has computed it, knowing the same attractors.
    pub fn take(&mut self, round: &Round) {
        self.attractors.extend_from_slice(&round.found);
        self.done += round.cells.len();
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Attractors found so far, in the order of their numbers.
    #[must_use]
    pub fn attractors(&self) -> &[Attractor] {
        &self.attractors
    }

    /// Cells done.
    #[must_use]
    pub fn done(&self) -> usize {
        self.done
    }

    /// Does one more round.
    ///
    /// * `workers`: do its cells; the result does not depend on who does which.
    ///
    /// # Returns
    /// `None` if all cells are done, or if it was stopped: a round that was stopped leaves nothing.
    pub fn round(&mut self, workers: &mut impl InOrder) -> Option<Round> {
        let range = rounds_from(self.done, self.grid.cells()).next()?;
        let (first, size) = (range.start, range.len());
        let cells: Vec<usize> = range.collect();
        let make = || SystemMap::new(self.system.clone(), self.frequency_hz, 1, self.motion);
        let follow = |map: &mut Result<SystemMap, AttractorError>, cell: &usize| match map {
            Ok(map) => self.destination(map, *cell).unwrap_or(Destination::Lost),
            Err(_) => Destination::Lost,
        };
        let destinations = workers.in_order(&cells, &make, &follow)?;
        let known = self.attractors.len();
        let numbers = destinations.into_iter().map(|destination| self.number(destination)).collect();
        self.done += size;
        Some(Round { first, cells: numbers, found: self.attractors[known..].to_vec() })
    }

    /// Where the motion from a cell leads, given the attractors of earlier rounds.
    fn destination(&self, map: &mut SystemMap, cell: usize) -> Result<Destination, AttractorError> {
        let scales = map.scales();
        let mut patience = self.effort.patience;
        let mut state = self.grid.state(cell);
        map.check_in_front_of_stops(&state)?;
        loop {
            let mut arrived = None;
            let settled = settle_unless(map, 1, &state, patience, |states| {
                arrived = self.attractors.iter().position(|known| approaches(&scales, known, states));
                arrived.is_some()
            })?;
            if let Some(known) = arrived {
                return Ok(Destination::Known(known));
            }
            let end = match settled {
                Settled::Repeats(states) => return Ok(Destination::New(periodic(map, states)?.into())),
                Settled::Restless(end) => end,
            };
            let (probes, end) = probes(map, end)?;
            let among = |known: &Attractor| is_among(&scales, known, &probes);
            if let Some(known) = self.attractors.iter().position(among) {
                return Ok(Destination::Known(known));
            }
            let mut examined = examine(map, 1, &end, &self.effort)?;
            let unsettled = examined.class == Class::Doubtful(MotionDoubt::NotSettled);
            if !unsettled || patience.skipped == 0 {
                return Ok(Destination::New(examined.into()));
            }
            state = examined.states.pop().unwrap_or(end);
            patience = Patience { skipped: 0, ..patience };
        }
    }

    /// Number of a destination, counted from 1; an attractor that is new gets the next one.
    fn number(&mut self, destination: Destination) -> u32 {
        let index = match destination {
            Destination::Lost => return 0,
            Destination::Known(index) => index,
            Destination::New(found) => {
                let scales = crate::section::state_scales(&self.system, self.frequency_hz);
                let same = |known: &Attractor| is_same(&scales, known, &found);
                self.attractors.iter().position(same).unwrap_or_else(|| {
                    self.attractors.push(found);
                    self.attractors.len() - 1
                })
            }
        };
        index as u32 + 1
    }
}

/// The cells of each round of a grid with so many cells.
pub fn rounds(cells: usize) -> impl Iterator<Item = Range<usize>> {
    rounds_from(0, cells)
}

fn rounds_from(mut first: usize, cells: usize) -> impl Iterator<Item = Range<usize>> {
    std::iter::from_fn(move || {
        let range = first..first + first.clamp(1, ROUND).min(cells - first);
        first = range.end;
        (!range.is_empty()).then_some(range)
    })
}

/// Whether a motion comes near a periodic attractor, and closer than a period before.
fn approaches(scales: &[f64], known: &Attractor, states: &std::collections::VecDeque<Vec<f64>>) -> bool {
    let (Class::Periodic { period }, last) = (known.class, states.len() - 1) else { return false };
    if last < period {
        return false;
    }
    let near = known.states.iter().find(|state| distance(scales, state, &states[last]) < NEAR);
    near.is_some_and(|state| {
        let (now, before) =
            (distance(scales, state, &states[last]), distance(scales, state, &states[last - period]));
        now < before || now == 0.0
    })
}

/// The next states of a motion, and the last of them.
fn probes(map: &mut SystemMap, state: Vec<f64>) -> Result<(Vec<Vec<f64>>, Vec<f64>), AttractorError> {
    let mut states = vec![state];
    for k in 0..PROBES as usize {
        states.push(advance_period(map, 1, &states[k])?);
    }
    let end = states.pop().unwrap_or_default();
    Ok((states, end))
}

/// Whether most of these states lie among the states of an attractor without a period.
fn is_among(scales: &[f64], known: &Attractor, states: &[Vec<f64>]) -> bool {
    if matches!(known.class, Class::Periodic { .. }) || known.states.len() < 2 {
        return false;
    }
    let nearest = |state: &[f64], but: Option<usize>| {
        let others = known.states.iter().enumerate().filter(|(k, _)| Some(*k) != but);
        others.map(|(_, other)| distance(scales, other, state)).fold(f64::INFINITY, f64::min)
    };
    // How far the states of the attractor lie from one another: exceeded by one in twenty. Chaos may visit
    // bands in turn, which lie differently close: equal steps through the states would see some bands only.
    let count = known.states.len();
    let place = |i: usize| ((i as f64 * GOLDEN).fract() * count as f64) as usize;
    let mut own: Vec<f64> =
        (0..count.min(SAMPLED)).map(place).map(|k| nearest(&known.states[k], Some(k))).collect();
    own.sort_by(f64::total_cmp);
    let usual = own[own.len() * 19 / 20];
    let inside = states.iter().filter(|state| nearest(state, None) <= usual).count();
    inside as f64 >= MOST * states.len() as f64
}

fn is_same(scales: &[f64], known: &Attractor, found: &Attractor) -> bool {
    match (known.class, found.class) {
        (Class::Periodic { period }, Class::Periodic { period: other }) => {
            period == other
                && found.states.first().is_some_and(|first| {
                    known.states.iter().any(|state| distance(scales, state, first) < SAME)
                })
        }
        (Class::Periodic { .. }, _) | (_, Class::Periodic { .. }) => false,
        _ => {
            let most = found.states.len().min(PROBES as usize);
            is_among(scales, known, &found.states[..most])
        }
    }
}

/// Whether each cell of a grid begins behind a rigid stop, where no state of the structure is.
///
/// # Errors
/// [`AttractorError::Input`], [`AttractorError::StateLength`], or the damping has no block form.
pub fn behind_rigid_stops(
    system: &System,
    frequency_hz: f64,
    grid: &Grid,
) -> Result<Vec<bool>, AttractorError> {
    grid.check(2 * system.dof())?;
    let map = SystemMap::new(system.clone(), frequency_hz, 1, ExactSettings::default())?;
    Ok((0..grid.cells()).map(|cell| map.check_in_front_of_stops(&grid.state(cell)).is_err()).collect())
}

/// Part of the cells that lead to each attractor, with its standard error; index 0 is for motions that cannot
/// be computed.
#[must_use]
pub fn fractions(cells: &[u32], attractors: usize) -> Vec<Estimate> {
    let mut counts = vec![0_u64; attractors + 1];
    cells.iter().for_each(|&number| counts[number as usize] += 1);
    let total = cells.len().max(1) as f64;
    let of = |count: u64| {
        let value = count as f64 / total;
        Estimate { value, half_width: (value * (1.0 - value) / total).sqrt() }
    };
    counts.into_iter().map(of).collect()
}
