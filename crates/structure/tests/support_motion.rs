//! Support motion: static shape, inertia, dampers, at one place or several.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use crate::common::{bare, lumped, paper_beam, unit_beam};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use faer::{Mat, c64, linalg::solvers::Solve};
use hammerbeam_structure::{BeamPoint, Damping, End, ReducedModel, Reduction, Structure};

fn unreduced(structure: &Structure) -> ReducedModel {
    structure.reduce(&Reduction::None, &Damping::none(), &[]).unwrap().model
}

/// Complex amplitude of a point per unit support amplitude, from the modal form at `w` rad/s.
fn transfer(model: &ReducedModel, point: &str, w: f64) -> c64 {
    let support = &model.supports[0];
    let n = model.dof();
    let dynamic = Mat::from_fn(n, n, |i, j| {
        let diagonal = if i == j { model.natural_frequencies[i].powi(2) - w * w } else { 0.0 };
        c64::new(diagonal, w * model.damping[(i, j)])
    });
    let load = Mat::from_fn(n, 1, |i, _| c64::new(w * w * support.inertia[i], -w * support.damping[i]));
    let q = dynamic.partial_piv_lu().solve(load);
    let point = model.point(point).unwrap();
    (0..n).fold(c64::new(point.support_ratios[0], 0.0), |sum, i| sum + q[(i, 0)] * point.shape[i])
}

/// `gamma = k1 / (k1 + k2)` for a mass between a moving mass and the ground.
#[test]
fn mass_between_two_springs_follows_by_their_ratio() {
    let system = lumped(&[("a", 2.0), ("shaker", 1.0)], &[("shaker", "a", 3.0), ("a", "ground", 5.0)], &[]);
    let model = unreduced(&system.structure().unwrap().with_support_motion(&["shaker"]).unwrap());
    assert_relative_eq!(model.point("a").unwrap().support_ratios[0], 3.0 / 8.0, max_relative = 1e-15);
    assert_eq!(model.point("shaker").unwrap().support_ratios[0], 1.0);
    assert_eq!(model.point("ground").unwrap().support_ratios[0], 0.0);
    assert_relative_eq!(model.supports[0].inertia[0], 2.0_f64.sqrt() * 3.0 / 8.0, max_relative = 1e-15);
    assert_relative_eq!(model.natural_frequencies[0], 2.0, max_relative = 1e-15);
}

/// `m y'' + c (y' - u') + k (y - u) = 0`: `y / u = (k + i w c) / (k - w^2 m + i w c)`.
#[test]
fn mass_on_a_moving_ground_has_the_transmissibility_of_the_textbook() {
    let (m, c, k, w) = (2.0, 0.7, 50.0, 4.3);
    let system = lumped(&[("a", m)], &[("a", "ground", k)], &[("ground", "a", c)]);
    let model = unreduced(&system.structure().unwrap().with_support_motion(&["ground"]).unwrap());
    let expected = c64::new(k, w * c) / c64::new(k - w * w * m, w * c);
    assert_abs_diff_eq!((transfer(&model, "a", w) - expected).norm(), 0.0, epsilon = 1e-14);
    assert_eq!(model.point("ground").unwrap().support_ratios[0], 1.0);
    assert!(model.supports[0].damping[0].abs() < 1e-15, "the damper moves with the support");
}

/// Two masses, dampers to a fixed ground and to a moving mass: `(K + i w C - w^2 M) y = -(k_p + i w c_p) u`.
#[test]
fn dampers_to_a_fixed_ground_feel_the_absolute_motion() {
    let system = lumped(
        &[("a", 1.0), ("b", 3.0), ("shaker", 7.0)],
        &[("shaker", "a", 40.0), ("a", "b", 30.0), ("b", "ground", 20.0)],
        &[("a", "ground", 2.0), ("b", "shaker", 0.5), ("a", "b", 0.9), ("b", "a", 0.1)],
    );
    let model = unreduced(&system.structure().unwrap().with_support_motion(&["shaker"]).unwrap());
    for w in [0.5, 4.0, 9.0] {
        let entry = |k: f64, c: f64, m: f64| c64::new(k - w * w * m, w * c);
        let (aa, ab, bb) = (entry(70.0, 3.0, 1.0), entry(-30.0, -1.0, 0.0), entry(50.0, 1.5, 3.0));
        let (pa, pb) = (entry(40.0, 0.0, 0.0), entry(0.0, 0.5, 0.0));
        let determinant = aa * bb - ab * ab;
        let (a, b) = ((bb * pa - ab * pb) / determinant, (aa * pb - ab * pa) / determinant);
        assert_abs_diff_eq!((transfer(&model, "a", w) - a).norm(), 0.0, epsilon = 1e-13);
        assert_abs_diff_eq!((transfer(&model, "b", w) - b).norm(), 0.0, epsilon = 1e-13);
    }
}

/// Then the support drives the modes like a uniform acceleration, `M_fp` included.
#[test]
fn beam_without_other_supports_rides_exactly_with_its_support() {
    let beam = paper_beam().structure().unwrap();
    let model = unreduced(&beam.with_support_motion(&["left", "left"]).unwrap());
    assert_eq!(model.point("contact").unwrap().support_ratios[0], 1.0);
    assert_eq!(model.point("right").unwrap().support_ratios[0], 1.0);
    for (g, m) in model.supports[0].inertia.iter().zip(&model.uniform_acceleration) {
        assert_abs_diff_eq!(*g, *m, epsilon = 1e-12);
    }
}

