//! Every law: values, slopes against differences, levels of its contacts, and the parameters it refuses.

use super::*;

/// Some laws by hand, and those of the list as they come.
fn every_law() -> Vec<Law> {
    let described = DESCRIPTIONS.iter().flat_map(|described| described.sample(1e-3).unwrap());
    let of_list = described.map(|part| part.law.struck_at(0.6));
    laws_by_hand().into_iter().chain(of_list).collect()
}

fn laws_by_hand() -> [Law; 10] {
    let hertz = HertzStop::with_gap(4.5e9, 1e-3).unwrap();
    let flores = RestitutionStop::new(hertz, RestitutionModel::Flores, 0.7).unwrap();
    [
        Law::Linear(LinearStop::with_gap(1.6e5, 1e-3).unwrap().with_damping(30.0).unwrap()),
        Law::HuntCrossley(HuntCrossleyStop::new(hertz, 0.4).unwrap()),
        Law::Restitution(flores).struck_at(0.6),
        Law::Hertz(HertzStop::with_gap(4.5e9, 1e-3).unwrap()),
        Law::Hertz(HertzStop::with_preload(4.5e9, 12.0).unwrap()),
        Law::Linear(LinearStop::with_gap(1.6e5, 1e-3).unwrap()),
        Law::Linear(LinearStop::with_preload(1.6e5, 12.0).unwrap()),
        Law::TwoSided(TwoSidedStop::new(2e4, 1e-3, 5e-4).unwrap()),
        Law::Power(PowerSpring::cubic(3e7).unwrap()),
        Law::Power(PowerSpring::cubic(-3e7).unwrap()),
    ]
}

/// Displacements away from the levels of the laws above.
const PLACES: [f64; 6] = [-4e-3, -6.1e-4, -3e-4, 4.1e-4, 1.3e-3, 5e-3];

fn assert_close(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{what}: {found:e}, not {expected:e}");
}

#[test]
fn slopes_agree_with_differences() {
    for law in every_law() {
        for place in PLACES {
            let step = 1e-7;
            let difference =
                (law.force(place + step, 0.0).value - law.force(place - step, 0.0).value) / (2.0 * step);
            let slope = law.force(place, 0.0).slope;
            let scale = slope.abs().max(1.0);
            assert!(
                (slope - difference).abs() < 1e-6 * scale,
                "{law:?} at {place}: {slope} against {difference}"
            );
        }
    }
}

#[test]
fn one_sided_stops_are_free_up_to_their_gap_and_press_back_beyond() {
    let hertz = Law::Hertz(HertzStop::with_gap(4.5e9, 1e-3).unwrap());
    let linear = Law::Linear(LinearStop::with_gap(1.6e5, 1e-3).unwrap());
    for law in [hertz.clone(), linear.clone()] {
        assert_eq!(law.force(1e-3, 0.0), Force::ZERO);
        assert_eq!(law.force(-1.0, 0.0), Force::ZERO);
    }
    assert_close(hertz.force(1e-3 + 4e-6, 0.0).value, -4.5e9 * 8e-9, "Hertz at 4 micrometres");
    assert_close(hertz.force(1e-3 + 4e-6, 0.0).slope, -1.5 * 4.5e9 * 2e-3, "Hertz slope");
    assert_close(linear.force(3e-3, 0.0).value, -320.0, "linear at 2 millimetres");
}

#[test]
fn a_preload_is_the_force_on_the_undeformed_structure() {
    assert_close(HertzStop::with_preload(4.5e9, 12.0).unwrap().force(0.0, 0.0).value, -12.0, "Hertz");
    assert_close(LinearStop::with_preload(1.6e5, 12.0).unwrap().force(0.0, 0.0).value, -12.0, "linear");
    assert_eq!(LinearStop::with_preload(1.6e5, 0.0).unwrap().force(0.0, 0.0), Force::ZERO);
}

#[test]
fn a_two_sided_stop_presses_back_on_either_side() {
    let law = Law::TwoSided(TwoSidedStop::new(2e4, 1e-3, 5e-4).unwrap());
    assert_eq!(law.force(9e-4, 0.0), Force::ZERO);
    assert_eq!(law.force(-4e-4, 0.0), Force::ZERO);
    assert_close(law.force(2e-3, 0.0).value, -20.0, "above");
    assert_close(law.force(-1.5e-3, 0.0).value, 20.0, "below");
}

/// Value and slope of `-k r^n`, for both signs of the constant.
#[test]
fn powers_push_back_or_away() {
    for k in [2e4, -2e4] {
        let at = |degree| Law::Power(PowerSpring::new(k, degree).unwrap()).force(-1e-2, 0.0);
        let expected = [
            (Degree::Linear, k * 1e-2, -k),
            (Degree::Quadratic, -k * 1e-4, k * 2e-2),
            (Degree::Cubic, k * 1e-6, -3.0 * k * 1e-4),
        ];
        for (degree, value, slope) in expected {
            assert_close(at(degree).value, value, "force");
            assert_close(at(degree).slope, slope, "slope");
        }
    }
}

