//! No crate that computes reads a clock: results depend on work, not on the time that it takes.

use super::{files_below, read, tokens::tokens};

/// Crates that compute.
const COMPUTE: [&str; 9] =
    ["structure", "matrices", "motion", "path", "orbit", "attractor", "signal", "fit", "study"];

#[test]
fn no_crate_that_computes_reads_a_clock() {
    let mut readers = Vec::new();
    for name in COMPUTE {
        for file in files_below(&format!("crates/{name}/src"), ".rs") {
            let found = tokens(&read(&file));
            let reads = found.windows(3).any(|next| next[0].is("Instant") && next[2].is("now"));
            if reads || found.iter().any(|token| token.is("SystemTime")) {
                readers.push(file);
            }
        }
    }
    assert_eq!(readers, Vec::<String>::new());
}
