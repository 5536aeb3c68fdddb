//! Supports whose displacement the excitation prescribes: one motion that all of them have, or one for each.

use serde::Serialize;

use crate::document::{Key, KeyRow, Quantity, TomlTable, Value, quantity};

use super::{Amplitude, amplitude, harmonic::PHASE, names::Names};

/// A support that moves in a way of its own, as `amplitude cos(2 pi order f t + phase)`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MovingSupport {
    /// Where: places that move as one.
    pub at: Vec<String>,
    /// Its displacement or its acceleration, the same at every frequency.
    #[serde(flatten)]
    pub drive: SupportDrive,
    /// Phase [rad].
    pub phase_rad: f64,
}

/// What of a support is prescribed, as `amplitude cos(2 pi order f t + phase)`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub enum SupportDrive {
    /// Its displacement [m].
    #[serde(rename = "amplitude_m")]
    Displacement(Amplitude),
    /// Its acceleration [m/s^2].
    #[serde(rename = "amplitude_m_s2")]
    Acceleration(Amplitude),
}

/// What is prescribed of all supports.
pub(super) enum PrescribedMotion {
    /// The supports of these names move as one.
    Common { at: Vec<String>, drive: SupportDrive },
    /// Each moves in a way of its own.
    Each(Vec<MovingSupport>),
}

const DISPLACEMENT: Key<Quantity> =
    Key::new("amplitude_m", quantity::AMPLITUDE, "amplitude of the displacement");
const ACCELERATION: Key<Quantity> = Key::new(
    "amplitude_m_s2",
    quantity::ACCELERATION,
    "amplitude of the acceleration, in place of `amplitude_m`",
)
.without("none");

/// Rows of the page of keys: the amplitudes of `[excitation]`.
///
/// * `bound`: what else bounds the displacement, in words.
pub(super) fn rows_of_amplitude(bound: &str) -> [KeyRow; 2] {
    let table = "; or a table over the frequency";
    let displacement = DISPLACEMENT.without("required for support motion, or `amplitude_m_s2`").row();
    let allowed = format!("{}{bound}{table}", displacement.allowed);
    [KeyRow { allowed, ..displacement }, ACCELERATION.further(table).row()]
}

/// Those of `support`.
pub(super) fn rows() -> Vec<KeyRow> {
    let places = "the support, or several that move as one";
    let at = KeyRow::read_apart("at", "a name, or a list of names", "required", places);
    let displacement = DISPLACEMENT.without("required, or `amplitude_m_s2`").row();
    vec![at, displacement, ACCELERATION.row(), PHASE.row()]
}

/// Reads `at` with `amplitude_m` or `amplitude_m_s2`, or a `support` for each motion.
pub(super) fn read(table: &TomlTable<'_>, names: &Names) -> Option<PrescribedMotion> {
    if table.has("support") {
        return read_each(table, names).map(PrescribedMotion::Each);
    }
    let at = table.required("at").and_then(|value| read_places(&value, names));
    let motion = read_motion(table, &DISPLACEMENT.range, &ACCELERATION.range);
    Some(PrescribedMotion::Common { at: at?, drive: motion? })
}

/// Reads `amplitude_m`, or `amplitude_m_s2` in its place.
///
/// * `displacement`, `acceleration`: what they may be as numbers; tables hold what is more than 0.
pub(super) fn read_motion(
    table: &TomlTable<'_>,
    displacement: &Quantity,
    acceleration: &Quantity,
) -> Option<SupportDrive> {
    let read = |value: Value<'_>, allowed: &Quantity, of_table: &Quantity| {
        amplitude::read(&value, if value.is_list() { of_table } else { allowed })
    };
    let Some(value) = table.optional("amplitude_m_s2") else {
        let value = table.required("amplitude_m")?;
        return read(value, displacement, &DISPLACEMENT.range).map(SupportDrive::Displacement);
    };
    if table.optional("amplitude_m").is_some() {
        let help = vec!["allowed: one of `amplitude_m` and `amplitude_m_s2`".to_owned()];
        value.problem("`amplitude_m_s2` is given, and `amplitude_m`, too".to_owned(), help);
        return None;
    }
    read(value, acceleration, &ACCELERATION.range).map(SupportDrive::Acceleration)
}

fn read_each(table: &TomlTable<'_>, names: &Names) -> Option<Vec<MovingSupport>> {
    for key in ["at", "amplitude_m", "amplitude_m_s2", "phase_rad"] {
        if let Some(value) = table.optional(key) {
            let help = vec!["allowed: in each entry of `support`, which says it for its own".to_owned()];
            value.problem(format!("`{key}` is given besides `support`"), help);
        }
    }
    let is_empty = table.optional("support").is_some_and(|value| value.is_empty_list());
    let entries = table.tables("support");
    let count = entries.len();
    let mut supports: Vec<MovingSupport> = Vec::with_capacity(count);
    for entry in entries {
        let Some(support) = read_support(entry, names) else { continue };
        let twice = support.at.iter().find(|at| supports.iter().any(|other| other.at.contains(at)));
        if let Some(at) = twice {
            let help =
                vec!["allowed: each support in one entry; a further harmonic is a [[load]]".to_owned()];
            table.problem("support", format!("two entries of `support` move \"{at}\""), help);
            return None;
        }
        supports.push(support);
    }
    if is_empty || count == 1 {
        let message = if is_empty { "`support` is an empty list" } else { "`support` has one entry" };
        let help = "allowed: two entries or more; one support is moved with `at` and `amplitude_m`";
        table.problem("support", message.to_owned(), vec![help.to_owned()]);
    }
    (count > 1 && supports.len() == count).then_some(supports)
}

