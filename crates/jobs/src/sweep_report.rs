//! What came of a sweep, as `--json` says it.

use hammerbeam_results::store::SettledMotion;
use serde::{Serialize, Serializer};

/// The motions of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepReport {
    /// `sweep`, or `starts` from many states at every frequency.
    pub kind: &'static str,
    /// Motions in the order in which they were computed.
    pub motions: Vec<SweptMotion>,
    /// The folder that keeps them, with their tables.
    pub results: Option<String>,
}

/// A settled motion of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptMotion {
    /// The motion, and where it began.
    pub motion: SettledMotion,
    /// The stored branch that it lies on, if it is periodic and branches are known.
    pub branch: Option<u32>,
}

impl Serialize for SweptMotion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Document<'a> {
            from: String,
            frequency_hz: f64,
            class: &'static str,
            period: Option<usize>,
            doubt: Option<&'static str>,
            max_abs_displacement_m: f64,
            contacts_per_period: f64,
            largest_exponent_per_s: Option<f64>,
            half_width_per_s: Option<f64>,
            zero_one_k: Option<f64>,
            branch: Option<u32>,
            sampled_displacements_m: &'a [f64],
        }
        let SettledMotion { origin, point } = &self.motion;
        let document = Document {
            from: origin.to_string(),
            frequency_hz: point.frequency_hz,
            class: point.class.name(),
            period: point.class.period(),
            doubt: point.class.doubt(),
            max_abs_displacement_m: point.max_abs_displacement,
            contacts_per_period: point.contacts_per_period,
            largest_exponent_per_s: point.largest_exponent.map(|exponent| exponent.value),
            half_width_per_s: point.largest_exponent.map(|exponent| exponent.half_width),
            zero_one_k: point.zero_one,
            branch: self.branch,
            sampled_displacements_m: &point.samples,
        };
        document.serialize(serializer)
    }
}
