//! Defaults in the tables of keys are those that the readers take: a study in which a default is written out
//! is the study without the key, and another value makes another one.

use super::{KeyTable, Study, StudyFile, key_tables};
use crate::document::KeyRow;

const BEAM: &str = include_str!("../../../../studies/beam-between-stops.toml");

/// Where the studies are said to be: matrices are beside them.
const BESIDE_MATRICES: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/tutorials/calculix/study.toml");

/// Defaults that are no value, since they depend on the rest of the study.
const IN_WORDS: [&str; 9] =
    ["component", "directions", "directions", "name", "fixed_to", "point", "name", "quantity", "signals"];

/// What stands for a default that there is not, or that other keys have.
const NO_VALUE: [&str; 4] = ["required", "none", "every default", "as in `[structure]`"];

/// A default of a key of a table.
struct Documented {
    table: &'static str,
    key: String,
    default: String,
}

fn documented() -> Vec<Documented> {
    let of = |KeyTable { name: table, rows }: KeyTable| {
        let row = move |KeyRow { name: key, default, .. }: KeyRow| Documented { table, key, default };
        rows.into_iter().map(row)
    };
    key_tables().into_iter().flat_map(of).collect()
}

impl Documented {
    /// The default as TOML; `None` where a key is required or there is nothing without it.
    fn value(&self) -> Option<String> {
        if self.default == "1/5000 of the frequency range" {
            return Some("0.004".to_owned());
        }
        let text = self.default.trim_matches('`');
        format!("x = {text}").parse::<toml::Table>().is_ok().then(|| text.to_owned())
    }

    /// A study that may have the key, and the line behind which it goes.
    fn study(&self) -> (String, &'static str) {
        let with = |more: &str| format!("{BEAM}\n{more}");
        let stop = |law: &str| with(&format!("[[stop]]\nname = \"other\"\nat = \"tip\"\nlaw = {law}\n"));
        let (shaken, range) = (
            "kind = \"support-motion\"\nat = \"left\"\namplitude_m = 0.2e-3\nfrequency_hz = [5.0, 25.0]\n",
            "frequency_hz = [5.0, 25.0]\n",
        );
        let excited = |other: &str| BEAM.replace(shaken, other);
        match self.table {
            "top level" => (format!("# first\n{}", BEAM.replace("title = ", "# ")), "# first"),
            "structure of kind beam" => (BEAM.to_owned(), "kind = \"beam\""),
            "structure.point of a beam" => (BEAM.replace("mass_kg = 0.02\n", ""), "[[structure.point]]"),
            "structure of kind matrices" | "structure.component" => {
                let files = "stiffness = \"plate.sti\"\nmass = \"plate.mas\"\ndamping = \"plate.mas\"\n";
                let kind = "[structure]\nkind = \"matrices\"\n";
                (format!("{kind}{files}[reduction]\nmethod = \"none\"\n"), "kind = \"matrices\"")
            }
            "structure.support" => {
                let support = "[[structure.support]]\nname = \"a\"\nrows = [1]\ndirection = \"z\"\n";
                let files = "stiffness = \"plate.sti\"\nmass = \"plate.mas\"\n";
                let kind = "[structure]\nkind = \"matrices\"\n";
                (format!("{kind}{files}{support}[reduction]\nmethod = \"none\"\n"), "name = \"a\"")
            }
            "load" => {
                let load = "[[load]]\nkind = \"force\"\nat = \"tip\"\namplitude_n = 1.0\norder = 2";
                (with(load), "order = 2")
            }
            "figures.orbit" => (with("[[figures.orbit]]\nfrequency_hz = 9.0"), "[[figures.orbit]]"),
            "excitation" => (BEAM.to_owned(), "[excitation]"),
            "excitation.support" => {
                let support = |at| format!("[[excitation.support]]\nat = \"{at}\"\namplitude_m = 1e-3\n");
                let post = "[[structure.point]]\nname = \"post\"\nat_m = 0.25\nsupport = \"pinned\"\n";
                let supports = [support("left"), support("post"), post.to_owned()].concat();
                (excited(&format!("kind = \"support-motion\"\n{range}{supports}")), "[[excitation.support]]")
            }
            "excitation.force" => {
                let forces = "[[excitation.force]]\nat = \"tip\"\namplitude_n = 1.0\n";
                (excited(&format!("kind = \"force\"\n{range}{forces}")), "[[excitation.force]]")
            }
            "stop by its law" if self.key.starts_with("stiffness_n_m3") => {
                (stop("\"cubic\"\nstiffness_n_m = 1.0"), "name = \"other\"")
            }
            "stop by its law" if self.key.starts_with("stiffness") => {
                (stop("\"cubic\"\nstiffness_n_m3 = 1.0"), "name = \"other\"")
            }
            "stop by its law" if self.key.starts_with("gap_above") => {
                (stop("\"two-sided\"\nstiffness_n_m = 1.0\ngap_below_m = 0.0"), "name = \"other\"")
            }
            "stop by its law" if self.key.starts_with("gap_below") => {
                (stop("\"two-sided\"\nstiffness_n_m = 1.0\ngap_above_m = 0.0"), "name = \"other\"")
            }
            "stop by its law" => {
                let law = "\"linear\"\nstiffness_n_m = 1.0\nside = \"above\"";
                (stop(law), "name = \"other\"")
            }
            "response" => (BEAM.to_owned(), "[response]"),
            "output" => (with("[[output]]\nname = \"seen\"\nat = \"tip\""), "name = \"seen\""),
            "search" => (with("[search]"), "[search]"),
            "continuation" => (with("[continuation]"), "[continuation]"),
            "vary" => {
                let vary = "[[vary]]\nparameter = \"excitation.amplitude_m\"\nrange = [1e-4, 3e-4]";
                (with(&format!("{vary}\nfrequency_hz = 9.0")), "[[vary]]")
            }
            "curve" => {
                let curve =
                    "[[curve]]\nof = \"fold\"\nnear_hz = 9.0\nparameter = \"excitation.amplitude_m\"\n";
                (with(&format!("{curve}range = [1e-4, 3e-4]")), "[[curve]]")
            }
            "figures" => (with("[figures]"), "[figures]"),
            "rig" => {
                let rig = "[rig]\nchanges = { damping = { modal_ratio = 0.03 } }\nsweep_hz = [6.0, 20.0]";
                (with(rig), "[rig]")
            }
            other => panic!("no study for {other}"),
        }
    }
}

