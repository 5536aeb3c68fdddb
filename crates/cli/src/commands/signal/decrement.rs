//! `hammerbeam signal decrement`: eigenfrequencies and damping of a free decay.

use hammerbeam_signal::decay::{
    Decay, DecayEstimate, DecayMode, DecaySettings, Decrement, decrement, free_decay,
};
use serde_json::{Value, json};

use super::input::{self, Input, named};
use crate::{failure::Failure, output::Output, signal_args::DecrementOptions};

pub fn run(options: &DecrementOptions, output: Output) -> Result<(), Failure> {
    let input = input::open(&options.input, None)?;
    let (samples, rate) = (&input.channel().samples, input.record.sampling_rate_hz);
    let settings = DecaySettings {
        modes: options.modes.map(|modes| modes as usize),
        band_hz: (options.above.unwrap_or(0.0), options.below.unwrap_or(f64::INFINITY)),
        ..DecaySettings::default()
    };
    let decay = free_decay(samples, rate, &settings)?;
    // Too few maxima are no reason to withhold the fit.
    let classical = decrement(samples, rate, &decay).ok();
    output
        .give(&document(&input, &decay, classical.as_ref()), || text(&input, &decay, classical.as_ref()))?;
    Ok(())
}

fn document(input: &Input, decay: &Decay, classical: Option<&Decrement>) -> Value {
    let mode = |mode: &DecayMode| {
        json!({
            "frequency_hz": mode.frequency_hz.value,
            "frequency_half_width_hz": mode.frequency_hz.half_width,
            "damping_ratio": mode.damping_ratio.value,
            "damping_ratio_half_width": mode.damping_ratio.half_width,
            "logarithmic_decrement": mode.decrement.value,
            "logarithmic_decrement_half_width": mode.decrement.half_width,
            "amplitude": mode.amplitude,
            "phase_rad": mode.phase,
        })
    };
    let estimate =
        |estimate: &DecayEstimate| json!({ "value": estimate.value, "half_width": estimate.half_width });
    let classical = classical.map(|classical| {
        json!({
            "frequency_hz": classical.frequency_hz,
            "damping_ratio": classical.damping_ratio.value,
            "damping_ratio_half_width": classical.damping_ratio.half_width,
            "logarithmic_decrement": classical.decrement.value,
            "logarithmic_decrement_half_width": classical.decrement.half_width,
            "maxima": classical.maxima,
            "halves": classical.halves.map(|halves| halves.iter().map(estimate).collect::<Vec<_>>()),
            "changes_over_the_decay": classical.changes(),
        })
    });
    let mut document = input.document();
    document["channel"] = json!(input.channel().name);
    document["confidence"] = json!(0.95);
    document["modes"] = decay.modes.iter().map(mode).collect();
    document["offset"] = json!(decay.offset);
    document["residual_rms"] = json!(decay.residual);
    document["residual_correlation"] = json!(decay.residual_correlation);
    document["residual_is_white"] = json!(decay.white);
    document["maxima"] = json!(classical);
    document
}

fn text(input: &Input, decay: &Decay, classical: Option<&Decrement>) -> String {
    let mut lines = vec![input.heading()];
    lines.push(format!("decay of {}, with intervals of 95 %", named(input.channel())));
    for mode in &decay.modes {
        lines.push(format!(
            "  {:>12.6} +- {:.6} Hz  damping ratio {:.6} +- {:.6}  decrement {:.6} +- {:.6}  amplitude \
            {:.4e}",
            mode.frequency_hz.value,
            mode.frequency_hz.half_width,
            mode.damping_ratio.value,
            mode.damping_ratio.half_width,
            mode.decrement.value,
            mode.decrement.half_width,
            mode.amplitude
        ));
    }
    lines.push(format!("  residual {:.4e} (root mean square)", decay.residual));
    if let Some(classical) = classical {
        lines.push(format!(
            "by {} successive maxima at {:.4} Hz: damping ratio {:.6} +- {:.6}",
            classical.maxima,
            classical.frequency_hz,
            classical.damping_ratio.value,
            classical.damping_ratio.half_width
        ));
        match classical.halves {
            Some([first, second]) if classical.changes() == Some(true) => lines.push(format!(
                "note: the decrement changes over the decay, from {:.5} to {:.5}: the damping is not \
                viscous, or more modes are in it",
                first.value, second.value
            )),
            Some(_) => {}
            None => lines.push(
                "note: too few maxima to see whether the decrement changes over the \
            decay"
                    .to_owned(),
            ),
        }
    }
    if !decay.white {
        lines.push(
            "note: the residual is not white; intervals allow for its density about each mode".to_owned(),
        );
    }
    lines.extend(input.notes());
    lines.join("\n")
}
