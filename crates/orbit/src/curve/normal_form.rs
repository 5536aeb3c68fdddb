//! The coefficients of normal forms: on which side of a bifurcation what branches off lies, and whether it is
//! stable.
//!
//! On the centre manifold the map of a period is at a flip `x -> -x + c x^3`, at a Neimark-Sacker point `x ->
//! e^{i a} x + C x |x|^2` with `d = Re(e^{-i a} C)`: for `c > 0` and `d < 0` the orbit is stable in it, and
//! what branches off is. With the derivatives B and C of the map and `A v = -v`, `A q = e^{i a} q`, `p^H A =
//! e^{i a} p^H`, `p^H q = 1`,
//!
//! * `6 c w^T v = w^T [C(v, v, v) + 3 B(v, (I - A)^-1 B(v, v))]`,
//! * `2 d = Re e^{-i a} p^H [C(q, q, q') + 2 B(q, (I - A)^-1 B(q, q')) + B(q', (e^{2 i a} I - A)^-1 B(q,
//!   q))]`, `q'` the conjugate of q.
//!
//! The test function of a flip is the first without `w^T v`, which vanishes at the 1:2 resonance. Both have a
//! pole where a further multiplier comes to +1, so they go over to `sign det(I - A) x / (x^2 + s^2)^{1/2}`
//! with a scale s of the derivatives, which passes that point without a zero.
//!
//! Over segments with the matrices `G_k` the terms are carried from node to node: `s -> G_k s + DG_k[v] v`
//! for the terms of second order, and `w_k^T (D^2 G_k[v, v] v + 3 DG_k[v] s)` is what each adds to the third.
//! `DG[v]` and `D^2 G[v, v]` are the first and the second central difference of the exact fundamental
//! matrices along v: two evaluations for a flip, four for a pair (`D^2 G[q, q'] = D^2 G[a, a] + D^2 G[b, b]`,
//! `q = a + i b`). Near a zero, or where differences are bent as beside a grazing, two steps are taken and
//! extrapolated; where they do not agree there is no value.
//!
//! # Sources
//! Kuznetsov, *Elements of Applied Bifurcation Theory* (2004), section 5.4 and chapter 9; Kuznetsov and
//! Meijer, SIAM J. Sci. Comput. 26 (2005), 1932-1954.

use hammerbeam_motion::exact::MotionError;
use hammerbeam_path::DenseLu;

use super::{
    bordered::Vectors,
    shooting::{CurveOrbit, Shooting},
};
use crate::by_rows::{dot, times};

/// Step along a vector, relative to the orbit, with which a coefficient far from zero is known well enough.
const STEP: f64 = 1.25e-3;
/// It is far from zero with this share of its scale, while second differences of matrices are this share of
/// the first ones.
const FAR: f64 = 2e-3;
const BEND: f64 = 0.02;
/// Further steps, by their ratio to the one before.
const STEPS: [f64; 2] = [4.0, 0.25];
/// Values of two steps agree within this share of their scale.
const AGREES: f64 = 0.02;
/// By how much an inverse may enlarge a vector: at a pole, where a row is located to 1e-10, rounding decides
/// on the value.
const LARGEST: f64 = 1e6;

/// A coefficient with one step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coefficient {
    pub value: f64,
    /// What it is to be compared with: without cancellation and without pole.
    pub scale: f64,
    /// Sign of `det(I - A)`.
    pub sign: f64,
    /// Largest second difference of a matrix, relative to its first.
    pub bend: f64,
}

impl Coefficient {
    /// The test function, which is continuous over its pole.
    pub fn bounded(self) -> f64 {
        self.sign * self.value / self.value.hypot(self.scale.max(f64::MIN_POSITIVE))
    }

    fn agrees(self, other: Self) -> bool {
        (self.value - other.value).abs() <= AGREES * self.value.abs().max(self.scale)
    }
}

/// First and second derivative of the matrix of a segment along a vector.
pub(super) struct Bend {
    pub first: Vec<f64>,
    pub second: Vec<f64>,
    /// Second difference relative to the first.
    pub ratio: f64,
}

/// The coefficient: of one step where that is enough, else as two that agree give it; `None` where none do.
pub(super) fn settled(
    mut with_step: impl FnMut(f64) -> Result<Option<Coefficient>, MotionError>,
) -> Result<Option<Coefficient>, MotionError> {
    let Some(first) = with_step(STEP)? else { return Ok(None) };
    if first.bend < BEND && first.bounded().abs() > FAR {
        return Ok(Some(first));
    }
    for ratio in STEPS {
        let Some(second) = with_step(STEP * ratio)? else { return Ok(None) };
        if first.agrees(second) {
            // Errors go like the square of the step.
            let value = first.value + (second.value - first.value) / (1.0 - ratio * ratio);
            return Ok(Some(Coefficient { value, ..first }));
        }
    }
    Ok(None)
}

