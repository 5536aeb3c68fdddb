//! Where a curve of folds comes to orbits that are their own images, and ends.
//!
//! # Mathematics
//! Pairs of orbits branch off from their own images (`image.rs`) as `x (mu + b x^2 + c x^4) = 0`, with x half
//! the way between the two of a pair. Their folds lie at `b = -2 c x^2`, `mu = c x^4`: a curve that comes for
//! `x -> 0`, with the parameters in `x^2`, to the place `mu = b = 0` on the curve of flips of the map over
//! half the period, at which these change their criticality. Behind it comes its own image, over the same
//! parameters, so it ends there: at a *degenerate flip* or, where the orbits become symmetric, at a
//! *degenerate branch point* (of the pitchfork).
//!
//! The equations of the curve hold on the curve of flips as well, and that three times: with `mu` eliminated
//! they are `x^3 (b + 2 c x^2) = 0`. So what they know of the place is rounding over `x^3`, and their steps
//! get short before it. The place itself is regular in the equations of the half: from the last rows the own
//! image, frequency and parameter are extrapolated to `x^2 = 0`, corrected on the curve of flips, and this is
//! followed to the zero of the coefficient of its normal form. It is the end of the curve if it lies where
//! the rows lead to, and the whole orbit there solves the equations of the curve.
//!
//! # Source
//! Golubitsky and Schaeffer, *Singularities and Groups in Bifurcation Theory* I (1985), chapter VI;
//! Kuznetsov, *Elements of Applied Bifurcation Theory* (2004), section 9.4 (generalised flip).

use hammerbeam_path::StartDirection;

use super::{
    closing::half_of,
    image::{Apart, apart, nodes_from_first, unfolded},
    problem::CurveProblem,
    row::CurveSettings,
    shooting::{CurveOrbit, Shooting},
};
use crate::{OrbitError, OrbitSettings, Response, by_rows::dot, solve::integrator};

/// Asymmetry, relative to the orbit, within which the end is looked for.
const NEAR: f64 = 0.05;
/// Asymmetry, relative to the orbit, below which an orbit is its own image.
const OWN: f64 = 1e-6;
/// How far the asymmetry comes down before it is looked for again.
const AGAIN: f64 = 0.5;
/// How far before it the curve of flips starts, in hundredths of the range of the parameter.
const AHEAD: f64 = 0.02;
/// Distance of the place from where the rows lead, relative to their own distance.
const OFF: f64 = 0.5;
/// Squares of asymmetries from whose ratio on a line is drawn through them.
const APART: f64 = 0.8;

/// A row beside its image.
#[derive(Debug, Clone)]
struct Beside {
    apart: Apart,
    /// Phase, frequency and parameter.
    phase: f64,
    at: [f64; 2],
}

impl Beside {
    /// `x^2`, relative to the orbit.
    fn square(&self) -> f64 {
        dot(&self.apart.odd, &self.apart.odd) / dot(&self.apart.mean, &self.apart.mean).max(f64::MIN_POSITIVE)
    }
}

/// Where a curve ends.
pub(super) struct Met {
    /// The orbit that is its own image, cut like the orbits of the curve.
    pub place: CurveOrbit,
    /// How well that is known, relative to the orbit.
    pub off: f64,
    /// Whether the last row lies behind it.
    pub is_behind: bool,
}

/// What the rows of a curve show about such an end.
#[derive(Debug)]
pub(super) struct Approach {
    response: Response,
    orbits: OrbitSettings,
    last: Option<Beside>,
    /// The least `x` for which the end was looked for.
    looked: f64,
}

/// A degenerate flip of the map over half the period.
pub(super) struct DegenerateFlip {
    /// The equations of the half.
    pub shooting: Shooting,
    pub place: CurveOrbit,
    /// How well it is known.
    pub off: f64,
}

/// The first degenerate flip on the curve of flips of a map over half a period, from a place on in a
/// direction; `None` if it has none within some rows, or no curve is found there.
pub(super) type FollowHalf = fn(
    Shooting,
    &CurveOrbit,
    StartDirection<'_>,
    &CurveSettings,
) -> Result<Option<DegenerateFlip>, OrbitError>;

/// The own image to which rows seem to lead.
struct ExtrapolatedImage {
    mean: Vec<f64>,
    phase: f64,
    at: [f64; 2],
    /// The last row but one.
    from: [f64; 2],
}

impl Approach {
    pub fn new(response: &Response, orbits: &OrbitSettings) -> Self {
        Self { response: response.clone(), orbits: *orbits, last: None, looked: f64::INFINITY }
    }

