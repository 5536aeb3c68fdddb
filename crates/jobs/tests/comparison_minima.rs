//! Which minimum a comparison finds, and which other one it reports, with points on curves in closed form.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_jobs::comparison::{
    BranchCurve, Comparison, CurvePoint, Curves, FitSettings, Fixed, Verdict, compare,
};
use hammerbeam_signal::{
    MeasuredQuantity,
    points::{MeasuredKind, MeasuredMaxima, MeasuredPoint},
    random::RandomSource,
};
use hammerbeam_testkit::stride;

/// Magnification of a mass on a spring with viscous damping, at a frequency over its eigenfrequency.
fn magnification(r: f64, damping: f64) -> f64 {
    1.0 / ((1.0 - r * r).powi(2) + (2.0 * damping * r).powi(2)).sqrt()
}

fn branch(number: u32, (low, high): (f64, f64), value: impl Fn(f64) -> f64) -> BranchCurve {
    let point = |k: usize| {
        let frequency_hz = low + (high - low) * k as f64 / 40_000.0;
        CurvePoint { frequency_hz, value: value(frequency_hz), stable: true, row: k + 1 }
    };
    BranchCurve { branch: number, period_multiple: 1, points: (0..=40_000).map(point).collect() }
}

fn point(frequency_hz: f64, value: f64, period: u32) -> MeasuredPoint {
    MeasuredPoint {
        origin: "point".into(),
        frequency_hz,
        maxima: MeasuredMaxima { displacement: Some(value), ..MeasuredMaxima::default() },
        kind: MeasuredKind::Periodic { period_multiple: Some(period) },
        excitation: None,
    }
}

fn held(points: &[MeasuredPoint], curves: &Curves, settings: &FitSettings) -> Comparison {
    compare(points, curves, MeasuredQuantity::Displacement, settings).unwrap()
}

/// Eigenfrequencies of 1 to 1000 Hz and half widths down to 0.05 %: the offset is tried on a scale of the
/// frequencies, and finely enough for the peak.
#[test]
fn offset_of_a_narrow_resonance_is_found_at_any_scale() {
    for (eigenfrequency, damping) in [(1.0, 0.003), (1.0, 5e-4), (30.0, 5e-4), (1000.0, 0.003)] {
        let value = |f: f64| magnification(f / eigenfrequency, damping);
        let curves = Curves::new(vec![branch(1, (0.5 * eigenfrequency, 1.5 * eigenfrequency), value)]);
        for part in [-0.117, -0.0402, -0.0071, 0.03, 0.0713, 0.15] {
            let offset = part * eigenfrequency;
            let points: Vec<MeasuredPoint> = (0..21)
                .map(|k| eigenfrequency * (1.0 + 4.0 * damping * (f64::from(k) / 10.0 - 1.0)))
                .map(|f| point(f - offset, value(f) / 2.0, 1))
                .collect();
            let frequency = Fixed::offsets(&points);
            let settings = FitSettings { offset: true, frequency, ..FitSettings::default() };
            let found = held(&points, &curves, &settings).fit;
            // A hundredth of the half width; the curve is interpolated over a twentieth of it at most.
            let error = (found.frequency.value - offset).abs() / eigenfrequency;
            assert!(error < 0.01 * damping, "{eigenfrequency} Hz, {damping}, {part}: {found:?}");
            assert!((found.amplitude.value / 2.0 - 1.0).abs() < 0.01, "{found:?}");
        }
    }
}

/// Sum of squares as the fit defines it, from the verdicts: what is farther off than the square of the reach,
/// or meets nothing, counts as that.
fn sum(comparison: &Comparison) -> f64 {
    let most = (2.0 * 1.5_f64.ln()).powi(2);
    let of = |point: &hammerbeam_jobs::comparison::PointOutcome| match (point.verdict, point.nearest) {
        (Verdict::Explained | Verdict::TooFar, Some(nearest)) => nearest.difference.powi(2).min(most),
        _ => most,
    };
    comparison.points.iter().map(of).sum()
}

/// A branch that ends at 36 Hz, and a low one behind it. Points lie up to the end, so that a shift that is a
/// little too large loses some: no minimum that is found may be above the sum at the shift that was put in.
#[test]
fn sum_of_squares_beside_the_end_of_a_branch_is_no_larger_than_at_the_true_shift() {
    let high = |f: f64| 1.0 + 0.5 / (36.3 - f);
    let low = |f: f64| 0.3 + 0.01 * (f - 35.0);
    let curves = Curves::new(vec![branch(1, (28.0, 36.0), high), branch(2, (35.5, 44.0), low)]);
    for seed in 0..40 {
        let mut random = RandomSource::new(seed);
        let (factor, amplitude) =
            (0.95 + 0.003 * f64::from(seed as u32), 2.0 + 0.05 * f64::from(seed as u32));
        let mut noisy =
            |f: f64, value: f64| point(f / factor, value / amplitude * (0.05 * random.normal()).exp(), 1);
        let mut points: Vec<MeasuredPoint> =
            (0..24).map(|k| 36.0 - 0.003 * f64::from(k * k) - 1e-4).map(|f| noisy(f, high(f))).collect();
        points.extend((0..8).map(|k| 36.05 + 0.5 * f64::from(k)).map(|f| noisy(f, low(f))));
        let (frequency, given) = (Fixed::Given(factor), Fixed::Given(amplitude));
        let truth = FitSettings { frequency, amplitude: given, ..FitSettings::default() };
        let [found, at_truth] =
            [FitSettings::default(), truth].map(|settings| sum(&held(&points, &curves, &settings)));
        assert!(found <= at_truth, "seed {seed}: {found} {at_truth}");
    }
}

