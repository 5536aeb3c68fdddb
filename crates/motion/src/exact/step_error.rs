//! The error of a solved step.
//!
//! Over a step of length h the force `F` of each active element, its slope `f'` and its sensitivities `dF` are expanded in the orthonormal
//! polynomials of the step, up to the degree `m = NODES - 1`; the tail of a function is the magnitude of its two highest
//! coefficients added, its decay D the tail over the same at half the degree. With the mobility `G = C A B` and the largest relative
//! velocity `V` that the present state can reach, or that the load gives it in the step,
//!
//! `T = h G tail(F)/V`, or `sqrt(h G tail(F)/V . h^2 G tail(f'))` if that is larger,
//!
//! is the relative error of the force. On Gauss nodes it is orthogonal to all that is smooth over the step, so the state at the end has
//! about its square; `T D^2`, the force in the polynomials of twice the degree, if that is larger: near a half-integer power
//! outside the step the coefficients fall slowly. Of the share `S` of the blocks that are not smooth over the step it has the
//! error itself, and blocks so fast that the nodes do not resolve their part `U` in the force leave that part. The step is accepted if
//!
//! `T^2`, `T D^2 <= 4 tolerance` and `T S`, `U <= 10 tolerance`,
//!
//! and, where sensitivities are wanted, the same holds of them, relative to the largest sensitivity of a velocity (columns of displacements
//! divided by the eigenfrequency).

use super::{
    ExactIntegrator,
    collocation::NODES,
    run::{ElementStart, Run},
};

/// How the expansion of a function over a step ends.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Tail {
    /// The two highest coefficients, in magnitude, added.
    pub highest: f64,
    /// The same at half the degree.
    pub middle: f64,
}

impl Tail {
    /// Part that is left at twice the degree.
    fn decay(self) -> f64 {
        (self.highest / self.middle.max(f64::MIN_POSITIVE)).min(1.0).powi(2)
    }
}

/// Relative errors of a step by the file header.
#[derive(Debug, Clone, Copy, Default)]
struct Errors {
    /// `T`.
    tail: f64,
    /// `T D^2`.
    slow: f64,
    /// `S`.
    fast_share: f64,
    /// `U`.
    unresolved: f64,
}

/// Turning of a block over a step, in radians, below which the nodes resolve it to rounding.
const RESOLVED: f64 = 5.5;

impl ExactIntegrator {
    /// Largest velocity that an output can reach from the present state.
    pub(super) fn velocity_range(&self, run: &Run, output: usize) -> f64 {
        let o = &self.outputs[output];
        let driven = self.drive.magnitude(output) * self.drive.circular_frequency();
        driven + (0..self.blocks.count()).map(|i| o.first_bound[i] * self.energy_norm(run, i)).sum::<f64>()
    }

    fn energy_norm(&self, run: &Run, block: usize) -> f64 {
        let (p, s) = (run.state[block], run.state[self.blocks.count() + block]);
        (self.blocks.stiffness[block] * p * p + s * s).sqrt()
    }

    /// Error of the state at the end of the solved step, relative to its bound, to the power that makes it go like `h^NODES`.
    pub(super) fn state_error(&self, run: &Run) -> f64 {
        let of_element = |(a, &element): (usize, &usize)| {
            let (step, nodes) = (&self.step, a * NODES..(a + 1) * NODES);
            let impulse = step.weights.length * self.mobility[element][element];
            let ElementStart { jet, velocity, .. } = run.start[element];
            let driven = jet.slope.abs() + jet.curvature.abs() * step.weights.length;
            let velocity = velocity.max(driven).max(f64::MIN_POSITIVE);
            let force = step.tail(&step.force[nodes.clone()]);
            let tail = impulse * force.highest / velocity;
            let dual = impulse * step.weights.length * step.tail(&step.slope[nodes.clone()]).highest;
            let stiffest =
                step.slope[nodes].iter().fold(0.0_f64, |stiffest, slope| stiffest.max(slope.abs()));
            let bounds = &self.outputs[element].value_bound;
            let unresolved = self.unresolved(|i| bounds[i] * self.energy_norm(run, i));
            self.relative_to_bound(Errors {
                tail: tail.max((tail * dual).sqrt()),
                slow: tail * force.decay(),
                fast_share: self.fast_share(element),
                unresolved: impulse * stiffest * unresolved / velocity,
            })
        };
        self.step.active.iter().enumerate().map(of_element).fold(0.0, f64::max)
    }

