//! One file for each format, and how a format is found out.

mod cards;
mod extrn;
mod harwell_boeing;
pub(crate) mod mat5;
mod matrix_market;
mod output4;
pub(crate) mod output4_binary;
mod output4_text;
mod punch;
mod tables;
mod text;
mod triplets;
mod user_element;

use std::{
    fs::{self, File},
    io::{self, BufReader, Read, Seek},
    path::Path,
};

use hammerbeam_structure::RowLabel;

pub use tables::Nodes;

use crate::{
    error::{FilePlace, MatrixError, MatrixFault, PlacedFault},
    format::MatrixFormat,
    matrix::FileMatrix,
};

/// Bytes by which a format is found out.
const FIRST: usize = 4096;

/// Reads all real matrices of a file.
///
/// * `format`: found out by the content where `None`.
///
/// # Errors
/// [`MatrixError`] with the place in the file.
pub fn read_matrices(path: &Path, format: Option<MatrixFormat>) -> Result<Vec<FileMatrix>, MatrixError> {
    let read = || {
        let mut file = open(path)?;
        let first = first_bytes(&mut file)?;
        file.rewind()?;
        parse(BufReader::with_capacity(1 << 16, file), &first, format)
    };
    read().map_err(|error: PlacedFault| named(path, error))
}

/// Reads all real matrices of the bytes of a file; as [`read_matrices`].
///
/// # Errors
/// [`MatrixError`] with an empty path.
pub fn parse_matrices(bytes: &[u8], format: Option<MatrixFormat>) -> Result<Vec<FileMatrix>, MatrixError> {
    let first = &bytes[..bytes.len().min(FIRST)];
    parse(bytes, first, format).map_err(|error| named(Path::new(""), error))
}

fn parse<R: io::BufRead>(
    source: R,
    first: &[u8],
    format: Option<MatrixFormat>,
) -> Result<Vec<FileMatrix>, PlacedFault> {
    let unknown = || MatrixFault::UnknownFormat { known: MatrixFormat::names() }.at(FilePlace::Whole);
    let matrices = match format.or_else(|| MatrixFormat::of(first)).ok_or_else(unknown)? {
        MatrixFormat::MatrixMarket => matrix_market::read(source).map(|matrix| vec![matrix]),
        MatrixFormat::Triplets => triplets::read(source).map(|matrix| vec![matrix]),
        MatrixFormat::UserElement => user_element::read(source),
        MatrixFormat::Punch => punch::read(source),
        MatrixFormat::Output4 => match output4_binary::encoding(first) {
            Some(encoding) => output4_binary::read(source, encoding),
            None => output4_text::read(source),
        },
        MatrixFormat::Mat5 => mat5::read(source),
        MatrixFormat::HarwellBoeing => harwell_boeing::read(source).map(|matrix| vec![matrix]),
    }?;
    for matrix in &matrices {
        let most = 64 * (matrix.entries.len() + 1000);
        if matrix.rows.max(matrix.columns) > most {
            let (what, found) = ("the number of rows or columns", matrix.rows.max(matrix.columns) as i64);
            let allowed = format!("at most {most} with {} entries", matrix.entries.len());
            return Err(MatrixFault::OutOfRange { what, found, allowed }.at(matrix.place));
        }
    }
    Ok(matrices)
}

/// Opens a regular file: a device may have no end, and a pipe may keep a reader waiting.
fn open(path: &Path) -> io::Result<File> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file"));
    }
    File::open(path)
}

fn first_bytes(file: &mut File) -> Result<Vec<u8>, PlacedFault> {
    let mut first = Vec::with_capacity(FIRST);
    file.take(FIRST as u64).read_to_end(&mut first)?;
    Ok(first)
}

/// Reads what the rows are: `dofs.csv`, CalculiX' `.dof`, or the `EXTRN` card of Nastran's `.pch` or `.asm`.
///
/// # Errors
/// [`MatrixError`] with the place in the file.
pub fn read_labels(path: &Path) -> Result<Vec<RowLabel>, MatrixError> {
    with(path, |extension, source| match extension {
        "csv" => tables::dofs(source),
        "dof" => tables::dof_lines(source),
        _ => extrn::read(source),
    })
}

/// Reads where nodes are: `nodes.csv`, an input deck `.inp`, or Nastran bulk data.
///
/// # Errors
/// [`MatrixError`] with the place in the file.
pub fn read_nodes(path: &Path) -> Result<Nodes, MatrixError> {
    let nodes = with(path, |extension, source| match extension {
        "csv" => tables::nodes(source),
        "inp" => tables::deck_nodes(source),
        _ => tables::grid_nodes(source),
    })?;
    if nodes.is_empty() {
        return Err(named(
            path,
            MatrixFault::Truncated { what: "the search for nodes" }.at(FilePlace::Whole),
        ));
    }
    Ok(nodes)
}

/// Reads which nodes are joined by lines: `lines.csv`.
///
/// # Errors
/// [`MatrixError`] with the place in the file.
pub fn read_lines(path: &Path) -> Result<Vec<[i64; 2]>, MatrixError> {
    with(path, |_, source| tables::lines(source))
}

fn with<T>(
    path: &Path,
    read: impl FnOnce(&str, BufReader<File>) -> Result<T, PlacedFault>,
) -> Result<T, MatrixError> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let opened = open(path).map_err(PlacedFault::from);
    opened
        .and_then(|file| read(&extension.to_ascii_lowercase(), BufReader::new(file)))
        .map_err(|error| named(path, error))
}

pub(crate) fn named(path: &Path, PlacedFault { place, fault }: PlacedFault) -> MatrixError {
    MatrixError { path: path.to_owned(), place, fault }
}