fn read(study: &str) -> Option<Study> {
    StudyFile::parse(BESIDE_MATRICES, study.to_owned()).ok().map(|file| file.study)
}

#[test]
fn defaults_of_the_page_are_those_of_the_readers() {
    let (mut literal, mut in_words) = (0, Vec::new());
    for row in documented() {
        let Some(default) = row.value() else {
            let says_nothing = NO_VALUE.iter().any(|word| row.default.contains(word));
            if !says_nothing || row.key == "fixed_to" {
                in_words.push(row.key);
            }
            continue;
        };
        let (study, line) = row.study();
        let with = |value: &str| read(&study.replacen(line, &format!("{line}\n{} = {value}", row.key), 1));
        let place = format!("`{}` of {}", row.key, row.table);
        let expected = read(&study).unwrap_or_else(|| panic!("the study for {place} is refused:\n{study}"));
        let written = with(&default).unwrap_or_else(|| panic!("{place} = {default} is refused"));
        assert!(written == expected, "{default} is not the default of {place}");
        let others = [
            "1",
            "2",
            "1e-9",
            "77",
            "0.002",
            "7",
            "false",
            "true",
            "\"pinned\"",
            "\"at-rest\"",
            "[2]",
            "[900.0]",
            "[\"rms\"]",
        ];
        let changes = |other: &&str| with(other).is_some_and(|study| study != expected);
        // Another theory needs Poisson's ratio, which this one refuses.
        assert!(row.key == "theory" || others.iter().any(changes), "nothing changes {place}");
        literal += 1;
    }
    assert_eq!(in_words, IN_WORDS, "defaults that are no value");
    assert!(literal > 35, "{literal}");
}
