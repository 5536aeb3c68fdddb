//! Mean logarithmic distance of neighbours over time: Rosenstein's and Kantz's methods.

use super::{
    embedding::Embedding,
    scatter::{ExponentEstimate, GROUPS, LEAST_FLOW_PERIOD, standard_error},
    slope::{growth, rises, slope, steepest_period, straight_part},
    states::DelayStates,
    tree::NeighbourTree,
};
use crate::error::{SignalError, ensure};

/// Largest number of states whose neighbours are followed; of more, every n-th is used.
const STATES: usize = 5000;
/// Minimum number of neighbours of a state for Kantz's method, and the fraction of states that must have
/// them.
const NEIGHBOURS: usize = 5;
const ENOUGH: f64 = 0.8;
/// Minimum number of states with neighbours.
const MIN_STATES: usize = 50;

/// Which part of the curve is fitted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum StraightPart {
    /// Found automatically, between two fractions of the rise.
    #[default]
    Found,
    /// From one step to another.
    Given(usize, usize),
    /// The mean period in which the curve grows most, after the first one: for flows with one dominant
    /// period, whose curves oscillate with it.
    SteepestPeriod,
}

/// How neighbours are followed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct DivergenceSettings {
    /// Steps for which they are followed; `None`: 25 steps of a map, or seven mean periods of a flow, doubled
    /// until distances stop growing.
    pub steps: Option<usize>,
    /// The straight part.
    pub fit: StraightPart,
}

/// An exponent, and the curve it was fitted to.
#[derive(Debug, Clone, PartialEq)]
pub struct Divergence {
    /// The exponent [1/s].
    pub exponent: ExponentEstimate,
    /// Mean logarithm of the distance after 0, 1, 2, .. samples.
    pub curve: Vec<f64>,
    /// First and last step of the fitted part.
    pub fit: (usize, usize),
    /// Number of states with a neighbour.
    pub states: usize,
    /// Radius of the neighbourhoods (Kantz), in the unit of the series.
    pub radius: Option<f64>,
}

/// The exponent by nearest neighbours.
///
/// # Errors
/// [`SignalError::NoScaling`] if there is no straight part, [`SignalError::TooFewNeighbours`],
/// [`SignalError::Input`].
pub fn rosenstein(
    series: &[f64],
    sampling_rate_hz: f64,
    embedding: &Embedding,
    settings: &DivergenceSettings,
) -> Result<Divergence, SignalError> {
    let hoods = Neighbourhoods::new(series, embedding, settings)?;
    let follow = |state: usize, steps: usize| {
        let Some((neighbour, _)) = hoods.tree.nearest(&hoods.states, state, embedding.theiler_window, 0.0)
        else {
            return Vec::new();
        };
        let last = hoods.states.len() - state.max(neighbour);
        (0..steps.min(last)).map(|k| 0.5 * hoods.states.square(state + k, neighbour + k).ln()).collect()
    };
    hoods.average(follow, sampling_rate_hz, settings, None)
}

/// The exponent by all neighbours within a radius.
///
/// The radius is doubled from 1/1000 of the range of the series until four states in five have five
/// neighbours.
///
/// # Errors
/// As [`rosenstein`].
pub fn kantz(
    series: &[f64],
    sampling_rate_hz: f64,
    embedding: &Embedding,
    settings: &DivergenceSettings,
) -> Result<Divergence, SignalError> {
    let hoods = Neighbourhoods::new(series, embedding, settings)?;
    let ends = series.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    let radius = hoods.radius(1e-3 * (ends.1 - ends.0), embedding.theiler_window)?;
    let last = (embedding.dimension - 1) * embedding.delay;
    let follow = |state: usize, steps: usize| {
        let mut neighbours = hoods.tree.within(&hoods.states, state, embedding.theiler_window, radius);
        neighbours.retain(|other| other + steps <= hoods.states.len());
        if neighbours.len() < NEIGHBOURS || state + steps > hoods.states.len() {
            return Vec::new();
        }
        let distance = |k: usize| {
            let sum: f64 = neighbours
                .iter()
                .map(|other| (series[state + last + k] - series[other + last + k]).abs())
                .sum();
            (sum / neighbours.len() as f64).ln()
        };
        (0..steps).map(distance).collect()
    };
    hoods.average(follow, sampling_rate_hz, settings, Some(radius))
}

/// States and the search for their neighbours, which both methods share.
struct Neighbourhoods<'a> {
    states: DelayStates<'a>,
    tree: NeighbourTree,
    steps: usize,
    /// Mean period of a flow in steps; `None` of a map.
    period: Option<usize>,
    /// States that are followed.
    followed: Vec<usize>,
}

