//! The signals of a rig over the orbits that are most alike, in a table of the report.

use std::fmt::Write;

use hammerbeam_jobs::rig::{SignalPair, figure_name};

/// The table, and notes to its rows.
pub fn report(text: &mut String, signals: &[SignalPair]) {
    text.push_str(
        "## Figures 7 to 14: signals\n\nFor each measured signal the computed orbit whose \
    acceleration, behind the same filter, is most alike. Residuals: root mean square of the difference over \
    that of the computed signal.\n\n| table | measured (Hz) | period | measured as | computed (Hz) | \
    computed over measured | correlation | lag (cycles) | factor | residual, factor 1 | with the factor | \
    max measured (m/s²) | computed | computed behind the filter \
    |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for (index, signal) in signals.iter().enumerate() {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} |",
            figure_name(index),
            signal.measured_hz,
            signal.period_multiple,
            signal.measured_as(),
            computed(signal),
        );
    }
    for (index, signal) in signals.iter().enumerate() {
        for note in signal.notes() {
            let _ = writeln!(text, "\nNote, {}: {note}.", figure_name(index));
        }
    }
    text.push('\n');
}

/// The cells of the orbit.
fn computed(signal: &SignalPair) -> String {
    let Ok(orbit) = signal.laid() else {
        return format!("none | | | | | | | {:.0} | |", signal.largest_measured);
    };
    format!(
        "{:.3} | {:.4} | {:.4} | {:+.3} | {:.2} | {:.2} | {:.2} | {:.0} | {:.0} | {:.0}",
        orbit.frequency_hz,
        orbit.frequency_hz / signal.measured_hz,
        orbit.alignment.correlation,
        SignalPair::lag(orbit),
        orbit.factor,
        orbit.residual_before,
        orbit.residual_after,
        signal.largest_measured,
        orbit.largest.0,
        orbit.largest.1,
    )
}

#[cfg(test)]
mod tests {
    use hammerbeam_jobs::{comparison::Overlay, rig::signal_document};
    use hammerbeam_signal::{
        classify::{Classification, MotionClass},
        waveform::{Alignment, Waveform},
    };
    use serde_json::Value;

    use super::*;

    /// A signal that was taken for an aperiodic one, with this correlation to its orbit.
    fn aperiodic(correlation: f64) -> SignalPair {
        let alignment = Alignment { shift: 0.0, correlation, factor: correlation, sizes: (1.0, 1.0) };
        let orbit = Overlay {
            frequency_hz: 5.0,
            branch: 1,
            row: Some(3),
            alignment,
            turned_correlation: 0.9,
            factor: correlation,
            residual_before: alignment.residual(1.0),
            residual_after: alignment.residual(correlation),
            filtered: vec![0.0; 4],
            unfiltered: vec![0.0; 4],
            displacement: vec![0.0; 4],
            supports: vec![vec![0.0; 4]],
            largest: (1.0, 1.0),
            alike: None,
            tried: 7,
            skipped: 2,
        };
        let samples = vec![1.0, 0.0, -1.0, 0.0];
        SignalPair {
            measured_hz: 4.8,
            period_multiple: 2,
            classification: Classification {
                motion: MotionClass::Aperiodic,
                repetitions: Vec::new(),
                frequency_hz: 4.8,
                correction_hz: 0.0,
                periods: 40,
                root_mean_square: 1.0,
                noise: 0.0,
            },
            computed: Some(orbit),
            measured: Waveform { samples, per_period: 2, lines: 1, pieces: 20, scatter: 0.9 },
            largest_measured: 1.0,
        }
    }

    #[test]
    fn signal_that_is_hardly_alike_is_told_in_words() {
        let signals = [aperiodic(0.58)];
        let mut text = String::new();
        report(&mut text, &signals);
        let expected = [
            // 0.58^2.
            "no orbit is alike: 34 % of the measured power is that of the most alike one",
            "the measured motion is aperiodic; its mean over 2 periods is compared",
            "turned around the measured signal would be more alike, with a correlation of 0.9000",
            "2 more orbits could not be gone over, left out",
            "pieces of the record differ from their mean by 90.0 % of it",
        ];
        let document = signal_document((0, &signals[0]));
        let notes: Vec<&str> =
            document["notes"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        for note in expected {
            assert!(text.contains(&format!("Note, figure_07.csv: {note}")), "{text}");
            assert!(notes.iter().any(|found| found.starts_with(note)), "{notes:?}");
        }
    }

    #[test]
    fn signal_that_nothing_is_like_has_no_orbit() {
        let signals = [aperiodic(0.09)];
        let mut text = String::new();
        report(&mut text, &signals);
        assert!(text.contains("nothing is alike: the largest correlation of 7 orbits"), "{text}");
        assert!(!text.contains("5.000"), "{text}");
        assert_eq!(signal_document((0, &signals[0]))["computed"], Value::Null);
    }
}
