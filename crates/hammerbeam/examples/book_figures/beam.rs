//! The modal form of the beam of `studies/beam-with-stop.toml`, by the equations (F2) to (F6) of the book
//! alone: natural frequencies, shapes and participations are those of the reduced structure.

use std::f64::consts::TAU;

use hammerbeam::structure::ReducedModel;

/// Of the study.
const DAMPING_RATIO: f64 = 0.015;
const AMPLITUDE_M: f64 = 0.5015e-3;

/// A complex number.
type Complex = [f64; 2];

/// A mode: a block of the book.
struct Mode {
    /// Square of its natural frequency.
    k: f64,
    /// Its damping.
    c: f64,
    /// Displacement of the contact in it.
    shape: f64,
    /// Amplitude of its particular motion.
    steady: Complex,
}

/// Displacements and velocities of the modes without the particular motion.
pub type Free = Vec<[f64; 2]>;

/// The beam in flight, shaken at one frequency.
pub struct Beam {
    modes: Vec<Mode>,
    circular: f64,
}

fn product(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn ratio(a: Complex, b: Complex) -> Complex {
    let square = b[0] * b[0] + b[1] * b[1];
    product(a, [b[0] / square, -b[1] / square])
}

impl Beam {
    /// The beam at a frequency. Its table moves by `u = U cos(W t)` and loads a mode with `g W^2 U`.
    pub fn new(model: &ReducedModel, frequency_hz: f64) -> Self {
        let circular = TAU * frequency_hz;
        let contact = model.points.iter().find(|point| point.name == "contact").expect("the study names it");
        let modes = model.natural_frequencies.iter().zip(&contact.shape).zip(&model.supports[0].inertia);
        let modes = modes.map(|((&rate, &shape), &participation)| {
            let (k, c) = (rate * rate, 2.0 * DAMPING_RATIO * rate);
            let load = [participation * circular * circular * AMPLITUDE_M, 0.0];
            let steady = ratio(load, [k - circular * circular, circular * c]); // (F4)
            Mode { k, c, shape, steady }
        });
        Self { modes: modes.collect(), circular }
    }

    /// The m-th derivative of the particular motion of a mode, (F4).
    fn particular(&self, mode: &Mode, time: f64, derivative: usize) -> f64 {
        let (sine, cosine) = (self.circular * time).sin_cos();
        let turned = product(mode.steady, [cosine, sine]);
        (0..derivative).fold(turned, |value, _| product(value, [0.0, self.circular]))[0]
    }

    /// What of a modal state `[q; q']` at time 0 is left without the particular motion.
    pub fn without_particular(&self, state: &[f64]) -> Free {
        let (q, v) = state.split_at(self.modes.len());
        let of_mode = |(mode, (q, v)): (&Mode, (&f64, &f64))| {
            [q - self.particular(mode, 0.0, 0), v - self.particular(mode, 0.0, 1)]
        };
        self.modes.iter().zip(q.iter().zip(v)).map(of_mode).collect()
    }

    /// The free part after a time, (F3).
    pub fn carried(&self, free: &Free, time: f64) -> Free {
        let of_mode = |(mode, &[p, s]): (&Mode, &[f64; 2])| {
            let half = 0.5 * mode.c;
            let root = (mode.k - half * half).sqrt();
            let decay = (-half * time).exp();
            let (sine, cosine) = (root * time).sin_cos();
            let (sine, cosine) = (decay * sine / root, decay * cosine);
            [(cosine + half * sine) * p + sine * s, -mode.k * sine * p + (cosine - half * sine) * s]
        };
        self.modes.iter().zip(free).map(of_mode).collect()
    }

    /// Displacement of the contact against the table, upwards, and its three derivatives, (F5).
    pub fn jet(&self, free: &Free, time: f64) -> [f64; 4] {
        let mut jet = [0.0; 4];
        for (mode, &[p, s]) in self.modes.iter().zip(&self.carried(free, time)) {
            let Mode { k, c, shape, .. } = *mode;
            let free = [p, s, -k * p - c * s, c * k * p + (c * c - k) * s];
            for (m, entry) in jet.iter_mut().enumerate() {
                *entry += shape * (free[m] + self.particular(mode, time, m));
            }
        }
        jet
    }

    /// Bounds on the second and the third derivative for all times after a state, (F6).
    pub fn bounds(&self, free: &Free) -> [f64; 2] {
        let drive = self.modes.iter().fold([0.0; 2], |sum, mode| {
            [sum[0] + mode.shape * mode.steady[0], sum[1] + mode.shape * mode.steady[1]]
        });
        let drive = drive[0].hypot(drive[1]);
        let mut bounds = [drive * self.circular.powi(2), drive * self.circular.powi(3)];
        for (mode, &[p, s]) in self.modes.iter().zip(free) {
            let Mode { k, c, shape, .. } = *mode;
            let energy = (k * p * p + s * s).sqrt();
            bounds[0] += shape.abs() * k.sqrt().hypot(c) * energy;
            bounds[1] += shape.abs() * (c * k.sqrt()).hypot(c * c - k) * energy;
        }
        bounds
    }
}
