//! Structures given as matrices, through the command: `modes`, `check`, `import`.

use std::{
    fs,
    path::{Path, PathBuf},
};

use hammerbeam_jobs::{ManyModes, PreparedStudy};
use serde_json::Value;

fn hammerbeam() -> assert_cmd::Command {
    assert_cmd::Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
}

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../matrices/tests/fixtures").join(name)
}

/// Files of public projects, where a checkout has them beside it.
fn shared(name: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/structures").join(name);
    if !folder.is_dir() {
        #[expect(clippy::print_stderr, reason = "a test that did not run says so")]
        {
            eprintln!("skipped: {} is not there", folder.display());
        }
        return None;
    }
    Some(folder)
}

/// The frequencies that `modes` prints of a study with this structure, as texts.
fn printed(structure: &str, cut_off_hz: f64) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let study = folder.path().join("study.toml");
    let reduction = format!("[reduction]\nmethod = \"truncation\"\ncut_off_hz = {cut_off_hz:?}\n");
    fs::write(&study, format!("[structure]\nkind = \"matrices\"\n{structure}\n{reduction}")).unwrap();
    let output = hammerbeam().arg("modes").arg(&study).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}{}", String::from_utf8_lossy(&output.stderr));
    let table =
        text.lines().skip(2).take_while(|line| line.trim_start().starts_with(|c: char| c.is_ascii_digit()));
    table.map(|line| line.split_whitespace().nth(1).unwrap().to_owned()).collect()
}

/// Frequencies as far as they are known, after so many zeros.
#[track_caller]
fn assert_known(printed: &[String], rigid: usize, known: &[&str]) {
    assert!(printed[..rigid].iter().all(|frequency| frequency == "0"), "{printed:?}");
    for (found, known) in printed[rigid..].iter().zip(known) {
        let decimals = known.split('.').nth(1).map_or(0, str::len) as i32;
        let half = 0.501 * 10.0_f64.powi(-decimals);
        let difference = found.parse::<f64>().unwrap() - known.parse::<f64>().unwrap();
        assert!(difference.abs() <= half, "{found} instead of {known}");
    }
}

fn files(folder: &Path, entries: &[(&str, &str)]) -> String {
    entries.iter().map(|(key, name)| format!("{key} = '{}'\n", folder.join(name).display())).collect()
}

#[test]
fn frequencies_of_the_bar_are_those_that_calculix_printed() {
    let structure =
        files(&fixture(""), &[("stiffness", "bar.sti"), ("mass", "bar.mas"), ("dofs", "bar.dof")]);
    let found = printed(&structure, 5000.0);
    assert_eq!(found.len(), 6);
    assert_known(&found, 0, &["526.8666", "526.8666", "1967.433", "3267.506", "4124.436", "4124.436"]);
}

#[test]
fn known_frequencies_of_public_files() {
    if let Some(folder) = shared("abaqus") {
        let names = [
            ("stiffness", "blockC3D8_STIF1.mtx"),
            ("mass", "blockC3D8_MASS1.mtx"),
            ("dofs", "blockC3D8.inp"),
        ];
        assert_known(&printed(&files(&folder, &names), 500.0), 6, &["438.775166"]);
        let names = [("stiffness", "rotorDiscTestSTIF1.mtx"), ("mass", "rotorDiscTestMASS1.mtx")];
        let rotor = files(&folder, &names) + "stiffness_factor = 1e-2\n";
        let known = ["104.637013", "104.637013", "187.824", "212.330", "224.552", "238.688"];
        assert_known(&printed(&rotor, 250.0), 6, &known);
    }
    if let Some(folder) = shared("calculix") {
        let names = [("stiffness", "b32.sti"), ("mass", "b32.mas"), ("dofs", "b32.dof")];
        assert_known(&printed(&files(&folder, &names), 2000.0), 0, &["221.9151", "429.9326", "1444.921"]);
    }
    if let Some(folder) = shared("nastran-punch") {
        let name = "sol103_swept_plane.pch1";
        let plane = files(&folder, &[("stiffness", name), ("mass", name)]);
        assert_known(&printed(&plane, 6.0), 3, &["1.339207", "3.406026", "5.610046"]);
    }
    if let Some(folder) = shared("nastran-op4") {
        let component = |name: &str| {
            let [matrices, order] = ["op4", "pch"].map(|extension| format!("{name}.{extension}"));
            let files = files(&folder, &[("stiffness", &matrices), ("mass", &matrices), ("dofs", &order)]);
            format!("[[structure.component]]\nname = \"{name}\"\n{files}")
        };
        let found = printed(&(component("inboard") + &component("outboard")), 44.0);
        assert_known(&found, 6, &["1.698800", "1.767487", "1.857720", "3.419612"]);
        assert_known(&found[22..], 0, &["43.08660"]);
    }
}

