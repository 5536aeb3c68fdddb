//! Positions and labels of the ticks of an axis.

use crate::{
    scale::{Scale, ScaleKind},
    text::{decimal, power_of_ten},
};

/// A tick; minor ones have no label.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: Option<String>,
}

/// Ticks of an axis with room for about `wanted` labels.
pub(crate) fn ticks(scale: &Scale, wanted: f64) -> Vec<Tick> {
    match scale.kind {
        ScaleKind::Linear => linear(scale, wanted),
        ScaleKind::Logarithmic => logarithmic(scale, wanted),
    }
}

/// Ticks with at least two labels, since one does not show the scale: more than `wanted` if necessary.
fn linear(scale: &Scale, wanted: f64) -> Vec<Tick> {
    let labels = |ticks: &[Tick]| ticks.iter().filter(|tick| tick.label.is_some()).count();
    let mut wanted = wanted.max(1.0);
    loop {
        let ticks = linear_of_about(scale, wanted);
        // Five steps per length, none longer than half of it, have two ends within it.
        if ticks.is_empty() || labels(&ticks) >= 2 || wanted > 5.0 {
            return ticks;
        }
        wanted *= 1.5;
    }
}

/// Steps of 1, 2 or 5 times a power of ten, with four or five minor ones in each.
fn linear_of_about(scale: &Scale, wanted: f64) -> Vec<Tick> {
    let (mantissa, exponent) = nice_step((scale.to - scale.from) / wanted);
    let parts = if mantissa == 2 { 4 } else { 5 };
    let step = f64::from(mantissa) * 10f64.powi(exponent);
    if !step.is_normal() {
        return Vec::new(); // an axis shorter than numbers can divide
    }
    let slack = 1e-9 * (scale.to - scale.from);
    let first = (parts as f64 * (scale.from - slack) / step).ceil() as i64;
    let last = (parts as f64 * (scale.to + slack) / step).floor() as i64;
    let magnitude = scale.from.abs().max(scale.to.abs());
    (first..=last)
        .map(|i| {
            let value = i as f64 / parts as f64 * step;
            let label = (i % parts == 0).then(|| linear_label(value, step, exponent, magnitude));
            Tick { value, label }
        })
        .collect()
}

/// The least of 1, 2, 5 times a power of ten that is not below `step`, as mantissa and exponent.
fn nice_step(step: f64) -> (u8, i32) {
    let exponent = step.log10().floor() as i32;
    let mantissa = step / 10f64.powi(exponent);
    match mantissa {
        m if m <= 1.0 + 1e-9 => (1, exponent),
        m if m <= 2.0 + 1e-9 => (2, exponent),
        m if m <= 5.0 + 1e-9 => (5, exponent),
        _ => (1, exponent + 1),
    }
}

fn linear_label(value: f64, step: f64, step_exponent: i32, magnitude: f64) -> String {
    let is_of_usual_size = (1e-3..1e7).contains(&magnitude) && step_exponent >= -9;
    if (-4..=6).contains(&step_exponent) && magnitude < 1e7 || is_of_usual_size {
        return decimal(value, usize::try_from(-step_exponent).unwrap_or(0));
    }
    if value.abs() < 0.5 * step {
        return "0".to_owned();
    }
    let exponent = (magnitude.log10() + 1e-9).floor() as i32;
    let decimals = usize::try_from(exponent - step_exponent).unwrap_or(0);
    power_of_ten(&decimal(value / 10f64.powi(exponent), decimals), exponent)
}

/// Decades, with labels at 2 and 5 if there is room, and ticks at 2 to 9 if they can be distinguished. Every
/// tick has a label only where there is room and hardly any other.
/// Labels of decades may be almost twice as close as others before some are left out.
fn logarithmic(scale: &Scale, wanted: f64) -> Vec<Tick> {
    let decades = (scale.to / scale.from).log10();
    if !decades.is_normal() {
        return Vec::new();
    }
    let is_within = |value: f64| (0.0..=1.0).contains(&scale.share(value));
    let count = |mantissas: &[u8]| {
        let exponents = scale.from.log10().floor() as i32..=scale.to.log10().ceil() as i32;
        let values = exponents.flat_map(|exponent| mantissas.iter().map(move |&one| (one, exponent)));
        values.filter(|&(one, exponent)| is_within(f64::from(one) * 10f64.powi(exponent))).count()
    };
    let mantissas: &[u8] = match wanted / decades {
        room if room >= 9.0 && count(&[1, 2, 5]) < 3 => &[1, 2, 3, 4, 5, 6, 7, 8, 9],
        room if room >= 2.5 => &[1, 2, 5],
        _ => &[1],
    };
    let every = (decades / (1.8 * wanted).max(1.0)).ceil().max(1.0) as i32;
    let first = scale.from.log10().floor() as i32;
    let last = scale.to.log10().ceil() as i32;
    let slack = 1e-9 * decades;
    (first..=last)
        .flat_map(|exponent| (1..=9).map(move |mantissa: u8| (mantissa, exponent)))
        .filter(|(mantissa, _)| every == 1 || *mantissa == 1)
        .map(|(mantissa, exponent)| {
            let labelled = mantissas.contains(&mantissa) && exponent.rem_euclid(every) == 0;
            let label = labelled.then(|| logarithmic_label(mantissa, exponent, first, last));
            Tick { value: f64::from(mantissa) * 10f64.powi(exponent), label }
        })
        .filter(|tick| {
            let share = scale.share(tick.value);
            (-slack..=1.0 + slack).contains(&share)
        })
        .collect()
}

