//! What stands below the sketch of a structure: the numbers of the study, in words.

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_motion::law::{LawKey, LawPhrase, LawValue};
use hammerbeam_study::{
    Study,
    file::{
        ActingForce, Amplitude, Approach, BeamPointTable, BeamSpanEntry, BeamTable, EndSupport, Excitation,
        ExcitationKind, FixedTo, ForcePlace, ForceSize, GapMeasured, LoadTable, LumpedTable, MatricesTable,
        MatrixFiles, MovingSupport, Place, Stop, StopLaw, StopRest, StopSide, StructureTable, SupportDrive,
    },
};

/// Most springs, dampers and masses that are listed.
const LISTED: usize = 12;

/// The lines.
pub fn of(study: &Study, unit: FrequencyUnit) -> Vec<String> {
    let mut lines = match &study.structure {
        StructureTable::Beam(beam) => beam_words(beam),
        StructureTable::Lumped(lumped) => lumped_words(lumped),
        StructureTable::Matrices(matrices) => matrix_words(matrices),
    };
    lines.extend(study.stops.iter().map(|stop| stop_words(stop, &study.excitation)));
    lines.push(excitation_words(study, unit));
    lines.extend(study.loads.iter().map(|load| load_words(load, &study.excitation)));
    lines
}

fn matrix_words(matrices: &MatricesTable) -> Vec<String> {
    let name = |file: &std::path::Path| {
        file.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
    let of = |files: &MatrixFiles| {
        format!("Matrices: {}, {}.", name(&files.stiffness.file.path), name(&files.mass.file.path))
    };
    matrices.components.iter().map(of).collect()
}

fn beam_words(beam: &BeamTable) -> Vec<String> {
    let profile = |span: &BeamSpanEntry| {
        let (stiffness, mass) = (span.profile.bending_stiffness(), span.profile.mass_per_length());
        let shear = if span.profile.poisson_ratio.is_some() { ", with shear" } else { "" };
        format!("bending stiffness {} N m², {} kg/m{shear}.", number(stiffness), number(mass))
    };
    let mut lines: Vec<String> = match beam.spans.as_slice() {
        [only] => vec![format!("Beam: {}", profile(only))],
        spans => {
            let line =
                |span: &BeamSpanEntry| format!("{} mm: {}", number(1e3 * span.length_m), profile(span));
            let spans = spans.iter().take(LISTED).enumerate();
            spans.map(|(index, span)| format!("Span {}, {}", index + 1, line(span))).collect()
        }
    };
    lines.extend(beam.points.iter().map(point_words));
    lines
}

fn point_words(point: &BeamPointTable) -> String {
    let parts = [
        (point.mass_kg, "kg"),
        (point.rotary_inertia_kg_m2, "kg m²"),
        (point.spring_n_m, "N/m to the ground"),
        (point.damper_n_s_m, "N s/m to the ground"),
        (point.rotational_spring_n_m_rad, "N m/rad to the ground"),
        (point.rotational_damper_n_m_s_rad, "N m s/rad to the ground"),
    ];
    let carried = parts.iter().filter(|(value, _)| *value > 0.0);
    let carried: Vec<String> = carried.map(|(value, unit)| format!("{} {unit}", number(*value))).collect();
    let carried = if carried.is_empty() { String::new() } else { format!(", {}", carried.join(", ")) };
    let held = match point.support {
        EndSupport::Free => "",
        EndSupport::Pinned => ", pinned",
        EndSupport::Clamped => ", clamped",
        EndSupport::Sliding => ", held against turning",
    };
    format!("{}: at {} mm{held}{carried}.", point.name, number(1e3 * point.at_m))
}

fn lumped_words(lumped: &LumpedTable) -> Vec<String> {
    let masses = lumped.masses.iter().map(|mass| format!("{} ({} kg)", mass.name, number(mass.mass_kg)));
    let between = |ends: &[String; 2]| format!("{}–{}", ends[0], ends[1]);
    let springs = lumped.springs.iter();
    let springs = springs.map(|s| format!("{} ({} N/m)", between(&s.between), number(s.stiffness_n_m)));
    let dampers = lumped.dampers.iter();
    let dampers = dampers.map(|d| format!("{} ({} N s/m)", between(&d.between), number(d.damping_n_s_m)));
    let lists =
        [("Masses", masses.collect()), ("Springs", springs.collect()), ("Dampers", dampers.collect())];
    let line = |(what, list): (&str, Vec<String>)| {
        (!list.is_empty()).then(|| {
            let end = if list.len() > LISTED { ", …" } else { "." };
            let listed: Vec<&str> = list.iter().take(LISTED).map(String::as_str).collect();
            format!("{what}: {}{end}", listed.join(", "))
        })
    };
    lists.into_iter().filter_map(line).collect()
}

fn stop_words(stop: &Stop, excitation: &Excitation) -> String {
    let place = match &stop.place {
        Place::At { point, fixed_to: FixedTo::Support(support) } if excitation.supports_differ() => {
            format!("at {point}, on the support that moves by u{}", support + 1)
        }
        Place::At { point, fixed_to: FixedTo::Support(_) } => format!("at {point}, on the moving support"),
        Place::At { point, fixed_to: FixedTo::Space } => format!("at {point}, fixed in space"),
        Place::Around { first, second, .. } => format!("around {first} and {second}"),
        Place::Between { first, second } => format!("between {first} and {second}"),
    };
    format!("{} {place}: {}.", stop.name, law_words(&stop.law))
}

/// A law by the words of its description, its values and how it rests.
fn law_words(law: &StopLaw) -> String {
    let words = law.in_words().into_iter().enumerate();
    let values: String = words.map(|(place, (key, value))| value_words(key, value, place == 0)).collect();
    let rest = match law.rest() {
        StopRest::OneSided { approach, side } => format!(", {}", rest(approach, side)),
        StopRest::TwoSided { gap_above_m, gap_below_m, gap_measured } => format!(
            " on both sides, gaps {} mm above and {} mm below{}",
            number(1e3 * gap_above_m),
            number(1e3 * gap_below_m),
            counted(gap_measured)
        ),
        StopRest::Around { gap_m } => format!(" all around, clearance {} mm", number(1e3 * gap_m)),
        StopRest::Always => String::new(),
    };
    format!("{}{values}{rest}", law.description().words.caption)
}

/// The value of a key behind what stands before it; lengths in millimetres.
fn value_words(key: &LawKey, value: &LawValue, is_first: bool) -> String {
    let unit = key.quantity().map_or("", |quantity| quantity.unit());
    let (factor, unit) = if unit == "m" { (1e3, "mm".to_owned()) } else { (1.0, raised(unit)) };
    let value = match value {
        LawValue::Number(value) => number(factor * value),
        LawValue::Hertz(stiffness) => number(stiffness.value()),
        LawValue::Formula(formula, constants) => {
            let with = |(name, value): &(String, f64)| format!(", {name} = {}", number(*value));
            return format!(" {formula} N{}", constants.iter().map(with).collect::<String>());
        }
    };
    let value = format!("{value} {unit}");
    match key.phrase {
        LawPhrase::Value if is_first => format!(" {}", value.trim_end()),
        LawPhrase::Value => format!(", {}", value.trim_end()),
        LawPhrase::Named(noun) => format!(", {noun} {}", value.trim_end()),
        LawPhrase::Beside => format!(" with {}", value.trim_end()),
    }
}

/// A unit with its exponents raised.
pub fn raised(unit: &str) -> String {
    let Some((base, exponent)) = unit.split_once('^') else { return unit.to_owned() };
    format!("{base}{}", exponent.chars().map(raise).collect::<String>())
}

fn rest(approach: Approach, side: StopSide) -> String {
    let side = if side == StopSide::Above { "above" } else { "below" };
    match approach {
        Approach::Gap { gap_m, measured } => {
            format!("gap {} mm {side}{}", number(1e3 * gap_m), counted(measured))
        }
        Approach::Preload { preload_n } => format!("preload {} N, {side}", number(preload_n)),
    }
}

fn counted(measured: GapMeasured) -> &'static str {
    if measured == GapMeasured::AtRest { " from rest" } else { "" }
}

