//! From a study file to matrices, forces and stops, without the library.

use std::f64::consts::TAU;

use hammerbeam_study::Model;
use toml::{Table, Value};

use super::{
    coordinates::{Coordinates, place},
    keys::{list, needed, number, table, text},
    stops::{Law, Stop},
};
use crate::results::BoxedError;

/// A force `amplitude cos(order w t + phase)` on each mass [N], times what the frequency makes of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Harmonic {
    pub row: Vec<f64>,
    pub order: f64,
    pub phase: f64,
    pub size: Size,
}

/// How an amplitude depends on the frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Size {
    /// Not at all.
    Kept,
    /// That of an unbalance, `(order w)^2`.
    Unbalance,
    /// A straight line through two points `[frequency, amplitude]`.
    Line([[f64; 2]; 2]),
}

impl Size {
    pub(super) fn at(self, order: f64, frequency_hz: f64) -> f64 {
        match self {
            Self::Kept => 1.0,
            Self::Unbalance => (TAU * order * frequency_hz).powi(2),
            Self::Line([[f, a], [g, b]]) => a + (b - a) * (frequency_hz - f) / (g - f),
        }
    }
}

/// A structure with its stops.
#[derive(Debug, Clone, PartialEq)]
pub struct Equations {
    /// What the numbers of a state are.
    pub coordinates: Coordinates,
    pub(super) mass: Vec<f64>,
    pub(super) stiffness: Vec<Vec<f64>>,
    pub(super) damping: Vec<Vec<f64>>,
    pub(super) forces: Vec<Harmonic>,
    /// Amplitude [m] and phase of the ground's motion, and its springs and dampers to each mass.
    pub(super) ground: Option<Ground>,
    pub(super) stops: Vec<Stop>,
}

/// A ground that moves as `amplitude cos(order w t + phase)`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ground {
    pub amplitude: f64,
    /// Whether the amplitude is that of the acceleration [m/s^2].
    pub is_acceleration: bool,
    pub order: f64,
    pub phase: f64,
    pub springs: Vec<f64>,
    pub dampers: Vec<f64>,
}

impl Ground {
    /// Displacement, velocity and acceleration.
    pub(super) fn motion(&self, frequency_hz: f64, time: f64) -> [f64; 3] {
        let w = TAU * self.order * frequency_hz;
        let (sine, cosine) = (w * time + self.phase).sin_cos();
        let a = if self.is_acceleration { -self.amplitude / (w * w) } else { self.amplitude };
        [a * cosine, -w * a * sine, -w * w * a * cosine]
    }
}

impl Equations {
    /// `q'' + C q' + W^2 q` of a beam.
    pub(super) fn of_modes(study: &Table, model: &Model) -> Result<Self, BoxedError> {
        let squares: Vec<f64> =
            model.system.model().natural_frequencies.iter().map(|frequency| frequency.powi(2)).collect();
        let damping: Vec<f64> = match study.get("damping").and_then(Value::as_table) {
            None => vec![0.0; squares.len()],
            Some(damping) if damping.contains_key("modal_ratio") => {
                let ratio = needed(damping, "modal_ratio")?;
                squares.iter().map(|square| 2.0 * ratio * square.sqrt()).collect()
            }
            Some(damping) => {
                let [by_mass, by_stiffness] = rayleigh(damping)?;
                squares.iter().map(|square| by_mass + by_stiffness * square).collect()
            }
        };
        Ok(Self {
            coordinates: Coordinates::of_modes(model),
            mass: vec![1.0; squares.len()],
            stiffness: diagonal(&squares),
            damping: diagonal(&damping),
            forces: Vec::new(),
            ground: None,
            stops: Vec::new(),
        })
    }