/// Clamped at the left and moved across in the middle: `x^2 (3 l - x) / (2 l^3)` up to there, straight
/// beyond.
#[test]
fn cantilever_moved_at_a_point_bends_up_to_it_and_is_straight_beyond() {
    let points = vec![bare("half", 0.25), bare("driven", 0.5)];
    let beam = unit_beam(12, End::Clamped, End::Free, points).structure().unwrap();
    let model = unreduced(&beam.with_support_motion(&["driven"]).unwrap());
    assert_relative_eq!(model.point("half").unwrap().support_ratios[0], 5.0 / 16.0, max_relative = 1e-11);
    assert_relative_eq!(model.point("right").unwrap().support_ratios[0], 2.5, max_relative = 1e-11);
    assert_eq!(model.point("driven").unwrap().support_ratios[0], 1.0);
}

#[test]
fn both_ends_shaken_alike_carry_the_beam_as_a_rigid_body() {
    let beam = unit_beam(12, End::Pinned, End::Clamped, vec![bare("mid", 0.5)]).structure().unwrap();
    let model = unreduced(&beam.with_support_motion(&["left", "right"]).unwrap());
    assert_eq!(model.point("mid").unwrap().support_ratios[0], 1.0);
    assert_eq!(model.point("right").unwrap().support_ratios[0], 1.0);
    assert!(model.point("right").unwrap().shape.iter().all(|phi| *phi == 0.0));
}

/// Clamped at both ends, one moved: `1 - 3 x^2 + 2 x^3`.
#[test]
fn one_moved_end_of_a_clamped_beam_bends_it_into_the_hermite_cubic() {
    let beam = unit_beam(12, End::Clamped, End::Clamped, vec![bare("quarter", 0.25)]).structure().unwrap();
    let model = unreduced(&beam.with_support_motion(&["left"]).unwrap());
    let expected = 1.0 - 3.0 / 16.0 + 2.0 / 64.0;
    assert_relative_eq!(model.point("quarter").unwrap().support_ratios[0], expected, max_relative = 1e-11);
    assert_eq!(model.point("right").unwrap().support_ratios[0], 0.0);
}

/// Tip on a spring to a fixed ground, clamp moved: `1 / (1 + k l^3 / (3 EI))`, in every basis.
#[test]
fn spring_to_the_ground_holds_back_the_tip_of_a_shaken_cantilever() {
    let tip = BeamPoint { spring: 6.0, damper: 0.4, ..bare("tip", 1.0) };
    let beam = unit_beam(12, End::Clamped, End::Free, vec![tip]).structure().unwrap();
    let shaken = beam.with_support_motion(&["left"]).unwrap();
    let full = unreduced(&shaken);
    for reduction in
        [Reduction::FreeInterface { cut_off_hz: 30.0 }, Reduction::FixedInterface { cut_off_hz: 30.0 }]
    {
        let model = shaken.reduce(&reduction, &Damping::none(), &["tip"]).unwrap().model;
        assert!(model.dof() < 7);
        assert_relative_eq!(model.point("tip").unwrap().support_ratios[0], 1.0 / 3.0, max_relative = 1e-11);
        for w in [0.0, 2.0, 5.0] {
            let difference = transfer(&model, "tip", w) - transfer(&full, "tip", w);
            assert_abs_diff_eq!(difference.norm(), 0.0, epsilon = 1e-4); // above the cut-off
        }
    }
}

/// A free end that is shaken is held across by what shakes it and free to rotate: a pin.
#[test]
fn shaken_free_end_vibrates_like_a_pinned_one() {
    let shaken = unit_beam(10, End::Clamped, End::Free, vec![]).structure().unwrap();
    let shaken = shaken.with_support_motion(&["right"]).unwrap().eigenfrequencies_hz().unwrap();
    let pinned = unit_beam(10, End::Clamped, End::Pinned, vec![]).structure().unwrap();
    assert_eq!(shaken, pinned.eigenfrequencies_hz().unwrap());
}

/// A pinned-free beam turns freely about its moving pin; the free pin's reaction is none in a steady state of
/// the rigid beam at high frequency: the centre of percussion, 2/3 of the length, stays at rest.
#[test]
fn rigid_beam_on_a_moving_pin_keeps_its_centre_of_percussion_at_rest() {
    let points = vec![bare("percussion", 2.0 / 3.0)];
    let mut beam = unit_beam(12, End::Pinned, End::Free, points);
    beam.youngs_modulus = 1e8;
    let model = unreduced(&beam.structure().unwrap().with_support_motion(&["left"]).unwrap());
    assert_eq!(model.natural_frequencies[0], 0.0);
    assert_abs_diff_eq!(transfer(&model, "percussion", 1.0).norm(), 0.0, epsilon = 1e-8);
}

#[test]
fn floating_mass_has_nothing_to_do_with_a_shaken_one() {
    let system = lumped(&[("a", 1.0), ("loose", 2.0), ("shaker", 1.0)], &[("a", "shaker", 4.0)], &[]);
    let model = unreduced(&system.structure().unwrap().with_support_motion(&["shaker"]).unwrap());
    assert_eq!(model.natural_frequencies, vec![0.0, 2.0]);
    assert_abs_diff_eq!(transfer(&model, "loose", 3.0).norm(), 0.0, epsilon = 1e-15);
}
