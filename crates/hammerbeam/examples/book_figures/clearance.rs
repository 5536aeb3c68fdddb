//! The certified search for the contact of that flight, by the equations (C2) and (C3) of the book alone,
//! without its convex stretches.

use hammerbeam::figure::{DataAxis, DataDiagram, DataLook, DataPanel, DataSeries, Figure};

use super::{Outcome, compared, flight::SettledMotion, style};

/// The clearance and its bounds at a time.
struct Look {
    time: f64,
    clearance: f64,
    rate: f64,
    curvature: f64,
    /// Bounds on the second and the third derivative from here on.
    bounds: [f64; 2],
    /// The step to the next look.
    step: f64,
    /// The equation that gives it.
    decides: Equation,
}

/// Which lower bound gives the longer step.
#[derive(Clone, Copy, PartialEq)]
enum Equation {
    C2,
    C3,
}

impl Look {
    fn new(motion: &SettledMotion, time: f64) -> Self {
        let [clearance, rate, curvature, _] = motion.beam.jet(&motion.free, time);
        let bounds = motion.beam.bounds(&motion.beam.carried(&motion.free, time));
        let mut look = Self { time, clearance, rate, curvature, bounds, step: 0.0, decides: Equation::C2 };
        let square = (rate + (rate * rate + 2.0 * bounds[0] * clearance).sqrt()) / bounds[0]; // (C2)
        let cubic = look.first_root();
        look.decides = if square > cubic { Equation::C2 } else { Equation::C3 };
        look.step = square.max(cubic);
        look
    }

    /// The lower bound of the clearance after a time that decides.
    fn bound(&self, after: f64) -> f64 {
        match self.decides {
            Equation::C2 => self.clearance + after * (self.rate - 0.5 * after * self.bounds[0]),
            Equation::C3 => self.cubic(after),
        }
    }

    /// The lower bound (C3).
    fn cubic(&self, after: f64) -> f64 {
        let third = self.bounds[1];
        self.clearance + after * (self.rate + after * (0.5 * self.curvature - after * third / 6.0))
    }

    /// The first positive root of that bound: it falls up to its minimum, if that is ahead, and again from
    /// its maximum on.
    fn first_root(&self) -> f64 {
        let third = self.bounds[1];
        let square = self.curvature * self.curvature + 2.0 * third * self.rate;
        let (mut low, mut high) = (0.0, f64::INFINITY);
        if square > 0.0 {
            let [minimum, maximum] = [-1.0, 1.0].map(|sign| (self.curvature + sign * square.sqrt()) / third);
            if minimum > 0.0 && self.cubic(minimum) <= 0.0 {
                high = minimum;
            } else {
                low = maximum.max(0.0);
            }
        }
        if high.is_infinite() {
            high = low + 1e-12;
            while self.cubic(high) > 0.0 {
                high = low + 2.0 * (high - low);
            }
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if self.cubic(middle) > 0.0 { low = middle } else { high = middle }
        }
        low
    }
}

/// Looks until the contact is reached.
fn search(motion: &SettledMotion) -> Vec<Look> {
    let mut looks: Vec<Look> = Vec::new();
    let mut time = 0.0;
    loop {
        let look = Look::new(motion, time);
        if look.clearance < 1e-15 {
            return looks;
        }
        time += look.step;
        let is_last = look.step < 1e-13;
        looks.push(look);
        if is_last {
            return looks;
        }
    }
}

/// Draws the search, and compares the contact that it finds with that of Hammerbeam.
pub fn draw(motion: &SettledMotion) -> Outcome<Figure> {
    let begin = motion.contact[0];
    let looks = search(motion);
    let found = looks.last().map_or(0.0, |look| look.time + look.step);
    let off = (found - begin).abs();
    compared(&format!("clearance: {} looks, contact off by {off:.1e} s", looks.len()));
    assert!(looks.len() == 9, "nine looks find the contact: {}", looks.len());
    assert!(off < 1e-13, "the contact is that of Hammerbeam: {off:e} s");

    let milli = |(time, clearance): (f64, f64)| (1e3 * time, 1e3 * clearance);
    let flight = (0..=800).map(|k| begin * f64::from(k) / 800.0);
    let clearance = flight.map(|time| milli((time, motion.beam.jet(&motion.free, time)[0].max(0.0))));
    let mut series = vec![DataSeries::new("clearance d", DataLook::Line(0), clearance)];
    for look in &looks {
        let bound = (0..=60).map(|k| look.step * f64::from(k) / 60.0);
        let bound = bound.map(|after| milli((look.time + after, look.bound(after).max(0.0))));
        let (name, line) = match look.decides {
            Equation::C2 => ("lower bound (C2)", 2),
            Equation::C3 => ("lower bound (C3)", 1),
        };
        series.push(DataSeries::new(name, DataLook::Line(line), bound));
    }
    let places = looks.iter().map(|look| milli((look.time, look.clearance)));
    series.push(DataSeries::new("look", DataLook::Dots(1), places));
    let search = DataPanel::new(
        DataAxis::linear("Time (ms)").between(0.0, 22.0),
        DataAxis::linear("Clearance (mm)").between(0.0, 7.0),
        series,
    );
    let last = looks.last().map_or(begin, |look| begin - look.time);
    compared(&format!("clearance: the last look is {last:.1e} s before the contact"));
    assert!((1e-13..1e-10).contains(&last), "the ninth look is just before the contact: {last:e} s");
    let left =
        looks.iter().zip(1..).map(|(look, number)| (f64::from(number), 1e3 * (begin - look.time).abs()));
    let left: Vec<(f64, f64)> = left.collect();
    let convergence = DataPanel::new(
        DataAxis::linear("Number of the look").between(0.5, looks.len() as f64 + 0.5),
        DataAxis::logarithmic("Time left to the contact (ms)"),
        vec![
            DataSeries::new("", DataLook::Line(0), left.clone()),
            DataSeries::new("", DataLook::Dots(1), left),
        ],
    );
    let description =
        "clearance over time with the lower bounds of nine looks; the time left to the contact".to_owned();
    Ok(DataDiagram { panels: vec![search, convergence], description }.draw(&style())?)
}
