//! Systems shared by the tests.
#![allow(dead_code, reason = "each test file uses some of them")]
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

#[path = "../../../motion/tests/common/mod.rs"]
mod motion;

#[allow(unused_imports, reason = "each test file uses some of them")]
pub use motion::{beam_with, element, hertz, model, paper_beam};

use hammerbeam_motion::{Harmonic, HarmonicForce, Load, LocalElement, System};

/// Whether whole sets are asked for instead of samples.
pub fn extensive() -> bool {
    std::env::var("HAMMERBEAM_EXTENSIVE").is_ok_and(|value| value == "1")
}

/// A mass of 1 kg on a spring of `stiffness` with damping `damping`, driven by `force cos(W t)`, with
/// elements that act on it.
pub fn oscillator(stiffness: f64, damping: f64, force: f64, elements: Vec<LocalElement>) -> System {
    let model = model(&[stiffness.sqrt()], faer::mat![[damping]]);
    let harmonic = Harmonic { order: 1, amplitude: force, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    System::new(model, &load, elements).unwrap()
}
