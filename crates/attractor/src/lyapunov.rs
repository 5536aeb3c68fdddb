//! The whole spectrum of Lyapunov exponents of a motion. Equations (E3) to (E6) of the book, `docs/theory`.
//!
//! With the growth `g_i(k)` of the tangent directions over the sections `k` of duration `h` (`tangents.rs`)
//! the exponents are the means
//!
//! `lambda_i = 1/(N h) sum_k g_i(k)`, `lambda_1 >= lambda_2 >= ...`.
//!
//! **Their sum** is the mean of `ln |det P|/h`. The flow of `z' = g(t, z)` changes volumes at the rate `tr
//! dg/dz`, so for a structure with contacts whose force depends on the displacement alone it is `-tr(M^-1
//! C)`, whatever the motion: an invariant, which says how good the fundamental matrices are. A contact whose
//! force depends on the velocity adds the mean of `phi^T phi df/dr'`, every impact on a rigid stop `2 ln e`
//! (the determinant of its jump is `e^2`). A law that depends on the speed `v` of its impact adds the mean of
//! `phi^T df/dv . dv/dq'` as well, where `dv/dz` is how the speed of neighbours that were struck at other
//! speeds goes with their present state. Where a rigid stop sticks, the relative motion is lost: two
//! exponents are minus infinity for each stop that is held at once, and so is the sum. One is where an impact
//! without restitution does not stick. The others belong to the remaining motion.
//!
//! **Confidence.** The sections are cut into [`BLOCKS`] blocks. Where those are longer than the correlation
//! time of the motion their means are independent, and `lambda` lies within `t s/sqrt(BLOCKS)` of the mean
//! with 95 per cent, with the standard deviation `s` of the block means and Student's `t` for `BLOCKS - 1`
//! degrees of freedom. The correlation of neighbouring blocks is reported, too: beyond `2/sqrt(BLOCKS)` the
//! blocks are too short or the motion has not settled, and the half width is too small.
//!
//! **Dimension.** With the largest k for which `S_k = lambda_1 + ... + lambda_k >= 0` the dimension after
//! Kaplan and Yorke is `k + S_k/|lambda_(k+1)|`. It is the dimension of the section for a motion that is
//! driven periodically, and of the attractor itself for a field that does not depend on time.
//!
//! # Source
//! See `tangents.rs`; Kaplan and Yorke, Lecture Notes in Mathematics 730 (1979), 204-227.

use crate::{AttractorError, SectionMap, Tangents, error::ensure};

/// Number of blocks.
pub const BLOCKS: u64 = 20;
/// Student's t at 97.5 per cent for 19 degrees of freedom.
const STUDENT: f64 = 2.093;
/// Places of the convergence curve in each doubling of the time.
const PER_OCTAVE: f64 = 4.0;

/// How long exponents are averaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LyapunovSettings {
    /// Sections over which the tangent vectors turn into their directions, not averaged.
    pub aligning: u64,
    /// Sections averaged; rounded up to a multiple of [`BLOCKS`].
    pub averaged: u64,
}

/// A mean with its confidence.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    /// Mean.
    pub value: f64,
    /// Half width of the interval of 95 per cent.
    pub half_width: f64,
}

impl Estimate {
    /// The low end of the interval.
    #[must_use]
    pub fn low(&self) -> f64 {
        self.value - self.half_width
    }

    /// The high end of the interval.
    #[must_use]
    pub fn high(&self) -> f64 {
        self.value + self.half_width
    }
}

/// Exponents as they are after a time.
#[derive(Debug, Clone, PartialEq)]
pub struct Convergence {
    /// Time averaged over, in the unit of [`SectionMap::duration`].
    pub time: f64,
    /// Exponents, length n.
    pub exponents: Vec<f64>,
}

