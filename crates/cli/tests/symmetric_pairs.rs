//! Pairs of mirror images, where they meet the symmetric orbits.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::{common::Workshop, corners::WHOLE};

/// Two masses, one of them between two stops. From the grazing at 10.72681 Hz, where one contact more is made
/// on one side, to the branch point 6e-7 Hz away from it the images part by some 1e-5 of the motion: beside
/// the branch point rounding is more than that.
const HARDLY_APART: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "m0", mass_kg = 0.472796 }, { name = "m1", mass_kg = 0.289279 }]
spring = [
    { between = ["m0", "ground"], stiffness_n_m = 6794.19 },
    { between = ["m1", "m0"], stiffness_n_m = 13349.9 },
]
damper = [
    { between = ["m0", "ground"], damping_n_s_m = 5.90353 },
    { between = ["m1", "m0"], damping_n_s_m = 11.5998 },
]

[excitation]
kind = "force"
at = "m1"
amplitude_n = 2.68638
frequency_hz = [10.70, 10.75]

[[stop]]
at = "m0"
law = "two-sided"
stiffness_n_m = 488772
gap_m = 8.96378e-05

[continuation]
max_step_hz = 0.005

[search]
frequencies = 1
"#;

/// There, or beyond, where the walk goes through the branch point: it must not come over to the symmetric
/// branch.
#[test]
fn a_pair_that_rounding_hardly_tells_apart_ends_where_it_becomes_symmetric() {
    let ends = Workshop::exported(HARDLY_APART).table("results/export/ends.csv");
    assert!(ends.len() > 6, "{ends:?}");
    let is_whole = |end: &str| WHOLE.contains(&end) || end == "symmetric";
    assert!(ends.iter().all(|end| is_whole(&end["end"])), "{ends:?}");
}
