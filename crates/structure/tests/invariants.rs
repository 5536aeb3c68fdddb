//! What every reduction keeps: rigid bodies, mass, static flexibility, frequencies below the cut-off.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::TAU;

use crate::common::{bare, lumped, paper_beam, unit_beam};
use approx::assert_relative_eq;
use hammerbeam_structure::{BeamPoint, Damping, End, OutlinePoint, Reduced, Reduction, Structure};

const METHODS: [fn(f64) -> Reduction; 2] = [
    |cut_off_hz| Reduction::FreeInterface { cut_off_hz },
    |cut_off_hz| Reduction::FixedInterface { cut_off_hz },
];

fn reduce(structure: &Structure, reduction: Reduction, interface: &[&str]) -> Reduced {
    structure.reduce(&reduction, &Damping::none(), interface).unwrap()
}

/// Beams with every kind of support, motion prescribed at nothing, an end, both ends or inside.
fn zoo() -> Vec<Structure> {
    let points = || {
        let mass = BeamPoint { mass: 0.3, rotary_inertia: 1e-3, ..bare("mass", 0.37) };
        vec![
            mass,
            BeamPoint { spring: 40.0, rotational_spring: 2.0, ..bare("spring", 0.8) },
            bare("twin", 0.8),
        ]
    };
    let ends = [End::Clamped, End::Pinned, End::Sliding, End::Free];
    let motions: [&[&str]; 4] = [&[], &["left"], &["left", "right"], &["mass"]];
    let mut zoo = Vec::new();
    for left in ends {
        for right in ends {
            let beam = unit_beam(16, left, right, points()).structure().unwrap();
            let bare =
                unit_beam(16, left, right, vec![bare("mass", 0.4), bare("spring", 0.7), bare("twin", 0.72)]);
            zoo.extend(motions.iter().map(|at| beam.clone().with_support_motion(at).unwrap()));
            zoo.push(bare.structure().unwrap());
        }
    }
    zoo
}

/// With rigid-body modes left, the inertia that balances the load is spread over the beam, and nearly exact.
#[test]
fn static_flexibility_at_the_interface_is_exact() {
    for structure in zoo() {
        for method in METHODS {
            let reduced = reduce(&structure, method(20.0), &["mass", "spring", "twin", "left", "right"]);
            let restrained = reduced.tables.clamped_hz[0] > 0.0;
            for error in &reduced.tables.flexibility_errors {
                assert!(error.relative.abs() < if restrained { 1e-8 } else { 5e-2 }, "{error:?}");
            }
        }
    }
}

/// Reduced frequencies are upper bounds; those well below the cut-off are close.
#[test]
fn frequencies_are_bounded_from_below_and_close_under_the_cut_off() {
    for structure in zoo() {
        for method in METHODS {
            let reduced = reduce(&structure, method(60.0), &["mass", "spring"]);
            let errors = &reduced.tables.frequency_errors;
            assert!(errors.iter().all(|error| error.relative > -1e-9), "{errors:?}");
            let low = errors.iter().filter(|error| error.full_hz < 20.0);
            assert!(low.clone().all(|error| error.relative < 1e-2), "{errors:?}");
            assert!(errors.len() < reduced.tables.clamped_hz.len());
        }
    }
}

#[test]
fn rigid_body_modes_survive_the_reduction() {
    for structure in zoo() {
        let rigid = |frequencies: &[f64]| frequencies.iter().filter(|f| **f == 0.0).count();
        for method in METHODS {
            let tables = reduce(&structure, method(20.0), &["mass", "twin"]).tables;
            assert_eq!(rigid(&tables.reduced_hz), rigid(&tables.clamped_hz));
        }
    }
}

#[test]
fn cut_off_above_everything_reduces_nothing() {
    for structure in zoo() {
        for method in METHODS {
            let tables = reduce(&structure, method(1e9), &["mass", "spring", "twin"]).tables;
            assert_eq!(tables.reduced_hz.len(), tables.clamped_hz.len());
            assert!(tables.frequency_errors.iter().all(|error| error.relative.abs() < 1e-8));
        }
    }
}

