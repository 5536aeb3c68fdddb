//! Lyapunov exponents of Ueda's oscillator over the averaging time, and its strange attractor.

use std::f64::consts::TAU;

use hammerbeam::{
    FrequencySeries, InitialState, Study,
    exponents::ExponentsRequest,
    figure::{DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries, Figure, LabelSide, Style},
};

use super::{Outcome, compared, style};

const STUDY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studies/ueda.toml");
/// Printed by Sprott, Chaos and Time-Series Analysis (2003), appendix A.
const PUBLISHED: [f64; 2] = [0.1034, -0.1534];

/// Draws the convergence and the section of a motion over that many periods.
pub fn draw(periods: u64) -> Outcome<[Figure; 2]> {
    let study = Study::read(STUDY)?;
    let frequency_hz = 1.0 / TAU;
    let report = study.exponents(&ExponentsRequest {
        frequencies: FrequencySeries { from_hz: frequency_hz, to_hz: frequency_hz, step_hz: None },
        initial: InitialState::Rest,
        transient_periods: 200,
        periods,
        sections_per_period: 1,
    })?;
    let record = &report.spectra[0].record;
    for (found, published) in record.spectrum.exponents.iter().zip(PUBLISHED) {
        let (value, half_width) = (found.value, found.half_width);
        compared(&format!("exponents: {value:.4} +- {half_width:.4} 1/s, published {published}"));
        // Half the last printed digit, and twice the interval of 95 per cent.
        assert!((value - published).abs() < 2.0 * half_width + 5e-5, "{value} is not {published}");
    }
    let dimension = record.spectrum.kaplan_yorke_dimension;
    compared(&format!("exponents: dimension {dimension:.3}"));
    assert!((dimension - (1.0 - PUBLISHED[0] / PUBLISHED[1])).abs() < 0.02, "the dimension is {dimension}");
    let line = |k: usize| {
        let at = record.spectrum.convergence.iter();
        at.map(move |at| (at.time, at.exponents[k]))
    };
    let label = |value: f64| DataLabel {
        at: (1e4, value),
        text: format!("published: {}{:.4}", if value < 0.0 { "−" } else { "" }, value.abs()),
        side: if value < 0.0 { LabelSide::Below } else { LabelSide::Above },
    };
    let convergence = DataPanel {
        levels: [0.0].into_iter().chain(PUBLISHED).collect(),
        labels: PUBLISHED.map(label).to_vec(),
        ..DataPanel::new(
            DataAxis::logarithmic("Averaging time (s)"),
            DataAxis::linear("Lyapunov exponent (1/s)").between(-0.35, 0.3),
            vec![
                DataSeries::new("first exponent", DataLook::Line(0), line(0)),
                DataSeries::new("second exponent", DataLook::Line(1), line(1)),
            ],
        )
    };
    let section = DataPanel::new(
        DataAxis::linear("Displacement (m)").between(1.4, 3.5),
        DataAxis::linear("Velocity (m/s)").between(-5.0, 6.0),
        vec![DataSeries::new("", DataLook::Specks(0), record.section.iter().map(|[x, v]| (*x, *v)))],
    );
    let mut narrow = Style::single_column();
    narrow.height_mm = 90.0;
    let of =
        |panel, description: &str| DataDiagram { panels: vec![panel], description: description.to_owned() };
    Ok([
        of(convergence, "both Lyapunov exponents of Ueda's oscillator over the averaging time")
            .draw(&style())?,
        of(section, "Poincaré section of Ueda's oscillator at phase 0").draw(&narrow)?,
    ])
}
