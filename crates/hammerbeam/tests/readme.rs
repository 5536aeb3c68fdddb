//! The Rust of the READMEs, letter for letter, and what it does.

use std::{error::Error, fs, path::Path};

fn of_the_project() -> Result<(), Box<dyn Error>> {
    // The block starts here.
    let study = hammerbeam::Study::read("studies/duffing.toml")?;
    let orbits = study.orbits(0.1, 1)?;
    for row in study.follow(&orbits[0], hammerbeam::Side::Up)? {
        println!("{:.4} Hz", row?.solution.frequency_hz);
    }
    // And ends here.
    Ok(())
}

fn of_the_crate() -> Result<(), Box<dyn Error>> {
    // The block starts here.
    use hammerbeam::{Side, Study};

    let study = Study::read("studies/beam-with-stop.toml")?;
    let orbits = study.orbits(31.5, 1)?;
    for row in study.follow(&orbits[0], Side::Up)?.take(100) {
        println!("{:.4} Hz", row?.solution.frequency_hz);
    }
    // And ends here.
    Ok(())
}

/// The functions above are the blocks, and run where a reader of the project's README stands.
#[test]
fn the_rust_of_the_readmes_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let source = include_str!("readme.rs").split("// The block starts here.\n").skip(1);
    let written = ["README.md", "crates/hammerbeam/README.md"].map(|file| {
        let text = fs::read_to_string(root.join(file)).unwrap();
        let blocks: Vec<&str> =
            text.split("```rust\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
        assert_eq!(blocks.len(), 1, "{file}");
        blocks[0].to_owned()
    });
    for (own, block) in source.zip(written) {
        let own = own.split("    // And ends here.").next().unwrap();
        let own: String =
            own.lines().map(|line| format!("{}\n", line.strip_prefix("    ").unwrap_or(line))).collect();
        assert_eq!(block, own);
    }
    // No other test of this binary has paths that depend on it.
    std::env::set_current_dir(&root).unwrap();
    of_the_project().unwrap();
    of_the_crate().unwrap();
}
