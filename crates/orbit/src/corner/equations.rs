//! Orbits that are cut at touches of rigid stops, with the phases of the touches for unknowns.
//!
//! Unknowns are the states `z_k` right before the touches (scaled), their phases `x_k`, and the last unknown
//! `p` of the path. With the flow `Z_k` from one touch to the next,
//!
//! `Z_k(J_k z_k; x_k, x_k+1, p) = z_k+1`, and with the impact `r_k = level`, `r_1' = v`; without it `J = 1`,
//! `r_k' = 0`, `level - r_1 = c`.
//!
//! `J z = z - (1 + e)/D B r'`, `D = phi . phi`. By the phases a flow has the derivatives `-G F/f` at its
//! start and `F/f` at its end, with the rate F of the state; what depends on an instant alone is
//! differentiated by p with differences. Beside the touches the stops are opened wide, so that no flow sees
//! the touch that is one of its ends.

use hammerbeam_motion::{
    LocalElement, Parameter, Stretch,
    exact::{ExactIntegrator, MotionError},
};
use hammerbeam_path::DenseLu;

use super::touch::{Touch, largest_speed};
use crate::{OrbitError, by_rows::times, shooting::ShootingProblem};

/// Longest time for which stops are opened beside a touch [cycles].
const WIDEST: f64 = 1.0 / 32.0;
/// Share of the time to the nearest other contact.
const PART: f64 = 0.25;
/// Contacts this near a touch are the touch: a guess of it may lie a little beyond the stop [cycles].
const SAME: f64 = 3e-5;
/// A gap is opened to so many times itself and the orbit.
const WIDE: f64 = 1e3;
const MOST_ITERATIONS: usize = 15;
/// Corrections relative to the orbit: where the last one is no larger the solution is taken, and the largest
/// that is made.
const CONVERGED: f64 = 1e-11;
const LARGEST: f64 = 0.5;
/// Error of the motion over a period, in tolerances of its steps.
const MOTION: f64 = 10.0;
/// Relative step of differences.
const DIFFERENCE: f64 = 1e-6;

/// On which side of the corner a solution is wanted, relative to the orbit.
#[derive(Debug, Clone, Copy)]
pub(super) enum Beside {
    /// The touches are impacts, the first of this speed.
    WithImpact { speed: f64 },
    /// The touches are turns, the first of this clearance.
    WithoutImpact { clearance: f64 },
}

/// `[z_1, x_1, z_2, x_2, ..., p]`.
#[derive(Debug, Clone)]
pub(super) struct Unknowns(Vec<f64>);

impl Unknowns {
    /// Touches in the order of their phases.
    pub fn of_touches(touches: &[Touch], last: f64) -> Self {
        let mut touches: Vec<&Touch> = touches.iter().collect();
        touches.sort_by(|a, b| a.phase.total_cmp(&b.phase));
        let nodes = touches.into_iter().flat_map(|touch| touch.state.iter().copied().chain([touch.phase]));
        Self(nodes.chain([last]).collect())
    }

    pub(super) fn node(&self, k: usize, size: usize) -> &[f64] {
        &self.0[k * (size + 1)..k * (size + 1) + size]
    }

    pub(super) fn phase(&self, k: usize, size: usize) -> f64 {
        self.0[k * (size + 1) + size]
    }

    pub(super) fn last(&self) -> f64 {
        self.0[self.0.len() - 1]
    }
}

/// Linear equations for a correction: residual and matrix by rows.
struct Linear {
    residual: Vec<f64>,
    matrix: Vec<f64>,
}

/// What the rows of one touch are made of.
struct OfTouch<'a> {
    k: usize,
    impacts: bool,
    /// Half the difference of the last unknowns of the instants, which are those short of it, at it and
    /// beyond.
    step: f64,
    instants: [&'a Instant; 3],
}

/// What depends on the instant of a touch alone: `r - level` and `r'` relative to the orbit, and the velocity
/// that an impact takes, scaled.
pub(super) struct Instant {
    values: [f64; 2],
    pub jump: Vec<f64>,
}

