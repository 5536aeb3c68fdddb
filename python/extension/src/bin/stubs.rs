//! Writes the stubs of the extension module, from the types that pyo3 has kept in the compiled library:
//! `stubs LIBRARY STUBS`.

use std::{env, error::Error, fs};

use pyo3_introspection::{introspect_cdylib, module_stub_files};

const HEAD: &str = "# Made by python/test.sh from the compiled module: HAMMERBEAM_UPDATE=1 python/test.sh.\n";

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths = env::args_os().skip(1);
    let (Some(library), Some(stubs)) = (paths.next(), paths.next()) else {
        return Err("a path is missing: stubs LIBRARY STUBS".into());
    };
    let module = introspect_cdylib(library, "_native")?;
    let files = module_stub_files(&module);
    let [text] = files.into_values().collect::<Vec<_>>().try_into().map_err(|_| "there are submodules")?;
    fs::write(stubs, [HEAD, &text].concat())?;
    Ok(())
}