/// The spectrum of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Exponents in descending order, length n, over the unit of time.
    pub exponents: Vec<Estimate>,
    /// Their sum.
    pub sum: f64,
    /// What the sum has to be, where [`SectionMap::growth_of_volume`] gives it.
    pub expected_sum: Option<f64>,
    /// Dimension after Kaplan and Yorke.
    pub kaplan_yorke_dimension: f64,
    /// Correlation of neighbouring blocks of the largest exponent; see the module.
    pub block_correlation: f64,
    /// Exponents after ever longer times.
    pub convergence: Vec<Convergence>,
    /// Time averaged over.
    pub time: f64,
}

/// An average of exponents under way, one section at a time.
#[derive(Debug, Clone)]
pub struct Lyapunov {
    tangents: Tangents,
    settings: LyapunovSettings,
    duration: f64,
    sections: u64,
    /// Sums of the growth, of each block.
    blocks: Vec<Vec<f64>>,
    /// Growth of volumes that is expected, of each block.
    expected: Vec<Option<f64>>,
    total: Vec<f64>,
    convergence: Vec<Convergence>,
}

impl Lyapunov {
    /// Begins at a state at the start of the section of that number.
    ///
    /// # Errors
    /// [`AttractorError::Input`], [`AttractorError::StateLength`].
    pub fn new(
        map: &impl SectionMap,
        section: u64,
        state: &[f64],
        settings: LyapunovSettings,
    ) -> Result<Self, AttractorError> {
        let asked = settings.averaged;
        ensure("the number of sections averaged", asked as f64, "20 or more", asked >= BLOCKS)?;
        let averaged = asked.div_ceil(BLOCKS) * BLOCKS;
        Ok(Self {
            tangents: Tangents::new(map, section, state)?,
            settings: LyapunovSettings { averaged, ..settings },
            duration: map.duration(),
            sections: 0,
            blocks: Vec::new(),
            expected: Vec::new(),
            total: vec![0.0; map.dimension()],
            convergence: Vec::new(),
        })
    }

    /// Sections done, aligning ones included, and all.
    #[must_use]
    pub fn progress(&self) -> (u64, u64) {
        (self.sections, self.settings.aligning + self.settings.averaged)
    }

    /// The state that it has come to.
    #[must_use]
    pub fn state(&self) -> &[f64] {
        self.tangents.state()
    }

    /// Goes over one more section; false if all are done.
    ///
    /// # Errors
    /// See [`Tangents::step`].
    pub fn step(&mut self, map: &mut impl SectionMap) -> Result<bool, AttractorError> {
        let (done, all) = self.progress();
        if done == all {
            return Ok(false);
        }
        self.tangents.step(map)?;
        self.sections += 1;
        let averaged = self.sections.saturating_sub(self.settings.aligning);
        if averaged == 0 {
            return Ok(true);
        }
        let length = self.settings.averaged / BLOCKS;
        if (averaged - 1).is_multiple_of(length) {
            self.blocks.push(vec![0.0; self.total.len()]);
            self.expected.push(Some(0.0));
        }
        if let Some(expected) = self.expected.last_mut() {
            *expected = expected.zip(self.tangents.growth_of_volume()).map(|(sum, growth)| sum + growth);
        }
        let block = self.blocks.last_mut().expect("the first section of a block begins it");
        for ((total, block), growth) in self.total.iter_mut().zip(block).zip(self.tangents.growth()) {
            *total += growth;
            *block += growth;
        }
        let octave = |sections: u64| (PER_OCTAVE * (sections as f64).log2()).floor();
        if octave(averaged) > octave(averaged - 1) || averaged == self.settings.averaged {
            let time = averaged as f64 * self.duration;
            let exponents = self.total.iter().map(|total| total / time).collect();
            self.convergence.push(Convergence { time, exponents });
        }
        Ok(true)
    }

