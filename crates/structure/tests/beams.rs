//! Beams of several spans, on several supports, with shear, against closed forms.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::{PI, TAU};

use crate::common::{bare, paper_beam, unit_beam};
use approx::assert_relative_eq;
use hammerbeam_structure::{
    BeamPoint, BeamSpan, Damping, End, Reduction, Section, Shear, SteppedBeam, Structure,
};

/// A span of `E I`, `rho A` and length, both constants of its section alone.
fn span(length: f64, bending_stiffness: f64, mass_per_length: f64) -> BeamSpan {
    let section = Section::general(mass_per_length, bending_stiffness).unwrap();
    BeamSpan { length, section, youngs_modulus: 1.0, density: 1.0, added_mass: 0.0, shear: None }
}

fn beam(elements: usize, spans: &[BeamSpan], left: End, right: End) -> SteppedBeam {
    SteppedBeam { elements, spans: spans.to_vec(), left, right, points: Vec::new() }
}

/// Angular eigenfrequencies [rad/s].
fn rates(beam: &SteppedBeam) -> Vec<f64> {
    let hz = beam.structure().unwrap().eigenfrequencies_hz().unwrap();
    hz.into_iter().map(|hz| TAU * hz).collect()
}

/// Displacement of a point under a unit force there.
fn flexibility(structure: &Structure, point: &str) -> f64 {
    let reduced = structure.reduce(&Reduction::None, &Damping::none(), &[point]).unwrap();
    reduced.tables.flexibility_errors[0].full
}

#[test]
fn beam_of_one_span_is_the_uniform_beam_bit_for_bit() {
    let paper = paper_beam();
    let bits = |structure: Structure| -> Vec<u64> {
        structure.eigenfrequencies_hz().unwrap().into_iter().map(f64::to_bits).collect()
    };
    let uniform = bits(paper.structure().unwrap());
    assert_eq!(bits(paper.stepped().structure().unwrap()), uniform);
    // Without added mass, rho A + 0 is rho A.
    let mut stepped = paper.stepped();
    stepped.spans[0].added_mass = 0.0;
    assert_eq!(bits(stepped.structure().unwrap()), uniform);
}

#[test]
fn a_border_between_equal_spans_is_nothing_but_a_node() {
    let whole = rates(&beam(40, &[span(1.0, 1.0, 1.0)], End::Clamped, End::Free));
    let halves = rates(&beam(40, &[span(0.5, 1.0, 1.0); 2], End::Clamped, End::Free));
    for (one, other) in whole.iter().zip(&halves) {
        assert_relative_eq!(one, other, max_relative = 1e-12);
    }
}

/// `b^3/(3 E I_2) + ((a + b)^3 - b^3)/(3 E I_1)`: curvature is the moment over the stiffness of each span.
#[test]
fn tip_of_a_stepped_cantilever_yields_as_its_spans_bend() {
    let (a, b, first, second) = (0.6_f64, 0.4_f64, 5.0, 2.0);
    let spans = [span(a, first, 1.0), span(b, second, 0.5)];
    let tip = beam(10, &spans, End::Clamped, End::Free).structure().unwrap();
    let expected = b.powi(3) / (3.0 * second) + ((a + b).powi(3) - b.powi(3)) / (3.0 * first);
    assert_relative_eq!(flexibility(&tip, "right"), expected, max_relative = 1e-10);
}

/// State `(w, w', M, -Q)` at the end of a span from that at its start, for harmonic motion at a rate.
fn transferred(state: [f64; 4], span: &BeamSpan, rate: f64) -> [f64; 4] {
    let stiffness = span.youngs_modulus * span.section.second_moment();
    let mass = span.density * span.section.area() + span.added_mass;
    let beta = (rate * rate * mass / stiffness).powf(0.25);
    let x = beta * span.length;
    // The functions of Krylov: each is the derivative of the next.
    let krylov = [
        0.5 * (x.cosh() + x.cos()),
        0.5 * (x.sinh() + x.sin()),
        0.5 * (x.cosh() - x.cos()),
        0.5 * (x.sinh() - x.sin()),
    ];
    let scaled = [
        state[0],
        state[1] / beta,
        state[2] / (stiffness * beta.powi(2)),
        state[3] / (stiffness * beta.powi(3)),
    ];
    let derivative =
        |order: usize| -> f64 { (0..4).map(|of| krylov[(of + 4 - order) % 4] * scaled[of]).sum() };
    [
        derivative(0),
        beta * derivative(1),
        stiffness * beta.powi(2) * derivative(2),
        stiffness * beta.powi(3) * derivative(3),
    ]
}

/// The frequency equation of a cantilever of spans: no moment and no shear at the tip.
fn cantilever_equation(spans: &[BeamSpan], rate: f64) -> f64 {
    let end = |start: [f64; 4]| spans.iter().fold(start, |state, span| transferred(state, span, rate));
    let (moment, shear) = (end([0.0, 0.0, 1.0, 0.0]), end([0.0, 0.0, 0.0, 1.0]));
    moment[2] * shear[3] - moment[3] * shear[2]
}

