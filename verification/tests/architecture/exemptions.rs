//! What breaks the rules today, and why it may for now.

/// The kernel is rebuilt on four nouns by an issue of its own (`motion/src/exact`).
const KERNEL: &str = "until the kernel is rebuilt";

/// The file of a law says how a law of the list is built from its keys, and the list holds every law.
const LAWS: &str = "a law is one file and one line of the list";

/// The general integrator of a system with rigid stops: one file for each jump of its state.
const GENERAL: &str = "until the kernel has its nouns, which this one is to share";

/// Files in circles of modules below a folder.
pub const CIRCLES: &[(&str, usize, &str)] =
    &[("crates/motion/src/exact", 30, KERNEL), ("crates/motion/src/law", 11, LAWS)];

/// Files with `impl` blocks of a type.
pub const DOORS: &[(&str, usize, &str)] = &[
    ("crates/motion/src/exact/mod.rs ExactIntegrator", 36, KERNEL),
    ("crates/motion/src/general/system_field.rs SystemField", 7, GENERAL),
];

/// Public types of one name.
pub const NAMES: &[(&str, usize, &str)] = &[];

/// Lines beyond column 110 below a folder.
pub const LONG_LINES: &[(&str, usize, &str)] = &[];
