//! The three eigenfrequencies that van de Vorst et al. measured, 17.2, 128.9 and 378.9 Hz: modulus and
//! contact mass that come closest.
//!
//! Independently of the program: a beam of two spans by the solution of Euler and Bernoulli, the contact mass
//! between them, no elements, no reduction; and instead of least squares by derivatives the best modulus in
//! closed form (frequencies go with its root) and the mass by golden section.
//!
//! | what | value |
//! |---|---|
//! | clamp to contact mass, overhang | 0.2432157 m, 0.0147665 m |
//! | section, density | 29.8 x 2.0 mm, 7800 kg/m^3 |
//! | rotary inertia of the contact mass | 1.59e-8 kg m^2 |
//! | standard deviations | half a percent, assumed |
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use hammerbeam_jobs::update::{UpdateData, UpdateSettings, update};
use hammerbeam_study::StudyFile;

const MEASURED_HZ: [f64; 3] = [17.2, 128.9, 378.9];
const DEVIATION: f64 = 0.005;
const SPANS: [f64; 2] = [0.243_215_7, 0.014_766_5];
const AREA: f64 = 0.0298 * 0.0020;
const SECOND_MOMENT: f64 = 0.0298 * 0.0020 * 0.0020 * 0.0020 / 12.0;
const DENSITY: f64 = 7800.0;
const ROTARY_INERTIA: f64 = 1.59e-8;
const MODULUS: f64 = 2.1e11;

/// Displacement, slope, bending moment and its derivative at the end of a span, of those at its beginning.
fn over(span: f64, wave_number: f64, bending: f64, at: [f64; 4]) -> [f64; 4] {
    let x = wave_number * span;
    let (s, c, sh, ch) = (x.sin(), x.cos(), x.sinh(), x.cosh());
    // Krylov's functions: each is the integral of the one before it.
    let k = [0.5 * (ch + c), 0.5 * (sh + s), 0.5 * (ch - c), 0.5 * (sh - s)];
    let b = wave_number;
    let [w, slope, moment, shear] = at;
    let (m, q) = (moment / bending, shear / bending);
    [
        w * k[0] + slope / b * k[1] + m / (b * b) * k[2] + q / (b * b * b) * k[3],
        b * w * k[3] + slope * k[0] + m / b * k[1] + q / (b * b) * k[2],
        bending * (b * b * w * k[2] + b * slope * k[3] + m * k[0] + q / b * k[1]),
        bending * (b * b * b * w * k[1] + b * b * slope * k[2] + b * m * k[3] + q * k[0]),
    ]
}

/// Zero at an eigenfrequency: what is left of moment and shear at the free end.
fn determinant(mass: f64, frequency_hz: f64) -> f64 {
    let w = std::f64::consts::TAU * frequency_hz;
    let bending = MODULUS * SECOND_MOMENT;
    let wave_number = (w * w * DENSITY * AREA / bending).powf(0.25);
    let end = |begin: [f64; 4]| {
        let [y, slope, moment, shear] = over(SPANS[0], wave_number, bending, begin);
        let behind = [y, slope, moment - w * w * ROTARY_INERTIA * slope, shear + w * w * mass * y];
        over(SPANS[1], wave_number, bending, behind)
    };
    let (a, b) = (end([0.0, 0.0, 1.0, 0.0]), end([0.0, 0.0, 0.0, 1.0]));
    a[2] * b[3] - a[3] * b[2]
}

/// The first three eigenfrequencies with the modulus of the study.
fn eigenfrequencies(mass: f64) -> [f64; 3] {
    let mut found = Vec::new();
    let (mut below, mut value) = (5.0, determinant(mass, 5.0));
    while found.len() < 3 {
        let above = below + 1.0;
        let next = determinant(mass, above);
        if (value > 0.0) != (next > 0.0) {
            let (mut low, mut high) = (below, above);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let same = (determinant(mass, middle) > 0.0) == (value > 0.0);
                if same { low = middle } else { high = middle }
            }
            found.push(0.5 * (low + high));
        }
        (below, value) = (above, next);
    }
    [found[0], found[1], found[2]]
}

/// Chi-squared with the best modulus for a mass, and that modulus.
fn best_modulus(mass: f64) -> (f64, f64) {
    let computed = eigenfrequencies(mass);
    let scaled: Vec<f64> = computed.iter().zip(MEASURED_HZ).map(|(f, measured)| f / measured).collect();
    // The least of sum (root x - 1)^2.
    let root = scaled.iter().sum::<f64>() / scaled.iter().map(|x| x * x).sum::<f64>();
    let chi_squared = scaled.iter().map(|x| ((root * x - 1.0) / DEVIATION).powi(2)).sum();
    (chi_squared, MODULUS * root * root)
}

fn best_mass() -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (0.015, 0.05);
    for _ in 0..80 {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if best_modulus(a).0 < best_modulus(b).0 { high = b } else { low = a }
    }
    0.5 * (low + high)
}

#[test]
fn printed_eigenfrequencies_are_those_of_the_two_spans() {
    // The reconstructed lengths give them to 6e-5.
    for (found, printed) in eigenfrequencies(0.03756).into_iter().zip([17.495, 137.28, 414.33]) {
        assert!((found / printed - 1.0).abs() < 6e-5, "{found} {printed}");
    }
}

#[test]
fn measured_eigenfrequencies_ask_for_a_modulus_of_176_gpa_and_a_contact_mass_of_27_6_g() {
    let mass = best_mass();
    let (chi_squared, modulus) = best_modulus(mass);
    let studies = Path::new(env!("CARGO_MANIFEST_DIR")).join("../studies");
    let study = StudyFile::read(&studies.join("beam-with-stop.toml")).unwrap();
    let data =
        UpdateData::read(&studies.join("measurements/measured-eigenfrequencies.toml"), &study).unwrap();
    let found = update(&study, &data, &UpdateSettings::default()).unwrap();
    assert!(found.end.converged());
    let [e, m] = [&found.parameters[0], &found.parameters[1]];
    // Elements and reduction move the frequencies by up to 5e-5, which moves the mass by about ten times as
    // much.
    assert!((e.value / modulus - 1.0).abs() < 5e-4, "{} {modulus}", e.value);
    assert!((m.value / mass - 1.0).abs() < 1e-3, "{} {mass}", m.value);
    assert!(
        (modulus / 1.755e11 - 1.0).abs() < 1e-3 && (mass / 27.6e-3 - 1.0).abs() < 1e-3,
        "{modulus} {mass}"
    );
    assert!((chi_squared - 4.6).abs() < 0.05, "{chi_squared}");
}
