//! `hammerbeam check`: what the program understood of a study, and whether its rig makes one too.

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::{
    PreparedStudy,
    check::{CheckReport, check},
    counted,
};
use hammerbeam_motion::law::{LawKey, LawPhrase, LawValue};
use hammerbeam_structure::MatrixReport;
use hammerbeam_study::{
    Study, UndampedInContact, UndampedMode,
    file::{
        ActingForce, Amplitude, Approach, BeamSpanEntry, BeamTable, DampingTable, EndSupport, Excitation,
        ExcitationKind, FixedTo, ForcePlace, ForceSize, LoadTable, LumpedTable, MatricesTable, ModalRatio,
        MovingSupport, Place, ReductionMethod, ReductionTable, Stop, StopLaw, StopRest, StopSide,
        StructureTable, SupportDrive,
    },
    readable,
};

use crate::{
    args::StudyOptions,
    failure::Failure,
    matrix_report,
    output::{Output, readable_frequency},
    watch::Notices,
};

pub fn run(options: &StudyOptions, output: Output) -> Result<(), Failure> {
    let study = PreparedStudy::new(options.study.read()?)?;
    let report = check(&study, &mut Notices)?;
    output.give(&report, || text(&report, output.frequency_unit))?;
    Ok(())
}

/// How to damp a mode.
pub const UNDAMPED_ADVICE: &str =
    "give `modal_ratio` in [damping], such as 0.01, or a damper to the structure";

/// The modes without damping while stops are closed, and what that means.
fn in_contact_text(modes: &[UndampedInContact]) -> Option<String> {
    let first = modes.first()?;
    let others = match modes.len() - 1 {
        0 => String::new(),
        others => format!(" (and {others} more of this kind)"),
    };
    Some(format!(
        "undamped     {first}{others}: steady states with closed contacts may be marginal, and simulation \
        takes long \
         to settle; {UNDAMPED_ADVICE}"
    ))
}

/// The modes without damping, and what that means.
fn undamped_text(modes: &[UndampedMode], dof: usize) -> Option<String> {
    const SHOWN: usize = 4;
    let first = modes.first()?;
    let which = match modes.len() {
        1 => first.to_string(),
        all if all == dof => format!("none of the {dof} modes has damping"),
        count => {
            let numbers: Vec<String> = modes.iter().take(SHOWN).map(|mode| mode.number.to_string()).collect();
            let more = if count > SHOWN { ", ..." } else { "" };
            format!("{count} modes have no damping ({}{more})", numbers.join(", "))
        }
    };
    Some(format!(
        "undamped     {which}: free vibration there never decays, so steady states are marginal and \
        simulation does not settle; {UNDAMPED_ADVICE}"
    ))
}

fn text(report: &CheckReport<'_>, unit: FrequencyUnit) -> String {
    let (study, dof) = (report.study, report.eigenfrequencies_hz.len());
    let shown = |hertz: f64| digits(unit.factor() * hertz);
    let mut lines = Vec::new();
    if !study.title.is_empty() {
        lines.push(study.title.clone());
    }
    lines.push(match &study.structure {
        StructureTable::Beam(beam) => beam_text(beam),
        StructureTable::Lumped(lumped) => lumped_text(lumped),
        StructureTable::Matrices(matrices) => matrices_text(matrices, report.matrices),
    });
    lines.push(format!("reduction    {}", reduction_text(&study.reduction, dof, unit)));
    let frequencies: Vec<String> = report.eigenfrequencies_hz.iter().take(8).map(|f| shown(*f)).collect();
    let more = if dof > 8 { ", ..." } else { "" };
    lines.push(format!("modes        {}{more} {}", frequencies.join(", "), unit.symbol()));
    lines.push(format!("damping      {}", damping_text(study)));
    lines.extend(undamped_text(&report.undamped_modes, dof));
    lines.extend(in_contact_text(&report.undamped_in_contact));
    lines.push(format!("excitation   {}", excitation_text(study, unit)));
    lines.extend(
        study.loads.iter().map(|load| format!("load         {}", load_text(load, &study.excitation))),
    );
    lines.extend(
        study.stops.iter().map(|stop| format!("stop         {}", stop_text(stop, &study.excitation))),
    );
    if study.excitation.harmonic().is_none() {
        lines.push(format!("response     point {}", study.response.point));
        return lines.join("\n");
    }
    let multiples: Vec<String> = study.response.period_multiples.iter().map(u32::to_string).collect();
    lines.push(format!(
        "response     point {}, period multiples {}",
        study.response.point,
        multiples.join(", ")
    ));
    let continuation = &study.continuation;
    lines.push(format!(
        "continuation steps of at most {}, tolerance {:e}, at most {} solutions on each side of a start",
        readable_frequency(unit, continuation.max_step_hz),
        continuation.tolerance,
        continuation.budget_solutions
    ));
    lines.join("\n")
}

