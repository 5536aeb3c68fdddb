//! Forecasts of a contact from its energy: how long it lasts, and how deep it goes.
//!
//! With the mobility G and the law `f = K p^e` the penetration p of a closed contact obeys about `p'' = -c -
//! G K p^e`, c being the acceleration with which the free motion leaves the stop. With the present p and
//! speed w, energy gives the depth P from `w^2/2 = c (P - p) + G K/(e+1) (P^(e+1) - p^(e+1))`, and the time
//! between P and p is the integral of `dx/v(x)`. Good to some percent (less where the contact loses energy,
//! which is left out): a start for Newton's method, and a first length.

use super::{ExactIntegrator, contact_phase::AT_REST, flight::clearance_of, run::Run};

/// Nodes and weights of Gauss-Legendre with four nodes on [0, 1].
const GAUSS_4: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// The motion of a contact under its own force and a constant acceleration.
struct Bounce {
    /// `c`, not negative.
    leaving: f64,
    /// `G K/(e + 1)`.
    gain: f64,
    /// `e + 1`.
    power: f64,
}

impl Bounce {
    /// Potential at a penetration.
    fn potential(&self, x: f64) -> f64 {
        self.leaving * x + self.gain * power_of(x, self.power)
    }

    /// Penetration at which the potential has this value, by Newton's method from above (the potential is
    /// convex).
    fn depth(&self, energy: f64) -> f64 {
        let elastic = (energy / self.gain).powf(1.0 / self.power);
        if self.leaving == 0.0 {
            return elastic;
        }
        let mut x = elastic.min(energy / self.leaving);
        for _ in 0..8 {
            let force = self.leaving + self.power * self.gain * power_of(x, self.power - 1.0);
            let change = (self.potential(x) - energy) / force;
            x -= change;
            if change.abs() <= 1e-3 * x {
                break;
            }
        }
        x
    }

    /// Time from the penetration `from` to the turning point `depth`; `x = depth (1 - w^2)` takes out the
    /// root at the turn.
    fn time(&self, from: f64, depth: f64) -> f64 {
        let energy = self.potential(depth);
        let range = (1.0 - from / depth).max(0.0).sqrt();
        let slowness = |w: f64| {
            let kinetic = (energy - self.potential(depth * (1.0 - w * w))).max(f64::MIN_POSITIVE);
            2.0 * depth * w / (2.0 * kinetic).sqrt()
        };
        GAUSS_4.iter().map(|&(x, weight)| weight * slowness(range * x)).sum::<f64>() * range
    }
}

/// A power of a number that is not negative, without a logarithm where the exponent is a multiple of a half,
/// as in all laws.
fn power_of(x: f64, exponent: f64) -> f64 {
    let whole = exponent.floor();
    match exponent - whole {
        0.0 => x.powi(whole as i32),
        0.5 => x.powi(whole as i32) * x.sqrt(),
        _ => x.powf(exponent),
    }
}

impl ExactIntegrator {
    /// The first closed contact that is expected to open, and in what time; `None` where the contact force is
    /// not what turns the motion.
    pub(super) fn first_forecast(&self, run: &Run, touched: Option<usize>) -> Option<(usize, f64)> {
        let of_element = |&element: &usize| self.forecast(run, element, touched == Some(element));
        self.step.active.iter().filter_map(of_element).min_by(|x, y| x.1.total_cmp(&y.1))
    }

    fn forecast(&self, run: &Run, element: usize, touched: bool) -> Option<(usize, f64)> {
        let contact = self.closed_contact(run, element)?;
        let clearance = clearance_of(run.start[element].jet, contact.level, contact.sign);
        let (penetration, speed) = (if touched { 0.0 } else { -clearance.value }, -clearance.slope);
        // Struck without speed it may stay or leave: the other forces decide, and its own does not turn it.
        if touched && speed.abs() <= AT_REST * run.start[element].velocity {
            return None;
        }
        let mobility = self.mobility[element][element];
        let power = contact.onset_exponent + 1.0;
        // The coefficient K of the law, read off it where it is loaded.
        let probe = if penetration > 0.0 { penetration } else { 1e-6 };
        let force = self.laws[element].force(contact.level + contact.sign * probe, 0.0).value.abs();
        let coefficient = force / power_of(probe, contact.onset_exponent);
        let gain = mobility * coefficient / power;
        if gain == 0.0 {
            return None;
        }
        if !touched {
            let elastic = mobility * force;
            if penetration <= 0.0 || (clearance.curvature + elastic) < 0.5 * elastic {
                return None;
            }
        }
        let leaving = if touched { clearance.curvature.max(0.0) } else { 0.0 };
        let bounce = Bounce { leaving, gain, power };
        let depth = bounce.depth(0.5 * speed * speed + bounce.potential(penetration));
        if depth.is_nan() || depth <= 0.0 {
            return None;
        }
        let falling = bounce.time(0.0, depth);
        let rising = if penetration == 0.0 { falling } else { bounce.time(penetration, depth) };
        let time = if speed > 0.0 { falling + rising } else { falling - rising };
        (time > 0.0).then_some((element, time))
    }
}
