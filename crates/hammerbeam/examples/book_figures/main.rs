//! Draws the figures of the book, and checks its formulas on the way: each figure compares what Hammerbeam
//! computes with the equations of its page.
//!
//! ```sh
//! cargo run --release -p hammerbeam --example book_figures
//! ```
//!
//! Each module is one figure, or what two of them share. The figures go to the folder `images` beside their
//! pages in `docs`.

#![allow(clippy::print_stdout, missing_docs, reason = "an example shows what it finds")]

mod beam;
mod bounces;
mod clearance;
mod collocation;
mod exponents;
mod flight;
mod gauss;
mod grazing;
mod laws;
mod orientation;
mod shooting;

use std::{error::Error, fs, path::Path};

use hammerbeam::figure::{Figure, Style};

/// What a figure needs may fail.
pub type Outcome<T> = Result<T, Box<dyn Error>>;

/// Prints a difference that was found.
fn compared(line: &str) {
    println!("{line}");
}

/// The style of all figures: two columns wide, of little height.
fn style() -> Style {
    let mut style = Style::double_column();
    style.height_mm = 72.0;
    style
}

/// All figures, by their file in `docs`.
pub fn figures() -> Outcome<Vec<(&'static str, Figure)>> {
    let motion = flight::SettledMotion::new()?;
    let [convergence, section] = exponents::draw(20_000)?;
    Ok(vec![
        ("theory/images/flight.svg", flight::draw(&motion)?),
        ("theory/images/clearance.svg", clearance::draw(&motion)?),
        ("theory/images/collocation.svg", collocation::draw(&motion)?),
        ("theory/images/shooting.svg", shooting::draw()?),
        ("theory/images/orientation.svg", orientation::draw()?),
        ("theory/images/grazing.svg", grazing::draw()?),
        ("theory/images/exponents-convergence.svg", convergence),
        ("theory/images/exponents-section.svg", section),
        ("reference/images/contact-laws-elastic.svg", laws::draw()?),
        ("reference/images/contact-laws-loops.svg", bounces::draw_loops()?),
        ("reference/images/contact-laws-restitution.svg", bounces::draw_restitution()?),
    ])
}

pub fn main() -> Outcome<()> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    for (file, figure) in figures()? {
        fs::write(docs.join(file), figure.svg())?;
        println!("{file}");
    }
    Ok(())
}
