//! The private extension module of the Python package `hammerbeam`.
//!
//! It hands what Python gives to the crate `hammerbeam`, and what comes out back: documents as JSON text,
//! tables as records in NumPy's layout, errors by their names. The typed layer in `python/hammerbeam` makes
//! arrays and objects of them; `python/hammerbeam/_native.pyi` describes what is here.
//!
//! | file | what it does |
//! |---|---|
//! | `study.rs`, `asked.rs` | a study and what can be asked of it; what Python gives, as jobs take it |
//! | `bin/stubs.rs` | the program that writes the types of all this for Python |
//! | `matrix.rs` | matrices as files |
//! | `stored.rs` | a results folder |
//! | `orbits.rs` | periodic solutions |
//! | `records.rs` | tables as bytes |
//! | `observer.rs` | progress, Ctrl-C |
//! | `failure.rs`, `numbers.rs` | errors as exceptions; what their messages say, as values |

mod asked;
mod failure;
mod matrix;
mod numbers;
mod observer;
mod orbits;
mod records;
mod stored;
mod study;

use pyo3::prelude::*;

/// What the typed layer takes.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::{
        matrix::{version, write_matrix},
        orbits::NativeOrbits,
        stored::NativeResults,
        study::NativeStudy,
    };
}
