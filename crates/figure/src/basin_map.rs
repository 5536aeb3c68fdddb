//! Basins of attraction: a plane of initial states, each cell in the colour of the attractor that it leads
//! to.

use std::collections::BTreeSet;

use crate::{
    chart::{Chart, ChartPanel, Measure},
    dots::{Dot, Shape},
    error::FigureError,
    figure::Figure,
    layer::Layer,
    legend::{LegendEntry, LegendSample},
    motion::MotionKind,
    style::{IMPOSSIBLE, INK, NOT_COMPUTED, PAPER, Style, fill},
};

/// A plane of initial states.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BasinMap {
    /// Title above the figure; may be empty.
    pub title: String,
    /// Label of the horizontal axis, with its unit in brackets.
    pub x_label: String,
    /// Label of the vertical axis, with its unit in brackets.
    pub y_label: String,
    /// Ends of the horizontal axis, at the outer edges of the cells.
    pub x_range: (f64, f64),
    /// Ends of the vertical axis.
    pub y_range: (f64, f64),
    /// Cells in a row, and rows.
    pub cells_along: usize,
    /// Attractor of each cell, counted from 1, row by row from the lower left corner; 0 where it is not
    /// known. Cells that are still missing are left white.
    pub cells: Vec<u32>,
    /// Whether each of these cells lies behind a rigid stop, where no motion can start; may be shorter.
    pub behind_stop: Vec<bool>,
    /// The attractors.
    pub attractors: Vec<BasinAttractor>,
}

/// An attractor of a map.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BasinAttractor {
    /// Kind of its motion.
    pub kind: MotionKind,
    /// Number of the branch that holds it, where that is known.
    pub branch: Option<u32>,
    /// Its points in the plane, if it lies in the plane.
    pub places: Vec<(f64, f64)>,
}

impl BasinMap {
    /// The figure, in a style.
    ///
    /// # Errors
    /// [`FigureError::Empty`] where there is no cell, or the axes have no length.
    pub fn draw(&self, style: &Style) -> Result<Figure, FigureError> {
        let ranges = [self.x_range, self.y_range];
        let has_length = ranges.iter().all(|(from, to)| from.is_finite() && to.is_finite() && from < to);
        if self.cells.is_empty() || self.cells_along == 0 || !has_length {
            let points = self.cells.len();
            return Err(FigureError::Empty { quantity: "cell", curves: self.attractors.len(), points });
        }
        let mut layers: Vec<Layer> = self.outcomes().map(|outcome| self.layer(outcome)).collect();
        for attractor in &self.attractors {
            let points = attractor.places.clone();
            for (full, colour, radius) in [(true, PAPER, 2.2), (true, INK, 1.4)] {
                let dot = Dot { shape: Shape::Circle, colour, full, radius };
                layers.push(Layer::Dots { points: points.clone(), dot });
            }
        }
        let panel = ChartPanel {
            quantity: "cell",
            y: Measure::new(&self.y_label).between(self.y_range),
            layers,
            heading: String::new(),
        };
        let x = Measure::new(&self.x_label).between(self.x_range);
        let legend = vec![self.outcomes().map(|outcome| self.entry(outcome)).collect(), self.note()];
        let (title, description) = (self.title.clone(), self.description());
        Chart { title, x, panels: vec![panel], legend, description, aspect: Some(0.9) }.draw(style)
    }

    /// Outcome of the motion from each cell.
    fn outcome_of_each_cell(&self) -> impl Iterator<Item = CellOutcome> + '_ {
        self.cells.iter().enumerate().map(|(cell, number)| match number {
            0 if self.behind_stop.get(cell) == Some(&true) => CellOutcome::BehindStop,
            0 => CellOutcome::NotComputed,
            number => CellOutcome::Attractor(*number),
        })
    }

    /// All outcomes, once each.
    fn outcomes(&self) -> impl Iterator<Item = CellOutcome> + use<> {
        self.outcome_of_each_cell().collect::<BTreeSet<CellOutcome>>().into_iter()
    }

    /// The cells of an outcome, with neighbours in a row joined.
    fn layer(&self, outcome: CellOutcome) -> Layer {
        let outcomes: Vec<CellOutcome> = self.outcome_of_each_cell().collect();
        let step = |(from, to): (f64, f64)| (to - from) / self.cells_along as f64;
        let (width, height) = (step(self.x_range), step(self.y_range));
        let mut cells = Vec::new();
        for (row, line) in outcomes.chunks(self.cells_along).enumerate() {
            let bottom = self.y_range.0 + row as f64 * height;
            let mut column = 0;
            for run in line.chunk_by(|a, b| a == b) {
                let left = self.x_range.0 + column as f64 * width;
                column += run.len();
                if run[0] == outcome {
                    cells.push([left, self.x_range.0 + column as f64 * width, bottom, bottom + height]);
                }
            }
        }
        Layer::Cells { cells, colour: outcome.colour() }
    }

    fn share(&self, outcome: CellOutcome) -> f64 {
        self.outcome_of_each_cell().filter(|found| *found == outcome).count() as f64 / self.cells.len() as f64
    }

    fn name(&self, outcome: CellOutcome) -> String {
        let percent = format!("{:.1}\u{2009}%", 100.0 * self.share(outcome));
        let number = match outcome {
            CellOutcome::BehindStop => return format!("starts behind a rigid stop, {percent}"),
            CellOutcome::NotComputed => return format!("not computed, {percent}"),
            CellOutcome::Attractor(number) => number,
        };
        match self.attractors.get(number as usize - 1) {
            None => format!("attractor {number}, {percent}"),
            Some(BasinAttractor { kind, branch, .. }) => {
                let branch = branch.map_or_else(String::new, |branch| format!(", branch {branch}"));
                format!("{number}: {}{branch}, {percent}", kind.words())
            }
        }
    }

    fn entry(&self, outcome: CellOutcome) -> LegendEntry {
        LegendEntry { sample: LegendSample::Cell(outcome.colour()), name: self.name(outcome) }
    }

    fn note(&self) -> Vec<LegendEntry> {
        let has_places = self.attractors.iter().any(|attractor| !attractor.places.is_empty());
        let dot = Dot { shape: Shape::Circle, colour: INK, full: true, radius: 1.4 };
        let entry = LegendEntry { sample: LegendSample::Dot(dot), name: "attractor at phase 0".to_owned() };
        has_places.then_some(entry).into_iter().collect()
    }

    fn description(&self) -> String {
        let names: Vec<String> = self.outcomes().map(|outcome| self.name(outcome)).collect();
        let wanted = self.cells_along * self.cells_along;
        let missing = wanted.saturating_sub(self.cells.len());
        let missing =
            if missing == 0 { String::new() } else { format!("; {missing} cells are not done yet") };
        format!(
            "basins of attraction over {} and {}: {}{missing}",
            self.x_label,
            self.y_label,
            names.join("; ")
        )
    }
}

/// Outcome of the motion from a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum CellOutcome {
    /// No motion: the structure cannot have this state.
    BehindStop,
    NotComputed,
    /// The motion approaches the attractor of this number, counted from 1.
    Attractor(u32),
}

impl CellOutcome {
    fn colour(self) -> &'static str {
        match self {
            Self::BehindStop => IMPOSSIBLE,
            Self::NotComputed => NOT_COMPUTED,
            Self::Attractor(number) => fill(number as usize - 1),
        }
    }
}