fn beam_text(beam: &BeamTable) -> String {
    let profile = |span: &BeamSpanEntry| {
        let profile = span.profile;
        let shear = if profile.poisson_ratio.is_some() { ", with shear" } else { "" };
        let stiffness = readable(profile.bending_stiffness(), "N m^2");
        format!("EI {stiffness}, {}{shear}", readable(profile.mass_per_length(), "kg/m"))
    };
    let ends = format!("left end {}, right end {}", word(&beam.left), word(&beam.right));
    let (length, elements) = (readable(beam.length_m, "m"), beam.elements);
    let mut text = match beam.spans.as_slice() {
        [only] => format!("structure    beam of {length}, {}, {elements} elements, {ends}", profile(only)),
        _ => format!("structure    beam of {length}, {elements} elements, {ends}"),
    };
    let several = if beam.spans.len() > 1 { beam.spans.as_slice() } else { &[] };
    for (index, span) in several.iter().enumerate() {
        let length = readable(span.length_m, "m");
        text.push_str(&format!("\nspan         {} of {length}, {}", index + 1, profile(span)));
    }
    if !beam.planes.is_one() {
        text.push_str("\nplanes       2, with points NAME.y and NAME.z");
    }
    for point in &beam.points {
        let (at, mass) = (readable(point.at_m, "m"), readable(point.mass_kg, "kg"));
        text.push_str(&format!("\npoint        {} at {at}, {mass}", point.name));
        if point.support != EndSupport::Free {
            text.push_str(&format!(", {}", word(&point.support)));
        }
    }
    text
}

fn matrices_text(matrices: &MatricesTable, report: Option<&MatrixReport>) -> String {
    let points: Vec<&str> = matrices.points.iter().map(|point| point.name.as_str()).collect();
    let mut lines = vec![format!("structure    matrices with points {}", points.join(", "))];
    if let Some(report) = report {
        lines.extend(matrix_report::lines(report));
    }
    lines.join("\n")
}

fn lumped_text(lumped: &LumpedTable) -> String {
    let masses: Vec<String> = lumped
        .masses
        .iter()
        .map(|mass| format!("{} ({})", mass.name, readable(mass.mass_kg, "kg")))
        .collect();
    format!(
        "structure    masses {}; {}, {}",
        masses.join(", "),
        counted(lumped.springs.len() as u64, "spring"),
        counted(lumped.dampers.len() as u64, "damper")
    )
}

fn reduction_text(reduction: &ReductionTable, dof: usize, unit: FrequencyUnit) -> String {
    let modes = counted(dof as u64, "mode");
    match reduction.method {
        ReductionMethod::None => format!("none, {modes}"),
        ReductionMethod::Given => format!("as given, {modes}"),
        _ => {
            let cut_off = readable_frequency(unit, reduction.cut_off_hz);
            format!("{}, cut-off {cut_off}, {modes} left", word(&reduction.method))
        }
    }
}

fn damping_text(study: &Study) -> String {
    let of_modes = match &study.damping {
        DampingTable::Modal(ModalRatio::Every(ratio)) if *ratio == 0.0 => "none of the modes".to_owned(),
        DampingTable::Modal(ModalRatio::Every(ratio)) => format!("ratio {ratio} of every mode"),
        DampingTable::Modal(ModalRatio::Each(ratios)) => {
            let shown: Vec<String> = ratios.iter().take(8).map(f64::to_string).collect();
            let more = if ratios.len() > 8 { ", ..." } else { "" };
            format!("ratios {}{more} of the modes", shown.join(", "))
        }
        DampingTable::Rayleigh { mass_per_s, stiffness_s } => {
            format!("Rayleigh, {mass_per_s} 1/s times the mass and {stiffness_s} s times the stiffness")
        }
    };
    match dampers(&study.structure) {
        0 => of_modes,
        count => format!("{of_modes}, and {} of the structure", counted(count as u64, "damper")),
    }
}

/// Number of dampers of the structure that are not zero.
fn dampers(structure: &StructureTable) -> usize {
    match structure {
        StructureTable::Lumped(lumped) => {
            lumped.dampers.iter().filter(|damper| damper.damping_n_s_m > 0.0).count()
        }
        StructureTable::Matrices(_) => 0,
        StructureTable::Beam(beam) => {
            let of_points =
                beam.points.iter().flat_map(|point| [point.damper_n_s_m, point.rotational_damper_n_m_s_rad]);
            of_points.filter(|damper| *damper > 0.0).count()
        }
    }
}