/// The equations of the orbits beside a grazing.
pub(super) struct TouchEquations<'a> {
    pub(super) problem: &'a mut ShootingProblem,
    /// With the gaps of the touched stops opened.
    pub(super) opened: ExactIntegrator,
    /// Touched stops in the order of the phases.
    pub(super) elements: Vec<usize>,
    /// For how long they are opened beside the touches [cycles].
    pub(super) width: f64,
    evaluations: u64,
}

impl<'a> TouchEquations<'a> {
    /// * `touches`: of the orbit with this last unknown.
    pub fn new(problem: &'a mut ShootingProblem, touches: &[Touch], last: f64) -> Result<Self, OrbitError> {
        let mut sorted: Vec<&Touch> = touches.iter().collect();
        sorted.sort_by(|a, b| a.phase.total_cmp(&b.phase));
        let elements: Vec<usize> = sorted.iter().map(|touch| touch.element).collect();
        let mut system = problem.system().clone();
        for &element in &elements {
            let level = problem.system().elements()[element].law.gap().unwrap_or(0.0);
            let reach = reach(problem, element);
            let gap = Parameter::gap(element);
            system = system.with_parameter(gap, WIDE * (level.abs() + reach)).map_err(MotionError::from)?;
        }
        let mut opened = problem.integrator().for_system(system)?;
        opened.differentiate_by(problem.varied().parameter().and_then(|p| p.without_gaps_of(&elements)))?;
        let mut equations = Self { problem, opened, elements, width: WIDEST, evaluations: 0 };
        equations.width = equations.fitting_width(&sorted, last)?;
        Ok(equations)
    }

    /// Work so far, in evaluations of the shooting equations.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// How many hertz of arc length a change of the orbit by its own size counts.
    pub fn length_per_norm(&self) -> f64 {
        self.problem.length_per_norm()
    }

    pub(super) fn size(&self) -> usize {
        self.problem.node_size()
    }

    pub(super) fn frequency(&self, unknowns: &Unknowns) -> f64 {
        self.problem.frequency(&unknowns.0)
    }

    /// A part of the time to the nearest contact of a touched stop that is not one of the touches.
    fn fitting_width(&mut self, touches: &[&Touch], last: f64) -> Result<f64, OrbitError> {
        let frequency_hz = self.problem.frequency(&[last]);
        let cycles = f64::from(self.problem.period_multiple());
        let first = touches[0];
        let state = self.unscaled(&first.state);
        let stretch = Stretch { frequency_hz, start: first.phase, end: first.phase + cycles };
        let trace = self.problem.integrator().trace(&stretch, &state, &[])?;
        let of_stops = trace.contacts.iter().filter(|contact| self.elements.contains(&contact.element));
        let mut nearest = cycles;
        for contact in of_stops {
            let phase = first.phase + contact.since() * frequency_hz;
            let apart = |touch: &&Touch| {
                let apart = (phase - touch.phase).rem_euclid(cycles);
                apart.min(cycles - apart)
            };
            let distance = touches.iter().map(apart).fold(cycles, f64::min);
            if distance > SAME {
                nearest = nearest.min(distance);
            }
        }
        for pair in touches.windows(2) {
            nearest = nearest.min((pair[1].phase - pair[0].phase).abs());
        }
        Ok(WIDEST.min(PART * nearest))
    }

    /// Newton's method from a guess; `None` where it does not converge, or where its first correction is
    /// larger than `farthest`.
    pub fn solve(&mut self, guess: &Unknowns, beside: Beside, farthest: f64) -> Option<Unknowns> {
        let mut unknowns = guess.clone();
        let mut largest = farthest.min(LARGEST);
        for _ in 0..MOST_ITERATIONS {
            let Linear { residual, matrix } = self.linearise(&unknowns, beside).ok()?;
            let mut lu = DenseLu::new();
            lu.factorise(residual.len(), &matrix).ok()?;
            let mut correction: Vec<f64> = residual.iter().map(|value| -value).collect();
            lu.solve(&mut correction);
            let size = self.length(&correction);
            if size.is_nan() || size > largest {
                return None;
            }
            unknowns.0.iter_mut().zip(&correction).for_each(|(u, c)| *u += c);
            if size <= CONVERGED {
                return self.turns_towards_stops(&unknowns).then_some(unknowns);
            }
            largest = LARGEST;
        }
        None
    }

