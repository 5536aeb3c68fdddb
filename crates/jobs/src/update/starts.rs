//! The best of fits from several starts.
//!
//! `chi^2` may have several minima, and which one a fit ends in hangs on its start. Besides the start of the
//! data file others are tried, at the points of Halton's sequence: each parameter within [`SPREAD`] of its
//! value either way, and within its bounds.
//!
//! # Source
//! Halton, Numer. Math. 2 (1960), 84-90.

use hammerbeam_fit::{Bounds, FitError, LeastSquaresFit, LeastSquaresSettings, fit};
use hammerbeam_study::StudyFile;

use super::{candidate::CandidateError, data::UpdateData, problem::UpdateProblem};

/// Largest relative distance of a further start from the one of the data file.
const SPREAD: f64 = 0.3;
/// Two minima are the same if their `chi^2` differ by less than this, relatively or in standard deviations,
/// and their parameters by less than this part.
const SAME: f64 = 1e-4;
const BASES: [u32; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];

/// What the starts led to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Starts {
    /// Starts that were tried, that of the data file included.
    pub tried: u32,
    /// How many of them led to the minimum that was taken.
    pub led_here: u32,
    /// Smallest `chi^2` of another minimum, if one was met.
    pub next_chi_squared: Option<f64>,
}

/// A fit with the problem at its end.
pub(super) struct Found<'a> {
    pub problem: UpdateProblem<'a>,
    pub fit: LeastSquaresFit,
    pub starts: Starts,
    /// Other minima that were met.
    pub elsewhere: Vec<LeastSquaresFit>,
}

/// Fits from the start of the data file and from `more` others; the smallest `chi^2` of those that converge
/// is taken, or the first fit if none does.
///
/// # Errors
/// What is wrong at the start of the data file; other starts are passed over.
pub(super) fn best<'a>(
    study: &'a StudyFile,
    data: &'a UpdateData,
    mut problem: UpdateProblem<'a>,
    more: u32,
    settings: &LeastSquaresSettings,
) -> Result<Found<'a>, FitError<CandidateError>> {
    let bounds = problem.bounds();
    let start: Vec<f64> = data.parameters.iter().map(|parameter| parameter.start).collect();
    let first = fit(&mut problem, &start, &bounds, settings)?;
    let mut ends: Vec<(UpdateProblem<'a>, LeastSquaresFit)> = vec![(problem, first)];
    for number in 1..=more {
        let start = further(data, &bounds, number);
        let Ok(mut problem) = UpdateProblem::new(study, data, &start) else { continue };
        if let Ok(found) = fit(&mut problem, &start, &bounds, settings) {
            ends.push((problem, found));
        }
    }
    let converged = |found: &LeastSquaresFit| found.end.converged();
    let minima = ends.iter().filter(|(_, found)| converged(found)).map(|(_, found)| found.chi_squared());
    let least = minima.reduce(f64::min).unwrap_or(f64::INFINITY);
    let lowest =
        |found: &LeastSquaresFit| converged(found) && found.chi_squared() - least <= SAME * least.max(1.0);
    // Of equals the first is taken: the one from the start that was asked for, if it led there.
    let best = ends.iter().position(|(_, found)| lowest(found)).unwrap_or(0);
    let (problem, fit) = ends.remove(best);
    let near = |other: &LeastSquaresFit| {
        let pairs = other.parameters.iter().zip(&fit.parameters).zip(&data.parameters);
        lowest(other) && pairs.into_iter().all(|((a, b), p)| (a - b).abs() <= SAME * p.typical)
    };
    let others: Vec<LeastSquaresFit> = ends.into_iter().map(|(_, found)| found).filter(converged).collect();
    let (here, elsewhere): (Vec<LeastSquaresFit>, Vec<LeastSquaresFit>) =
        others.into_iter().partition(|found| near(found));
    let starts = Starts {
        tried: more + 1,
        led_here: here.len() as u32 + u32::from(converged(&fit)),
        next_chi_squared: elsewhere.iter().map(LeastSquaresFit::chi_squared).reduce(f64::min),
    };
    Ok(Found { problem, fit, starts, elsewhere })
}

fn further(data: &UpdateData, bounds: &[Bounds], number: u32) -> Vec<f64> {
    let place = |(j, parameter): (usize, &super::FittedKey)| {
        let part = 2.0 * radical_inverse(number, BASES[j % BASES.len()]) - 1.0;
        bounds[j].clamp(parameter.start + SPREAD * part * parameter.typical)
    };
    data.parameters.iter().enumerate().map(place).collect()
}

/// The digits of a number in some base, mirrored at the point: between 0 and 1.
fn radical_inverse(number: u32, base: u32) -> f64 {
    let (mut rest, mut place, mut sum) = (number, 1.0, 0.0);
    while rest > 0 {
        place /= f64::from(base);
        sum += place * f64::from(rest % base);
        rest /= base;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sequence_of_halton_begins_as_printed() {
        let binary = [1, 2, 3, 4, 5].map(|number| radical_inverse(number, 2));
        assert_eq!(binary, [0.5, 0.25, 0.75, 0.125, 0.625]);
        assert!((radical_inverse(5, 3) - 7.0 / 9.0).abs() < 1e-15);
    }
}
