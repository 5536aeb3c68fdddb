//! Contact laws without loss: the force over the displacement.

use hammerbeam::{
    figure::{DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries, Figure, LabelSide},
    motion::{
        Law,
        law::{Degree, HertzStop, LinearStop, PowerSpring, TwoSidedStop, TwoSlopeStop},
    },
};

use super::{Outcome, style};

/// Gaps above and below, in units of the constants of the laws, which are 1.
const GAPS: [f64; 2] = [0.5, 0.9];
const ENDS: (f64, f64) = (-2.0, 2.2);

/// The force on the stop, of one law or several at one place.
fn force(laws: &[Law]) -> impl Iterator<Item = (f64, f64)> {
    let places = (0..=840).map(|k| ENDS.0 + (ENDS.1 - ENDS.0) * f64::from(k) / 840.0);
    places.map(|r| (r, -laws.iter().map(|law| law.force(r, 0.0).value).sum::<f64>()))
}

/// Compares the laws with (L2), (L5), (L11), (L12) and (L15), and draws them.
pub fn draw() -> Outcome<Figure> {
    let linear: [Law; 1] = [LinearStop::with_gap(1.0, GAPS[0])?.into()];
    let hertz: [Law; 1] = [HertzStop::with_gap(1.0, GAPS[0])?.into()];
    let two_sided: [Law; 1] = [TwoSidedStop::new(1.0, GAPS[0], GAPS[1])?.into()];
    let two_slopes: [Law; 1] = [TwoSlopeStop::with_gap(0.4, (0.6, 1.6), GAPS[0])?.into()];
    let power = |k: f64, degree: Degree| PowerSpring::new(k, degree).map(Law::from);
    let springs = [power(1.0, Degree::Linear)?, power(1.0, Degree::Quadratic)?, power(1.0, Degree::Cubic)?];
    let wells = [power(-1.0, Degree::Linear)?, springs[2].clone()];
    let beyond = |r: f64| (r - GAPS[0]).max(0.0);
    compare(&linear, beyond);
    compare(&hertz, |r| beyond(r).powf(1.5));
    compare(&two_sided, |r| beyond(r) + (r + GAPS[1]).min(0.0));
    compare(&two_slopes, |r| 0.4 * beyond(r).min(0.6) + 1.6 * (beyond(r) - 0.6).max(0.0));
    compare(&springs[1..2], |r| r * r);
    compare(&wells, |r| r * r * r - r);

    let stops = DataPanel {
        uprights: vec![-GAPS[1], GAPS[0]],
        labels: vec![
            DataLabel { at: (GAPS[0], -0.6), text: "gap above".into(), side: LabelSide::Right },
            DataLabel { at: (-GAPS[1], 0.6), text: "gap below".into(), side: LabelSide::Left },
        ],
        ..DataPanel::new(
            DataAxis::linear("Relative displacement r (–)").between(ENDS.0, ENDS.1),
            DataAxis::linear("Force on the stop −f (–)").between(-1.2, 2.3),
            vec![
                DataSeries::new("linear (L2)", DataLook::Line(0), force(&linear)),
                DataSeries::new("Hertz (L5)", DataLook::Line(1), force(&hertz)),
                DataSeries::new("two-sided (L11)", DataLook::Line(2), force(&two_sided)),
                DataSeries::new("two slopes (L15)", DataLook::Line(3), force(&two_slopes)),
            ],
        )
    };
    let springs = DataPanel {
        levels: vec![0.0],
        ..DataPanel::new(
            DataAxis::linear("Relative displacement r (–)").between(ENDS.0, ENDS.1),
            DataAxis::linear("Force on the spring −f (–)").between(-4.0, 4.0),
            vec![
                DataSeries::new("r", DataLook::Line(0), force(&springs[..1])),
                DataSeries::new("r²", DataLook::Line(1), force(&springs[1..2])),
                DataSeries::new("r³", DataLook::Line(2), force(&springs[2..])),
                DataSeries::new("two wells, r³ − r", DataLook::Line(3), force(&wells)),
            ],
        )
    };
    let description =
        "force over displacement of linear, Hertz, two-sided and two-slope stops, and of powers";
    Ok(DataDiagram { panels: vec![stops, springs], description: description.to_owned() }.draw(&style())?)
}

/// The law of the code is the formula of the page.
fn compare(laws: &[Law], formula: impl Fn(f64) -> f64) {
    for (r, found) in force(laws) {
        assert!((found - formula(r)).abs() < 1e-14, "{laws:?} at {r}: {found}");
    }
}