    /// Within which the last unknown of a solution is known: what the error of the motion, in each of the
    /// equations, makes of it.
    pub fn uncertainty(&mut self, unknowns: &Unknowns, beside: Beside) -> Option<f64> {
        let Linear { residual, matrix } = self.linearise(unknowns, beside).ok()?;
        let size = residual.len();
        let mut lu = DenseLu::new();
        lu.factorise(size, &matrix).ok()?;
        let response = (0..size).map(|row| {
            let mut unit = vec![0.0; size];
            unit[row] = 1.0;
            lu.solve(&mut unit);
            unit[size - 1].abs()
        });
        let error = MOTION * self.problem.integrator().settings().tolerance;
        Some(error * response.sum::<f64>())
    }

    /// Largest change of a state, a phase and the last unknown, relative to the orbit.
    fn length(&self, correction: &[f64]) -> f64 {
        let last = correction[correction.len() - 1].abs() / self.problem.length_per_norm();
        correction[..correction.len() - 1].iter().fold(last, |most, change| most.max(change.abs()))
    }

    /// Whether the motion turns back at each touch.
    fn turns_towards_stops(&self, unknowns: &Unknowns) -> bool {
        let frequency_hz = self.frequency(unknowns);
        (0..self.elements.len()).all(|k| {
            let state = self.unscaled(unknowns.node(k, self.size()));
            let phase = unknowns.phase(k, self.size());
            self.problem.system().relative_motion(self.elements[k], frequency_hz, phase, &state)[2] < 0.0
        })
    }

    pub(super) fn move_to(&mut self, last: f64) -> Result<(), OrbitError> {
        self.problem.move_to(&[last])?;
        let varied = self.problem.varied().parameter();
        if let Some(parameter) = varied.and_then(|varied| varied.without_gaps_of(&self.elements)) {
            self.opened.set_parameter(parameter, last)?;
        }
        Ok(())
    }

    fn linearise(&mut self, unknowns: &Unknowns, beside: Beside) -> Result<Linear, OrbitError> {
        let count = self.elements.len();
        let width = count * (self.size() + 1) + 1;
        let step = DIFFERENCE * self.problem.parameter_size(&unknowns.0);
        let instants = |equations: &mut Self, last: f64| -> Result<Vec<Instant>, OrbitError> {
            equations.move_to(last)?;
            Ok((0..count).map(|k| equations.instant(unknowns, (k, last))).collect())
        };
        let beyond = instants(self, unknowns.last() + step)?;
        let short = instants(self, unknowns.last() - step)?;
        let here = instants(self, unknowns.last())?;
        self.evaluations += 1;
        let impacts = matches!(beside, Beside::WithImpact { .. });
        let mut linear = Linear { residual: vec![0.0; width], matrix: vec![0.0; width * width] };
        for k in 0..count {
            let of_touch = OfTouch { k, impacts, step, instants: [&short[k], &here[k], &beyond[k]] };
            self.fill_touch(&mut linear, unknowns, &of_touch)?;
        }
        let (which, wanted) = match beside {
            Beside::WithImpact { speed } => (1, speed),
            Beside::WithoutImpact { clearance } => (0, -clearance),
        };
        self.fill_condition(&mut linear, unknowns, (0, which), (width - 1, wanted));
        let by_last = (beyond[0].values[which] - short[0].values[which]) / (2.0 * step);
        linear.matrix[width * width - 1] = by_last;
        Ok(linear)
    }

