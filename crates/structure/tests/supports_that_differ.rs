//! Supports that move differently: static shapes, harmonic response of a beam and of masses between them.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use crate::common::{bare, lumped, paper_beam, unit_beam};
use approx::assert_relative_eq;
use faer::{Mat, c64, linalg::solvers::Solve};
use hammerbeam_structure::{Damping, End, ReducedModel, Reduction, Structure};

fn unreduced(structure: &Structure) -> ReducedModel {
    structure.reduce(&Reduction::None, &Damping::none(), &[]).unwrap().model
}

/// Complex amplitude of a point where supports have the amplitudes `moved`, from the modal form at `w` rad/s.
fn response(model: &ReducedModel, point: &str, w: f64, moved: &[c64]) -> c64 {
    let n = model.dof();
    let dynamic = Mat::from_fn(n, n, |i, j| {
        let diagonal = if i == j { model.natural_frequencies[i].powi(2) - w * w } else { 0.0 };
        c64::new(diagonal, w * model.damping[(i, j)])
    });
    let load = Mat::from_fn(n, 1, |i, _| {
        let of = model.supports.iter().zip(moved);
        of.map(|(s, u)| *u * c64::new(w * w * s.inertia[i], -w * s.damping[i])).sum::<c64>()
    });
    let q = dynamic.partial_piv_lu().solve(load);
    let point = model.point(point).unwrap();
    let carried: c64 = point.support_ratios.iter().zip(moved).map(|(ratio, u)| *u * *ratio).sum();
    (0..n).fold(carried, |sum, i| sum + q[(i, 0)] * point.shape[i])
}

fn two_ends(end: End, elements: usize) -> Structure {
    let points = vec![bare("third", 0.3), bare("half", 0.5)];
    unit_beam(elements, end, end, points)
        .structure()
        .unwrap()
        .with_support_motions(&[&["left"], &["right"]])
        .unwrap()
}

/// Pinned: `1 - x` and `x`. Clamped: the cubics of Hermite.
#[test]
fn each_support_bends_the_beam_into_a_shape_of_its_own() {
    let x: f64 = 0.3;
    let cubic = 1.0 - 3.0 * x * x + 2.0 * x * x * x;
    for (end, left) in [(End::Pinned, 1.0 - x), (End::Clamped, cubic)] {
        let model = unreduced(&two_ends(end, 20));
        let ratios = &model.point("third").unwrap().support_ratios;
        assert_relative_eq!(ratios[0], left, max_relative = 1e-10);
        assert_relative_eq!(ratios[1], 1.0 - left, max_relative = 1e-10);
        assert_eq!(model.point("left").unwrap().support_ratios, [1.0, 0.0]);
        assert_eq!(model.point("right").unwrap().support_ratios, [0.0, 1.0]);
    }
}

/// A pinned beam of unit `EI` and `rho A`, `w^2 = b^4`, without moments at its ends: `y = u_0 g(1 - x) + u_1
/// g(x)`, `2 g(x) = sin bx/sin b + sinh bx/sinh b`.
#[test]
fn two_moving_ends_shake_a_beam_as_euler_and_bernoulli_say() {
    let moved = [c64::new(0.7, -0.2), c64::new(-0.1, 0.5)];
    let structure = two_ends(End::Pinned, 60);
    let reduction = Reduction::FreeInterface { cut_off_hz: 60.0 };
    let reduced = structure.reduce(&reduction, &Damping::none(), &[]).unwrap().model;
    for w in [3.0, 15.0, 30.0, 61.0] {
        let b = f64::sqrt(w);
        let part = |x: f64| 0.5 * ((b * x).sin() / b.sin() + (b * x).sinh() / b.sinh());
        for (name, x) in [("third", 0.3), ("half", 0.5)] {
            let exact = moved[0] * part(1.0 - x) + moved[1] * part(x);
            for (model, bound) in [(&unreduced(&structure), 1e-5), (&reduced, 1e-4)] {
                let found = response(model, name, w, &moved);
                assert!((found - exact).norm() < bound * exact.norm(), "{w} {name}: {found} {exact}");
            }
        }
    }
}