impl<'a> Neighbourhoods<'a> {
    fn new(
        series: &'a [f64],
        embedding: &Embedding,
        settings: &DivergenceSettings,
    ) -> Result<Self, SignalError> {
        let flow = embedding.mean_period > LEAST_FLOW_PERIOD;
        let states = DelayStates::new(series, embedding.delay, embedding.dimension);
        let usual = if flow { (7.0 * embedding.mean_period) as usize } else { 25 };
        let steps = settings.steps.unwrap_or(usual.min(states.len() / 4));
        let holds = steps >= 4 && steps < states.len();
        ensure(
            "the number of steps",
            steps as f64,
            format!("from 4 to less than the {} states", states.len()),
            holds,
        )?;
        match settings.fit {
            StraightPart::Given(from, to) => {
                let allowed = format!("after the first one, {from}, and at most {}", steps - 1);
                ensure("the last step of the fit", to as f64, allowed, to > from && to < steps)?;
            }
            StraightPart::SteepestPeriod => {
                let allowed =
                    format!("more than {LEAST_FLOW_PERIOD} samples where the steepest one is fitted");
                ensure("the mean period", embedding.mean_period, allowed, flow)?;
            }
            StraightPart::Found => {}
        }
        let tree = NeighbourTree::new(&states, states.len());
        let followed = (0..states.len()).step_by(states.len().div_ceil(STATES)).collect();
        let period = flow.then(|| embedding.mean_period.round() as usize);
        Ok(Self { states, tree, steps, period, followed })
    }

    fn radius(&self, smallest: f64, window: usize) -> Result<f64, SignalError> {
        let some: Vec<usize> =
            self.followed.iter().copied().step_by((self.followed.len() / 200).max(1)).collect();
        let mut found = 0;
        for doublings in 0..8 {
            let radius = smallest * f64::from(1 << doublings);
            let has_enough =
                |state: &&usize| self.tree.within(&self.states, **state, window, radius).len() >= NEIGHBOURS;
            found = some.iter().filter(has_enough).count();
            if found as f64 >= ENOUGH * some.len() as f64 {
                return Ok(radius);
            }
        }
        Err(SignalError::TooFewNeighbours { found, asked: some.len() })
    }

    /// Averages the logarithms of distances, and fits the slope.
    ///
    /// * `follow`: logarithms of the distances of a state after 0, 1, 2, .. steps, up to a number of steps.
    fn average(
        &self,
        follow: impl Fn(usize, usize) -> Vec<f64>,
        sampling_rate_hz: f64,
        settings: &DivergenceSettings,
        radius: Option<f64>,
    ) -> Result<Divergence, SignalError> {
        let longest = self.states.len() / 4;
        let given = matches!(settings.fit, StraightPart::Given(..));
        let free = self.period.is_some() && settings.steps.is_none() && !given;
        let mut steps = self.steps;
        let mut sums = self.sums(&follow, steps)?;
        while free && steps < longest && rises(&sums.curve()) {
            steps = (2 * steps).min(longest);
            // Fewer states can be followed for longer; where there are too few, the shorter curve is used.
            let Ok(longer) = self.sums(&follow, steps) else { break };
            sums = longer;
        }
        let curve = sums.curve();
        let fit = match (settings.fit, self.period) {
            (StraightPart::Given(from, to), _) => (from, to),
            (StraightPart::SteepestPeriod, Some(period)) => steepest_period(&curve, period)?,
            (_, period) => straight_part(&curve, period.is_some())?,
        };
        let steepness = |curve: &[f64]| match settings.fit {
            StraightPart::SteepestPeriod => growth(curve, fit),
            _ => slope(curve, fit),
        };
        let slopes = sums.groups.iter().map(|group| steepness(&group.mean()));
        let slopes: Vec<f64> = slopes.filter(|slope| slope.is_finite()).collect();
        let exponent = ExponentEstimate {
            value: sampling_rate_hz * steepness(&curve),
            scatter: sampling_rate_hz * standard_error(&slopes),
        };
        Ok(Divergence { exponent, curve, fit, states: sums.found, radius })
    }

    /// Sums over all states with neighbours, in groups by time.
    fn sums(&self, follow: &impl Fn(usize, usize) -> Vec<f64>, steps: usize) -> Result<Grouped, SignalError> {
        let mut groups = vec![Sums::new(steps); GROUPS];
        let mut found = 0;
        for (index, &state) in self.followed.iter().enumerate() {
            let logarithms = follow(state, steps);
            found += usize::from(!logarithms.is_empty());
            groups[index * GROUPS / self.followed.len()].add(&logarithms);
        }
        if found < MIN_STATES {
            return Err(SignalError::TooFewNeighbours { found, asked: self.followed.len() });
        }
        Ok(Grouped { groups, found })
    }
}

/// Sums over groups of states, and the number of states with neighbours.
struct Grouped {
    groups: Vec<Sums>,
    found: usize,
}

impl Grouped {
    fn curve(&self) -> Vec<f64> {
        let mut all = Sums::new(self.groups[0].sum.len());
        self.groups.iter().for_each(|group| all.merge(group));
        all.mean()
    }
}

/// Sums of logarithms for each step.
#[derive(Clone)]
struct Sums {
    sum: Vec<f64>,
    count: Vec<f64>,
}

impl Sums {
    fn new(steps: usize) -> Self {
        Self { sum: vec![0.0; steps], count: vec![0.0; steps] }
    }

    /// Adds the logarithms of a state; distances of zero do not count.
    fn add(&mut self, logarithms: &[f64]) {
        for (k, value) in logarithms.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            self.sum[k] += value;
            self.count[k] += 1.0;
        }
    }

    fn merge(&mut self, other: &Self) {
        for k in 0..self.sum.len() {
            self.sum[k] += other.sum[k];
            self.count[k] += other.count[k];
        }
    }

    fn mean(&self) -> Vec<f64> {
        self.sum.iter().zip(&self.count).map(|(sum, count)| sum / count).collect()
    }
}