    fn relative_to_bound(&self, errors: Errors) -> f64 {
        let square = errors.tail.powi(2).max(errors.slow) / 4.0;
        let linear = (errors.tail * errors.fast_share).max(errors.unresolved) / 10.0;
        (square.max(linear) / self.settings.tolerance).sqrt()
    }

    /// `S`: part of the mobility of an element whose blocks are not smooth over the step.
    ///
    /// A block that turns by z over the step has about `(z/4)^m/m!` of its response in the polynomial of degree m, and never more than `1/z`.
    fn fast_share(&self, element: usize) -> f64 {
        let share = |(rate, share): (&f64, &f64)| {
            let z = rate * self.step.weights.length;
            share * highest_part(z, NODES - 1).min(z.recip())
        };
        self.rates.iter().zip(&self.shares[element]).map(share).sum()
    }

    /// Sum of `amplitude(i)` over the blocks, each times what of it the nodes do not resolve.
    fn unresolved(&self, amplitude: impl Fn(usize) -> f64) -> f64 {
        let length = self.step.weights.length;
        let part = |(i, rate): (usize, &f64)| {
            let z = rate * length;
            if z > RESOLVED { highest_part(z, 2 * NODES) * amplitude(i) } else { 0.0 }
        };
        self.rates.iter().enumerate().map(part).sum()
    }

    /// Solves for the sensitivities of the forces of the solved step; their error, 0 if none are wanted, `None` if the step is singular.
    pub(super) fn sensitivity_error(&mut self, run: &Run) -> Option<f64> {
        let Some(sensitivity) = &run.sensitivity else { return Some(0.0) };
        if !self.step.weights.complete {
            self.series.complete(&self.step.active, self.step.grading(), &mut self.step.weights);
        }
        self.step.solve_sensitivity(&self.drive, &self.outputs, sensitivity).ok()?;
        let slowest = self.drive.circular_frequency();
        let frequencies = &self.system.model().natural_frequencies;
        let scale = |column: usize| frequencies.get(column).map_or(1.0, |w| w.max(slowest));
        let stiffest = self.step.slope.iter().fold(0.0_f64, |stiffest, slope| stiffest.max(slope.abs()));
        let (mut errors, mut by_frequency, mut norm) =
            (Errors::default(), Errors::default(), f64::MIN_POSITIVE);
        for (a, &element) in self.step.active.iter().enumerate() {
            let fast_share = self.fast_share(element);
            let bounds = &self.outputs[element].value_bound;
            let impulse = self.step.weights.length * self.mobility[element][element].sqrt();
            for (column, found) in self.step.sensitivity_tails(a, sensitivity).iter().enumerate() {
                let amplitude =
                    |i: usize| bounds[i] * sensitivity.energy_norm(i, column, self.blocks.stiffness[i]);
                let size = found.velocity + impulse * found.largest;
                let (scale, into) = if column == sensitivity.frequency_column() {
                    (size.max(f64::MIN_POSITIVE), &mut by_frequency)
                } else {
                    norm = norm.max(size / scale(column));
                    (scale(column), &mut errors)
                };
                let tail = impulse * found.tail.highest / scale;
                into.tail = into.tail.max(tail);
                into.slow = into.slow.max(tail * found.tail.decay());
                into.fast_share = into.fast_share.max(fast_share);
                into.unresolved =
                    into.unresolved.max(impulse * stiffest * self.unresolved(amplitude) / scale);
            }
        }
        errors.tail /= norm;
        errors.slow /= norm;
        errors.unresolved /= norm;
        Some(self.relative_to_bound(errors).max(self.relative_to_bound(by_frequency)))
    }
}

/// About the part of `exp(i z t)` over a step in the polynomial of that degree: `(z/4)^degree/degree!`, at most 1.
fn highest_part(z: f64, degree: usize) -> f64 {
    let factorial: f64 = (1..=degree).map(|k| k as f64).product();
    ((0.25 * z).powi(degree as i32) / factorial).min(1.0)
}
