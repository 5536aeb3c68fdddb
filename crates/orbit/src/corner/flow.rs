//! The motion from one touch to the next: with the touched stops opened beside the touches, which are its
//! ends.

use hammerbeam_motion::{Stretch, exact::ExactIntegrator};

use super::equations::{Beside, TouchEquations, Unknowns, times_matrix};
use crate::OrbitError;
use crate::by_rows::times;

/// The flow from one touch to the next in scaled states, the matrix by rows.
pub(super) struct FlowBetweenTouches {
    pub end: Vec<f64>,
    pub matrix: Vec<f64>,
    pub by_last: Vec<f64>,
}

impl TouchEquations<'_> {
    /// From touch k to the next one, or to the first one N cycles later.
    pub(super) fn stretch(&self, unknowns: &Unknowns, k: usize) -> Stretch {
        let (size, count) = (self.size(), self.elements.len());
        let end = if k + 1 == count {
            unknowns.phase(0, size) + f64::from(self.problem.period_multiple())
        } else {
            unknowns.phase(k + 1, size)
        };
        Stretch { frequency_hz: self.frequency(unknowns), start: unknowns.phase(k, size), end }
    }

    /// The parts of a stretch from a touch to the next, and whether the stops are opened in them.
    fn parts(&self, stretch: Stretch) -> Vec<(Stretch, bool)> {
        let (from, to) = (stretch.start + self.width, stretch.end - self.width);
        vec![
            (Stretch { end: from, ..stretch }, true),
            (Stretch { start: from, end: to, ..stretch }, false),
            (Stretch { start: to, ..stretch }, true),
        ]
    }

    fn integrator(&mut self, opened: bool) -> &mut ExactIntegrator {
        if opened { &mut self.opened } else { self.problem.integrator() }
    }

    pub(super) fn flow_between_touches(
        &mut self,
        stretch: Stretch,
        start: &[f64],
    ) -> Result<FlowBetweenTouches, OrbitError> {
        let size = self.size();
        let scales = self.problem.scale().values().to_vec();
        let mut state = self.unscaled(start);
        let mut matrix = vec![0.0; size * size];
        (0..size).for_each(|i| matrix[i * size + i] = 1.0);
        let mut by_last = vec![0.0; size];
        for (part, opened) in self.parts(stretch) {
            let flow = self.integrator(opened).flow(&part, &state)?;
            let factor: Vec<f64> = (0..size * size)
                .map(|entry| (entry / size, entry % size))
                .map(|(i, j)| flow.by_state[(i, j)] / scales[i] * scales[j])
                .collect();
            // A gap that is opened depends on nothing.
            let by_part = self.problem.varied().column_of(&flow);
            let own = |i: usize| by_part.get(i).map_or(0.0, |value| value / scales[i]);
            by_last =
                times(&factor, &by_last).iter().enumerate().map(|(i, carried)| carried + own(i)).collect();
            matrix = times_matrix(&factor, &matrix, size);
            state = flow.state;
        }
        let end = state.iter().zip(&scales).map(|(z, s)| z / s).collect();
        Ok(FlowBetweenTouches { end, matrix, by_last })
    }

    /// The point of the path: the orbit at the phases of its nodes.
    pub fn point(&mut self, unknowns: &Unknowns, beside: Beside) -> Option<Vec<f64>> {
        self.move_to(unknowns.last()).ok()?;
        let (size, count) = (self.size(), self.elements.len());
        let (frequency_hz, cycles) = (self.frequency(unknowns), f64::from(self.problem.period_multiple()));
        let first = unknowns.phase(0, size);
        let mut nodes = Vec::new();
        for segment in 0..self.problem.segments() {
            let phase = self.problem.stretch(segment, frequency_hz).start;
            let wanted = first + (phase - first).rem_euclid(cycles);
            let touch = (0..count).rev().find(|&k| unknowns.phase(k, size) <= wanted).unwrap_or(0);
            let mut state = unknowns.node(touch, size).to_vec();
            if let Beside::WithImpact { .. } = beside {
                let jump = self.instant(unknowns, (touch, unknowns.last())).jump;
                state.iter_mut().zip(jump).for_each(|(z, j)| *z += j);
            }
            let mut state = self.unscaled(&state);
            for (part, opened) in self.parts(self.stretch(unknowns, touch)) {
                if part.start < wanted {
                    let part = Stretch { end: part.end.min(wanted), ..part };
                    state = self.integrator(opened).advance(&part, &state).ok()?;
                }
            }
            nodes.push(state);
        }
        Some(self.problem.point(&nodes, unknowns.last()))
    }
}
