//! What a run needs of the numerics; the rest of this module knows no more of them than this.

use hammerbeam_orbit::{Crossing, Interruption, PeriodicSolution, Side};

use crate::walk::Walk;

/// Finds periodic solutions and follows their branches; shared by all threads.
pub trait Solver: Sync {
    /// A harmonic solution near which a branch can begin.
    ///
    /// * `interrupted`: asked now and then; the search ends with an error when it says true.
    ///
    /// # Errors
    /// Why there is none, in words.
    fn find_harmonic(
        &self,
        frequency_hz: f64,
        interrupted: Interruption<'_>,
    ) -> Result<PeriodicSolution, String>;

    /// Periodic solutions of these minimal periods that simulation leads to at a frequency, and harmonic ones
    /// that few trials find elsewhere in its part of the range.
    ///
    /// * `width_hz`: of the part, of which the frequency is the middle.
    /// * `interrupted`: asked now and then; the search ends with an error when it says true.
    ///
    /// # Errors
    /// Why nothing could be simulated, in words.
    fn survey(
        &self,
        frequency_hz: f64,
        width_hz: f64,
        multiples: &[u32],
        interrupted: Interruption<'_>,
    ) -> Result<Surveyed, String>;

    /// Frequencies at which the linear system suggests to look: near those at which the linear response
    /// reaches a contact, and resonances [Hz].
    fn resonances_hz(&self) -> Vec<f64>;

    /// Stable solutions of these minimal periods at a frequency that few motions lead to.
    ///
    /// * `interrupted`: asked now and then; the search ends with an error when it says true.
    ///
    /// # Errors
    /// Why nothing could be simulated, in words.
    fn probe(
        &self,
        frequency_hz: f64,
        multiples: &[u32],
        interrupted: Interruption<'_>,
    ) -> Result<Surveyed, String>;

    /// The solution at a crossing, as one of the branch that leaves there, if one does.
    ///
    /// # Errors
    /// Why there is none, in words.
    fn root(&self, crossing: &Crossing) -> Result<PeriodicSolution, String>;

    /// A walk along the branch from its start, or from the crossing where it leaves another branch.
    ///
    /// # Errors
    /// Why it cannot begin, in words.
    fn begin<'a>(&'a self, origin: &BranchOrigin, side: Side) -> Result<Box<dyn Walk + 'a>, String>;

    /// The walk that a checkpoint was taken of; it goes on as if it had never been left.
    ///
    /// * `journal`: everything [`Walk::take_journal`] gave, end to end.
    ///
    /// # Errors
    /// Why it cannot go on, in words.
    fn resume<'a>(&'a self, checkpoint: &[u8], journal: &[u8]) -> Result<Box<dyn Walk + 'a>, String>;

    /// For comparing a solution with others.
    ///
    /// # Errors
    /// Why that is not possible, in words.
    fn matcher<'a>(&'a self, solution: &'a PeriodicSolution) -> Result<Box<dyn OrbitMatcher + 'a>, String>;
}

/// What a survey has found.
#[derive(Debug, Clone, PartialEq)]
pub struct Surveyed {
    /// The solutions.
    pub solutions: Vec<PeriodicSolution>,
    /// Why not everything was looked at that was meant to be, in words.
    pub incomplete: Option<String>,
}

/// Where a walk begins.
#[derive(Debug, Clone, PartialEq)]
pub enum BranchOrigin {
    /// At a solution that was found.
    Found(PeriodicSolution),
    /// Where the branch leaves another one.
    Crossing(Crossing),
}

/// A solution that others are compared with, whatever the excitation period at which they begin.
pub trait OrbitMatcher {
    /// Distance of a state at a phase [cycles] from the solution, relative to it.
    fn distance(&self, state: (f64, &[f64])) -> f64;

    /// Whether the periodic solution near a guess, a state at a phase, at the same frequency, is this one.
    fn is_near(&self, guess: (f64, &[f64])) -> bool;
}
