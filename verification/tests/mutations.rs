//! Damaged input makes no reader panic or hang: a few hundred mutations each; `examples/mutations.rs` does
//! it for as long as one likes.

use std::path::Path;

use hammerbeam_verification::{
    attractors::Random,
    mutations::{Reader, corpus, mutated, outcome},
};

#[test]
fn no_reader_fails_on_damaged_input() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    // Results databases need a run first: the example has them.
    for reader in [Reader::Study, Reader::Signal, Reader::Points, Reader::Matrices] {
        let inputs = corpus(reader, &root).unwrap();
        assert!(!inputs.is_empty(), "{reader:?} has no corpus");
        let mut random = Random::new(11);
        for input in &inputs {
            assert!(outcome(reader, folder.path(), input).0.is_allowed());
            for round in 0..20 {
                let bytes = mutated(input, &inputs[round % inputs.len()], &mut random);
                let (outcome, _) = outcome(reader, folder.path(), &bytes);
                assert!(
                    outcome.is_allowed(),
                    "{reader:?}: {outcome:?} on {:?}",
                    String::from_utf8_lossy(&bytes)
                );
            }
        }
    }
}