fn read_support(entry: TomlTable<'_>, names: &Names) -> Option<MovingSupport> {
    let at = entry.required("at").and_then(|value| read_places(&value, names));
    refuse_tables(&entry);
    let drive = read_motion(&entry, &DISPLACEMENT.range, &ACCELERATION.range);
    let phase = PHASE.read(&entry);
    entry.finish();
    Some(MovingSupport { at: at?, drive: drive?, phase_rad: phase? })
}

/// A table over the frequency is a factor of the whole excitation.
fn refuse_tables(entry: &TomlTable<'_>) {
    for key in ["amplitude_m", "amplitude_m_s2"] {
        if let Some(value) = entry.optional(key).filter(Value::is_list) {
            let message =
                format!("`{key}` of a support that moves differently is a table over the frequency");
            let help = "allowed: a number; tables are for supports that all move alike, with `at = [...]`";
            value.problem(message, vec![help.to_owned()]);
        }
    }
}

fn read_places(value: &Value<'_>, names: &Names) -> Option<Vec<String>> {
    if value.is_text() {
        return names.support(value).map(|name| vec![name]);
    }
    let elements = value.array_of("supports")?;
    let supports: Vec<Option<String>> = elements.iter().map(|element| names.support(element)).collect();
    let supports = supports.into_iter().collect::<Option<Vec<String>>>()?;
    let mut distinct = supports.clone();
    distinct.sort_unstable();
    distinct.dedup();
    if supports.is_empty() || distinct.len() < supports.len() {
        let message =
            if supports.is_empty() { "`at` is an empty list" } else { "`at` names a support twice" };
        value.problem(message.into(), vec!["allowed: one support or more, each once".into()]);
        return None;
    }
    Some(supports)
}

#[cfg(test)]
mod tests {
    use crate::{
        Model, StudyFile,
        file::{Excitation, FixedTo, LoadTable, Place, Study},
    };

    const TUBE: &str = r#"
        [structure]
        kind = "beam"
        length_m = 0.5
        elements = 20
        section = { width_m = 0.02, height_m = 0.003 }
        youngs_modulus_pa = 2.1e11
        density_kg_m3 = 7800.0
        left = "clamped"
        right = "pinned"
        [[structure.point]]
        name = "middle"
        at_m = 0.2
        [reduction]
        method = "free-interface"
        cut_off_hz = 1000.0
        [excitation]
        kind = "support-motion"
        frequency_hz = [20.0, 90.0]
        support = [
            { at = "left", amplitude_m = 0.5e-3 },
            { at = "right", amplitude = "0.2 mm", phase = "90 deg" },
        ]
        [[stop]]
        at = "middle"
        fixed_to = "right"
        law = "linear"
        stiffness_n_m = 2.0e4
        side = "above"
        gap_m = 1.0e-3
        [response]
        point = "middle"
    "#;

    fn tube_with(old: &str, new: &str) -> Result<StudyFile, String> {
        assert!(TUBE.contains(old), "{old} is not in the study");
        StudyFile::parse("tube.toml", TUBE.replacen(old, new, 1)).map_err(|error| error.to_string())
    }

    fn tube() -> Study {
        tube_with("beam", "beam").unwrap().study
    }

    #[track_caller]
    fn assert_refused(old: &str, new: &str, parts: &[&str]) {
        let message = tube_with(old, new).unwrap_err();
        for part in parts {
            assert!(message.contains(part), "\"{part}\" is missing in:\n{message}");
        }
    }

    #[test]
    fn every_support_has_its_motion_and_a_stop_the_one_that_carries_it() {
        let study = tube();
        let supports: Vec<&[String]> = study.excitation.supports();
        assert_eq!(supports, [["left".to_owned()], ["right".to_owned()]]);
        let Excitation::Harmonic(harmonic) = &study.excitation else { panic!("nothing shakes it") };
        assert!(harmonic.amplitude().is_none());
        let place = Place::At { point: "middle".into(), fixed_to: FixedTo::Support(1) };
        assert_eq!(study.stops[0].place, place);
        let model = Model::build(&tube_with("beam", "beam").unwrap()).unwrap();
        let stop = &model.system.elements()[0];
        let point = model.system.model().point("middle").unwrap();
        assert_eq!(stop.support_ratios, [point.support_ratios[0], point.support_ratios[1] - 1.0]);
        let right = model.system.support_motions(30.0, 0.75)[1];
        assert!((right[0] - 0.2e-3).abs() < 1e-18, "a quarter of a period late: {right:?}");
    }

