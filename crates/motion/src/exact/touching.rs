//! Open contacts that close while forces act.

use super::{
    ExactIntegrator,
    clearance::{Look, look},
    collocation::NODES,
    event::Event,
    flight::{Touch, clearance_of},
    run::Run,
};

/// Most looks at an open contact within one force step. Each goes on by at least this part of the step: a touch that is left again
/// sooner, between two looks whose clearances are both positive, carries next to no force and may be passed by.
const MAX_LOOKS: usize = 20_000;

impl ExactIntegrator {
    /// The first open contact, other than that of `event`, that closes within the solved step, and when.
    pub(super) fn first_touch_in_step(&self, run: &Run, event: Option<Event>) -> Option<(Touch, f64)> {
        let mut first: Option<(Touch, f64)> = None;
        for element in 0..self.laws.len() {
            if run.closed[element].is_some() {
                continue;
            }
            for contact in 0..self.laws[element].contacts().len() {
                let touch = Touch { element, contact };
                if event == Some(Event::Touch(touch)) {
                    continue;
                }
                if let Some(time) = self.touch_in_step(run, touch)
                    && first.is_none_or(|(_, earlier)| time < earlier)
                {
                    first = Some((touch, time));
                }
            }
        }
        first
    }

    /// When an open contact closes within the solved step, by the safe steps of a flight with the forces in the bound. The bound takes the
    /// force between its nodes as at most twice its nodal values, so this is no proof, unlike the search in flight.
    fn touch_in_step(&self, run: &Run, Touch { element, contact }: Touch) -> Option<f64> {
        let c = self.laws[element].contacts()[contact];
        let length = self.step.weights.length;
        let mut bounds = self.bounds(run, element, run.time + length);
        bounds.second += self.forced_bound(element);
        bounds.third = f64::INFINITY;
        let mut time = 0.0;
        let mut jet = run.start[element].jet;
        let start = clearance_of(jet, c.level, c.sign);
        // A release that ends again before it rises above what its own location left undecided.
        if start.value <= 0.0 && start.curvature < 0.0 {
            let highest = start.value - 0.5 * start.slope * start.slope / start.curvature;
            if highest <= bounds.margin {
                return Some(0.0);
            }
        }
        for _ in 0..MAX_LOOKS {
            let step = match look(clearance_of(jet, c.level, c.sign), bounds) {
                Look::Contact => return Some(time),
                Look::FreeFor(step) => step,
                Look::MinimumAhead { at, .. } => at,
            };
            time += step.max(length / MAX_LOOKS as f64);
            if time >= length {
                return None;
            }
            jet = self.jet_in_step(&run.state, element, time);
        }
        None
    }

    /// Bound on the relative acceleration that the forces of the step cause.
    fn forced_bound(&self, element: usize) -> f64 {
        let (n, step, output) = (self.blocks.count(), &self.step, &self.outputs[element]);
        let of_active = |a: usize| {
            let other = step.active[a];
            let nodal = step.force[a * NODES..(a + 1) * NODES].iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            let input = &self.inputs[other];
            let energy =
                |i: usize| (self.blocks.stiffness[i] * input[i].powi(2) + input[n + i].powi(2)).sqrt();
            let later: f64 = (0..n).map(|i| output.second_bound[i] * energy(i)).sum();
            // Between Gauss nodes the polynomial exceeds them by little; twice is safe.
            2.0 * nodal * (self.mobility[element][other].abs() + step.weights.length * later)
        };
        (0..step.active.len()).map(of_active).sum()
    }
}
