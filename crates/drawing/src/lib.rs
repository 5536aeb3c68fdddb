//! Figures of a results folder, and the page that shows all of it.
//!
//! What is stored is read here and handed to the figure crate as plain rows. Orbits are computed again from
//! their stored states, as far as a figure shows their motion.
//!
//! | file | what it does |
//! |---|---|
//! | `selection.rs` | what of a folder is drawn, and in which formats |
//! | `drawn.rs` | files as they are drawn, on the threads of a pool |
//! | `linear.rs`, `structure.rs` | the structure, its modes, its reduction, its excitation |
//! | `response.rs`, `varied.rs` | branches over the frequency, over other parameters |
//! | `branches.rs` | stored branches as curves |
//! | `overlaid.rs` | branches of further folders behind them |
//! | `curves.rs`, `multipliers.rs`, `motions.rs` | curves of bifurcations, multipliers, motions |
//! | `parameter.rs` | parameters in words |
//! | [`orbit`] | one orbit over its period |
//! | `compare.rs` | measured points over branches |
//! | `page.rs`, `page/` | the page |
//!
//! # Example
//! ```no_run
//! use hammerbeam_drawing::{DrawSettings, DrawingError, FigureSelection, draw, draw_into};
//! use hammerbeam_jobs::{PreparedStudy, Quiet};
//! use hammerbeam_results::Store;
//!
//! let folder = std::path::Path::new("results");
//! let store = Store::open(folder)?;
//! let study = PreparedStudy::of_store(&store)?;
//! let selection = FigureSelection::of(&study.file);
//! let files = draw_into(folder, DrawSettings::default(), &mut Quiet, |drawn| {
//!     draw(&store, (&study.file, &study.model), &selection, drawn)
//! })?;
//! println!("{:?}", files.names);
//! # Ok::<(), DrawingError>(())
//! ```

mod branches;
mod compare;
mod curves;
mod detail;
mod drawn;
mod error;
mod linear;
mod motions;
mod multipliers;
pub mod orbit;
mod outputs;
mod overlaid;
mod page;
mod parameter;
mod response;
mod selection;
mod structure;
mod varied;

use hammerbeam_results::Store;
use hammerbeam_study::{Model, StudyFile};

pub use compare::draw_compared;
pub use detail::ensure_details;
pub use drawn::{Album, DrawSettings, Drawn, DrawnFiles, RESOLUTION, draw_into};
pub use error::DrawingError;
pub use linear::draw_linear;
pub use overlaid::ensure_alike;
pub use selection::{FigureDetail, FigureFormat, FigureKind, FigureScale, FigureSelection};

/// Draws what is selected of a results folder, or some of it when the observer says stop.
///
/// The page comes first: it takes the longest, and while its file is put together the figures are drawn.
///
/// # Errors
/// [`DrawingError`].
pub fn draw(
    store: &Store,
    (file, model): (&StudyFile, &Model),
    selection: &FigureSelection,
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
    let (page, figures): (Vec<FigureKind>, Vec<FigureKind>) = FigureKind::ALL
        .into_iter()
        .filter(|kind| selection.kinds.contains(kind))
        .partition(|kind| *kind == FigureKind::Page);
    for kind in page.into_iter().chain(figures) {
        if drawn.is_stopped() {
            break;
        }
        let result = draw_kind(store, (file, model), (kind, selection), drawn);
        drawn.unless_damaged(result, &format!("{kind:?}").to_lowercase())?;
    }
    Ok(())
}

fn draw_kind(
    store: &Store,
    (file, model): (&StudyFile, &Model),
    (kind, selection): (FigureKind, &FigureSelection),
    drawn: &mut Drawn<'_>,
) -> Result<(), DrawingError> {
    match kind {
        FigureKind::Structure => draw_linear(drawn, file, model),
        FigureKind::Response => response::draw(store, file, selection, drawn)?,
        FigureKind::Vary => varied::draw(store, file, selection, drawn)?,
        FigureKind::Curves => curves::draw(store, drawn)?,
        FigureKind::Multipliers => multipliers::draw(store, drawn)?,
        FigureKind::Orbits => {
            let asked = (selection.orbits.as_slice(), selection.low_pass_hz);
            orbit::draw_stored(store.folder(), (file, model), asked, drawn)?;
        }
        FigureKind::Sweeps => motions::draw_sweeps(store, drawn)?,
        FigureKind::Exponents => {
            motions::draw_exponents(store, drawn)?;
            motions::draw_convergence(store, drawn)?;
            motions::draw_sections(store, drawn)?;
        }
        FigureKind::Basins => motions::draw_basins(store, (file, model), drawn)?,
        FigureKind::Page => page::draw(store, file, model, drawn)?,
    }
    Ok(())
}