fn excitation_words(study: &Study, unit: FrequencyUnit) -> String {
    let Some(excitation) = study.excitation.harmonic() else {
        return "No excitation: free vibration.".to_owned();
    };
    let [low, high] = excitation.frequency_hz;
    let what = match &excitation.kind {
        ExcitationKind::SupportMotion { at, amplitude_m } => {
            format!("motion u of the support ({}), {} mm", at.join(", "), amplitude_words(amplitude_m, 1e3))
        }
        ExcitationKind::SupportAcceleration { at, amplitude_m_s2 } => {
            let amplitude = amplitude_words(amplitude_m_s2, 1.0);
            format!("acceleration of the support ({}), {amplitude} m/s²", at.join(", "))
        }
        ExcitationKind::Forces { forces } => {
            let each: Vec<String> = forces.iter().map(acting_words).collect();
            each.join("; ")
        }
        ExcitationKind::SupportMotions { supports } => {
            let motion = |(index, support): (usize, &MovingSupport)| {
                let amplitude = match &support.drive {
                    SupportDrive::Displacement(amplitude) => {
                        format!("{} mm", number(1e3 * amplitude.largest()))
                    }
                    SupportDrive::Acceleration(amplitude) => format!("{} m/s²", number(amplitude.largest())),
                };
                let (at, phase) = (support.at.join(", "), number(support.phase_rad));
                format!("u{} of {at}, {amplitude} at {phase} rad", index + 1)
            };
            let motions: Vec<String> = supports.iter().enumerate().map(motion).collect();
            format!("motions of the supports, {}", motions.join("; "))
        }
        ExcitationKind::Force { at, amplitude_n } => {
            format!("force F at {at}, {} N", amplitude_words(amplitude_n, 1.0))
        }
    };
    let order = if excitation.order > 1 { format!(", order {}", excitation.order) } else { String::new() };
    let [low, high] = [low, high].map(|end| number(unit.factor() * end));
    format!("Excitation: {what}, {low} to {high} {}{order}.", unit.symbol())
}

