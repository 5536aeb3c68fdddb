//! A pair of multipliers with product one: the determinant of `A` on their invariant plane.
//!
//! With bases `R` and `L` of the right and left invariant planes, `L^T R = I`, the matrix on the plane is
//! `A_c = L^T A R`, `d = det A_c` the product of the pair and `k = tr A_c / 2`. `d(ln d) = tr(A_c^-1 L^T (dA)
//! R)`. The plane stays well defined where the pair becomes real, at `k = 1` and `k = -1`. It is the null
//! space of `A^2 - 2 k A + d I`.

use faer::c64;
use hammerbeam_motion::exact::MotionError;

use super::{
    linear::Linear,
    lyapunov,
    null::null_space,
    shooting::{CurveOrbit, Shooting},
};
use crate::{
    by_rows::{dot, multiply, times, transposed},
    eigenvalues::eigenvalues,
};

/// The pair that is followed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    /// `k` at the last point of the curve, by which the pair is known.
    half_trace: f64,
}

/// The plane of the pair.
struct Plane {
    right: Vec<Vec<f64>>,
    /// Dual to `right`.
    left: Vec<Vec<f64>>,
    /// `A_c` by rows.
    matrix: [f64; 4],
}

impl Plane {
    fn determinant(&self) -> f64 {
        self.matrix[0] * self.matrix[3] - self.matrix[1] * self.matrix[2]
    }

    fn half_trace(&self) -> f64 {
        0.5 * (self.matrix[0] + self.matrix[3])
    }
}

impl Pair {
    /// The complex pair nearest to the unit circle at the last evaluated place; `None` without one.
    pub fn new(shooting: &Shooting) -> Option<Self> {
        let multipliers = eigenvalues(shooting.size(), shooting.monodromy()).ok()?;
        let pairs = multipliers.into_iter().filter(|[_, im]| *im > 0.0);
        let nearest = pairs.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        Some(Self { half_trace: nearest[0] })
    }

    /// Remembers the pair at the last evaluated place.
    pub fn renew(&mut self, shooting: &Shooting) {
        if let Some(plane) = self.plane(shooting) {
            self.half_trace = plane.half_trace();
        }
    }

    /// Basis of the right invariant plane at the last evaluated place.
    pub fn right_plane(self, shooting: &Shooting) -> Option<Vec<Vec<f64>>> {
        self.plane(shooting).map(|plane| plane.right)
    }

    /// Vectors of the pair at the last evaluated place; `None` where it is real.
    pub fn vectors(self, shooting: &Shooting) -> Option<lyapunov::PairVectors> {
        let plane = self.plane(shooting)?;
        let [a, b, c, _] = plane.matrix;
        let off_real = plane.determinant() - plane.half_trace().powi(2);
        if off_real.is_nan() || off_real <= 0.0 {
            return None;
        }
        let multiplier = c64::new(plane.half_trace(), off_real.sqrt());
        // (A_c - m I) x = 0 and y^T (A_c - m I) = 0; b c < 0, as the pair is complex.
        let (x, y) = ([c64::new(b, 0.0), multiplier - a], [c64::new(c, 0.0), multiplier - a]);
        let scale = x[0] * y[0] + x[1] * y[1];
        let of = |columns: &[Vec<f64>], by: [c64; 2]| -> lyapunov::Complex {
            let combine = |of: fn(c64) -> f64| {
                columns[0].iter().zip(&columns[1]).map(|(u, v)| of(by[0]) * u + of(by[1]) * v).collect()
            };
            [combine(|z| z.re), combine(|z| z.im)]
        };
        let left = of(&plane.left, [y[0] / scale, y[1] / scale]);
        Some(lyapunov::PairVectors { multiplier, right: of(&plane.right, x), left })
    }

    fn plane(self, shooting: &Shooting) -> Option<Plane> {
        let size = shooting.size();
        let monodromy = shooting.monodromy();
        let (half_trace, product) = self.half_trace_and_product(&eigenvalues(size, monodromy).ok()?)?;
        let mut squares = vec![0.0; size * size];
        multiply(size, monodromy, monodromy, &mut squares);
        let mut matrix: Vec<f64> =
            squares.iter().zip(monodromy).map(|(square, a)| square - 2.0 * half_trace * a).collect();
        (0..size).for_each(|i| matrix[i * size + i] += product);
        let right = null_space(size, &matrix, 2);
        let left = dual(&null_space(size, &transposed(size, &matrix), 2), &right)?;
        let images: Vec<Vec<f64>> = right.iter().map(|column| times(monodromy, column)).collect();
        let matrix = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| dot(&left[i], &images[j]));
        Some(Plane { right, left, matrix })
    }

    /// Half the sum and the product of the pair: conjugate, or two real multipliers of one sign.
    fn half_trace_and_product(self, multipliers: &[[f64; 2]]) -> Option<(f64, f64)> {
        let complex = multipliers.iter().filter(|[_, im]| *im > 0.0).map(|[re, im]| (*re, re * re + im * im));
        let real: Vec<f64> = multipliers.iter().filter(|[_, im]| *im == 0.0).map(|[re, _]| *re).collect();
        let pairs = real.iter().enumerate().flat_map(|(i, a)| real[..i].iter().map(move |b| (*a, *b)));
        let real = pairs.map(|(a, b)| (0.5 * (a + b), a * b)).filter(|(_, product)| *product > 0.0);
        let off = |(half, product): &(f64, f64)| (half - self.half_trace).abs() + product.ln().abs();
        complex.chain(real).min_by(|a, b| off(a).total_cmp(&off(b)))
    }

    /// `ln d` and its gradient, and the test `k`.
    pub fn evaluate(
        self,
        shooting: &mut Shooting,
        place: &CurveOrbit,
    ) -> Result<Option<Linear>, MotionError> {
        let Some(plane) = self.plane(shooting) else { return Ok(None) };
        let (determinant, [a, b, c, d]) = (plane.determinant(), plane.matrix);
        if determinant <= 0.0 {
            return Ok(None);
        }
        let inverse = [d, -b, -c, a].map(|entry| entry / determinant);
        // tr(A_c^-1 L^T dA R) = sum_j (sum_i inverse_ji l_i)^T dA r_j.
        let mut gradient: Vec<f64> = Vec::new();
        for (j, right) in plane.right.iter().enumerate() {
            let left: Vec<f64> = plane.left[0]
                .iter()
                .zip(&plane.left[1])
                .map(|(l0, l1)| inverse[2 * j] * l0 + inverse[2 * j + 1] * l1)
                .collect();
            let part = shooting.gradient(place, &left, right)?;
            gradient.resize(part.len(), 0.0);
            gradient.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
        }
        let tests = vec![plane.half_trace()];
        Ok(Some(Linear { values: vec![determinant.ln()], rows: vec![gradient], tests }))
    }
}

fn distance([re, im]: &[f64; 2]) -> f64 {
    (1.0 - re.hypot(*im)).abs()
}

/// The basis of the span of `left` that is dual to `right`; `None` if there is none.
fn dual(left: &[Vec<f64>], right: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let [a, b, c, d] = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| dot(&left[i], &right[j]));
    let determinant = a * d - b * c;
    if determinant.is_nan() || determinant == 0.0 {
        return None;
    }
    // Rows of [a b; c d]^-1 times the rows of `left`.
    let combine = |x: f64, y: f64| -> Vec<f64> {
        left[0].iter().zip(&left[1]).map(|(l0, l1)| (x * l0 + y * l1) / determinant).collect()
    };
    Some(vec![combine(d, -b), combine(-c, a)])
}
