//! How far about the motion without contacts searches for other motions begin.
//!
//! Six reaches, from half the linear motion to sixteen times as much, over and over. Beyond resonance, or
//! where a constant load hides that motion at phase 0, none of them may come to a stop, and from states that
//! reach none all go back to the linear motion. Then every second start reaches for the nearest gap: half as
//! far, as far and twice as far.
//!
//! But for a gap that no periodic motion can be as large as: the load puts in `F v` and damping takes `d v^2`
//! at least, so that the velocity of a periodic motion is at most about `F/d`.

use std::f64::consts::TAU;

use crate::{LocalElement, System};

/// Reaches about the linear motion, relative to it.
const REACHES: [f64; 6] = [0.5, 1.0, 2.0, 4.0, 8.0, 16.0];
/// Reaches of every second start, relative to the nearest gap.
const TO_GAP: [f64; 3] = [0.5, 1.0, 2.0];

/// How far from the linear motion a search puts its start of that number, from 0: a velocity [kg^1/2 m/s].
/// States of the reach V have displacements of mode i, from 0, of about `V/max(w_i, 2 pi f)/(i + 1)`: low
/// modes move most.
///
/// * `linear`: velocity of the linear motion.
#[must_use]
pub fn start_reach(system: &System, frequency_hz: f64, linear: f64, start: usize) -> f64 {
    let about_linear = linear * REACHES[start % REACHES.len()];
    let is_for_gap = start % 2 == 1;
    match speed_to_gap(system, frequency_hz).filter(|_| is_for_gap) {
        Some(speed)
            if speed > linear * REACHES[REACHES.len() - 1]
                && speed <= largest_speed(system, frequency_hz) =>
        {
            speed * TO_GAP[start / 2 % TO_GAP.len()]
        }
        _ => about_linear,
    }
}

/// Reach that comes to the nearest stop which the undeformed structure does not touch; `None` without one.
fn speed_to_gap(system: &System, frequency_hz: f64) -> Option<f64> {
    let speed = |element: &LocalElement| {
        let modes = element.shape.iter().zip(&system.model().natural_frequencies).enumerate();
        let part =
            |(i, (phi, w)): (usize, (&f64, &f64))| phi.abs() / w.max(TAU * frequency_hz) / (i + 1) as f64;
        let per_speed: f64 = modes.map(part).sum();
        let open = element.law.contacts().iter().filter(|contact| contact.sign * contact.level > 0.0);
        let nearest = open.map(|contact| contact.level.abs()).reduce(f64::min)?;
        Some(nearest / per_speed).filter(|speed| speed.is_finite())
    };
    system.elements().iter().filter_map(speed).reduce(f64::min)
}

/// About the largest velocity of a periodic motion, `F/d` with the load of all harmonics and the least
/// damping of a mode; 0 where that is none, and nothing bounds it.
fn largest_speed(system: &System, frequency_hz: f64) -> f64 {
    let damping = &system.model().damping;
    let least = (0..system.dof()).map(|i| damping[(i, i)]).fold(f64::INFINITY, f64::min);
    if least <= 0.0 {
        return 0.0;
    }
    let works = system.orders().iter().enumerate().filter(|(_, order)| **order > 0);
    let load = |(index, _)| {
        let amplitudes = system.modal_load(index, frequency_hz).amplitude;
        amplitudes.iter().map(|b| b.norm_sqr()).sum::<f64>().sqrt()
    };
    works.map(load).sum::<f64>() / least
}