#[test]
fn a_cubic_spring_is_odd_and_always_active() {
    let law = Law::Power(PowerSpring::cubic(3e7).unwrap());
    assert_close(law.force(1e-2, 0.0).value, -30.0, "above");
    assert_close(law.force(-1e-2, 0.0).value, 30.0, "below");
    assert!(law.contacts().is_empty());
}

#[test]
fn forces_set_in_at_the_level_of_a_contact_and_with_its_exponent() {
    for law in every_law().into_iter().filter(|law| law.rigid().is_none()) {
        for contact in law.contacts() {
            let force = |depth: f64| law.force(contact.level + contact.sign * depth, 0.0).value;
            assert_eq!(force(-1e-9), 0.0);
            assert!(contact.sign * force(1e-9) < 0.0, "{law:?}");
            let exponent = (force(2e-6) / force(1e-6)).log2();
            assert!((exponent - contact.onset_exponent).abs() < 1e-6, "{law:?}: {exponent}");
        }
    }
}

/// Two steel spheres of radius R on each other: `1/E = 2 (1 - nu^2) / E_0`, `1/R' = 2 / R`.
#[test]
fn stiffness_of_two_equal_spheres_is_that_of_hertz() {
    let found = HertzStop::stiffness_of_spheres([0.02; 2], [2.1e11; 2], [0.3; 2]);
    assert_close(found, 4.0 / 3.0 * 2.1e11 / (2.0 * 0.91) * 0.1, "equal spheres");
    let plane = HertzStop::stiffness_of_spheres([0.01, f64::INFINITY], [2.1e11; 2], [0.3; 2]);
    assert_close(plane, found, "a sphere of half the radius on a plane");
}

#[test]
fn stiffnesses_are_finite_and_positive() {
    for found in [0.0, -1.0, f64::INFINITY] {
        let refused = Err(LawError::Stiffness { found, allowed: "positive" });
        assert_eq!(HertzStop::with_gap(found, 0.0).map(|_| ()), refused);
        assert_eq!(HertzStop::with_preload(found, 0.0).map(|_| ()), refused);
        assert_eq!(LinearStop::with_gap(found, 0.0).map(|_| ()), refused);
        assert_eq!(LinearStop::with_preload(found, 0.0).map(|_| ()), refused);
        assert_eq!(TwoSidedStop::new(found, 0.0, 0.0).map(|_| ()), refused);
    }
    assert!(HertzStop::with_gap(f64::NAN, 0.0).is_err());
}

#[test]
fn a_cubic_stiffness_may_be_negative_but_not_zero() {
    let refused = Err(LawError::Stiffness { found: 0.0, allowed: "not zero" });
    assert_eq!(PowerSpring::cubic(0.0), refused);
    assert!(PowerSpring::cubic(f64::INFINITY).is_err() && PowerSpring::cubic(f64::NAN).is_err());
    assert!(PowerSpring::cubic(-1.0).is_ok());
}

#[test]
fn gaps_and_preloads_are_finite_and_not_negative() {
    for found in [-1e-9, f64::INFINITY] {
        let gap = Err(LawError::Gap { found });
        let preload = Err(LawError::Preload { found });
        assert_eq!(HertzStop::with_gap(1.0, found).map(|_| ()), gap);
        assert_eq!(LinearStop::with_gap(1.0, found).map(|_| ()), gap);
        assert_eq!(TwoSidedStop::new(1.0, found, 0.0).map(|_| ()), gap);
        assert_eq!(TwoSidedStop::new(1.0, 0.0, found).map(|_| ()), gap);
        assert_eq!(HertzStop::with_preload(1.0, found).map(|_| ()), preload);
        assert_eq!(LinearStop::with_preload(1.0, found).map(|_| ()), preload);
    }
    assert!(LinearStop::with_gap(1.0, f64::NAN).is_err() && LinearStop::with_preload(1.0, f64::NAN).is_err());
}

#[test]
fn refusals_say_what_was_found_and_what_is_allowed() {
    let message = HertzStop::with_gap(1.0, -0.5).unwrap_err().to_string();
    assert_eq!(message, "gap is -0.5 m, must be finite and not negative");
    let message = PowerSpring::cubic(0.0).unwrap_err().to_string();
    assert_eq!(message, "stiffness is 0, must be finite and not zero");
}