    /// The matrices of masses, and what joins each to the ground.
    pub(super) fn of_masses(study: &Table) -> Result<(Self, Vec<f64>, Vec<f64>), BoxedError> {
        let structure = table(study, "structure")?;
        let masses = list(structure, "mass");
        let names: Vec<String> =
            masses.iter().map(|mass| text(mass, "name").map(str::to_owned)).collect::<Result<_, _>>()?;
        let mass: Vec<f64> = masses.iter().map(|mass| needed(mass, "mass_kg")).collect::<Result<_, _>>()?;
        let (stiffness, springs) = joined(&names, &list(structure, "spring"), "stiffness_n_m")?;
        let (mut damping, dampers) = joined(&names, &list(structure, "damper"), "damping_n_s_m")?;
        if let Some(value) = study.get("damping") {
            let [by_mass, by_stiffness] = rayleigh(value.as_table().ok_or("[damping] is no table")?)?;
            for i in 0..names.len() {
                damping[i][i] += by_mass * mass[i];
                (0..names.len()).for_each(|j| damping[i][j] += by_stiffness * stiffness[i][j]);
            }
        }
        let coordinates = Coordinates::Masses(names);
        let this = Self {
            coordinates,
            mass,
            stiffness,
            damping,
            forces: Vec::new(),
            ground: None,
            stops: Vec::new(),
        };
        Ok((this, springs, dampers))
    }

    pub(super) fn shake(
        &mut self,
        study: &Table,
        springs: Vec<f64>,
        dampers: Vec<f64>,
    ) -> Result<(), BoxedError> {
        let excitation = table(study, "excitation")?;
        let (order, phase) = (number(excitation, "order", 1.0)?, number(excitation, "phase_rad", 0.0)?);
        match text(excitation, "kind")? {
            "force" if excitation.contains_key("force") => {
                for force in list(excitation, "force") {
                    let (row, size) = self.force(force)?;
                    let phase = number(force, "phase_rad", 0.0)?;
                    self.forces.push(Harmonic { row, order, phase, size });
                }
            }
            "force" => {
                let (row, size) = self.force(excitation)?;
                self.forces.push(Harmonic { row, order, phase, size });
            }
            _ if excitation.get("at").and_then(Value::as_str) == Some("ground") => {
                let is_acceleration = excitation.contains_key("amplitude_m_s2");
                let key = if is_acceleration { "amplitude_m_s2" } else { "amplitude_m" };
                let amplitude = needed(excitation, key)?;
                self.ground = Some(Ground { amplitude, is_acceleration, order, phase, springs, dampers });
            }
            _ => return Err("only the ground of masses may be moved".into()),
        }
        Ok(())
    }

    pub(super) fn load(&mut self, load: &Table) -> Result<(), BoxedError> {
        let harmonic = match text(load, "kind")? {
            "gravity" if matches!(self.coordinates, Coordinates::Modes(_)) => {
                return Err("no weight of a beam here".into());
            }
            "gravity" => {
                let acceleration = needed(load, "acceleration_m_s2")?;
                let row = self.mass.iter().map(|mass| mass * acceleration).collect();
                Harmonic { row, order: 0.0, phase: 0.0, size: Size::Kept }
            }
            "force" => {
                let (row, size) = self.force(load)?;
                Harmonic { row, order: needed(load, "order")?, phase: number(load, "phase_rad", 0.0)?, size }
            }
            other => return Err(format!("no load of kind {other} here").into()),
        };
        self.forces.push(harmonic);
        Ok(())
    }

    /// A force at a point or against another, and how it depends on the frequency.
    fn force(&self, force: &Table) -> Result<(Vec<f64>, Size), BoxedError> {
        let (value, size) = match force.get("amplitude_n").and_then(Value::as_array) {
            Some(points) => (1.0, Size::Line(two_points(points)?)),
            None if force.contains_key("unbalance_mass_kg") => {
                let moment = needed(force, "unbalance_mass_kg")? * needed(force, "eccentricity_m")?;
                (moment, Size::Unbalance)
            }
            None => (needed(force, "amplitude_n")?, Size::Kept),
        };
        let Some(pair) = force.get("between").and_then(Value::as_array) else {
            return Ok((self.row(text(force, "at")?, value)?, size));
        };
        let name = |place: usize| pair.get(place).and_then(Value::as_str).ok_or("no two names");
        let (one, other) = (self.row(name(0)?, value)?, self.row(name(1)?, value)?);
        Ok((one.iter().zip(other).map(|(one, other)| one - other).collect(), size))
    }