fn logarithmic_label(mantissa: u8, exponent: i32, first: i32, last: i32) -> String {
    if first >= -4 && last <= 5 {
        return decimal(f64::from(mantissa) * 10f64.powi(exponent), usize::try_from(-exponent).unwrap_or(0));
    }
    power_of_ten(&mantissa.to_string(), exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(kind: ScaleKind, ends: (f64, f64), wanted: f64) -> Vec<String> {
        ticks(&Scale::exact(kind, ends), wanted).into_iter().filter_map(|tick| tick.label).collect()
    }

    /// A low panel with room for one label or two.
    #[test]
    fn an_axis_has_two_labels_at_least() {
        for (from, to) in [(-1.9, 1.16), (-0.9, 0.4), (0.0, 4.9), (11.0, 19.0), (-1e-7, 3e-9)] {
            for wanted in [0.5, 1.0, 1.7, 2.5] {
                let ticks = ticks(&Scale::exact(ScaleKind::Linear, (from, to)), wanted);
                let labels = ticks.iter().filter(|tick| tick.label.is_some()).count();
                assert!((2..=7).contains(&labels), "{labels} from {from} to {to}");
            }
        }
    }

    #[test]
    fn an_axis_too_short_to_divide_has_no_ticks() {
        assert_eq!(ticks(&Scale::exact(ScaleKind::Linear, (0.0, 1e-320)), 5.0), []);
    }

    #[test]
    fn linear_ticks_step_by_1_2_or_5() {
        assert_eq!(
            labels(ScaleKind::Linear, (19.0, 110.0), 10.0),
            ["20", "30", "40", "50", "60", "70", "80", "90", "100", "110"]
        );
        assert_eq!(labels(ScaleKind::Linear, (0.0, 6.3), 5.0), ["0", "2", "4", "6"]);
        assert_eq!(labels(ScaleKind::Linear, (-0.1, 0.1), 4.0), ["−0.10", "−0.05", "0.00", "0.05", "0.10"]);
    }

    #[test]
    fn linear_labels_of_very_small_values_have_powers_of_ten() {
        assert_eq!(labels(ScaleKind::Linear, (0.0, 2.1e-7), 3.0), ["0", "10⁻⁷", "2\u{2009}×\u{2009}10⁻⁷"]);
    }

    /// A section of a nearly periodic motion has plain digits, not eight of them with a power of ten.
    #[test]
    fn labels_of_values_close_to_each_other_are_plain() {
        let found = labels(ScaleKind::Linear, (-112.178_25, -112.178_21), 3.0);
        assert_eq!(found, ["−112.17824", "−112.17822"]);
    }

    #[test]
    fn logarithmic_labels_thin_out_with_the_range() {
        assert_eq!(labels(ScaleKind::Logarithmic, (0.9, 11.0), 6.0), ["1", "2", "5", "10"]);
        assert_eq!(labels(ScaleKind::Logarithmic, (0.9, 1100.0), 6.0), ["1", "10", "100", "1000"]);
        assert_eq!(
            labels(ScaleKind::Logarithmic, (0.9e-8, 1.1e8), 2.5),
            ["10⁻⁸", "10⁻⁴", "10⁰", "10⁴", "10⁸"]
        );
        assert_eq!(labels(ScaleKind::Logarithmic, (2.5, 4.5), 12.0), ["3", "4"]);
    }

    #[test]
    fn logarithmic_axes_have_eight_minor_ticks_in_a_decade() {
        let ticks = ticks(&Scale::exact(ScaleKind::Logarithmic, (1.0, 100.0)), 4.0);
        assert_eq!(ticks.len(), 19);
        assert_eq!(ticks.iter().filter(|tick| tick.label.is_none()).count(), 16);
    }

    #[test]
    fn ticks_stay_inside_the_axis_and_are_few() {
        for kind in [ScaleKind::Linear, ScaleKind::Logarithmic] {
            for exponent in -12..12 {
                let scale = Scale::exact(kind, (1.3 * 10f64.powi(exponent), 7.9 * 10f64.powi(exponent)));
                let ticks = ticks(&scale, 6.0);
                let labelled = ticks.iter().filter(|tick| tick.label.is_some()).count();
                assert!((1..=8).contains(&labelled), "{kind:?} {exponent} {labelled}");
                assert!(ticks.iter().all(|tick| (-1e-6..1.000001).contains(&scale.share(tick.value))));
            }
        }
    }
}