/// The exact frequency equation of three spans, one with added mass, changes its sign at each frequency; 80
/// elements leave an error of `(beta l)^4 / 1440`, some 1e-7 at the fourth mode.
#[test]
fn frequencies_of_a_stepped_cantilever_solve_its_frequency_equation() {
    let loaded = BeamSpan { added_mass: 0.7, ..span(0.3, 2.0, 0.8) };
    let spans = [span(0.5, 6.0, 1.5), loaded, span(0.4, 1.0, 0.6)];
    let found = rates(&beam(80, &spans, End::Clamped, End::Free));
    for rate in &found[..4] {
        let sides = [1.0 - 1e-6, 1.0 + 1e-6].map(|factor| cantilever_equation(&spans, factor * rate));
        assert!(sides[0] * sides[1] < 0.0, "{rate}: {sides:?}");
    }
    // Between the frequencies there are no others.
    let signs: Vec<bool> = (1..4000)
        .map(|step| cantilever_equation(&spans, found[3] * 1.01 * f64::from(step) / 4000.0) > 0.0)
        .collect();
    assert_eq!(signs.windows(2).filter(|pair| pair[0] != pair[1]).count(), 4);
}

/// `f = 1.8751^2 / (2 pi L^2) sqrt(E I / (rho A + m))` with `I = pi/64 (D^4 - d^4)`: a steel tube of 25 x 2
/// mm and 0.8 m, empty and with water in it (0.3464 kg/m).
#[test]
fn tube_full_of_water_is_slower_by_the_root_of_its_mass() {
    let (outer, inner, length): (f64, f64, f64) = (0.025, 0.021, 0.8);
    let moment = PI / 64.0 * (outer.powi(4) - inner.powi(4));
    let steel = 7800.0 * PI / 4.0 * (outer.powi(2) - inner.powi(2));
    let water = 1000.0 * PI / 4.0 * inner.powi(2);
    for added_mass in [0.0, water] {
        let tube = BeamSpan {
            section: Section::tube(outer, 0.002).unwrap(),
            youngs_modulus: 2.1e11,
            density: 7800.0,
            added_mass,
            ..span(length, 1.0, 1.0)
        };
        let found = rates(&beam(40, &[tube], End::Clamped, End::Free))[0];
        let expected = (1.875104068711961 / length).powi(2) * (2.1e11 * moment / (steel + added_mass)).sqrt();
        assert_relative_eq!(found, expected, max_relative = 1e-8);
    }
}

/// Rotations `cos(i k pi/N)` at the supports of N equal spans solve `a theta_i + b theta_(i+1) = 0`, so that
/// `cos(k pi/N) = -a/b` with the dynamic stiffnesses of a span, `a ~ cosh x sin x - sinh x cos x` and
/// `b ~ sinh x - sin x`.
fn continuous_equation(x: f64, of_spans: f64) -> f64 {
    (x.cosh() * x.sin() - x.sinh() * x.cos()) / (x.sinh() - x.sin()) + of_spans.cos()
}

fn zero(function: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    assert!(function(low) * function(high) < 0.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        *(if function(low) * function(middle) <= 0.0 { &mut high } else { &mut low }) = middle;
    }
    0.5 * (low + high)
}

/// Three equal spans on four supports: wavenumbers of a span, `pi` first, then those of the equation. The
/// error of 20 elements a span, `(beta l)^4 / 2880`, is 3.4e-6 at the fourth.
#[test]
fn beam_on_four_supports_has_the_frequencies_of_a_continuous_beam() {
    let mut continuous = beam(60, &[span(1.0, 1.0, 1.0); 3], End::Pinned, End::Pinned);
    let support = |name: &str, at| BeamPoint { support: End::Pinned, ..bare(name, at) };
    continuous.points = vec![support("second", 1.0), support("third", 2.0)];
    let found: Vec<f64> = rates(&continuous).into_iter().map(f64::sqrt).collect();
    let of = |k: f64| zero(|x| continuous_equation(x, k * PI / 3.0), PI + 1e-6, 1.5 * PI);
    for (found, expected) in found.iter().zip([PI, of(2.0), of(1.0), 2.0 * PI]) {
        assert_relative_eq!(*found, expected, max_relative = 4e-6);
    }
}

/// A support that holds the rotation, too, makes two beams of one.
#[test]
fn a_clamp_in_the_middle_parts_the_beam() {
    let points = vec![BeamPoint { support: End::Clamped, ..bare("clamp", 0.4) }];
    let found = rates(&unit_beam(60, End::Clamped, End::Free, points).stepped());
    let mut expected = vec![
        (4.730040744862704_f64 / 0.4).powi(2),
        (1.875104068711961_f64 / 0.6).powi(2),
        (4.694091132974175_f64 / 0.6).powi(2),
    ];
    expected.sort_by(f64::total_cmp);
    for (found, expected) in found.iter().zip(expected) {
        assert_relative_eq!(*found, expected, max_relative = 1e-5);
    }
}

