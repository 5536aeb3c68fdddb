//! The commit that a release is built from, for `hammerbeam --version`.
//!
//! Only releases name it: a build for development would be made anew with every commit. Outside a repository,
//! as in a package, there is none.

use std::{env, process::Command};

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed=HAMMERBEAM_COMMIT");
    let is_release = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let given = env::var("HAMMERBEAM_COMMIT").ok();
    let commit = given.or_else(|| is_release.then(commit).flatten());
    let version = env::var("CARGO_PKG_VERSION").unwrap_or_default();
    let version = commit.map_or_else(|| version.clone(), |commit| format!("{version} ({commit})"));
    println!("cargo:rustc-env=HAMMERBEAM_VERSION={version}");
}

/// The first digits of the commit that is checked out, with a word where files differ from it.
fn commit() -> Option<String> {
    for path in ["HEAD", "index"] {
        let place = git(&["rev-parse", "--git-path", path])?;
        println!("cargo:rerun-if-changed={place}");
    }
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let is_changed = !git(&["status", "--porcelain", "--untracked-files=no"])?.is_empty();
    Some(if is_changed { format!("{commit}, changed") } else { commit })
}

fn git(arguments: &[&str]) -> Option<String> {
    let output =
        Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}