#[test]
fn unreduced_beam_has_the_clamped_frequencies() {
    for structure in zoo() {
        let tables = reduce(&structure, Reduction::None, &["mass"]).tables;
        assert_eq!(tables.reduced_hz, tables.clamped_hz);
        assert!(tables.free_interface_hz.is_empty());
        assert!(tables.frequency_errors.iter().all(|error| error.relative == 0.0));
    }
}

/// Two loads at one place answer alike, so one residual mode serves both.
#[test]
fn interface_points_at_one_place_count_once() {
    let beam =
        unit_beam(16, End::Clamped, End::Free, vec![bare("a", 0.6), bare("b", 0.6)]).structure().unwrap();
    let once = reduce(&beam, Reduction::FreeInterface { cut_off_hz: 20.0 }, &["a"]).model;
    let twice = reduce(&beam, Reduction::FreeInterface { cut_off_hz: 20.0 }, &["b", "a", "b"]).model;
    assert_eq!(once.natural_frequencies, twice.natural_frequencies);
}

#[test]
fn held_interface_point_adds_no_mode() {
    let beam = unit_beam(16, End::Clamped, End::Free, vec![]).structure().unwrap();
    let without = reduce(&beam, Reduction::FreeInterface { cut_off_hz: 20.0 }, &["right"]).model;
    let with = reduce(&beam, Reduction::FreeInterface { cut_off_hz: 20.0 }, &["left", "right"]).model;
    assert_eq!(without.natural_frequencies, with.natural_frequencies);
    assert!(with.point("left").unwrap().shape.iter().all(|phi| *phi == 0.0));
}

#[test]
fn without_support_motion_the_free_interface_is_the_supported_beam() {
    let beam = paper_beam().structure().unwrap();
    let reduced = reduce(&beam, Reduction::FreeInterface { cut_off_hz: 1000.0 }, &["contact"]);
    let tables = reduced.tables;
    assert_eq!(tables.free_interface_hz, tables.clamped_hz[..4]);
    assert_eq!(tables.reduced_hz.len(), 5);
    assert!(reduced.model.supports.is_empty());
}

/// All modes of a free structure carry all its mass: `sum m_i^2 = 1^T M 1`.
#[test]
fn modal_loads_of_a_free_beam_sum_up_to_its_mass() {
    let points = vec![BeamPoint { mass: 0.25, ..bare("a", 0.3) }];
    let beam = unit_beam(10, End::Free, End::Free, points).structure().unwrap();
    for reduction in [Reduction::None, Reduction::FreeInterface { cut_off_hz: 20.0 }] {
        let model = reduce(&beam, reduction, &["a"]).model;
        let mass: f64 = model.uniform_acceleration.iter().map(|m| m * m).sum();
        assert_relative_eq!(mass, 1.25, max_relative = 1e-12);
        assert_eq!(model.natural_frequencies.iter().filter(|w| **w == 0.0).count(), 2);
    }
}

#[test]
fn floating_groups_of_masses_have_a_rigid_body_mode_each() {
    let names = ["a", "b", "c", "d", "e"];
    let masses = names.map(|name| (name, 0.1));
    let system = lumped(&masses, &[("a", "b", 1e6), ("c", "d", 1e-3)], &[]);
    let hz = system.structure().unwrap().eigenfrequencies_hz().unwrap();
    assert_eq!(hz[..3], [0.0, 0.0, 0.0]);
    assert_relative_eq!(hz[3], (2e-3_f64 / 0.1).sqrt() / TAU, max_relative = 1e-10);
    assert_relative_eq!(hz[4], (2e6_f64 / 0.1).sqrt() / TAU, max_relative = 1e-14);
}

