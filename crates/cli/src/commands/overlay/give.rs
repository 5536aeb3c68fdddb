//! An overlay as a table, a document and in words.

use std::path::Path;

use hammerbeam_figure::plain_number;
use hammerbeam_jobs::counted;
use hammerbeam_results::export::{Table, header, number};
use serde_json::{Value, json};

use super::laid::Laid;
use crate::{failure::Failure, overlay_args::OverlayOptions};

/// Writes `overlay.csv`.
pub fn write(folder: &Path, laid: &Laid) -> Result<String, Failure> {
    let unit = laid.quantity.key();
    let value = |what: &str| format!("{what}_{}_{unit}", laid.quantity.word());
    let mut titles = header(&["time_s", "phase_cycles"]);
    titles.extend(["measured", "shifted", "computed", "computed_unfiltered"].map(value));
    titles.extend(header(&["orbit_displacement_m"]));
    // Without a moving support it stands still; where several move differently they are numbered.
    let supports = laid.overlay.supports.len();
    titles.extend((0..supports.max(1)).map(|k| match supports {
        0 | 1 => "support_displacement_m".to_owned(),
        _ => format!("support_{}_displacement_m", k + 1),
    }));
    let mut table = Table::begin(folder, "overlay.csv", &titles)?;
    let (overlay, measured) = (&laid.overlay, &laid.measured);
    let per_period = measured.per_period as f64;
    let length = measured.samples.len() as f64;
    let mean = |series: &[f64]| series.iter().sum::<f64>() / length;
    let (level, computed_level) = (mean(&measured.samples), mean(&overlay.filtered));
    for (k, value) in measured.samples.iter().enumerate() {
        let mut row = vec![
            number(laid.time_s(k as f64)),
            number((k as f64 - overlay.alignment.shift).rem_euclid(length) / per_period),
            number(*value),
            number(overlay.factor * (value - level) + computed_level),
            number(overlay.filtered[k]),
            number(overlay.unfiltered[k]),
            number(overlay.displacement[k]),
        ];
        match &overlay.supports[..] {
            [] => row.push(number(0.0)),
            supports => row.extend(supports.iter().map(|series| number(series[k]))),
        }
        table.row(&row)?;
    }
    Ok(table.finish()?.display().to_string())
}

pub fn document(laid: &Laid, options: &OverlayOptions, table: Option<&str>) -> Value {
    let overlay = &laid.overlay;
    let mut document = laid.input.document();
    document["results_folder"] = json!(options.results);
    document["channel"] = json!(laid.input.channel().name);
    document["sensor"] = json!(laid.quantity.word());
    document["point"] = json!(laid.point);
    document["excitation_frequency_hz"] = json!(laid.classification.frequency_hz);
    document["motion"] = json!(super::super::signal::word(laid.classification.motion));
    document["period_multiple"] = json!(laid.period_multiple);
    document["pieces"] = json!(laid.measured.pieces);
    document["compared_up_to_hz"] = json!(laid.highest_hz());
    document["scatter_over_rms"] = json!(laid.measured.scatter / overlay.alignment.sizes.0);
    document["low_pass_hz"] = json!(options.low_pass);
    document["order"] = json!(options.low_pass.map(|_| options.order));
    document["zero_phase"] = json!(options.zero_phase);
    document["orbit"] = json!({
        "frequency_hz": overlay.frequency_hz,
        "over_measured": overlay.frequency_hz / laid.classification.frequency_hz,
        "branch": overlay.branch,
        "row": overlay.row,
        "tried": overlay.tried,
        "skipped": overlay.skipped,
        "as_alike": overlay.alike.as_ref().map(|alike| json!({
            "orbits": alike.count,
            "branches": alike.branches,
            "frequency_hz": [alike.frequency_hz.0, alike.frequency_hz.1],
        })),
        "max_abs": overlay.largest.0,
        "max_abs_filtered": overlay.largest.1,
    });
    document["time_shift_s"] = json!(laid.phase_zero_s());
    document["correlation"] = json!(overlay.alignment.correlation);
    document["turned_correlation"] = json!(overlay.turned_correlation);
    document["amplitude_factor"] =
        json!({ "value": overlay.factor, "given": options.amplitude_factor.is_some() });
    document["measured_rms"] = json!(overlay.alignment.sizes.0);
    document["computed_rms"] = json!(overlay.alignment.sizes.1);
    document["residual_before"] = json!(overlay.residual_before);
    document["residual_after"] = json!(overlay.residual_after);
    document["notes"] = json!(laid.notes());
    document["results"] = json!(table);
    document
}

pub fn text(laid: &Laid, options: &OverlayOptions, table: Option<&str>) -> String {
    let overlay = &laid.overlay;
    let mut lines = vec![laid.input.heading()];
    lines.push(format!(
        "{} at {} of {} over {} at {:.6} Hz, mean of {} pieces, lines up to {:.1} Hz",
        laid.quantity.word(),
        laid.point,
        laid.input.channel().name,
        counted(laid.period_multiple.into(), "excitation period"),
        laid.classification.frequency_hz,
        laid.measured.pieces,
        laid.highest_hz(),
    ));
    if let Some(cut_off) = options.low_pass {
        let way = if options.zero_phase { "without phase" } else { "causal" };
        lines
            .push(format!("orbits behind a low-pass filter of {cut_off} Hz, order {}, {way}", options.order));
    }
    let row = overlay.row.map_or_else(String::new, |row| format!(", row {row}"));
    lines.push(format!(
        "most alike of {}: {:.6} Hz, {:.5} times the measured frequency; branch {}{row}",
        counted(overlay.tried as u64, "orbit"),
        overlay.frequency_hz,
        overlay.frequency_hz / laid.classification.frequency_hz,
        overlay.branch,
    ));
    lines.push(format!("  correlation            {:.6}", overlay.alignment.correlation));
    lines.push(format!(
        "  time shift             {} s: there on the clock of the record the orbit starts, the excitation \
        at phase 0",
        plain_number(laid.phase_zero_s())
    ));
    let given = if options.amplitude_factor.is_some() { " (given)" } else { "" };
    lines.push(format!("  amplitude factor       {:.6}{given}", overlay.factor));
    lines.push(format!(
        "  residual               {:.4} of the computed root mean square with the factor {}, {:.4} with \
        {:.6}",
        overlay.residual_before,
        overlay.factor.signum(),
        overlay.residual_after,
        overlay.factor,
    ));
    lines.extend(table.map(|path| format!("{path}: both histories")));
    lines.extend(laid.notes().into_iter().map(|note| format!("note: {note}")));
    lines.extend(laid.input.notes());
    lines.join("\n")
}
