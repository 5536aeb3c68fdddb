//! From a study file to matrices, forces and stops, without the library.

use std::f64::consts::TAU;

use toml::{Table, Value};

use crate::results::Failure;

/// What a stop does at a relative displacement beyond its gap.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Law {
    /// `k d + c d'`, and a force at the gap [N/m, N s/m, N].
    Linear { stiffness: f64, damping: f64, preload: f64 },
    /// `k d^1.5 (1 + 3/2 a d')` [N/m^1.5, s/m].
    Hertz { stiffness: f64, loss: f64 },
    /// An impact leaves `e` of the speed.
    Rigid { restitution: f64 },
    /// `k1 r + k2 r^2 + k3 r^3`, always.
    Power { terms: [f64; 3] },
}

/// A stop between two masses, or a mass and what carries it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stop {
    /// The relative displacement is `row . y - ratio u`.
    pub row: Vec<f64>,
    pub ratio: f64,
    /// 1 above, -1 below.
    pub side: f64,
    pub gap: f64,
    pub law: Law,
}

/// A force `amplitude cos(order w t + phase)` on each mass [N].
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Harmonic {
    pub row: Vec<f64>,
    pub order: f64,
    pub phase: f64,
}

/// A lumped structure with its stops.
#[derive(Debug, Clone, PartialEq)]
pub struct Equations {
    /// Names of the masses, in their order.
    pub names: Vec<String>,
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
        [self.amplitude * cosine, -w * self.amplitude * sine, -w * w * self.amplitude * cosine]
    }
}

impl Equations {
    /// Reads a study of masses, springs and dampers.
    ///
    /// # Errors
    /// A beam, modal damping, a table of amplitudes, or a law that is not known here.
    pub fn read(study: &Table) -> Result<Self, Failure> {
        let structure = table(study, "structure")?;
        if text(structure, "kind")? != "lumped" {
            return Err("only lumped structures".into());
        }
        let masses = list(structure, "mass");
        let names: Vec<String> =
            masses.iter().map(|mass| text(mass, "name").map(str::to_owned)).collect::<Result<_, _>>()?;
        let mass: Vec<f64> = masses.iter().map(|mass| needed(mass, "mass_kg")).collect::<Result<_, _>>()?;
        let (stiffness, springs) = joined(&names, &list(structure, "spring"), "stiffness_n_m")?;
        let (mut damping, dampers) = joined(&names, &list(structure, "damper"), "damping_n_s_m")?;
        if let Some(value) = study.get("damping") {
            let rayleigh = table(value.as_table().ok_or("[damping] is no table")?, "rayleigh")?;
            let (by_mass, by_stiffness) = (needed(rayleigh, "mass_per_s")?, needed(rayleigh, "stiffness_s")?);
            for i in 0..names.len() {
                damping[i][i] += by_mass * mass[i];
                (0..names.len()).for_each(|j| damping[i][j] += by_stiffness * stiffness[i][j]);
            }
        }
        let mut this =
            Self { names, mass, stiffness, damping, forces: Vec::new(), ground: None, stops: Vec::new() };
        this.shake(study, springs, dampers)?;
        for load in list(study, "load") {
            this.load(load)?;
        }
        for stop in list(study, "stop") {
            let stop = this.stop(stop)?;
            this.stops.extend(stop);
        }
        Ok(this)
    }

    fn shake(&mut self, study: &Table, springs: Vec<f64>, dampers: Vec<f64>) -> Result<(), Failure> {
        let excitation = table(study, "excitation")?;
        let (order, phase) = (number(excitation, "order", 1.0)?, number(excitation, "phase_rad", 0.0)?);
        match text(excitation, "kind")? {
            "force" => {
                let row = self.row(text(excitation, "at")?, needed(excitation, "amplitude_n")?)?;
                self.forces.push(Harmonic { row, order, phase });
            }
            _ if excitation.get("at").and_then(Value::as_str) == Some("ground") => {
                let amplitude = needed(excitation, "amplitude_m")?;
                self.ground = Some(Ground { amplitude, order, phase, springs, dampers });
            }
            _ => return Err("only the ground may be moved".into()),
        }
        Ok(())
    }

    fn load(&mut self, load: &Table) -> Result<(), Failure> {
        let harmonic = match text(load, "kind")? {
            "gravity" => {
                let acceleration = needed(load, "acceleration_m_s2")?;
                let row = self.mass.iter().map(|mass| mass * acceleration).collect();
                Harmonic { row, order: 0.0, phase: 0.0 }
            }
            "force" => Harmonic {
                row: self.row(text(load, "at")?, needed(load, "amplitude_n")?)?,
                order: needed(load, "order")?,
                phase: number(load, "phase_rad", 0.0)?,
            },
            other => return Err(format!("no load of kind {other} here").into()),
        };
        self.forces.push(harmonic);
        Ok(())
    }

    fn row(&self, name: &str, value: f64) -> Result<Vec<f64>, Failure> {
        let place = place(&self.names, name).ok_or_else(|| format!("no mass {name}"))?;
        let mut row = vec![0.0; self.names.len()];
        row[place] = value;
        Ok(row)
    }

