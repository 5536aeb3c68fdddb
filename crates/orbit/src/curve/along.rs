//! Along an orbit whose touched elements are left out beside their touches (`passing.rs`).

use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, Maxima, MotionError},
};

use super::{passing::WIDEST, shooting::Shooting};
use crate::{OrbitError, OrbitMaxima, solve};

/// Times this near the touch are the touch [cycles].
const TOUCH: f64 = 1e-3;
impl Shooting {
    /// The parts of a stretch of an orbit from `start` on, and whether touched elements are left out in them.
    pub fn parts(&self, stretch: Stretch, start: f64) -> Vec<(Stretch, bool)> {
        let Some(passing) = &self.passing else { return vec![(stretch, false)] };
        let windows = passing.windows(start, f64::from(self.period_multiple));
        let mut cuts: Vec<f64> = windows.iter().flatten().copied().collect();
        cuts.retain(|cut| stretch.start < *cut && *cut < stretch.end);
        cuts.extend([stretch.start, stretch.end]);
        cuts.sort_by(f64::total_cmp);
        let part = |cuts: &[f64]| {
            let middle = 0.5 * (cuts[0] + cuts[1]);
            let passes = windows.iter().any(|[from, to]| (*from..=*to).contains(&middle));
            (Stretch { start: cuts[0], end: cuts[1], ..stretch }, passes)
        };
        cuts.windows(2).map(part).collect()
    }

    /// The state at the end of a stretch of the orbit that starts at the phase `start`, in its own units.
    pub fn advance(&mut self, stretch: Stretch, start: f64, state: &[f64]) -> Result<Vec<f64>, MotionError> {
        let mut state = state.to_vec();
        for (part, passes) in self.parts(stretch, start) {
            state = self.integrator_of(passes).advance(&part, &state)?;
        }
        Ok(state)
    }

    /// The integrator of a part of the orbit.
    pub fn integrator_of(&mut self, passes: bool) -> &mut ExactIntegrator {
        match &mut self.passing {
            Some(passing) if passes => &mut passing.integrator,
            _ => &mut self.integrator,
        }
    }

    /// Leaves touched elements out as long as their other contacts allow, over the orbit that starts with
    /// `state` at its touch.
    pub fn fit_passing(&mut self, frequency_hz: f64, start: f64, state: &[f64]) -> Result<(), MotionError> {
        let Some(passing) = &self.passing else { return Ok(()) };
        let (touches, opposite) = (passing.touches.clone(), passing.behind);
        let cycles = f64::from(self.period_multiple);
        let first = Stretch { frequency_hz, start, end: start + TOUCH };
        let state = self.integrator_of(true).advance(&first, state)?;
        let rest = Stretch { frequency_hz, start: first.end, end: start + cycles - TOUCH };
        let trace = self.integrator.trace(&rest, &state, &[])?;
        let length = (rest.end - rest.start) / frequency_hz;
        let of_elements =
            trace.contacts.iter().filter(|contact| touches.iter().any(|t| t.element == contact.element));
        let distances = of_elements.filter_map(|contact| {
            // Times behind the start of the orbit [cycles].
            let from = TOUCH + contact.since() * frequency_hz;
            let to = TOUCH + contact.clear.unwrap_or(length) * frequency_hz;
            let to_ends = from.min(cycles - to);
            let Some(opposite) = opposite else { return Some(to_ends) };
            let to_opposite = (from - opposite).max(opposite - to);
            let is_it = from > opposite - TOUCH && to < opposite + TOUCH;
            (!is_it).then_some(to_ends.min(to_opposite))
        });
        let nearest = distances.fold(f64::INFINITY, f64::min);
        if let Some(passing) = &mut self.passing {
            passing.width = WIDEST.min(0.25 * nearest.max(0.0));
        }
        Ok(())
    }

    /// Maxima of the orbit whose segments start at these phases with these states.
    pub fn observe(&mut self, stretches: &[Stretch], nodes: &[Vec<f64>]) -> Result<OrbitMaxima, OrbitError> {
        if self.passing.is_none() {
            return solve::observe(&mut self.integrator, stretches, nodes);
        }
        let start = stretches[0].start;
        let mut all: Option<Maxima> = None;
        for (stretch, node) in stretches.iter().zip(nodes) {
            let mut state = node.clone();
            for (part, passes) in self.parts(*stretch, start) {
                let integrator = self.integrator_of(passes);
                let maxima = integrator.observe(&[(part, &state)])?;
                state = integrator.advance(&part, &state)?;
                all = Some(all.map_or(maxima, |all| all.and(&maxima)));
            }
        }
        Ok(all.unwrap_or_default().into())
    }
}
