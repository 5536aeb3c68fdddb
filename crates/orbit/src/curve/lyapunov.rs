//! The first Lyapunov coefficient of a Neimark-Sacker point (`normal_form.rs` has the formula).

use faer::c64;
use hammerbeam_motion::exact::MotionError;
use hammerbeam_path::DenseLu;

use super::{
    normal_form::{Bend, Coefficient, answer, bends, is_answer, settled, summed},
    shooting::{CurveOrbit, Shooting},
};
use crate::by_rows::{dot, times};

/// Real and imaginary part.
pub(super) type Complex = [Vec<f64>; 2];

/// A pair `exp(+-i a)` and its vectors.
pub(super) struct PairVectors {
    /// `exp(i a)`.
    pub multiplier: c64,
    /// `A q = exp(i a) q`.
    pub right: Complex,
    /// `p^T A = exp(i a) p^T`, `p^T q = 1`: the conjugate of what is written `p^H`.
    pub left: Complex,
}

/// `d`, for a right vector of length one.
pub(super) fn of_pair(
    shooting: &mut Shooting,
    place: &CurveOrbit,
    pair: &PairVectors,
) -> Result<Option<Coefficient>, MotionError> {
    let PairVectors { multiplier, right, left } = upright(pair);
    let [first, second] = right.each_ref().map(|part| shooting.carried(part));
    let lefts = left.each_ref().map(|part| shooting.carried_back(part));
    let vectors: Vec<Complex> = first.iter().zip(&second).map(|(a, b)| [a.clone(), b.clone()]).collect();
    settled(|step| {
        let bends = [bends(shooting, place, &first, step)?, bends(shooting, place, &second, step)?];
        let terms: Vec<Terms> =
            (0..shooting.count).map(|k| Terms::new([&bends[0][k], &bends[1][k]], &vectors[k])).collect();
        Ok(combined(shooting, multiplier, &lefts, &terms))
    })
}

/// What a segment adds to the terms of second and third order.
struct Terms {
    /// `DG[q]`, real and imaginary part.
    first: Complex,
    /// `DG[q] q'`, which is real.
    mean: Vec<f64>,
    /// `DG[q] q`.
    double: Complex,
    /// `D^2 G[q, q'] q`.
    third: Complex,
    /// Larger one of the second differences, relative to the first.
    bend: f64,
}

impl Terms {
    fn new([along_a, along_b]: [&Bend; 2], [a, b]: &Complex) -> Self {
        let [aa, ab] = [a, b].map(|part| times(&along_a.first, part));
        let [ba, bb] = [a, b].map(|part| times(&along_b.first, part));
        let both: Vec<f64> = along_a.second.iter().zip(&along_b.second).map(|(x, y)| x + y).collect();
        Self {
            first: [along_a.first.clone(), along_b.first.clone()],
            mean: combine(1.0, &aa, 1.0, &bb),
            double: [combine(1.0, &aa, -1.0, &bb), combine(1.0, &ab, 1.0, &ba)],
            third: [times(&both, a), times(&both, b)],
            bend: along_a.ratio.max(along_b.ratio),
        }
    }

    /// `D^2 G[q, q'] q + 2 DG[q] s + DG[q'] r`.
    ///
    /// * `mean`, `double`: s, which is real, and r at the node of the segment.
    fn third_order(&self, mean: &[f64], [x, y]: &Complex) -> Complex {
        // With F and G for DG[q]: 2 (F + i G) s + (F - i G) (x + i y).
        let [f, g] = &self.first;
        let re = combine(2.0, &times(f, mean), 1.0, &combine(1.0, &times(f, x), 1.0, &times(g, y)));
        let im = combine(2.0, &times(g, mean), 1.0, &combine(1.0, &times(f, y), -1.0, &times(g, x)));
        [combine(1.0, &self.third[0], 1.0, &re), combine(1.0, &self.third[1], 1.0, &im)]
    }
}

