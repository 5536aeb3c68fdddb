//! Printed figures for the page: of all results that it does not draw itself.

use hammerbeam_figure::{Figure, FigureError, FrequencyUnit, PageFigure, PageFigures};
use hammerbeam_results::Store;
use hammerbeam_study::{Model, StudyFile};

use crate::{Album, DrawingError, Drawn, FigureSelection, curves, linear::draw_linear, motions, varied};

/// The figures of a results folder. Those that say most come first, since there is not room for any number.
pub fn figures(
    store: &Store,
    (file, model): (&StudyFile, &Model),
    drawn: &mut Drawn<'_>,
) -> Result<PageFigures, DrawingError> {
    let mut gallery = Gallery { heading: "", figures: PageFigures::default(), drawn };
    gallery.heading = "Structure and excitation";
    draw_linear(&mut gallery, file, model);
    gallery.heading = "Branches over another parameter";
    varied::draw(store, file, &FigureSelection::of(file), &mut gallery)?;
    gallery.heading = "Curves of bifurcations in two parameters";
    curves::draw(store, &mut gallery)?;
    gallery.heading = "Sweeps";
    motions::draw_sweeps(store, &mut gallery)?;
    gallery.heading = "Lyapunov exponents";
    motions::draw_exponents(store, &mut gallery)?;
    gallery.heading = "Basins of attraction";
    let basins = motions::draw_basins(store, (file, model), &mut gallery);
    gallery.drawn.unless_damaged(basins, "basins on the page")?;
    gallery.heading = "Convergence of Lyapunov exponents";
    motions::draw_convergence(store, &mut gallery)?;
    Ok(gallery.figures)
}

/// Figures under headings.
struct Gallery<'a, 'd> {
    heading: &'static str,
    figures: PageFigures,
    drawn: &'a mut Drawn<'d>,
}

impl Album for Gallery<'_, '_> {
    fn add(&mut self, name: &str, figure: Result<Figure, FigureError>) {
        match figure {
            Ok(figure) => self.figures.push(PageFigure::new(name, self.heading, &figure)),
            Err(reason) => self.figures.refuse(name, &reason.to_string()),
        }
    }

    fn frequency_unit(&self) -> FrequencyUnit {
        self.drawn.frequency_unit()
    }

    fn is_stopped(&mut self) -> bool {
        self.drawn.is_stopped()
    }
}