    /// The spectrum, once all sections are done; of what is done before, with the whole blocks only.
    ///
    /// # Returns
    /// `None` with fewer than two whole blocks.
    #[must_use]
    pub fn spectrum(&self) -> Option<Spectrum> {
        let length = self.settings.averaged / BLOCKS;
        let whole = (self.sections.saturating_sub(self.settings.aligning) / length) as usize;
        if whole < 2 {
            return None;
        }
        let blocks = &self.blocks[..whole];
        let time = length as f64 * self.duration;
        let mean_of = |i: usize| blocks.iter().map(|block| block[i]).sum::<f64>() / (whole as f64 * time);
        let mut exponents: Vec<Estimate> =
            (0..self.total.len()).map(|i| estimate(blocks.iter().map(|block| block[i] / time))).collect();
        let sum = (0..self.total.len()).map(mean_of).sum();
        let expected: Option<f64> = self.expected[..whole].iter().copied().sum();
        let expected_sum = expected.map(|growth| growth / (whole as f64 * time));
        let block_correlation = correlation(&blocks.iter().map(|block| block[0]).collect::<Vec<_>>());
        exponents.sort_by(|a, b| b.value.total_cmp(&a.value));
        Some(Spectrum {
            kaplan_yorke_dimension: kaplan_yorke(&exponents),
            exponents,
            sum,
            expected_sum,
            block_correlation,
            convergence: self.convergence.clone(),
            time: whole as f64 * time,
        })
    }
}

/// The spectrum of a motion from a state at the start of section 0.
///
/// # Errors
/// See [`Lyapunov::new`] and [`Lyapunov::step`].
pub fn lyapunov(
    map: &mut impl SectionMap,
    state: &[f64],
    settings: LyapunovSettings,
) -> Result<Spectrum, AttractorError> {
    let mut average = Lyapunov::new(map, 0, state, settings)?;
    while average.step(map)? {}
    Ok(average.spectrum().expect("all blocks are whole"))
}

/// Mean of some values and the half width of its interval of 95 per cent (with the t of 19 degrees of
/// freedom, however many there are).
fn estimate(values: impl Iterator<Item = f64> + Clone) -> Estimate {
    let count = values.clone().count() as f64;
    let value = values.clone().sum::<f64>() / count;
    if value == f64::NEG_INFINITY {
        return Estimate { value, half_width: 0.0 };
    }
    let variance = values.map(|x| (x - value).powi(2)).sum::<f64>() / (count - 1.0);
    Estimate { value, half_width: STUDENT * (variance / count).sqrt() }
}

/// Correlation of neighbouring values; 0 if they are all the same.
fn correlation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let variance: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    let product: f64 = values.windows(2).map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum();
    if variance > 0.0 { product / variance } else { 0.0 }
}

fn kaplan_yorke(exponents: &[Estimate]) -> f64 {
    let mut sum = 0.0;
    for (k, exponent) in exponents.iter().enumerate() {
        if sum + exponent.value < 0.0 {
            return k as f64 + sum / exponent.value.abs();
        }
        sum += exponent.value;
    }
    exponents.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dimension_of_published_exponents_is_the_published_one() {
        let of = |values: &[f64]| {
            kaplan_yorke(&values.iter().map(|&value| Estimate { value, half_width: 0.0 }).collect::<Vec<_>>())
        };
        // Lorenz' attractor: 2.0621, with its exponents.
        assert!((of(&[0.9056, 0.0, -14.5723]) - 2.0621).abs() < 5e-5);
        assert_eq!(of(&[-0.1, -0.2]), 0.0);
        assert_eq!(of(&[0.1, 0.2]), 2.0);
    }

    /// Of the values 0 and 1 in turn the mean is 1/2 and the sum of squared deviations 20/4.
    #[test]
    fn interval_of_alternating_values_is_that_of_their_deviation() {
        let values = (0..20).map(|k| f64::from(k % 2));
        let Estimate { value, half_width } = estimate(values.clone());
        assert_eq!(value, 0.5);
        assert!((half_width - 2.093 * (5.0_f64 / 19.0 / 20.0).sqrt()).abs() < 1e-15);
        assert!(correlation(&values.collect::<Vec<_>>()) < -0.9);
    }
}
