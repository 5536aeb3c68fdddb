//! Accelerations in force steps over which a load goes through waves.
//!
//! The length of a force step follows from the forces of the elements, to which a load of high order may add
//! next to nothing, while it makes the acceleration wave many times over the step. The nodes do not show such
//! waves. Yet the load's part is known in closed form, and what is left is smooth:
//!
//! `r''(t) = s(t) + r_particular''(t)`, s a polynomial through its values at the nodes.
//!
//! So the sum is looked at [`PLACES_PER_RADIAN`] times for each radian through which the fastest load turns,
//! and every top of it is noted, with the most that it can be. With the distance `d` between places [rad] and
//! the amplitude `A` of the load's part, that is `A d^2/8` above the higher one of two places. The vertex of
//! a parabola through three places lies below the top of a wave beside the middle one: a top at the part `e`
//! of `d` from it is missed by `A d^4 (e^2 - e^4)/8`, up to terms of sixth order, and `e` is 1/2 at most.
//! That is `3 A d^4/128`; a third more is for what is smooth, which bends far less over three places.

use super::{
    ExactIntegrator,
    collocation::NODES,
    course::CourseStep,
    parabola::closed_in,
    step_maximum::{Peak, Peaks},
};

/// Radians through which a load turns in a step whose nodes still show it: half a wave through 12 nodes is
/// good to some 1e-10.
const SHOWN: f64 = 3.0;
/// Places for each radian.
const PLACES_PER_RADIAN: f64 = 2.5;
/// What a parabola misses of a top at most, in `A d^4`.
const MISSED: f64 = 1.0 / 32.0;

impl ExactIntegrator {
    /// Length of steps up to which their nodes show how the loads go.
    pub(super) fn shown_length(&self) -> f64 {
        SHOWN / self.drive.fastest()
    }

    /// Whether the present step is longer.
    pub(super) fn has_waves(&self) -> bool {
        self.step.length > self.shown_length()
    }

    /// Notes every top of the acceleration of the response in the present step.
    ///
    /// * `nodes`: the acceleration at the nodes.
    pub(super) fn note_waves(
        &self,
        peaks: &mut Peaks,
        (piece, step): (usize, CourseStep),
        nodes: &[f64; NODES],
    ) {
        let (length, output) = (self.step.length, self.laws.len());
        let driven = |time| self.drive.jet(output, &self.outputs[output], self.step.start + time).curvature;
        let smooth: [f64; NODES] = std::array::from_fn(|k| nodes[k] - driven(self.step.node_time(k)));
        let rule = step.grading.rule();
        let expansion = rule.expansion(&smooth);
        let count = (PLACES_PER_RADIAN * self.drive.fastest() * length).ceil() as usize;
        let place = |time: f64| step.grading.inverse(time / length);
        let at = |time: f64| {
            let [smooth] = rule.sums(&expansion, &[place(time)]);
            (smooth + driven(time)).abs()
        };
        let width = length / count as f64;
        let values: Vec<f64> = (0..=count).map(|i| at(i as f64 * width)).collect();
        let amplitude = self.drive.bounds(output, &self.outputs[output], self.step.start + length).0;
        let apart = self.drive.fastest() * length / count as f64;
        for (i, &here) in values.iter().enumerate() {
            let [before, after] = [i.checked_sub(1), Some(i + 1)].map(|k| k.and_then(|k| values.get(k)));
            if [before, after].into_iter().flatten().any(|beside| *beside > here) {
                continue;
            }
            let middle = i as f64 * width;
            let (time, value, more) = match (before, after) {
                (Some(before), Some(after)) if before + after < 2.0 * here => {
                    let three = [(middle - width, *before), (middle, here), (middle + width, *after)];
                    // What is not of the load may bend more over three places than it does.
                    let (time, value) = closed_in(three, three[1], (0.0, length), at);
                    (time, value, MISSED * amplitude * apart.powi(4))
                }
                // The top may lie beside an end of the step, in it or beyond.
                _ => (middle, here, amplitude * apart * apart / 8.0),
            };
            peaks.add(Peak { piece, step, output, value: value + more, place: place(time) }, value);
        }
    }
}