/// `w_j = 2 sqrt(k/m) sin(j pi / (2 (n + 1)))` of a chain held at both ends, here with doubled springs.
#[test]
fn chain_of_forty_masses_has_the_closed_form_and_fills_one_table() {
    let names: Vec<String> = (1..=40).map(|i| format!("m{i}")).collect();
    let masses: Vec<(&str, f64)> = names.iter().map(|name| (name.as_str(), 2.0)).collect();
    let mut stations = vec!["ground"];
    stations.extend(names.iter().map(String::as_str));
    stations.push("ground");
    let springs: Vec<(&str, &str, f64)> =
        stations.windows(2).flat_map(|pair| [(pair[0], pair[1], 5.0), (pair[1], pair[0], 3.0)]).collect();
    let structure = lumped(&masses, &springs, &[]).structure().unwrap();
    let reduced = reduce(&structure, Reduction::None, &["m7"]);
    for (j, w) in reduced.model.natural_frequencies.iter().enumerate() {
        let expected = 4.0 * ((j + 1) as f64 * std::f64::consts::PI / 82.0).sin();
        assert_relative_eq!(*w, expected, max_relative = 1e-13);
    }
    assert_eq!(reduced.tables.clamped_hz.len(), 40);
    assert!(reduced.tables.reduced_hz.is_empty() && reduced.tables.free_interface_hz.is_empty());
    assert_eq!(reduced.model.points.len(), 41);
}

#[test]
fn same_input_gives_the_same_bits() {
    let shaken = || paper_beam().structure().unwrap().with_support_motion(&["left"]).unwrap();
    let model = || reduce(&shaken(), Reduction::FreeInterface { cut_off_hz: 1000.0 }, &["contact"]).model;
    let (one, two) = (model(), model());
    assert_eq!(one.natural_frequencies, two.natural_frequencies);
    assert_eq!(one.points, two.points);
}

/// The outline of a structure passes through its named points, and goes from one end to the other.
#[test]
fn the_outline_passes_through_the_points() {
    for structure in zoo() {
        let Reduced { model, outline, .. } = reduce(&structure, METHODS[0](20.0), &["mass", "spring"]);
        assert!(outline.windows(2).all(|places| places[0].at < places[1].at));
        for (name, place) in [("left", outline.first().unwrap()), ("right", outline.last().unwrap())] {
            let point = model.point(name).unwrap();
            assert_eq!(
                (&point.shape, &point.support_ratios),
                (&place.shape, &place.support_ratios),
                "{name}"
            );
        }
        for point in &model.points {
            let is_there = |place: &OutlinePoint| {
                place.shape == point.shape && place.support_ratios == point.support_ratios
            };
            assert!(outline.iter().any(is_there), "{}", point.name);
        }
    }
}

/// First mode of a clamped-free beam: `w(x) / w(L)` is half of `cosh kx - cos kx - s (sinh kx - sin kx)`, `k
/// L = 1.87510407`, `s = 0.73409551`.
#[test]
fn the_outline_of_a_cantilever_has_the_shape_of_its_first_mode() {
    let beam = unit_beam(16, End::Clamped, End::Free, Vec::new());
    let outline = reduce(&beam.structure().unwrap(), Reduction::None, &[]).outline;
    let tip = outline.last().unwrap();
    for place in &outline {
        let kx = 1.875_104_07 * place.at / tip.at;
        let meant = 0.5 * (kx.cosh() - kx.cos() - 0.734_095_51 * (kx.sinh() - kx.sin()));
        // Cubic elements: the error of the shape is of the order of (k h)^4 = 2e-4 times its fourth
        // derivative's share, 1/720.
        assert_relative_eq!(place.shape[0] / tip.shape[0], meant, epsilon = 1e-6);
    }
}

/// Masses of a lumped structure, without the ground.
#[test]
fn the_outline_of_masses_is_one_place_each() {
    let structure = lumped(&[("a", 1.0), ("b", 2.0)], &[("a", "ground", 1.0), ("a", "b", 3.0)], &[]);
    let outline = reduce(&structure.structure().unwrap(), Reduction::None, &[]).outline;
    assert_eq!(outline.iter().map(|place| place.at).collect::<Vec<_>>(), [0.0, 1.0]);
}