    #[test]
    fn a_further_harmonic_says_whose_it_is() {
        let load = "[[load]]\nkind = \"support-motion\"\nat = \"right\"\namplitude_m = 1e-4\norder = 3\n";
        let study = tube_with("[response]", &format!("{load}[response]")).unwrap().study;
        assert!(matches!(study.loads[0], LoadTable::SupportMotion { support: 1, order: 3, .. }));
        let nameless = load.replace("at = \"right\"\n", "");
        assert_refused("[response]", &format!("{nameless}[response]"), &["`at` is missing"]);
        let other = load.replace("right", "middle");
        assert_refused("[response]", &format!("{other}[response]"), &["middle", "left, right"]);
    }

    /// `u = -a/(2 pi f)^2 cos(2 pi f t + p)` has the acceleration `a cos(2 pi f t + p)`.
    #[test]
    fn a_support_may_be_given_by_its_acceleration() {
        let file = tube_with("amplitude = \"0.2 mm\"", "amplitude_m_s2 = 7.0").unwrap();
        let model = Model::build(&file).unwrap();
        for f in [20.0_f64, 55.0] {
            let w = std::f64::consts::TAU * f;
            // Three quarters of a period and a phase of 90 degrees make a whole one.
            let right = model.system.support_motions(f, 0.75)[1];
            assert!((right[0] * w * w + 7.0).abs() < 1e-12 && (right[2] - 7.0).abs() < 1e-12, "{right:?}");
        }
        let both = "amplitude_m_s2 = 7.0, amplitude = \"0.2 mm\"";
        assert_refused(
            "amplitude = \"0.2 mm\"",
            both,
            &["`amplitude_m_s2` is given, and `amplitude_m`, too"],
        );
        let table = "amplitude_m_s2 = [[10.0, 1.0], [90.0, 2.0]]";
        assert_refused("amplitude = \"0.2 mm\"", table, &["`amplitude_m_s2` of a support", "all move alike"]);
        let load = "[[load]]\nkind = \"support-motion\"\nat = \"right\"\namplitude_m_s2 = 1.0\norder = 3\n";
        Model::build(&tube_with("[response]", &format!("{load}[response]")).unwrap()).unwrap();
    }

    #[test]
    fn what_does_not_fit_supports_that_differ_is_refused() {
        assert_refused("at = \"right\",", "at = \"left\",", &["two entries of `support` move \"left\""]);
        assert_refused("fixed_to = \"right\"\n", "", &["2 supports move differently", "left, right, space"]);
        let table = "amplitude_m = [[10.0, 1e-3], [90.0, 2e-3]]";
        assert_refused("amplitude_m = 0.5e-3", table, &["a table over the frequency", "all move alike"]);
        assert_refused("support = [", "phase_rad = 1.0\nsupport = [", &["`phase_rad` is given besides"]);
        assert_refused("support = [", "at = \"left\"\nsupport = [", &["`at` is given besides `support`"]);
        assert_refused("amplitude_m = 0.5e-3", "amplitude_m = 0.6", &["0.6 m", "0.5 m, the length"]);
        assert_refused("right = \"pinned\"", "right = \"free\"", &["the right end of the beam is not held"]);
        let second = "{ at = \"right\", amplitude = \"0.2 mm\", phase = \"90 deg\" },";
        assert_refused(second, "", &["`support` has one entry", "is moved with `at`"]);
        assert_refused(second, "\"right\"", &["support[1]"]);
        let rig = "[rig]\nsweep_hz = [20.0, 30.0]\nchanges = {}\n[response]";
        assert_refused("[response]", rig, &["a rig has one table, but the supports move differently"]);
        let whole = "[[vary]]\nparameter = \"excitation.amplitude_m\"\nrange = [1e-4, 1e-3]\n\
                     frequency_hz = 30.0\n[response]";
        assert_refused("[response]", whole, &["not a parameter of this study"]);
    }

    #[test]
    fn amplitude_and_phase_of_a_support_vary_by_their_key_paths() {
        for (key, range) in [("1.amplitude_m", "[1e-4, 1e-3]"), ("2.phase_rad", "[0.5, 2.0]")] {
            let vary = format!(
                "[[vary]]\nparameter = \"excitation.support.{key}\"\nrange = {range}\nfrequency_hz = 30.0\n\
                 [response]"
            );
            Model::build(&tube_with("[response]", &vary).unwrap()).unwrap();
        }
    }

    #[test]
    fn the_identity_of_a_study_has_its_supports() {
        let of = |old, new| tube_with(old, new).unwrap().study.identity();
        let whole = of("beam", "beam");
        assert_ne!(whole, of("fixed_to = \"right\"", "fixed_to = \"left\""));
        assert_ne!(whole, of("90 deg", "80 deg"));
        assert_ne!(whole, of("0.2 mm", "0.3 mm"));
    }
}