/// The coefficient of what all segments add.
fn combined(
    shooting: &Shooting,
    multiplier: c64,
    lefts: &[Vec<Vec<f64>>; 2],
    terms: &[Terms],
) -> Option<Coefficient> {
    let part = |of: &dyn Fn(&Terms) -> Vec<f64>| summed(shooting, &terms.iter().map(of).collect::<Vec<_>>());
    let mean_of_all = part(&|terms| terms.mean.clone());
    let double_of_all = [part(&|terms| terms.double[0].clone()), part(&|terms| terms.double[1].clone())];
    let (mut mean, sign) = answer(shooting, 1.0, &mean_of_all)?;
    let mut double = complex_answer(shooting, multiplier * multiplier, &double_of_all)?;
    let mut sum = c64::new(0.0, 0.0);
    let mut scale = dot(&mean_of_all, &mean_of_all) + length(&double_of_all).powi(2);
    for (k, terms) in terms.iter().enumerate() {
        let left = [&lefts[0][k], &lefts[1][k]];
        sum += product(left, &terms.third_order(&mean, &double));
        scale += dot(left[0], left[0]).hypot(dot(left[1], left[1])).sqrt() * length(&terms.third);
        let matrix = &shooting.segments[k].matrix;
        mean = combine(1.0, &times(matrix, &mean), 1.0, &terms.mean);
        double = [0, 1].map(|i| combine(1.0, &times(matrix, &double[i]), 1.0, &terms.double[i]));
    }
    let value = 0.5 * (multiplier.conj() * sum).re;
    let bend = terms.iter().map(|terms| terms.bend).fold(0.0, f64::max);
    Some(Coefficient { value, scale: 0.5 * scale, sign, bend })
}

/// The same pair with a right vector of length one whose parts are orthogonal, the real one the longer:
/// directions of differences that do not depend on chance.
fn upright(PairVectors { multiplier, right, left }: &PairVectors) -> PairVectors {
    let [a, b] = right;
    let square = c64::new(dot(a, a) - dot(b, b), 2.0 * dot(a, b));
    let factor = c64::from_polar(1.0 / length(right), -0.5 * square.arg());
    let inverse = c64::new(1.0, 0.0) / factor;
    PairVectors { multiplier: *multiplier, right: scaled(factor, right), left: scaled(inverse, left) }
}

fn scaled(by: c64, [re, im]: &Complex) -> Complex {
    [combine(by.re, re, -by.im, im), combine(by.im, re, by.re, im)]
}

/// `p^T x`.
fn product([re, im]: [&Vec<f64>; 2], [x, y]: &Complex) -> c64 {
    c64::new(dot(re, x) - dot(im, y), dot(re, y) + dot(im, x))
}

fn length([re, im]: &Complex) -> f64 {
    (dot(re, re) + dot(im, im)).sqrt()
}

/// `x a + y b`.
fn combine(x: f64, a: &[f64], y: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| x * a + y * b).collect()
}

/// `(by I - A)^-1` of a vector; `None` if there is no inverse, as far as can be resolved.
fn complex_answer(shooting: &Shooting, by: c64, [re, im]: &Complex) -> Option<Complex> {
    let size = shooting.size();
    let monodromy = shooting.monodromy();
    let entry = |i: usize, j: usize| -> f64 {
        let inner = if i % size == j % size { by } else { c64::new(0.0, 0.0) };
        match (i < size, j < size) {
            (true, false) => -inner.im,
            (false, true) => inner.im,
            _ => inner.re - monodromy[i % size * size + j % size],
        }
    };
    let width = 2 * size;
    let matrix: Vec<f64> = (0..width * width).map(|k| entry(k / width, k % width)).collect();
    let mut lu = DenseLu::new();
    lu.factorise(width, &matrix).ok()?;
    let vector = [re.clone(), im.clone()].concat();
    let mut answer = vector.clone();
    lu.solve(&mut answer);
    let is_answer = is_answer(&answer, &vector);
    let second = answer.split_off(size);
    is_answer.then_some([answer, second])
}