/// One amplitude, or the least and the largest of a table.
fn amplitude_words(amplitude: &Amplitude, factor: f64) -> String {
    match amplitude {
        Amplitude::Constant(amplitude) => number(factor * amplitude),
        Amplitude::OverFrequency(points) => {
            let least = points.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
            format!("{} to {}", number(factor * least), number(factor * amplitude.largest()))
        }
    }
}

/// A force with its place, size and phase.
fn acting_words(force: &ActingForce) -> String {
    let place = match &force.place {
        ForcePlace::At(point) => format!("force F at {point}"),
        ForcePlace::Between([first, second]) => format!("pair of forces F at {first} and {second}"),
    };
    let size = match &force.size {
        ForceSize::Amplitude(amplitude) => format!("{} N", amplitude_words(amplitude, 1.0)),
        ForceSize::Unbalance { mass_kg, eccentricity_m } => {
            format!("unbalance of {} kg at {} mm", number(*mass_kg), number(1e3 * eccentricity_m))
        }
    };
    let phase = if force.phase_rad == 0.0 { "" } else { &format!(" at {} rad", number(force.phase_rad)) };
    format!("{place}, {size}{phase}")
}

fn load_words(load: &LoadTable, excitation: &Excitation) -> String {
    match load {
        LoadTable::Gravity { acceleration_m_s2 } => format!("Gravity: {} m/s².", number(*acceleration_m_s2)),
        LoadTable::Force { at, amplitude_n, order: 0, .. } => {
            format!("Constant force F at {at}: {} N.", number(*amplitude_n))
        }
        LoadTable::Force { at, amplitude_n, order, .. } => {
            format!("Force F at {at}: {} N, order {order}.", number(*amplitude_n))
        }
        LoadTable::ActingForce { force, order } => format!("Load: {}, order {order}.", acting_words(force)),
        LoadTable::DrivenSupport { support, motion, order, .. } => {
            let which = if excitation.supports_differ() { format!("{}", support + 1) } else { String::new() };
            let (what, amplitude) = match motion {
                SupportDrive::Displacement(a) => ("motion u", format!("{} mm", amplitude_words(a, 1e3))),
                SupportDrive::Acceleration(a) => {
                    ("acceleration of u", format!("{} m/s²", amplitude_words(a, 1.0)))
                }
            };
            format!("Further {what}{which}: {amplitude}, order {order}.")
        }
        LoadTable::SupportMotion { support, amplitude_m, order, .. } => {
            let which = if excitation.supports_differ() { format!("{}", support + 1) } else { String::new() };
            format!("Further motion u{which}: {} mm, order {order}.", number(1e3 * amplitude_m))
        }
    }
}

/// A number as a journal prints it: five significant digits, powers of ten outside 0.001 to 100 000.
pub fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.4e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if size == 0.0 || (1e-3..1e5).contains(&size) {
        // Nothing has no sign.
        return format!("{}", rounded + 0.0).replace('-', "−");
    }
    let written = format!("{rounded:e}");
    let (mantissa, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    let raised: String = exponent.chars().map(raise).collect();
    format!("{}\u{2009}×\u{2009}10{raised}", mantissa.replace('-', "−"))
}

fn raise(character: char) -> char {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let other = if character == '.' { '·' } else { '⁻' };
    character.to_digit(10).map_or(other, |digit| RAISED[digit as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_have_true_signs() {
        assert_eq!(number(0.5015), "0.5015");
        assert_eq!(number(4.5e9), "4.5\u{2009}×\u{2009}10⁹");
        assert_eq!(number(1.59e-8), "1.59\u{2009}×\u{2009}10⁻⁸");
        assert_eq!(number(-9.81), "−9.81");
        assert_eq!(number(243.215_7), "243.22");
        assert_eq!([number(0.0), number(-0.0)], ["0", "0"]);
    }
}
