//! Reading a study: its structure, what shakes it, its stops.

use hammerbeam_study::Model;
use toml::{Table, Value};

use super::{
    equations::{Equations, dot},
    keys::{list, needed, number, table, text},
    stops::{Law, Stop},
};
use crate::results::BoxedError;

impl Equations {
    /// Reads a study.
    ///
    /// * `model`: what the library made of it, for the modes of a beam.
    ///
    /// # Errors
    /// A shaken beam, a lumped structure with modal damping, a longer table of amplitudes, or a law that is
    /// not known here.
    pub fn read(study: &Table, model: &Model) -> Result<Self, BoxedError> {
        let (mut this, springs, dampers) = if text(table(study, "structure")?, "kind")? == "beam" {
            let this = Self::of_modes(study, model)?;
            (this, Vec::new(), Vec::new())
        } else {
            Self::of_masses(study)?
        };
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

    /// One stop, or the two of one on both sides.
    fn stop(&self, stop: &Table) -> Result<Vec<Stop>, BoxedError> {
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
        let linear = || -> Result<Law, BoxedError> {
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
}
