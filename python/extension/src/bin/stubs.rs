//! Prints the stubs of the extension module, from the types that pyo3 has kept in the compiled library:
//! `stubs LIBRARY`.

use std::{env, error::Error};

use pyo3_introspection::{introspect_cdylib, module_stub_files};

fn main() -> Result<(), Box<dyn Error>> {
    let library = env::args_os().nth(1).ok_or("the compiled library is missing: stubs LIBRARY")?;
    let module = introspect_cdylib(library, "_native")?;
    let files = module_stub_files(&module);
    let [text] = files.into_values().collect::<Vec<_>>().try_into().map_err(|_| "there are submodules")?;
    println!("# Made by python/test.sh from the compiled module: HAMMERBEAM_UPDATE=1 python/test.sh.");
    print!("{text}");
    Ok(())
}