#[test]
fn derivatives_by_velocity_and_impact_speed_agree_with_differences() {
    let step = 1e-6;
    for law in every_law().into_iter().filter(Law::depends_on_velocity) {
        for (r, v) in [(1.3e-3, 0.5), (1.002e-3, 0.1), (1.3e-3, -0.1)] {
            let force = law.force(r, v);
            assert!(force.value < 0.0, "{law:?} does not press");
            let by_velocity = (law.force(r, v + step).value - law.force(r, v - step).value) / (2.0 * step);
            let close = |found: f64, expected: f64| (found - expected).abs() < 1e-6 * force.value.abs();
            assert!(close(force.damping, by_velocity), "{law:?}: {} {by_velocity}", force.damping);
            if law.remembers_impact() {
                let struck = |speed: f64| law.struck_at(speed).force(r, v).value;
                let by_speed = (struck(0.6 + step) - struck(0.6 - step)) / (2.0 * step);
                assert!(close(law.by_impact_speed(r, v), by_speed), "{law:?}: {by_speed}");
            }
        }
    }
}

#[test]
fn stops_never_pull() {
    for law in every_law().into_iter().filter(Law::has_pressure) {
        // The pressure vanishes where the force does.
        for v in [-0.2, -1.0, -5.0, -1e3] {
            for depth in [1e-6, 1e-4] {
                let (force, pressure) = (law.force(1e-3 + depth, v).value, law.pressure().unwrap());
                assert!(
                    force <= 0.0 && (force < 0.0) == (pressure.at(depth, v) > 0.0),
                    "{law:?} {v} {depth}"
                );
            }
        }
        assert_eq!(law.force(1e-3 + 1e-6, -1e6), Force::ZERO);
    }
}

#[test]
fn damping_and_restitution_are_in_their_ranges() {
    let hertz = HertzStop::with_gap(1.0, 0.0).unwrap();
    for found in [-1e-9, f64::INFINITY] {
        let refused = LawError::Damping { found };
        assert_eq!(LinearStop::with_gap(1.0, 0.0).unwrap().with_damping(found), Err(refused.clone()));
        assert_eq!(HuntCrossleyStop::new(hertz, found), Err(refused));
    }
    for model in RestitutionModel::ALL {
        for found in [0.0, -0.5, 1.0 + 1e-9] {
            let refused = Err(LawError::Restitution { found });
            assert_eq!(RestitutionStop::new(hertz, model, found), refused);
        }
        assert!(RestitutionStop::new(hertz, model, f64::NAN).is_err());
        assert_eq!(model.factor(1.0), 0.0, "{model:?} loses something at e = 1");
        let preloaded = HertzStop::with_preload(1.0, 2.0).unwrap();
        assert_eq!(RestitutionStop::new(preloaded, model, 0.5), Err(LawError::MemoryOfPreload));
    }
}

/// Of every constant that a description lets vary, at points where the element acts; where the force has a
/// kink, on either side of it.
#[test]
fn derivatives_by_constants_agree_with_differences() {
    for described in DESCRIPTIONS {
        let values = described.sample_values();
        let constants = described.keys.iter().zip(&values).filter_map(|(key, value)| key.constant(value));
        let law = described.sample(1e-3).unwrap()[0].law.struck_at(0.6);
        for constant in constants {
            let value = law.constant(constant);
            let value = value.unwrap_or_else(|| panic!("{} has no {constant:?}", described.name));
            for (r, v) in [(1.002e-3, 0.1), (1.3e-3, 0.5), (1.3e-3, -0.1)] {
                let force = |value| law.with_constant(constant, value).unwrap().force(r, v).value;
                let step = 1e-6 * value;
                let difference = (force(value + step) - force(value - step)) / (2.0 * step);
                let at = ForcePoint { displacement: r, velocity: v, force: force(value) };
                let found = if law.rigid().is_some() { 0.0 } else { law.by_constant(constant, at) };
                let size = at.force.abs() / value;
                assert!(
                    (found - difference).abs() <= 1e-7 * size,
                    "{law:?} by {constant:?} at {r}: {found} {difference}"
                );
            }
        }
    }
}

/// In each piece the law is smooth, and the pieces meet at the kink, with slopes that differ.
#[test]
fn pieces_of_a_force_meet_at_its_kinks() {
    for law in every_law().into_iter().filter(Law::has_kinks) {
        assert_eq!(law.kinks(), [None; 2], "as built a law has its whole force");
        let first = law.in_piece(law.contacts()[0].level);
        let [None, Some(kink)] = first.kinks() else { panic!("{first:?} begins with a kink") };
        let second = first.beyond_kink(true);
        assert_eq!(second.kinks()[0], Some(kink));
        assert_eq!(second.beyond_kink(false), first);
        assert_close(second.force(kink, 0.0).value, first.force(kink, 0.0).value, "at the kink");
        assert!(second.force(kink, 0.0).slope != first.force(kink, 0.0).slope);
        for (piece, place) in [(&first, kink - 1e-5), (&second, kink + 1e-5)] {
            assert_eq!(*piece, law.in_piece(place));
            assert_eq!(piece.force(place, 0.0), law.force(place, 0.0));
        }
    }
}