    pub(super) fn row(&self, name: &str, value: f64) -> Result<Vec<f64>, BoxedError> {
        let row = self.coordinates.row(name).ok_or_else(|| format!("no point {name}"))?;
        Ok(row.into_iter().map(|part| value * part).collect())
    }

    /// Where the structure rests under its constant forces, without any stop.
    pub(super) fn rest(&self) -> Vec<f64> {
        let mut force = vec![0.0; self.mass.len()];
        for constant in self.forces.iter().filter(|force| force.order == 0.0) {
            force.iter_mut().zip(&constant.row).for_each(|(sum, part)| *sum += part);
        }
        solved(self.stiffness.clone(), force)
    }

    /// A bound of the highest eigenfrequency [rad/s], contacts included, by the sum of rows.
    pub(super) fn fastest(&self) -> f64 {
        let n = self.mass.len();
        let mut bound: f64 = 0.0;
        for i in 0..n {
            let mut row: Vec<f64> = self.stiffness[i].clone();
            for stop in &self.stops {
                let stiffness = match &stop.law {
                    Law::Linear { stiffness, .. } => *stiffness,
                    _ => 0.0,
                };
                (0..n).for_each(|j| row[j] += stiffness * stop.row[i] * stop.row[j]);
            }
            let damping: f64 = self.damping[i].iter().map(|entry| entry.abs()).sum::<f64>() / self.mass[i];
            bound = bound.max((row.iter().map(|entry| entry.abs()).sum::<f64>() / self.mass[i]).sqrt());
            bound = bound.max(damping);
        }
        bound
    }
}

/// A table of amplitudes of two points, between which it is straight.
fn two_points(points: &[Value]) -> Result<[[f64; 2]; 2], BoxedError> {
    let pair = |point: &Value| -> Option<[f64; 2]> {
        let entries = point.as_array()?;
        Some([entries.first()?.as_float()?, entries.get(1)?.as_float()?])
    };
    match points {
        [one, other] => Ok([pair(one).ok_or("no pair")?, pair(other).ok_or("no pair")?]),
        _ => Err("only tables of two points here".into()),
    }
}

/// Factors of mass and stiffness in the damping [1/s, s].
fn rayleigh(damping: &Table) -> Result<[f64; 2], BoxedError> {
    let rayleigh = table(damping, "rayleigh")?;
    Ok([needed(rayleigh, "mass_per_s")?, needed(rayleigh, "stiffness_s")?])
}

fn diagonal(entries: &[f64]) -> Vec<Vec<f64>> {
    let n = entries.len();
    (0..n).map(|i| (0..n).map(|j| if i == j { entries[i] } else { 0.0 }).collect()).collect()
}

/// The matrix of elements between masses, and what joins each mass to the ground.
fn joined(names: &[String], elements: &[&Table], key: &str) -> Result<(Vec<Vec<f64>>, Vec<f64>), BoxedError> {
    let n = names.len();
    let (mut matrix, mut ground) = (vec![vec![0.0; n]; n], vec![0.0; n]);
    for element in elements {
        let value = needed(element, key)?;
        let ends = element.get("between").and_then(Value::as_array).ok_or("an element between two")?;
        let ends: Vec<Option<usize>> =
            ends.iter().map(|end| end.as_str().and_then(|name| place(names, name))).collect();
        for end in ends.iter().flatten() {
            matrix[*end][*end] += value;
        }
        match ends[..] {
            [Some(a), Some(b)] => {
                matrix[a][b] -= value;
                matrix[b][a] -= value;
            }
            [Some(a), None] | [None, Some(a)] => ground[a] += value,
            _ => return Err("an element between nothing".into()),
        }
    }
    Ok((matrix, ground))
}

/// The solution of `a x = b`, by elimination with row exchange.
pub(super) fn solved(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).unwrap_or(k);
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            for j in k..n {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
