//! What has to be known of a waveform that is laid over an orbit.

use hammerbeam_signal::{
    classify::{Classification, MotionClass},
    waveform::Waveform,
};

use super::found::Overlay;
use crate::counted;

/// Correlation below which nothing is laid over: a hundredth of the measured power, its square, is that of
/// the most alike orbit, which any two waveforms share by chance or rounding where one of them is delayed
/// freely.
const NOTHING: f64 = 0.1;
/// Correlation below which less than half of the measured power is that of the orbit (its square).
const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Correlation of a history turned around beyond which it is reported: half of what is left without.
const TURNED: f64 = 0.5;
/// Difference of correlations that is none: values between samples of a record are known to some 1e-5, and it
/// is the square that counts.
const ROUNDING: f64 = 1e-9;
/// Scatter of pieces that shows in a tenth of a per cent.
const SHOWS: f64 = 5e-4;

/// Something that the reader of an overlay has to know, and what can be done.
#[derive(Debug, Clone, PartialEq)]
pub struct OverlayNote {
    /// In words.
    pub text: String,
    /// What can be done.
    pub advice: Option<OverlayAdvice>,
}

/// What can be done where an overlay is doubtful.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OverlayAdvice {
    /// Give a negative factor on measured values.
    NegativeFactor,
    /// Give the frequency, the branch or the factor on measured values.
    GiveMore,
}

/// A waveform over an orbit, and what the record was taken for.
#[derive(Debug, Clone, Copy)]
pub struct LaidWaveform<'a> {
    /// What it was laid over.
    pub overlay: &'a Overlay,
    /// The waveform.
    pub measured: &'a Waveform,
    /// What its record was taken for.
    pub classification: &'a Classification,
    /// Its period, in excitation periods.
    pub period_multiple: u32,
}

/// That no orbit is alike enough to be laid over, in words.
#[must_use]
pub fn nothing_alike(overlay: &Overlay) -> Option<String> {
    let (correlation, tried) = (overlay.alignment.correlation, overlay.tried);
    // A correlation that is no number is none either.
    let alike = correlation >= NOTHING;
    (!alike).then(|| {
        format!(
            "nothing is alike: the largest correlation of {} with the record is \
            {correlation:.4}, less than {NOTHING}, so that neither shift nor factor mean anything",
            counted(tried as u64, "orbit")
        )
    })
}

impl LaidWaveform<'_> {
    /// What the reader has to know.
    #[must_use]
    pub fn notes(&self) -> Vec<OverlayNote> {
        let advised = [
            (self.turned(), Some(OverlayAdvice::NegativeFactor)),
            (self.little(), None),
            (self.others(), Some(OverlayAdvice::GiveMore)),
        ];
        let plain = [self.motion(), self.skipped(), self.scattered(), self.level()];
        let all = advised.into_iter().chain(plain.map(|text| (text, None)));
        all.filter_map(|(text, advice)| Some(OverlayNote { text: text?, advice })).collect()
    }

    /// That the sensor seems to be turned around.
    fn turned(&self) -> Option<String> {
        let correlation = self.overlay.turned_correlation;
        let [turned, as_it_is] = [correlation, self.overlay.alignment.correlation].map(|r| 1.0 - r);
        (turned < TURNED * as_it_is && as_it_is - turned > ROUNDING).then(|| {
            format!(
                "turned around the measured signal would be more alike, with a correlation of \
                {correlation:.4}: is the sensor's sign right?"
            )
        })
    }

    /// That no orbit is alike.
    fn little(&self) -> Option<String> {
        let correlation = self.overlay.alignment.correlation;
        (correlation < HALF).then(|| {
            format!(
                "no orbit is alike: {:.0} % of the measured power is that of the most alike one, less than \
                half; shift and factor mean little",
                100.0 * correlation.max(0.0).powi(2)
            )
        })
    }

    /// That others are as alike.
    fn others(&self) -> Option<String> {
        let alike = self.overlay.alike.as_ref()?;
        let branches: Vec<String> = alike.branches.iter().map(u32::to_string).collect();
        let (low, high) = alike.frequency_hz;
        Some(format!(
            "{} between {low:.4} and {high:.4} Hz, of branch {}, are as alike as the scatter \
            of the record can show: which of them it is remains open",
            counted(alike.count as u64, "other orbit"),
            branches.join(", ")
        ))
    }

    /// That the record is something else than an orbit of this period.
    fn motion(&self) -> Option<String> {
        let period = self.period_multiple;
        let found = match self.classification.motion {
            MotionClass::Periodic { period_multiple } if period_multiple as u32 == period => return None,
            MotionClass::Periodic { period_multiple } => {
                format!("of {}", counted(period_multiple as u64, "excitation period"))
            }
            MotionClass::Aperiodic => "aperiodic".to_owned(),
            MotionClass::Doubtful { reason } => format!("doubtful: {reason}"),
        };
        Some(format!(
            "the measured motion is {found}; its mean over {} is compared",
            counted(period.into(), "period")
        ))
    }

    fn skipped(&self) -> Option<String> {
        let skipped = self.overlay.skipped;
        (skipped > 0)
            .then(|| format!("{} could not be gone over, left out", counted(skipped as u64, "more orbit")))
    }

    /// That the record differs more from itself than from the orbit.
    fn scattered(&self) -> Option<String> {
        let scatter = self.measured.scatter / self.overlay.alignment.sizes.0;
        (scatter > self.overlay.residual_after && scatter >= SHOWS).then(|| {
            format!(
                "pieces of the record differ from their mean by {:.1} % of it, more than the mean from the \
                orbit",
                100.0 * scatter
            )
        })
    }

    /// That the level of the record is no small one.
    fn level(&self) -> Option<String> {
        let samples = &self.measured.samples;
        let mean = samples.iter().sum::<f64>() / samples.len() as f64;
        (mean.abs() > self.overlay.alignment.sizes.0)
            .then(|| format!("the signals are compared about their means; that of the record is {mean:.4e}"))
    }
}