    /// The rows of one touch: the flow to the next one, and the first condition.
    fn fill_touch(
        &mut self,
        linear: &mut Linear,
        unknowns: &Unknowns,
        of_touch: &OfTouch<'_>,
    ) -> Result<(), OrbitError> {
        let &OfTouch { k, impacts, step, instants: [short, here, beyond] } = of_touch;
        let (size, count, frequency_hz) = (self.size(), self.elements.len(), self.frequency(unknowns));
        let (block, width, next) = (size + 1, linear.residual.len(), (k + 1) % count);
        let start_state: Vec<f64> = if impacts {
            unknowns.node(k, size).iter().zip(&here.jump).map(|(z, j)| z + j).collect()
        } else {
            unknowns.node(k, size).to_vec()
        };
        let stretch = self.stretch(unknowns, k);
        let flow = self.flow_between_touches(stretch, &start_state)?;
        let rate_at =
            |equations: &Self, phase: f64, state: &[f64]| equations.scaled_rate(frequency_hz, phase, state);
        let start_rate = rate_at(self, stretch.start, &start_state);
        let end_rate = rate_at(self, stretch.end, &flow.end);
        let (by_state, by_phase) = self.jump_matrix(unknowns, k, impacts);
        let matrix = times_matrix(&flow.matrix, &by_state, size);
        // Of the start: what the jump does later, less what the flow is shorter by.
        let late: Vec<f64> =
            by_phase.iter().zip(&start_rate).map(|(jump, rate)| jump - rate / frequency_hz).collect();
        let late = times(&flow.matrix, &late);
        let jump_by_last: Vec<f64> = (0..size)
            .map(|i| if impacts { (beyond.jump[i] - short.jump[i]) / (2.0 * step) } else { 0.0 })
            .collect();
        let carried = times(&flow.matrix, &jump_by_last);
        for i in 0..size {
            let row = k * block + i;
            let entries = &mut linear.matrix[row * width..(row + 1) * width];
            entries[k * block..k * block + size].copy_from_slice(&matrix[i * size..(i + 1) * size]);
            entries[k * block + size] += late[i];
            entries[next * block + i] -= 1.0;
            entries[next * block + size] += end_rate[i] / frequency_hz;
            entries[width - 1] = flow.by_last[i] + carried[i];
            linear.residual[row] = flow.end[i] - unknowns.node(next, size)[i];
        }
        // With the impact r = level, without r' = 0; and of the first touch the other one, too.
        let which = usize::from(!impacts);
        self.fill_condition(linear, unknowns, (k, which), (k * block + size, 0.0));
        let by_last = (beyond.values[which] - short.values[which]) / (2.0 * step);
        linear.matrix[(k * block + size) * width + width - 1] = by_last;
        Ok(())
    }

    /// `r - level` or `r'` of a touch, with its derivatives by the touch.
    fn fill_condition(
        &self,
        linear: &mut Linear,
        unknowns: &Unknowns,
        (k, which): (usize, usize),
        (row, wanted): (usize, f64),
    ) {
        let (size, width) = (self.size(), linear.residual.len());
        let (element, scales) = (self.elements[k], self.problem.scale().values());
        let frequency_hz = self.frequency(unknowns);
        let (system, unit) = (self.problem.system(), self.units(element, frequency_hz)[which]);
        let LocalElement { shape, support_ratios, .. } = &system.elements()[element];
        let carried = system.carried(support_ratios, frequency_hz, unknowns.phase(k, size));
        let (n, at) = (size / 2, which * (size / 2));
        let entries = &mut linear.matrix[row * width..(row + 1) * width];
        for i in 0..n {
            entries[k * (size + 1) + at + i] = shape[i] * scales[at + i] / unit;
        }
        entries[k * (size + 1) + size] = carried[which + 1] / frequency_hz / unit;
        linear.residual[row] = self.instant(unknowns, (k, unknowns.last())).values[which] - wanted;
    }

    /// Units of the displacement and of the speed of an element.
    fn units(&self, element: usize, frequency_hz: f64) -> [f64; 2] {
        let speed = largest_speed(self.problem, element);
        [speed / (std::f64::consts::TAU * frequency_hz), speed]
    }

