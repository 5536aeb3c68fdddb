//! A sweep of our own: how far a mass between impacts swings at 0.2 Hz, over the gap of its rigid stop. Each
//! motion begins where the one before has settled.

#![allow(clippy::print_stdout, missing_docs, reason = "an example shows what it finds")]

use hammerbeam::{
    FrequencySeries, InitialState, Study,
    sweep::{SweepRequest, SweepStarts},
};

const OSCILLATOR: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studies/impact-oscillator.toml");

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let oscillator = std::fs::read_to_string(OSCILLATOR)?;
    let mut initial = InitialState::Rest;
    for gap_m in [1.0, 0.9, 0.8, 0.7, 0.6] {
        let text = oscillator.replace("gap_m = 1.0", &format!("gap_m = {gap_m:?}"));
        let study = Study::parse("impact oscillator", text)?;
        let request = SweepRequest {
            frequencies: FrequencySeries { from_hz: 0.2, to_hz: 0.2, step_hz: None },
            starts: SweepStarts::CarriedOver { initial: InitialState::Rest, down: false },
            samples: 16,
            effort: Default::default(),
        };
        let starts = SweepStarts::CarriedOver { initial: initial.clone(), down: false };
        // A state in front of one stop may lie behind the next.
        let moved = study.sweep(&SweepRequest { starts, ..request.clone() });
        let report = moved.or_else(|_| study.sweep(&request))?;
        let point = &report.motions[0].motion.point;
        println!("gap {gap_m} m: {}, largest {:.4} m", point.class, point.max_abs_displacement);
        initial = InitialState::Modal(point.state.clone());
    }
    Ok(())
}
