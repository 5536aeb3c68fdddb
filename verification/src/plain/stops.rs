//! Stops of a study file.

use toml::{Table, Value};

use super::{
    equations::{Equations, dot},
    keys::{needed, number, text},
};
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

impl Equations {
    /// One stop, or the two of one on both sides.
    pub(super) fn stop(&self, stop: &Table) -> Result<Vec<Stop>, Failure> {
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
}
