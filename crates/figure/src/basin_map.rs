//! Basins of attraction: a plane of initial states, each cell in the colour of the attractor that it leads
//! to.

use std::collections::BTreeSet;

use crate::{
    Figure, FigureError, MotionKind, Style,
    chart::{Chart, Measure, Panel},
    dots::{Dot, Shape},
    layer::Layer,
    legend::{Entry, Sample},
    style::{IMPOSSIBLE, INK, NOT_COMPUTED, PAPER, fill},
};

/// A plane of initial states.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BasinMap {
    /// Title above the figure; empty for none.
    pub title: String,
    /// What the horizontal axis shows, with its unit in brackets.
    pub x_label: String,
    /// What the vertical axis shows, with its unit in brackets.
    pub y_label: String,
    /// Ends of the horizontal axis, those of the first and the last cell.
    pub x_range: (f64, f64),
    /// Ends of the vertical axis.
    pub y_range: (f64, f64),
    /// Cells in a row, and rows.
    pub cells_along: usize,
    /// Attractor of each cell, counted from 1, row by row from the lower left corner; 0 where it is not
    /// known. Cells that are still missing are left white.
    pub cells: Vec<u32>,
    /// Whether each of these cells begins behind a rigid stop, where no motion can begin; may be shorter.
    pub behind_stop: Vec<bool>,
    /// The attractors.
    pub attractors: Vec<Destination>,
}

/// An attractor of a map.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Destination {
    /// What it is.
    pub kind: MotionKind,
    /// Number of the branch that holds it, where that is known.
    pub branch: Option<u32>,
    /// Its places in the plane, where it lies in it.
    pub places: Vec<(f64, f64)>,
}

impl BasinMap {
    /// The figure, in that style.
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
        let mut layers: Vec<Layer> = self.fates().map(|fate| self.layer(fate)).collect();
        for destination in &self.attractors {
            let points = destination.places.clone();
            for (full, colour, radius) in [(true, PAPER, 2.2), (true, INK, 1.4)] {
                let dot = Dot { shape: Shape::Circle, colour, full, radius };
                layers.push(Layer::Dots { points: points.clone(), dot });
            }
        }
        let panel = Panel {
            quantity: "cell",
            y: Measure::new(&self.y_label).between(self.y_range),
            layers,
            heading: String::new(),
        };
        let x = Measure::new(&self.x_label).between(self.x_range);
        let legend = vec![self.fates().map(|fate| self.entry(fate)).collect(), self.note()];
        let (title, description) = (self.title.clone(), self.description());
        Chart { title, x, panels: vec![panel], legend, description, aspect: Some(0.9) }.draw(style)
    }

    /// What becomes of the motion from each cell.
    fn each_fate(&self) -> impl Iterator<Item = Fate> + '_ {
        self.cells.iter().enumerate().map(|(cell, number)| match number {
            0 if self.behind_stop.get(cell) == Some(&true) => Fate::BehindStop,
            0 => Fate::NotComputed,
            number => Fate::Attractor(*number),
        })
    }

    /// All of those, once each.
    fn fates(&self) -> impl Iterator<Item = Fate> + use<> {
        self.each_fate().collect::<BTreeSet<Fate>>().into_iter()
    }

    /// The cells of a fate, neighbours in a row joined.
    fn layer(&self, fate: Fate) -> Layer {
        let fates: Vec<Fate> = self.each_fate().collect();
        let step = |(from, to): (f64, f64)| (to - from) / self.cells_along as f64;
        let (width, height) = (step(self.x_range), step(self.y_range));
        let mut cells = Vec::new();
        for (row, line) in fates.chunks(self.cells_along).enumerate() {
            let bottom = self.y_range.0 + row as f64 * height;
            let mut column = 0;
            for run in line.chunk_by(|a, b| a == b) {
                let left = self.x_range.0 + column as f64 * width;
                column += run.len();
                if run[0] == fate {
                    cells.push([left, self.x_range.0 + column as f64 * width, bottom, bottom + height]);
                }
            }
        }
        Layer::Cells { cells, colour: fate.colour() }
    }

    fn share(&self, fate: Fate) -> f64 {
        self.each_fate().filter(|found| *found == fate).count() as f64 / self.cells.len() as f64
    }

    fn name(&self, fate: Fate) -> String {
        let percent = format!("{:.1}\u{2009}%", 100.0 * self.share(fate));
        let number = match fate {
            Fate::BehindStop => return format!("begins behind a rigid stop, {percent}"),
            Fate::NotComputed => return format!("not computed, {percent}"),
            Fate::Attractor(number) => number,
        };
        match self.attractors.get(number as usize - 1) {
            None => format!("attractor {number}, {percent}"),
            Some(Destination { kind, branch, .. }) => {
                let branch = branch.map_or_else(String::new, |branch| format!(", branch {branch}"));
                format!("{number}: {}{branch}, {percent}", kind.words())
            }
        }
    }

    fn entry(&self, fate: Fate) -> Entry {
        Entry { sample: Sample::Cell(fate.colour()), name: self.name(fate) }
    }

    fn note(&self) -> Vec<Entry> {
        let has_places = self.attractors.iter().any(|destination| !destination.places.is_empty());
        let dot = Dot { shape: Shape::Circle, colour: INK, full: true, radius: 1.4 };
        let entry = Entry { sample: Sample::Dot(dot), name: "attractor at phase 0".to_owned() };
        has_places.then_some(entry).into_iter().collect()
    }

    fn description(&self) -> String {
        let names: Vec<String> = self.fates().map(|fate| self.name(fate)).collect();
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

/// What becomes of a motion from a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    /// There is none: no state of the structure is there.
    BehindStop,
    NotComputed,
    /// It leads to the attractor of that number, counted from 1.
    Attractor(u32),
}

impl Fate {
    fn colour(self) -> &'static str {
        match self {
            Self::BehindStop => IMPOSSIBLE,
            Self::NotComputed => NOT_COMPUTED,
            Self::Attractor(number) => fill(number as usize - 1),
        }
    }
}
