//! What an overlay finds.

use hammerbeam_signal::waveform::Alignment;

/// The orbit that is most alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlay {
    /// Its frequency [Hz].
    pub frequency_hz: f64,
    /// Number of its branch,
    pub branch: u32,
    /// and its row there, from 1 on; `None` if it was corrected at a frequency.
    pub row: Option<usize>,
    /// How it lies over the measurement; over its mirror image, if the factor is given and negative.
    pub alignment: Alignment,
    /// Largest correlation that an orbit among those tried has with the measurement turned around.
    pub turned_correlation: f64,
    /// Factor on measured values: given, or the best one.
    pub factor: f64,
    /// Root mean square of what is left over that of the computed history: with the factor 1, or -1 where
    /// [`Overlay::factor`] is negative,
    pub residual_before: f64,
    /// and with that factor.
    pub residual_after: f64,
    /// The measured quantity behind the filter and with the lines that the record holds, as it is delayed, at
    /// the samples of the waveform,
    pub filtered: Vec<f64>,
    /// and without filter, with all its lines.
    pub unfiltered: Vec<f64>,
    /// Displacement of the point [m], and of each moving support [m], so delayed.
    pub displacement: Vec<f64>,
    /// See above.
    pub supports: Vec<Vec<f64>>,
    /// Largest value of the quantity before and behind the filter, of all samples of the orbit.
    pub largest: (f64, f64),
    /// Others that are as alike, as far as the record can show: of other branches, or farther away than
    /// neighbours on a branch.
    pub alike: Option<Alike>,
    /// Orbits that were tried,
    pub tried: usize,
    /// and others that could not be gone over.
    pub skipped: usize,
}

/// Orbits that are as alike as the most alike one.
#[derive(Debug, Clone, PartialEq)]
pub struct Alike {
    /// How many.
    pub count: usize,
    /// Their branches, rising, each once.
    pub branches: Vec<u32>,
    /// Their lowest and highest frequency [Hz].
    pub frequency_hz: (f64, f64),
}