#[test]
fn a_force_at_a_support_has_no_answer() {
    let points = vec![BeamPoint { support: End::Pinned, ..bare("held", 0.4) }];
    let structure = unit_beam(20, End::Clamped, End::Free, points).structure().unwrap();
    let reduced = structure.reduce(&Reduction::None, &Damping::none(), &[]).unwrap();
    assert!(reduced.model.point("held").unwrap().shape.iter().all(|entry| *entry == 0.0));
}

/// A steel bar of 20 x 20 mm with shear.
fn thick(length: f64) -> BeamSpan {
    let section = Section::rectangle(0.02, 0.02).unwrap();
    let shear = Shear { modulus: 2.1e11 / 2.6, coefficient: section.shear_coefficient(0.3).unwrap() };
    BeamSpan { length, section, youngs_modulus: 2.1e11, density: 7800.0, added_mass: 0.0, shear: Some(shear) }
}

/// `L^3/(3 E I) + L/(kappa G A)`.
#[test]
fn thick_cantilever_yields_in_bending_and_in_shear() {
    let bar = thick(0.1);
    let shear = bar.shear.unwrap();
    let structure = beam(7, &[bar], End::Clamped, End::Free).structure().unwrap();
    let bending = 0.1_f64.powi(3) / (3.0 * 2.1e11 * bar.section.second_moment());
    let sheared = 0.1 / (shear.coefficient * shear.modulus * bar.section.area());
    assert_relative_eq!(flexibility(&structure, "right"), bending + sheared, max_relative = 1e-10);
    assert!(sheared > 0.02 * bending);
}

/// `rho A w^2 (1 + ...)`: with `k = n pi/L`, the lower root of
/// `E I k^4 - rho A w^2 - rho I k^2 (1 + E/(kappa G)) w^2 + rho^2 I/(kappa G) w^4 = 0`.
fn pinned_timoshenko(bar: &BeamSpan, n: f64) -> f64 {
    let shear = bar.shear.unwrap();
    let (area, moment) = (bar.section.area(), bar.section.second_moment());
    let k = n * PI / bar.length;
    let stiffness = shear.coefficient * shear.modulus;
    let quadratic = bar.density.powi(2) * moment / stiffness;
    let linear = bar.density * (area + moment * k * k * (1.0 + bar.youngs_modulus / stiffness));
    let constant = bar.youngs_modulus * moment * k.powi(4);
    (2.0 * constant / (linear + (linear * linear - 4.0 * quadratic * constant).sqrt())).sqrt()
}

/// A bar ten times as long as thick: the third frequency is 11 % below that of Euler and Bernoulli. The shear
/// angle of an element is constant, which leaves `(k l)^2 k^2 E I/(24 kappa G A)` with `k` of the mode.
#[test]
fn pinned_thick_beam_has_the_frequencies_of_timoshenko() {
    let bar = thick(0.2);
    let shear = bar.shear.unwrap();
    let compliance = bar.youngs_modulus * bar.section.second_moment()
        / (shear.coefficient * shear.modulus * bar.section.area());
    let error = |elements: u32, mode: usize, n: f64| {
        let found = rates(&beam(elements as usize, &[bar], End::Pinned, End::Pinned))[mode];
        let k = n * PI / bar.length;
        let left = (k * bar.length / f64::from(elements)).powi(2) * k * k * compliance / 24.0;
        (found / pinned_timoshenko(&bar, n) - 1.0, left)
    };
    for (mode, n) in [1.0, 2.0, 3.0].into_iter().enumerate() {
        let (found, expected) = error(100, mode, n);
        assert!(found > 0.0 && found < expected, "{n}: {found:e}, {expected:e}");
    }
    let order = (error(12, 2, 3.0).0 / error(48, 2, 3.0).0).log2() / 2.0;
    assert!((order - 2.0).abs() < 0.1, "order {order}");
    let plain = rates(&beam(100, &[BeamSpan { shear: None, ..bar }], End::Pinned, End::Pinned));
    assert!((0.85..0.92).contains(&(pinned_timoshenko(&bar, 3.0) / plain[2])));
}

#[test]
fn what_is_wrong_with_a_span_names_it() {
    let message =
        |spans: &[BeamSpan]| beam(10, spans, End::Clamped, End::Free).structure().unwrap_err().to_string();
    let good = span(0.5, 1.0, 1.0);
    let negative = BeamSpan { added_mass: -1.0, ..good };
    assert_eq!(message(&[good, negative]), "added mass of span 2 is -1, must be 0 or greater");
    let short = BeamSpan { length: 1e-6, ..good };
    assert!(message(&[good, short, good]).starts_with("points \"end of span 1\" and \"end of span 2\" are"));
    let many = beam(2, &[good; 3], End::Clamped, End::Free).structure().unwrap_err();
    assert!(many.to_string().contains("into 3 stretches"), "{many}");
}