fn amplitude_text(amplitude: &Amplitude, unit: &str) -> String {
    match amplitude {
        Amplitude::Constant(value) => readable(*value, unit),
        Amplitude::OverFrequency(points) => {
            let values = || points.iter().map(|point| point[1]);
            let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max));
            let (low, high) = (readable(low, unit), readable(high, unit));
            format!("{low} to {high} over the frequency ({} points)", points.len())
        }
    }
}

fn excitation_text(study: &Study, unit: FrequencyUnit) -> String {
    let Some(excitation) = study.excitation.harmonic() else {
        return "none; `simulate` follows the free vibration".to_owned();
    };
    let [low, high] = excitation.frequency_hz;
    let what = match &excitation.kind {
        ExcitationKind::SupportMotion { at, amplitude_m } => {
            format!("support motion at {}, amplitude {}", at.join(", "), amplitude_text(amplitude_m, "m"))
        }
        ExcitationKind::SupportAcceleration { at, amplitude_m_s2 } => {
            let amplitude = amplitude_text(amplitude_m_s2, "m/s^2");
            format!("support motion at {}, acceleration {amplitude}", at.join(", "))
        }
        ExcitationKind::Forces { forces } => {
            let each: Vec<String> = forces.iter().map(force_text).collect();
            each.join("; ")
        }
        ExcitationKind::SupportMotions { supports } => {
            let motion = |support: &MovingSupport| {
                let (at, phase) = (support.at.join(", "), digits(support.phase_rad));
                match &support.drive {
                    SupportDrive::Displacement(amplitude) => {
                        format!("{at} by {} at {phase} rad", readable(amplitude.largest(), "m"))
                    }
                    SupportDrive::Acceleration(amplitude) => {
                        format!("{at} with {} at {phase} rad", readable(amplitude.largest(), "m/s^2"))
                    }
                }
            };
            let motions: Vec<String> = supports.iter().map(motion).collect();
            format!("support motion, {}", motions.join("; "))
        }
        ExcitationKind::Force { at, amplitude_n } => {
            format!("force at {at}, amplitude {}", amplitude_text(amplitude_n, "N"))
        }
    };
    let phase = match &excitation.kind {
        ExcitationKind::SupportMotions { .. } => String::new(),
        _ => format!(", phase {} rad", excitation.phase_rad),
    };
    format!(
        "{what}, {} to {}, order {}{phase}",
        readable_frequency(unit, low),
        readable_frequency(unit, high),
        excitation.order,
    )
}

/// A support in words: by its places where supports move differently.
fn support_text(excitation: &Excitation, support: usize) -> String {
    match excitation.supports().get(support) {
        Some(places) if excitation.supports_differ() => format!("the moving support {}", places.join(", ")),
        _ => "the moving support".to_owned(),
    }
}

/// A force with its place, size and phase.
fn force_text(force: &ActingForce) -> String {
    let place = match &force.place {
        ForcePlace::At(point) => format!("force at {point}"),
        ForcePlace::Between([first, second]) => format!("pair of forces at {first} and {second}"),
    };
    let size = match &force.size {
        ForceSize::Amplitude(amplitude) => format!("amplitude {}", amplitude_text(amplitude, "N")),
        ForceSize::Unbalance { mass_kg, eccentricity_m } => {
            format!("unbalance {} at {}", readable(*mass_kg, "kg"), readable(*eccentricity_m, "m"))
        }
    };
    let phase = if force.phase_rad == 0.0 { "" } else { &format!(", phase {} rad", digits(force.phase_rad)) };
    format!("{place}, {size}{phase}")
}

fn load_text(load: &LoadTable, excitation: &Excitation) -> String {
    match load {
        LoadTable::Gravity { acceleration_m_s2 } => {
            format!("gravity, {}", readable(*acceleration_m_s2, "m/s^2"))
        }
        LoadTable::Force { at, amplitude_n, order, phase_rad } => {
            let amplitude = readable(*amplitude_n, "N");
            format!("force at {at}, {amplitude}, order {order}, phase {phase_rad} rad")
        }
        LoadTable::ActingForce { force, order } => format!("{}, order {order}", force_text(force)),
        LoadTable::DrivenSupport { support, motion, order, phase_rad } => {
            let of = match excitation.supports_differ() {
                true => format!(" of {}", support_text(excitation, *support)),
                false => String::new(),
            };
            let amplitude = match motion {
                SupportDrive::Displacement(amplitude) => amplitude_text(amplitude, "m"),
                SupportDrive::Acceleration(amplitude) => amplitude_text(amplitude, "m/s^2"),
            };
            format!("support motion{of}, {amplitude}, order {order}, phase {phase_rad} rad")
        }
        LoadTable::SupportMotion { support, amplitude_m, order, phase_rad } => {
            let of = match excitation.supports_differ() {
                true => format!(" of {}", support_text(excitation, *support)),
                false => String::new(),
            };
            let amplitude = readable(*amplitude_m, "m");
            format!("support motion{of}, {amplitude}, order {order}, phase {phase_rad} rad")
        }
    }
}