    /// Where the curve ends, if its new row at `place` shows that it comes there.
    pub fn meets(
        &mut self,
        problem: &mut CurveProblem,
        place: &CurveOrbit,
        settings: &CurveSettings,
        follow: FollowHalf,
    ) -> Option<Met> {
        let apart = apart(&mut problem.shooting, place).ok()?;
        let new = Beside { apart, phase: place.phase, at: [place.frequency_hz, place.value] };
        let last = self.last.replace(new.clone())?;
        let was_own_image = last.square().sqrt() < OWN;
        if was_own_image || last.phase != new.phase || !self.looks(&last, &new) {
            return None;
        }
        // What cannot be followed there is no such end.
        let (place, off) = self.find(problem, &extrapolate(&last, &new), settings, follow).ok().flatten()?;
        Some(Met { place, off, is_behind: dot(&last.apart.odd, &new.apart.odd) < 0.0 })
    }

    /// Whether two rows one after the other ask for a look.
    fn looks(&mut self, last: &Beside, new: &Beside) -> bool {
        let x = new.square().sqrt();
        let passes = dot(&last.apart.odd, &new.apart.odd) < 0.0;
        let comes_near = x < NEAR && x < AGAIN * self.looked && new.square() < last.square();
        if comes_near {
            self.looked = x;
        }
        passes || comes_near
    }

    /// The zero to which the curve of flips of the half leads, and how well it is known, if it is where rows
    /// lead.
    fn find(
        &self,
        problem: &mut CurveProblem,
        expected: &ExtrapolatedImage,
        settings: &CurveSettings,
        follow: FollowHalf,
    ) -> Result<Option<(CurveOrbit, f64)>, OrbitError> {
        for (direction, sign) in [(StartDirection::Increasing, 1.0), (StartDirection::Decreasing, -1.0)] {
            let (shooting, mut place) = self.half(&problem.shooting, expected)?;
            place.value -= sign * AHEAD * problem.units[1];
            if let Some(mut flip) = follow(shooting, &place, direction, settings)? {
                let units = problem.units;
                let at = [flip.place.frequency_hz, flip.place.value];
                let is_there = distance(at, expected.at, units) <= OFF * distance(at, expected.from, units);
                let whole = unfolded(&mut flip.shooting, &flip.place, &problem.shooting, problem.cut_phase)?;
                return Ok(is_there.then_some((whole, flip.off)));
            }
        }
        Ok(None)
    }

    /// The map over half the period, and the own image to which rows lead.
    fn half(
        &self,
        of: &Shooting,
        expected: &ExtrapolatedImage,
    ) -> Result<(Shooting, CurveOrbit), OrbitError> {
        let (period_multiple, closing) = half_of(of.period_multiple);
        let mut integrator = integrator(of.integrator.system(), &self.response, &self.orbits)?;
        integrator.differentiate_by(Some(of.parameter))?;
        let mut half = Shooting {
            touches: vec![0; integrator.touches().len()],
            integrator,
            parameter: of.parameter,
            period_multiple,
            closing,
            scale: of.scale.clone(),
            count: of.count.div_ceil(2),
            segments: Vec::new(),
            products: Vec::new(),
            grazing_distance: f64::INFINITY,
            passing: None,
        };
        let [frequency_hz, value] = expected.at;
        half.set_parameter(value)?;
        let one = CurveOrbit { nodes: expected.mean.clone(), frequency_hz, phase: expected.phase, value };
        let nodes = nodes_from_first(&mut half, &one)?;
        Ok((half, CurveOrbit { nodes, ..one }))
    }
}

/// Where the line through two rows over `x^2` comes to zero.
fn extrapolate(last: &Beside, new: &Beside) -> ExtrapolatedImage {
    let (far, near) = if last.square() < new.square() { (new, last) } else { (last, new) };
    let ratio = near.square() / far.square();
    let share = if ratio < APART { ratio / (1.0 - ratio) } else { 0.0 };
    let line = |far: &[f64], near: &[f64]| -> Vec<f64> {
        far.iter().zip(near).map(|(far, near)| near + share * (near - far)).collect()
    };
    let at = line(&far.at, &near.at);
    ExtrapolatedImage {
        mean: line(&far.apart.mean, &near.apart.mean),
        phase: new.phase,
        at: [at[0], at[1]],
        from: far.at,
    }
}

fn distance(a: [f64; 2], b: [f64; 2], units: [f64; 2]) -> f64 {
    ((a[0] - b[0]) / units[0]).hypot((a[1] - b[1]) / units[1])
}
