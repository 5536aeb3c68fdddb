//! What is read off orbits, against closed forms, balances of momentum, and the certified maxima.

use std::f64::consts::TAU;

use hammerbeam_motion::{
    Law, System,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_orbit::{
    OrbitSettings, OrbitSignal, PeriodicSolution, Response, SignalStatistics, TimeDerivative, find_start,
    read_orbit,
};
use hammerbeam_testkit::{
    laws, paper_rig,
    structures::unit_mass,
    systems::{element, force, forced},
};

const ALL: [TimeDerivative; 3] =
    [TimeDerivative::Displacement, TimeDerivative::Velocity, TimeDerivative::Acceleration];

fn moving(shape: &[f64], support_ratios: &[f64]) -> Vec<OrbitSignal> {
    let signal = |derivative| OrbitSignal::Motion {
        shape: shape.to_vec(),
        support_ratios: support_ratios.to_vec(),
        derivative,
    };
    ALL.map(signal).into()
}

fn read(system: &System, solution: &PeriodicSolution, signals: &[OrbitSignal]) -> Vec<SignalStatistics> {
    let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings::default()).unwrap();
    read_orbit(&mut integrator, solution, signals, 3).unwrap()
}

/// The mass on its spring with a damping of 0.1 under these loads (order, amplitude, phase), at a frequency.
fn driven(loads: &[(u32, f64, f64)], law: Option<Law>, w: f64) -> (System, PeriodicSolution) {
    let load =
        forced(loads.iter().map(|(order, size, phase)| force(&[1.0], *order, *size, *phase)).collect());
    let elements = law.into_iter().map(|law| element(&[1.0], 0.0, law)).collect();
    let system = System::new(unit_mass(1.0, 0.1), &load, elements).unwrap();
    let response = Response { shape: vec![1.0], support_ratios: vec![0.0] };
    let solution = find_start(&system, &response, w / TAU, 1, &OrbitSettings::default()).unwrap();
    (system, solution)
}

/// `1/(1 - v^2 + 0.1 i v)`.
fn receptance(v: f64) -> [f64; 2] {
    let (re, im) = (1.0 - v * v, 0.1 * v);
    let square = re * re + im * im;
    [re / square, -im / square]
}