fn stop_text(stop: &Stop, excitation: &Excitation) -> String {
    let place = match &stop.place {
        Place::At { point, fixed_to: FixedTo::Support(support) } => {
            format!("at {point}, riding on {}", support_text(excitation, *support))
        }
        Place::At { point, fixed_to: FixedTo::Space } => format!("at {point}, fixed in space"),
        Place::Around { first, second, fixed_to } => {
            let carrier = match fixed_to {
                [FixedTo::Space, FixedTo::Space] => "fixed in space".to_owned(),
                carriers => format!("riding on {}", carriers_text(excitation, *carriers)),
            };
            format!("around {first} and {second}, {carrier}")
        }
        Place::Between { first, second } => format!("between {first} and {second}"),
    };
    format!("\"{}\" {place}: {}", stop.name, law_text(&stop.law))
}

/// What carries a round hole in its two directions.
fn carriers_text(excitation: &Excitation, carriers: [FixedTo; 2]) -> String {
    let of = |carrier| match carrier {
        FixedTo::Support(support) => support_text(excitation, support),
        FixedTo::Space => "space".to_owned(),
    };
    let [first, second] = carriers.map(of);
    if first == second { first } else { format!("{first} and {second}") }
}

/// A law by the words of its description, its values and how it rests.
fn law_text(law: &StopLaw) -> String {
    let (side, rest) = match law.rest() {
        StopRest::OneSided { approach, side } => {
            (format!(" {}", side_text(side)), format!(", {}", rest(approach)))
        }
        StopRest::TwoSided { gap_above_m, gap_below_m, gap_measured } => {
            let [above, below] = [gap_above_m, gap_below_m].map(|gap| readable(gap, "m"));
            let rest = format!(", gaps {above} above and {below} below ({})", word(&gap_measured));
            (" on both sides".to_owned(), rest)
        }
        StopRest::Around { gap_m } => {
            (" all around".to_owned(), format!(", clearance {}", readable(gap_m, "m")))
        }
        StopRest::Always => (String::new(), String::new()),
    };
    let values: String = law.in_words().into_iter().map(|(key, value)| value_text(key, value)).collect();
    format!("{}{side}{values}{rest}", law.description().words.report)
}

/// The value of a key behind what stands before it.
fn value_text(key: &LawKey, value: &LawValue) -> String {
    let number = match value {
        LawValue::Number(number) => number.to_string(),
        LawValue::Hertz(stiffness) => format!("{:e}", stiffness.value()),
        LawValue::Formula(formula, constants) => {
            let with = |(name, value): &(String, f64)| format!(", {name} = {value}");
            let constants: String = constants.iter().map(with).collect();
            return format!(" {formula} N against x, with x in m and v in m/s{constants}");
        }
    };
    let unit = key.quantity().map_or("", |quantity| quantity.unit());
    let number = format!("{number} {unit}");
    match key.phrase {
        LawPhrase::Value => format!(", {}", number.trim_end()),
        LawPhrase::Named(noun) => format!(", {noun} {}", number.trim_end()),
        LawPhrase::Beside => format!(" and {}", number.trim_end()),
    }
}

fn side_text(side: StopSide) -> &'static str {
    match side {
        StopSide::Above => "above",
        StopSide::Below => "below",
    }
}

fn rest(approach: Approach) -> String {
    match approach {
        Approach::Gap { gap_m, measured } => format!("gap {} ({})", readable(gap_m, "m"), word(&measured)),
        Approach::Preload { preload_n } => format!("preload {}", readable(preload_n, "N")),
    }
}

/// A number to nine digits, with an exponent where it is very small or large.
fn digits(value: f64) -> String {
    let rounded = format!("{value:.8e}").parse().unwrap_or(value);
    if rounded == 0.0 {
        // Without a sign.
        "0".to_owned()
    } else if (1e-4..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

/// The word of the study file for a choice.
fn word(choice: &impl serde::Serialize) -> String {
    serde_json::to_value(choice).ok().and_then(|value| value.as_str().map(str::to_owned)).unwrap_or_default()
}