    /// One stop, or the two of one on both sides.
    fn stop(&self, stop: &Table) -> Result<Vec<Stop>, Failure> {
        let mut ratio = 0.0;
        let row = if let Some(pair) = stop.get("between").and_then(Value::as_array) {
            let name = |index: usize| pair[index].as_str().ok_or("a name");
            let (mut row, other) = (self.row(name(0)?, 1.0)?, self.row(name(1)?, 1.0)?);
            row.iter_mut().zip(other).for_each(|(entry, other)| *entry -= other);
            row
        } else {
            let carrier = stop.get("fixed_to").and_then(Value::as_str).unwrap_or("ground");
            ratio = f64::from(u8::from(carrier == "ground" && self.ground.is_some()));
            self.row(text(stop, "at")?, 1.0)?
        };
        let rest = match stop.get("gap_measured").and_then(Value::as_str) {
            Some("at-rest") => dot(&row, &self.rest()),
            _ => 0.0,
        };
        let one = |side: f64, gap: f64, law: Law| Stop {
            row: row.clone(),
            ratio,
            side,
            gap: gap + side * rest,
            law,
        };
        let gap = number(stop, "gap_m", 0.0)?;
        let linear = || -> Result<Law, Failure> {
            Ok(Law::Linear {
                stiffness: needed(stop, "stiffness_n_m")?,
                damping: number(stop, "damping_n_s_m", 0.0)?,
                preload: number(stop, "preload_n", 0.0)?,
            })
        };
        let plainly_hertz = stop.contains_key("stiffness_n_m15")
            && !["restitution", "preload_n"].iter().any(|key| stop.contains_key(*key));
        let law = match text(stop, "law")? {
            "two-sided" => {
                let (above, below) = (number(stop, "gap_above_m", gap)?, number(stop, "gap_below_m", gap)?);
                return Ok(vec![one(1.0, above, linear()?), one(-1.0, below, linear()?)]);
            }
            "cubic" => {
                let term = |key: &str| number(stop, key, 0.0);
                let terms = [term("stiffness_n_m")?, term("stiffness_n_m2")?, term("stiffness_n_m3")?];
                return Ok(vec![one(1.0, 0.0, Law::Power { terms })]);
            }
            "linear" => linear()?,
            "hertz" | "hunt-crossley" if plainly_hertz => Law::Hertz {
                stiffness: needed(stop, "stiffness_n_m15")?,
                loss: number(stop, "loss_s_m", 0.0)?,
            },
            "rigid" => Law::Rigid { restitution: needed(stop, "restitution")? },
            other => return Err(format!("no law {other} here").into()),
        };
        let sides = match text(stop, "side")? {
            "above" => &[1.0][..],
            "below" => &[-1.0],
            "both" => &[1.0, -1.0],
            other => return Err(format!("no side {other} here").into()),
        };
        // A preloaded stop is in touch when the structure is undeformed, and opens where its force is gone.
        let gap = match law {
            Law::Linear { stiffness, preload, .. } => gap - preload / stiffness,
            _ => gap,
        };
        Ok(sides.iter().map(|side| one(*side, gap, law.clone())).collect())
    }

    /// Where the structure rests under its constant forces, without any stop.
    fn rest(&self) -> Vec<f64> {
        let mut force = vec![0.0; self.names.len()];
        for constant in self.forces.iter().filter(|force| force.order == 0.0) {
            force.iter_mut().zip(&constant.row).for_each(|(sum, part)| *sum += part);
        }
        solved(self.stiffness.clone(), force)
    }

    /// A bound of the highest eigenfrequency [rad/s], contacts included, by the sum of rows.
    pub(super) fn fastest(&self) -> f64 {
        let n = self.names.len();
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

/// The matrix of elements between masses, and what joins each mass to the ground.
fn joined(names: &[String], elements: &[&Table], key: &str) -> Result<(Vec<Vec<f64>>, Vec<f64>), Failure> {
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

fn place(names: &[String], name: &str) -> Option<usize> {
    names.iter().position(|known| known == name)
}

fn table<'a>(table: &'a Table, key: &str) -> Result<&'a Table, Failure> {
    table.get(key).and_then(Value::as_table).ok_or_else(|| format!("no table {key}").into())
}

fn list<'a>(table: &'a Table, key: &str) -> Vec<&'a Table> {
    let entries = table.get(key).and_then(Value::as_array);
    entries.into_iter().flatten().filter_map(Value::as_table).collect()
}

fn text<'a>(table: &'a Table, key: &str) -> Result<&'a str, Failure> {
    table.get(key).and_then(Value::as_str).ok_or_else(|| format!("no text {key}").into())
}

fn needed(table: &Table, key: &str) -> Result<f64, Failure> {
    let value = table.get(key).ok_or_else(|| format!("no number {key}"))?;
    let number = value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    number.ok_or_else(|| format!("{key} is no number").into())
}

fn number(table: &Table, key: &str, default: f64) -> Result<f64, Failure> {
    if table.contains_key(key) { needed(table, key) } else { Ok(default) }
}
