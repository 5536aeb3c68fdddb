//! Frequencies over which the linear response reaches a contact.
//!
//! Without local forces the steady motion is known in closed form, and with it the depth to which it would
//! enter a contact, `d(f) = max_t s (r(t) - level)`. Where `d > 0` the linear response is no motion of the
//! system: what happens there begins at the zeros of `d`, at which the linear response grazes. Of one mass on
//! a spring, driven by a force, `d = F/(m |w0^2 - W^2 + i c W/m|) - gap`, so that impacts span the
//! frequencies about the resonance at which the amplitude exceeds the gap.
//!
//! `d` is smooth but for its peaks at the resonances, whose widths are known: it is sampled there as closely
//! as they ask for, and its zeros are bisected. What lies between is no wider than a line width of a
//! resonance and is where to look, not a result.

use hammerbeam_motion::{Stretch, System, exact::ExactIntegrator};

use crate::{OrbitError, OrbitSettings, Response, solve::integrator};

/// Samples of a cycle of the highest order of the load.
const SAMPLES: u32 = 16;
/// Frequencies between the ends of the range at which the depth is looked at, besides those about resonances.
const ACROSS: u32 = 64;
/// Doublings of the distance from a resonance, from half its line width on.
const DOUBLINGS: i32 = 12;
/// Bisections of a zero.
const BISECTIONS: usize = 40;

/// Ranges of the frequency within `range_hz` [Hz], ascending, over which the linear response reaches a
/// contact, of all contacts that it reaches over a part of `range_hz` only.
///
/// # Errors
/// [`OrbitError::Motion`] if no integrator can be made for the system.
pub fn linear_contact_ranges(
    system: &System,
    response: &Response,
    range_hz: (f64, f64),
    settings: &OrbitSettings,
) -> Result<Vec<[f64; 2]>, OrbitError> {
    let mut integrator = integrator(system, response, settings)?;
    let looked_at = frequencies(system, range_hz);
    let mut ranges = Vec::new();
    for element in 0..system.elements().len() {
        if system.elements()[element].law.contacts().is_empty() {
            continue;
        }
        let depths: Vec<f64> = looked_at.iter().map(|&at| depth(&mut integrator, element, at)).collect();
        let mut entered = (depths[0] > 0.0).then_some(range_hz.0);
        for (at, pair) in looked_at.windows(2).zip(depths.windows(2)) {
            match (pair[0] > 0.0, pair[1] > 0.0) {
                (false, true) => entered = Some(zero(&mut integrator, element, (at[0], at[1]))),
                (true, false) => {
                    let left = zero(&mut integrator, element, (at[1], at[0]));
                    ranges.extend(entered.take().map(|entered| [entered, left]));
                }
                _ => {}
            }
        }
        ranges.extend(entered.filter(|&at| at > range_hz.0).map(|entered| [entered, range_hz.1]));
    }
    ranges.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    Ok(ranges)
}

/// Where the depth is looked at, ascending: across the range, and about each resonance of each order at
/// distances that double.
fn frequencies(system: &System, (low, high): (f64, f64)) -> Vec<f64> {
    let across = |k: u32| low + (high - low) * f64::from(k) / f64::from(ACROSS);
    let mut all: Vec<f64> = (0..=ACROSS).map(across).collect();
    let model = system.model();
    for (mode, w) in model.natural_frequencies.iter().enumerate() {
        for &order in system.orders().iter().filter(|&&order| order > 0) {
            let per_order = std::f64::consts::TAU * f64::from(order);
            let (centre, width) = (w / per_order, 0.5 * model.damping[(mode, mode)] / per_order);
            let width = width.max(1e-6 * centre);
            all.push(centre);
            for doubling in -1..=DOUBLINGS {
                let away = width * 2f64.powi(doubling);
                all.extend([centre - away, centre + away]);
            }
        }
    }
    all.retain(|at| (low..=high).contains(at));
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// How deep the linear response enters the contacts of an element [m], a parabola through the deepest
/// samples.
fn depth(integrator: &mut ExactIntegrator, element: usize, frequency_hz: f64) -> f64 {
    let order = integrator.system().orders().last().copied().unwrap_or(1).max(1);
    let count = SAMPLES * order;
    let at = |sample: u32| f64::from(sample) / f64::from(count);
    let mut sample = |k: u32| {
        let stretch = Stretch { frequency_hz, start: at(k), end: at(k) + 1.0 };
        let state = integrator.steady_state(&stretch);
        let depth = integrator.system().depth_in_contact(element, frequency_hz, at(k), &state);
        depth.unwrap_or(f64::NEG_INFINITY)
    };
    let depths: Vec<f64> = (0..count).map(&mut sample).collect();
    let n = depths.len();
    let deepest = (0..n).max_by(|&a, &b| depths[a].total_cmp(&depths[b])).unwrap_or(0);
    let (before, here, after) = (depths[(deepest + n - 1) % n], depths[deepest], depths[(deepest + 1) % n]);
    let bend = before - 2.0 * here + after;
    if bend < 0.0 { here - (after - before).powi(2) / (8.0 * bend) } else { here }
}

/// The frequency between one at which no contact is reached and one at which it is, where that begins.
fn zero(integrator: &mut ExactIntegrator, element: usize, (mut without, mut with): (f64, f64)) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (without + with);
        if depth(integrator, element, middle) > 0.0 { with = middle } else { without = middle }
    }
    with
}
