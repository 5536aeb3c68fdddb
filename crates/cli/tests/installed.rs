//! What an installed command offers besides its work: completions, manual pages, a version.

use std::process::Command;

use crate::common::{Workshop, assert_success, stdout};

#[test]
fn every_shell_completes_every_command() {
    let workshop = Workshop::with("");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = workshop.hammerbeam(&["completions", shell]);
        assert_success(&output);
        for word in ["lyapunov", "period-multiple", "low-pass"] {
            assert!(stdout(&output).contains(word), "{shell}: {word}");
        }
    }
    // What can be asked of the shell that is there as a rule: that it is a script.
    let script = workshop.path("script");
    std::fs::write(&script, stdout(&workshop.hammerbeam(&["completions", "bash"]))).unwrap();
    if let Ok(read) = Command::new("bash").arg("-n").arg(&script).status() {
        assert!(read.success());
    }
}

#[test]
fn there_is_a_manual_page_for_every_command() {
    let workshop = Workshop::with("");
    let page = workshop.hammerbeam(&["man"]);
    assert_success(&page);
    assert!(stdout(&page).contains(".TH hammerbeam 1") && stdout(&page).contains("130 interrupted"));
    assert_success(&workshop.hammerbeam(&["man", "--out", "pages"]));
    for (name, words) in [
        ("hammerbeam.1", "hammerbeam\\-run(1)"),
        ("hammerbeam-run.1", "\\-\\-jobs"),
        ("hammerbeam-signal-chain.1", "\\-\\-sampling"),
    ] {
        let text = std::fs::read_to_string(workshop.path("pages").join(name)).unwrap();
        assert!(text.contains(words), "{name} has no {words}:\n{text}");
    }
}

#[test]
fn the_version_is_that_of_the_package() {
    let version = stdout(&Workshop::with("").hammerbeam(&["--version"]));
    assert!(version.starts_with(concat!("hammerbeam ", env!("CARGO_PKG_VERSION"))), "{version}");
}