#[test]
fn a_bundle_has_the_same_frequencies_as_the_files_that_it_is_of() {
    let folder = tempfile::tempdir().unwrap();
    let bundle = folder.path().join("bar");
    let output = hammerbeam()
        .args(["--json", "import"])
        .args(["bar.sti", "bar.mas", "bar.dof", "bar.inp"].map(fixture))
        .arg("--out")
        .arg(&bundle)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&report["matrices"]["rows"], &report["matrices"]["rigid_modes"]), (&90.into(), &0.into()));
    assert_eq!(report["files"], serde_json::json!(["K.mtx", "M.mtx", "dofs.csv", "nodes.csv"]));
    // 18 motions of the nodes have no mass.
    assert_eq!(report["mass_rank"], 72);
    let names = [("stiffness", "K.mtx"), ("mass", "M.mtx"), ("dofs", "dofs.csv"), ("nodes", "nodes.csv")];
    let direct = files(&fixture(""), &[("stiffness", "bar.sti"), ("mass", "bar.mas")]);
    assert_eq!(printed(&files(&bundle, &names), 5000.0), printed(&direct, 5000.0));
}

/// The paper's beam, and the study that reads it back.
#[test]
fn the_beam_of_a_study_exported_and_read_back_has_the_same_modes() {
    let folder = tempfile::tempdir().unwrap();
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../studies/beam-with-stop.toml");
    hammerbeam().arg("import").arg(&study).arg("--out").arg(folder.path()).assert().success();
    let modes = |study: &Path| -> Value {
        let output = hammerbeam().args(["--json", "modes"]).arg(study).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let (beam, back) = (modes(&study), modes(&folder.path().join("study.toml")));
    for table in ["reduced_hz", "free_interface_hz"] {
        let [beam, back] = [&beam, &back].map(|document| document[table].as_array().unwrap().clone());
        assert_eq!(beam.len(), back.len(), "{table}");
        for (beam, back) in beam.iter().zip(&back) {
            let (beam, back) = (beam.as_f64().unwrap(), back.as_f64().unwrap());
            assert!((beam - back).abs() <= 1e-9 * beam, "{table}: {beam} {back}");
        }
    }
}

#[track_caller]
fn refused(structure: &str, parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let study = folder.path().join("study.toml");
    let text = format!("[structure]\nkind = \"matrices\"\n{structure}\n[reduction]\nmethod = \"none\"\n");
    fs::write(&study, text).unwrap();
    fs::write(folder.path().join("K.mtx"), "1 1 2.0\n1 2 -1.0\n2 1 -1.5\n2 2 2.0\n").unwrap();
    fs::write(folder.path().join("S.mtx"), "1 1 2.0\n2 1 -1.0\n2 2 2.0\n").unwrap();
    fs::write(folder.path().join("M.mtx"), "1 1 1.0\n2 2 1.0\n").unwrap();
    fs::write(folder.path().join("three.mtx"), "1 1 1.0\n2 2 1.0\n3 3 1.0\n").unwrap();
    fs::write(folder.path().join("nan.mtx"), "1 1 1.0\n2 2 nan\n").unwrap();
    fs::write(folder.path().join("dofs.csv"), "row,node,direction,kind,name\n1,1,x,physical,\n").unwrap();
    fs::write(folder.path().join("both.csv"), "1,4,x,physical,tip\n2,4,x,physical,\n").unwrap();
    let twice = "row,node,direction,kind,name\n1,1,x,physical,end\n2,2,x,physical,end\n";
    fs::write(folder.path().join("twice.csv"), twice).unwrap();
    fs::write(folder.path().join("negative.mtx"), "1 1 1.0\n2 2 -1.0\n").unwrap();
    fs::write(folder.path().join("loose.mtx"), "1 1 1.0\n2 2 1.0\n3 2 -1.0\n3 3 1.0\n").unwrap();
    fs::write(folder.path().join("first.mtx"), "1 1 1.0\n3 3 0.0\n").unwrap();
    let output = hammerbeam().arg("modes").arg(&study).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{message}");
    for part in parts {
        assert!(message.contains(part), "\"{part}\" is missing in:\n{message}");
    }
}

#[test]
fn files_that_do_not_fit_are_refused_with_their_place() {
    refused("stiffness = \"K.mtx\"\nmass = \"M.mtx\"", &["not symmetric", "row 2, column 1", "stiffness = "]);
    refused("stiffness = \"S.mtx\"\nmass = \"three.mtx\"", &["3 rows", "has 2", "mass = "]);
    refused("stiffness = \"S.mtx\"\nmass = \"nan.mtx\"", &["nan.mtx, line 2", "finite"]);
    refused("stiffness = \"S.mtx\"\nmass = \"gone.mtx\"", &["cannot read", "gone.mtx"]);
    refused("stiffness = \"S.mtx\"\nmass = \"M.mtx\"\ndofs = \"dofs.csv\"", &["labels has 1 rows"]);
    refused("stiffness = \"S.mtx\"\nmass = \"M.mtx\"\nmas = 3", &["`mas`", "did you mean"]);
}

/// Line by line as `refused` writes the study: the files of the matrices stand in lines 3 and 4.
#[test]
fn faults_of_matrices_stand_at_the_key_that_is_to_blame() {
    let files = "stiffness = \"S.mtx\"\nmass = \"M.mtx\"\n";
    let labelled = format!("{files}dofs = \"both.csv\"\n");
    let point = |keys: &str| format!("[[structure.point]]\nname = \"tip\"\n{keys}");
    let of_node = |node: u32, direction: &str| point(&format!("node = {node}\ndirection = \"{direction}\""));
    for (point, parts) in [
        (
            of_node(9, "x"),
            ["study.toml:8:", "point \"tip\" is at nodes that no row has: 9", "said by both.csv"],
        ),
        (of_node(4, "y"), ["study.toml:9:", "node 4 y, which no row has", "both.csv"]),
        (of_node(4, "x"), ["study.toml:9:", "several rows, 1, 2; name the one by its row", "both.csv"]),
        (point("label = \"end\""), ["study.toml:8:", "the name \"end\", which no row has", "both.csv"]),
    ] {
        refused(&(labelled.clone() + &point), &parts);
    }
    refused(&(files.to_owned() + &point("row = 3")), &["study.toml:7:", "row 3, there are 2 rows"]);
    refused(&(files.to_owned() + &of_node(4, "x")), &["study.toml:7:", "give `dofs`"]);
    let fixed = "[[structure.fixed]]\nrows = [1]\n[[structure.fixed]]\n";
    refused(
        &format!("{files}{fixed}rows = [5]"),
        &["study.toml:8:", "entry 2 of the fixed rows is at row 5"],
    );
    refused(&format!("{labelled}{fixed}nodes = [7]"), &["study.toml:9:", "nodes that no row has: 7"]);
    let support = "[[structure.support]]\nname = \"base\"\ndirection = \"x\"\nnodes = [8]";
    refused(&format!("{labelled}{support}"), &["study.toml:9:", "support \"base\" is at nodes"]);
    // The labels of files, and what components share.
    let twice = format!("{files}dofs = \"twice.csv\"\n");
    refused(
        &twice,
        &["study.toml:5:", "twice.csv, line 3", "the name \"end\" stands for row 1 and for row 2"],
    );
    let component = |name: &str| format!("[[structure.component]]\nname = \"{name}\"\n{labelled}");
    let parts =
        ["study.toml:7:", "node 4 x of component \"one\" stands for several rows, 1, 2, and joins it"];
    refused(&(component("one") + &component("two")), &parts);
    let broken = component("two").replace("M.mtx", "nan.mtx");
    refused(&(component("one") + &broken), &["study.toml:11:", "nan.mtx, line 2"]);
    // Matrices that are no structure.
    let negative = files.replace("M.mtx", "negative.mtx");
    refused(&negative, &["study.toml:4:", "mass on the diagonal of row 2 is -1"]);
    let loose = "stiffness = \"loose.mtx\"\nmass = \"first.mtx\"";
    refused(loose, &["study.toml:3:", "can move without mass and without stiffness"]);
}

#[test]
fn matrices_of_a_beam_in_two_planes_are_refused_with_what_is_allowed() {
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../studies/tube-in-hole.toml");
    let folder = tempfile::tempdir().unwrap();
    let output = hammerbeam().arg("import").arg(&study).arg("--out").arg(folder.path().join("tube")).output();
    let output = output.unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{message}");
    for part in ["bends in two planes", "tube-in-hole.toml:7:", "allowed: planes = 1"] {
        assert!(message.contains(part), "{message}");
    }
    assert!(!folder.path().join("tube").exists(), "nothing is written");
}

/// A chain of so many equal masses.
fn chain(masses: usize) -> String {
    let mass = |k: usize| format!("{{ name = \"m{k}\", mass_kg = 1.0 }}");
    let before = |k: usize| if k == 0 { "ground".to_owned() } else { format!("m{}", k - 1) };
    let spring = |k: usize| format!("{{ between = [\"{}\", \"m{k}\"], stiffness_n_m = 2500.0 }}", before(k));
    let rows = |one: &dyn Fn(usize) -> String| (0..masses).map(one).collect::<Vec<_>>().join(", ");
    format!(
        "[structure]\nkind = \"lumped\"\nmass = [{}]\nspring = [{}]\n[damping]\nmodal_ratio = 0.01\n\
         [excitation]\nkind = \"force\"\nat = \"m0\"\namplitude_n = 1.0\nfrequency_hz = [0.2, 2.0]\n",
        rows(&mass),
        rows(&spring)
    )
}

#[test]
fn a_structure_of_too_many_modes_is_told_before_anything_is_computed() {
    let folder = tempfile::tempdir().unwrap();
    let advice = ManyModes { modes: 101, is_lumped: true };
    for (masses, expected) in [(100, None), (101, Some(advice))] {
        let study = folder.path().join("study.toml");
        fs::write(&study, chain(masses)).unwrap();
        let output = hammerbeam().arg("check").arg(&study).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        let messages = String::from_utf8(output.stderr).unwrap();
        assert_eq!(PreparedStudy::read(&study).unwrap().many_modes(), expected);
        assert_eq!(messages.contains(&advice.to_string()), expected.is_some(), "{messages}");
    }
}
