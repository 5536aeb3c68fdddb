//! A bracket of solid elements from CalculiX, `studies/bracket.toml`: its frequencies against those that
//! CalculiX finds itself, and the mesh that is drawn against the points of the study.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::{f64::consts::TAU, path::Path};

use approx::assert_relative_eq;
use hammerbeam_study::{Model, StudyFile};

/// `*FREQUENCY` of CalculiX 2.20 with the deck `studies/bracket/bracket.inp` [rad/s].
const PRINTED: [f64; 4] = [0.9299358e3, 2.287692e3, 3.726947e3, 5.790397e3];

fn model() -> (StudyFile, Model) {
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("../studies/bracket.toml");
    let file = StudyFile::read(&study).unwrap();
    let model = Model::build(&file).unwrap();
    (file, model)
}

#[test]
fn frequencies_are_those_of_calculix() {
    let (_, model) = model();
    for (found, printed) in model.tables.clamped_hz.iter().zip(PRINTED) {
        // Seven digits are printed.
        assert_relative_eq!(TAU * found, printed, max_relative = 1e-6);
    }
}

#[test]
fn nodes_of_the_mesh_move_as_points_do_and_the_foot_follows_its_base() {
    let (_, model) = model();
    let mesh = model.mesh.as_ref().unwrap();
    assert_eq!((mesh.nodes.len(), mesh.lines.len()), (92, 120));
    let node = |number: i64| mesh.nodes.iter().find(|node| node.number == number).unwrap();
    for (name, number, axis) in [("end", 86, 0), ("knee", 53, 2)] {
        let point = model.system.model().point(name).unwrap();
        assert_eq!(node(number).shape[axis], point.shape);
        assert_eq!(node(number).support_ratios[axis], point.support_ratios);
    }
    for number in [1, 4, 5, 8, 12, 16, 17, 20] {
        let foot = node(number);
        assert_eq!(foot.place[0], 0.0);
        assert!(foot.shape.iter().flatten().all(|entry| *entry == 0.0), "the foot is held");
        assert_eq!(foot.support_ratios, [vec![0.0], vec![0.0], vec![1.0]]);
    }
    // The base takes everything along as a rigid body.
    for node in &mesh.nodes {
        for (axis, ratio) in [0.0, 0.0, 1.0].into_iter().enumerate() {
            assert!((node.support_ratios[axis][0] - ratio).abs() < 1e-12);
        }
    }
    // Lines join neighbours: half an edge of an element is 20 mm long at most.
    for [from, to] in &mesh.lines {
        let square: f64 =
            (0..3).map(|k| (mesh.nodes[*from].place[k] - mesh.nodes[*to].place[k]).powi(2)).sum();
        assert!(square.sqrt() < 0.0201, "{}", square.sqrt());
    }
}

/// Points that only outputs name are no part of the identity, and leave every number of the model as it is.
#[test]
fn a_point_that_is_only_observed_changes_neither_the_identity_nor_the_model() {
    let (file, model) = model();
    let name = Path::new(env!("CARGO_MANIFEST_DIR")).join("../studies/bracket.toml");
    let with = |added: &str| {
        let text = file.text.replacen("[[structure.support]]", &format!("{added}[[structure.support]]"), 1);
        StudyFile::parse(&name.display().to_string(), text).unwrap()
    };
    let observed = with("[[structure.point]]\nname = \"corner\"\nnode = 52\ndirection = \"y\"\n\n");
    assert_eq!(observed.study.identity(), file.study.identity());
    let other = Model::build(&observed).unwrap();
    let [one, other] = [&model, &other].map(|model| model.system.model());
    assert_eq!(one.natural_frequencies, other.natural_frequencies);
    assert_eq!(one.point("end"), other.point("end"));
    assert!(one.point("corner").is_none() && other.point("corner").is_some());
}