/// `c w^T v` of a flip, for vectors of length one.
pub(super) fn of_flip(
    shooting: &mut Shooting,
    place: &CurveOrbit,
    Vectors { left, right, .. }: &Vectors,
) -> Result<Option<Coefficient>, MotionError> {
    let [left, right] = [left, right].map(|vector| unit(vector));
    let (vectors, lefts) = (shooting.carried(&right), shooting.carried_back(&left));
    settled(|step| {
        let bends = bends(shooting, place, &vectors, step)?;
        let own: Vec<Vec<f64>> = bends.iter().zip(&vectors).map(|(bend, v)| times(&bend.first, v)).collect();
        let second = summed(shooting, &own);
        let Some((mut mean, sign)) = answer(shooting, 1.0, &second) else { return Ok(None) };
        let bend = bends.iter().map(|bend| bend.ratio).fold(0.0, f64::max);
        let (mut sum, mut scale) = (0.0, dot(&second, &second));
        for (k, (bend, left)) in bends.iter().zip(&lefts).enumerate() {
            let third = times(&bend.second, &vectors[k]);
            sum += dot(left, &third) + 3.0 * dot(left, &times(&bend.first, &mean));
            scale += (dot(left, left) * dot(&third, &third)).sqrt();
            mean = add(&times(&shooting.segments[k].matrix, &mean), &own[k]);
        }
        Ok(Some(Coefficient { value: sum / 6.0, scale: scale / 6.0, sign, bend }))
    })
}

/// Derivatives of the matrix of each segment along a vector at its node.
///
/// * `step`: relative to the orbit.
pub(super) fn bends(
    shooting: &mut Shooting,
    place: &CurveOrbit,
    vectors: &[Vec<f64>],
    step: f64,
) -> Result<Vec<Bend>, MotionError> {
    let each = vectors.iter().enumerate();
    each.map(|(k, vector)| bend(shooting, k, place, vector, step)).collect()
}

fn bend(
    shooting: &mut Shooting,
    k: usize,
    place: &CurveOrbit,
    vector: &[f64],
    step: f64,
) -> Result<Bend, MotionError> {
    let size = shooting.size();
    let h = step / dot(vector, vector).sqrt().max(f64::MIN_POSITIVE);
    let node = &place.nodes[k * size..(k + 1) * size];
    let moved = |h: f64| -> Vec<f64> { node.iter().zip(vector).map(|(z, v)| z + h * v).collect() };
    let above = shooting.flow(k, place, &moved(h))?.matrix;
    let below = shooting.flow(k, place, &moved(-h))?.matrix;
    let here = &shooting.segments[k].matrix;
    let first: Vec<f64> = above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * h)).collect();
    let ends = above.iter().zip(&below).zip(here);
    let second: Vec<f64> = ends.map(|((a, b), at)| (a - 2.0 * at + b) / (h * h)).collect();
    let largest = |values: &[f64]| values.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    let ratio = 0.5 * h * largest(&second) / largest(&first);
    Ok(Bend { first, second, ratio })
}

/// What is added in each segment, carried to the end of the orbit.
pub(super) fn summed(shooting: &Shooting, own: &[Vec<f64>]) -> Vec<f64> {
    let zero = vec![0.0; shooting.size()];
    let each = shooting.segments.iter().zip(own);
    each.fold(zero, |sum, (segment, own)| add(&times(&segment.matrix, &sum), own))
}

/// `(by I - A)^-1` of a vector, and the sign of the determinant; `None` if there is no inverse, as far as can
/// be resolved.
pub(super) fn answer(shooting: &Shooting, by: f64, vector: &[f64]) -> Option<(Vec<f64>, f64)> {
    let size = shooting.size();
    let mut matrix: Vec<f64> = shooting.monodromy().iter().map(|entry| -entry).collect();
    (0..size).for_each(|i| matrix[i * size + i] += by);
    let mut lu = DenseLu::new();
    let sign = lu.factorise(size, &matrix).ok()?.sign;
    let mut answer = vector.to_vec();
    lu.solve(&mut answer);
    is_answer(&answer, vector).then_some((answer, sign))
}

/// Whether an inverse is known well enough: a further multiplier is not at its pole as far as can be
/// resolved.
pub(super) fn is_answer(answer: &[f64], vector: &[f64]) -> bool {
    dot(answer, answer) <= LARGEST * LARGEST * dot(vector, vector)
}

fn unit(vector: &[f64]) -> Vec<f64> {
    let length = dot(vector, vector).sqrt();
    vector.iter().map(|x| x / length).collect()
}

pub(super) fn add(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}