/// Two peaks, the second one 13 % lower. Points of a period that no branch has fit nowhere: they are no
/// reason to take the second peak for as good.
#[test]
fn points_that_never_fit_make_no_second_minimum() {
    let bell = |f: f64, at: f64| (-((f / at).ln() / 0.02).powi(2)).exp();
    let value = |f: f64| 1.0 + 5.0 * bell(f, 30.0) + 4.35 * bell(f, 33.0);
    let curves = Curves::new(vec![branch(1, (22.0, 42.0), value)]);
    let mut points: Vec<MeasuredPoint> = (0..21)
        .map(|k| (29.0 + 0.1 * f64::from(k), f64::from(k)))
        .map(|(f, k)| point(f, value(f) * (1.0 + 0.03 * (17.0 * k).sin()), 1))
        .collect();
    let settings = FitSettings { amplitude: Fixed::Given(1.0), ..FitSettings::default() };
    assert_eq!(held(&points, &curves, &settings).fit.second, None);
    points.extend((0..40).map(|k| point(29.0 + 0.05 * f64::from(k), 1.0, 3)));
    let found = held(&points, &curves, &settings).fit;
    assert!(found.second.is_none() && found.points == 21, "{found:?}");
}

/// Both flanks of a peak have the value; 0.4 % lie between them, and the peak itself is far above. The same
/// with values without any difference, where sums of squares are rounding.
#[test]
fn both_flanks_of_a_narrow_peak_are_told() {
    let damping = 0.003;
    let value = |f: f64| magnification(f, damping);
    let curves = Curves::new(vec![branch(1, (0.6, 1.4), value)]);
    let height = value(0.998);
    // The square of the other root of the quadratic equation for r^2: both add up to 2 - 4 D^2.
    let other = (2.0 - 4.0 * damping * damping - 0.998_f64.powi(2)).sqrt();
    for differences in [[0.01, -0.01, 0.005, -0.005], [0.0; 4]] {
        let points: Vec<MeasuredPoint> =
            differences.iter().map(|e: &f64| point(0.998 / 1.02, height * e.exp(), 1)).collect();
        let settings = FitSettings { amplitude: Fixed::Given(1.0), ..FitSettings::default() };
        let found = held(&points, &curves, &settings).fit;
        let second = found.second.unwrap();
        assert!((found.frequency.value - 1.02).abs() < 1e-5, "{found:?}");
        assert!((second.frequency - 1.02 * other / 0.998).abs() < 1e-5, "{second:?}");
        assert!(second.cost_ratio < 1.01 && second.points == 4, "{second:?}");
    }
}

/// Three branches of one period lie over one another, a factor of 1.3 apart, so that the nearest one of a
/// point changes with the factor, and some points are strays: no other factor may have a smaller sum at the
/// shift that was found, and no other shift with the factor that was. By default for the first of three sets
/// of points.
#[test]
fn no_factor_and_no_shift_of_a_fine_grid_has_a_smaller_sum() {
    let value = |f: f64| 1.0 + 4.0 * (-((f - 30.0) / 2.0).powi(2)).exp();
    let layer =
        |k: i32| branch(k as u32 + 1, (20.0, 40.0), move |f| 1.3_f64.powi(k) * value(f + 0.3 * f64::from(k)));
    let curves = Curves::new((0..3).map(layer).collect());
    for seed in (0..3).step_by(stride(3)) {
        let mut random = RandomSource::new(seed);
        let points: Vec<MeasuredPoint> = (0..30)
            .map(|k| {
                let f = 24.0 + 0.4 * f64::from(k);
                let off = if k % 7 == 3 { 1.0 } else { 0.1 };
                point(f / 1.03, value(f) / 1.7 * (off * random.normal()).exp(), 1)
            })
            .collect();
        let found = held(&points, &curves, &FitSettings::default());
        let least = sum(&found);
        let [frequency, amplitude] = [found.fit.frequency.value, found.fit.amplitude.value];
        let at = |frequency: f64, amplitude: f64| {
            let given = [frequency, amplitude].map(Fixed::Given);
            let settings = FitSettings { frequency: given[0], amplitude: given[1], ..FitSettings::default() };
            sum(&held(&points, &curves, &settings))
        };
        assert!((at(frequency, amplitude) - least).abs() < 1e-12);
        for k in 0..=1000 {
            let share = f64::from(k) / 1000.0;
            let factor = 0.05 * 400.0_f64.powf(share);
            assert!(at(frequency, factor) > least - 1e-12, "seed {seed}, factor {factor}");
            let shift = 0.85 + 0.33 * share;
            assert!(at(shift, amplitude) > least - 1e-12, "seed {seed}, shift {shift}");
        }
    }
}