/// `(K - w^2 M + i w C) y = [(k_1 + i w c_1) u_a; (k_3 + i w c_3) u_b]`.
#[test]
fn two_masses_between_two_walls_move_as_their_two_equations_say() {
    let (k, c, m) = ([300.0, 200.0, 500.0], [0.7, 0.3, 1.1], [2.0, 1.5]);
    let ends = [("wall a", "first"), ("first", "second"), ("second", "wall b")];
    let links = |values: [f64; 3]| [0, 1, 2].map(|i| (ends[i].0, ends[i].1, values[i]));
    let masses = [("wall a", 1.0), ("first", m[0]), ("second", m[1]), ("wall b", 7.0)];
    let walls = lumped(&masses, &links(k), &links(c)).structure().unwrap();
    let model = unreduced(&walls.with_support_motions(&[&["wall a"], &["wall b"]]).unwrap());
    let moved = [c64::new(1e-3, 0.0), c64::new(-0.4e-3, 0.9e-3)];
    for w in [5.0, 14.0, 40.0] {
        let z = |i: usize| c64::new(k[i], w * c[i]);
        let (a, b) = (z(0) + z(1) - w * w * m[0], z(1) + z(2) - w * w * m[1]);
        let (f, g, coupled) = (z(0) * moved[0], z(2) * moved[1], z(1));
        let determinant = a * b - coupled * coupled;
        let exact = [(f * b + g * coupled) / determinant, (g * a + f * coupled) / determinant];
        for (name, exact) in ["first", "second"].iter().zip(exact) {
            let found = response(&model, name, w, &moved);
            assert!((found - exact).norm() < 1e-12 * exact.norm(), "{w} {name}: {found} {exact}");
        }
    }
}

#[test]
fn supports_that_move_alike_are_one_support() {
    let beam = || unit_beam(30, End::Clamped, End::Pinned, vec![bare("third", 0.3)]).structure().unwrap();
    let one = beam().with_support_motion(&["left", "right"]).unwrap();
    let two = beam().with_support_motions(&[&["left"], &["right"]]).unwrap();
    for reduction in [Reduction::None, Reduction::FreeInterface { cut_off_hz: 40.0 }] {
        let of = |beam: &Structure| beam.reduce(&reduction, &Damping::none(), &["third"]).unwrap().model;
        let (one, two) = (of(&one), of(&two));
        let u = c64::new(0.3, 0.4);
        for w in [4.0, 17.0, 120.0] {
            let expected = response(&one, "third", w, &[u]);
            let found = response(&two, "third", w, &[u, u]);
            assert!((found - expected).norm() < 1e-10 * expected.norm(), "{w}: {found} {expected}");
        }
        for (mode, inertia) in one.supports[0].inertia.iter().enumerate() {
            let sum = two.supports[0].inertia[mode] + two.supports[1].inertia[mode];
            assert!((inertia - sum).abs() < 1e-10, "{mode}: {inertia} {sum}");
        }
    }
}

/// Where only dampers reach the walls statics leaves the rigid-body part open; the motion does not depend on
/// it: `(i w (c_1 + c_2) - w^2 m) y = i w (c_1 u_a + c_2 u_b)`.
#[test]
fn a_mass_between_dampers_follows_both_walls() {
    let masses = [("a", 1.0), ("mass", 2.0), ("b", 1.0)];
    let walls = lumped(&masses, &[], &[("a", "mass", 3.0), ("mass", "b", 5.0)]).structure().unwrap();
    let model = unreduced(&walls.with_support_motions(&[&["a"], &["b"]]).unwrap());
    let (u, v, w) = (c64::new(1.0, 0.5), c64::new(-0.3, 0.2), 1.7);
    let exact = (u * 3.0 + v * 5.0) * c64::new(0.0, w) / c64::new(-2.0 * w * w, 8.0 * w);
    let found = response(&model, "mass", w, &[u, v]);
    assert!((found - exact).norm() < 1e-13, "{found} {exact}");
}

#[test]
fn two_supports_at_one_place_are_refused() {
    let mut beam = paper_beam();
    beam.points.push(bare("clamp", 0.0));
    let twice = beam.structure().unwrap().with_support_motions(&[&["left"], &["clamp"]]).unwrap_err();
    let message = twice.to_string();
    assert!(message.contains("move one place") && message.contains("clamp, left"), "{message}");
}