    /// What depends on the instant of a touch, with the system as it is and this last unknown.
    pub(super) fn instant(&self, unknowns: &Unknowns, (k, last): (usize, f64)) -> Instant {
        let (size, element) = (self.size(), self.elements[k]);
        let frequency_hz = self.problem.frequency(&[last]);
        let state = self.unscaled(unknowns.node(k, size));
        let system = self.problem.system();
        let [r, speed, _] = system.relative_motion(element, frequency_hz, unknowns.phase(k, size), &state);
        let of = &system.elements()[element];
        let (level, restitution) =
            of.law.rigid().map_or((0.0, 0.0), |stop| (stop.level(), stop.restitution()));
        let units = self.units(element, self.frequency(unknowns));
        let mobility: f64 = of.shape.iter().map(|phi| phi * phi).sum();
        let impulse = -(1.0 + restitution) * speed / mobility;
        let scales = &self.problem.scale().values()[size / 2..];
        let velocities = of.shape.iter().zip(scales).map(|(phi, scale)| phi * impulse / scale);
        let jump = std::iter::repeat_n(0.0, size / 2).chain(velocities).collect();
        Instant { values: [(r - level) / units[0], speed / units[1]], jump }
    }

    /// The derivative of a state right behind a touch by the one before, by rows, and by the phase.
    fn jump_matrix(&self, unknowns: &Unknowns, k: usize, impacts: bool) -> (Vec<f64>, Vec<f64>) {
        let size = self.size();
        let (n, element) = (size / 2, self.elements[k]);
        let mut matrix = vec![0.0; size * size];
        (0..size).for_each(|i| matrix[i * size + i] = 1.0);
        let mut by_phase = vec![0.0; size];
        if !impacts {
            return (matrix, by_phase);
        }
        let of = &self.problem.system().elements()[element];
        let restitution = of.law.rigid().map_or(0.0, |stop| stop.restitution());
        let scales = &self.problem.scale().values()[n..];
        let mobility: f64 = of.shape.iter().map(|phi| phi * phi).sum();
        let factor = -(1.0 + restitution) / mobility;
        let frequency_hz = self.frequency(unknowns);
        let system = self.problem.system();
        let carried = system.carried(&of.support_ratios, frequency_hz, unknowns.phase(k, size));
        for i in 0..n {
            for j in 0..n {
                matrix[(n + i) * size + n + j] += factor * of.shape[i] * of.shape[j] * scales[j] / scales[i];
            }
            by_phase[n + i] = factor * of.shape[i] * carried[2] / frequency_hz / scales[i];
        }
        (matrix, by_phase)
    }

    pub(super) fn unscaled(&self, state: &[f64]) -> Vec<f64> {
        state.iter().zip(self.problem.scale().values()).map(|(x, s)| x * s).collect()
    }

    fn scaled_rate(&self, frequency_hz: f64, phase: f64, state: &[f64]) -> Vec<f64> {
        let rate = self.problem.system().rate(frequency_hz, phase, &self.unscaled(state));
        rate.iter().zip(self.problem.scale().values()).map(|(r, s)| r / s).collect()
    }
}

/// How far an orbit of the size of the scale moves an element [m].
fn reach(problem: &ShootingProblem, element: usize) -> f64 {
    let shape = &problem.system().elements()[element].shape;
    shape.iter().zip(problem.scale().values()).map(|(shape, scale)| (shape * scale).abs()).sum()
}

/// `A B` by rows.
pub(super) fn times_matrix(first: &[f64], second: &[f64], size: usize) -> Vec<f64> {
    let mut product = vec![0.0; size * size];
    for i in 0..size {
        for (k, factor) in first[i * size..(i + 1) * size].iter().enumerate() {
            let row = &second[k * size..(k + 1) * size];
            product[i * size..(i + 1) * size].iter_mut().zip(row).for_each(|(p, b)| *p += factor * b);
        }
    }
    product
}
