//! The Rust of the README, letter for letter, and what it does.

use std::{error::Error, fs, path::Path};

fn block() -> Result<(), Box<dyn Error>> {
    // The block starts here.
    let study = hammerbeam::Study::read("studies/duffing.toml")?;
    let orbits = study.orbits(0.1, 1)?;
    for row in study.follow(&orbits[0], hammerbeam::Side::Up)? {
        println!("{:.4} Hz", row?.solution.frequency_hz);
    }
    // And ends here.
    Ok(())
}

/// The function above is the block, and runs where the README's reader stands.
#[test]
fn the_rust_of_the_readme_runs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let readme = fs::read_to_string(root.join("README.md")).unwrap();
    let blocks: Vec<&str> =
        readme.split("```rust\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
    let source = include_str!("readme.rs");
    let own = source.split("// The block starts here.\n").nth(1).unwrap();
    let own = own.split("    // And ends here.").next().unwrap();
    let own: String = own.lines().map(|line| format!("{}\n", line.strip_prefix("    ").unwrap())).collect();
    assert_eq!(blocks, [own.as_str()]);
    // No other test of this binary has paths that depend on it.
    std::env::set_current_dir(&root).unwrap();
    block().unwrap();
}