fn times(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

#[track_caller]
fn assert_near(found: f64, exact: f64, tolerance: f64, what: &str) {
    assert!((found - exact).abs() <= tolerance, "{what}: {found} instead of {exact}");
}

#[test]
fn a_linear_oscillator_has_the_amplitudes_and_phases_of_its_receptance() {
    let (w, offset, phase) = (0.7, 0.4, 0.3_f64);
    let (system, solution) = driven(&[(0, offset, 0.0), (1, 1.5, phase)], None, w);
    let exact = times(receptance(w), [1.5 * phase.cos(), 1.5 * phase.sin()]);
    let amplitude = exact[0].hypot(exact[1]);
    let found = read(&system, &solution, &moving(&[1.0], &[0.0]));
    let mut turned = exact;
    for (order, statistics) in found.iter().enumerate() {
        let size = amplitude * w.powi(order as i32);
        let mean = if order == 0 { offset } else { 0.0 };
        let rms = (0.5 * size * size + mean * mean).sqrt();
        for (value, exact, what) in [
            (statistics.maximum, mean + size, "maximum"),
            (statistics.minimum, mean - size, "minimum"),
            (statistics.largest(), mean + size, "largest"),
            (statistics.peak_to_peak(), 2.0 * size, "peak to peak"),
            (statistics.mean, mean, "mean"),
            (statistics.root_mean_square, rms, "root mean square"),
            (statistics.harmonics[0][0], turned[0], "real part"),
            (statistics.harmonics[0][1], turned[1], "imaginary part"),
            (statistics.harmonics[1][0].hypot(statistics.harmonics[1][1]), 0.0, "second harmonic"),
        ] {
            // The orbit closes to 1e-10 of its size.
            assert_near(value, exact, 1e-9 * amplitude, &format!("{what} of derivative {order}"));
        }
        turned = times(turned, [0.0, w]);
    }
}

#[test]
fn each_harmonic_of_a_load_is_found_in_its_order() {
    let w = 0.45;
    let loads = [(1, 1.0, 0.0), (2, 0.5, 1.0_f64), (3, 0.8, -0.7)];
    let (system, solution) = driven(&loads, None, w);
    let found = &read(&system, &solution, &moving(&[1.0], &[0.0]))[0];
    for (order, size, phase) in loads {
        let exact = times(receptance(f64::from(order) * w), [size * phase.cos(), size * phase.sin()]);
        let harmonic = found.harmonics[order as usize - 1];
        assert_near(harmonic[0], exact[0], 1e-9, "real part");
        assert_near(harmonic[1], exact[1], 1e-9, "imaginary part");
    }
}

/// `x'' + 0.1 x' + x = f(t) - F(x)` integrated over a period, and multiplied by `exp(-i k w t)`:
/// `mean x + mean F = mean f`, `x_k/receptance(k w) + F_k = f_k`. The largest force follows from the law at
/// the largest displacement.
#[test]
fn forces_of_stops_obey_their_law_and_balance_the_motion() {
    type Force = fn(f64) -> f64;
    // Each law, the displacement at which its force sets in, and the force beyond it.
    let known: [(Law, f64, Option<Force>); 4] = [
        (laws::linear(20.0, 0.3), 0.3, Some(|p| 20.0 * p)),
        (laws::hertz(40.0, 0.3), 0.3, Some(|p| 40.0 * p.powf(1.5))),
        (laws::cubic(0.7), 0.0, Some(|x| 0.7 * x.powi(3))),
        (laws::damped(20.0, 0.5, 0.3), 0.3, None),
    ];
    for (law, gap, force_beyond) in known {
        let w = 0.8;
        let (system, solution) = driven(&[(0, 0.1, 0.0), (1, 1.0, 0.5)], Some(law), w);
        let mut signals = moving(&[1.0], &[0.0]);
        signals.push(OrbitSignal::Pressing { elements: vec![(0, 1.0)] });
        let found = read(&system, &solution, &signals);
        let [x, _, _, pressed] = &found[..] else { panic!("four signals were asked for") };
        if let Some(force) = force_beyond {
            let exact = force(x.maximum - gap);
            assert_near(pressed.maximum, exact, 1e-9 * exact, "largest force");
        }
        assert_near(x.mean + pressed.mean, 0.1, 1e-9, "balance of the mean");
        for k in 0..3 {
            let [re, im] = receptance((k + 1) as f64 * w);
            let square = re * re + im * im;
            let held = times(x.harmonics[k], [re / square, -im / square]);
            let loaded = if k == 0 { [0.5_f64.cos(), 0.5_f64.sin()] } else { [0.0; 2] };
            assert_near(held[0] + pressed.harmonics[k][0], loaded[0], 1e-9, "balance, real part");
            assert_near(held[1] + pressed.harmonics[k][1], loaded[1], 1e-9, "balance, imaginary part");
        }
    }
}

/// A mass that bounces on a rigid stop once a period with the speed V gets the impulse `(1 + e) V`: the
/// mean force is that over the period, and so, with `x'' + x = cos(w t) - F` and no mean acceleration,
/// is `-mean x`. The speed follows from Shaw and Holmes (1983): `(s + V C (1 + e)/2)^2 + (V (1 - e)/(2 w))^2
/// = g^2`.
#[test]
fn impulses_of_a_bouncing_mass_count_in_means_and_harmonics() {
    let (gap, e, w) = (0.1_f64, 0.6, 1.8);
    let law = laws::rigid(e, gap);
    let load = forced(vec![force(&[1.0], 1, 1.0, 0.4)]);
    let system = System::new(unit_mass(1.0, 0.0), &load, vec![element(&[1.0], 0.0, law)]).unwrap();
    let response = Response { shape: vec![1.0], support_ratios: vec![0.0] };
    let solution = find_start(&system, &response, w / TAU, 1, &OrbitSettings::default()).unwrap();
    let (g, cot) = (1.0 / (1.0 - w * w), (TAU / w / 2.0).tan().recip());
    let square = ((1.0 + e) / 2.0 * cot).powi(2) + ((1.0 - e) / (2.0 * w)).powi(2);
    let half = gap * (1.0 + e) / 2.0 * cot;
    let speed = (-half + (half * half - square * (gap * gap - g * g)).sqrt()) / square;
    let mean_force = (1.0 + e) * speed / (TAU / w);
    let mut signals = moving(&[1.0], &[0.0]);
    signals.push(OrbitSignal::Pressing { elements: vec![(0, 1.0)] });
    let found = read(&system, &solution, &signals);
    let [x, v, a, pressed] = &found[..] else { panic!("four signals were asked for") };
    for (found, exact, what) in [
        (x.maximum, gap, "the mass reaches the stop"),
        (v.maximum, speed, "largest velocity"),
        (pressed.mean, mean_force, "mean force"),
        (x.mean, -mean_force, "mean displacement"),
        (v.mean, 0.0, "mean velocity"),
        (a.mean, 0.0, "mean acceleration"),
        (pressed.maximum, 0.0, "no force between impacts"),
        (pressed.root_mean_square, 0.0, "no force between impacts"),
    ] {
        assert_near(found, exact, 1e-9, what);
    }
    for k in 0..3 {
        let order = w * (k + 1) as f64;
        let rate = times(x.harmonics[k], [0.0, order]);
        let second = times(rate, [0.0, order]);
        let loaded = if k == 0 { [0.4_f64.cos(), 0.4_f64.sin()] } else { [0.0; 2] };
        for part in 0..2 {
            assert_near(v.harmonics[k][part], rate[part], 1e-9, "velocity");
            assert_near(a.harmonics[k][part], second[part], 1e-8, "acceleration");
            let balance = second[part] + x.harmonics[k][part] + pressed.harmonics[k][part];
            assert_near(balance, loaded[part], 1e-9, "balance of a harmonic");
        }
    }
}

/// The certified search for maxima is a second method for the largest values.
#[test]
fn largest_values_of_the_papers_beam_are_the_certified_maxima() {
    let rig = paper_rig();
    for (frequency_hz, multiple) in [(22.0, 1), (27.55, 1), (36.2, 1), (53.0, 2)] {
        let settings = OrbitSettings::default();
        let solution = find_start(&rig.system, &rig.response, frequency_hz, multiple, &settings).unwrap();
        let mut signals = moving(&rig.response.shape, &rig.response.support_ratios);
        signals.push(OrbitSignal::Pressing { elements: vec![(0, 1.0)] });
        let found = read(&rig.system, &solution, &signals);
        let maxima = &solution.maxima;
        for (found, exact, what) in [
            (found[0].largest(), maxima.displacement, "displacement"),
            (found[2].largest(), maxima.acceleration, "acceleration"),
            (found[3].maximum, maxima.contact_force, "force"),
        ] {
            assert_near(found, exact, 1e-9 * exact, &format!("{what} at {frequency_hz} Hz"));
        }
    }
}
