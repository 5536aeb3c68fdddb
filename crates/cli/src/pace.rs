//! How long work still takes, and the lines that say so where no bar can be shown.
//!
//! What is left is estimated from the part that was done since this command began. That supposes that the
//! rest goes on as fast, which work does not where new branches turn up. So an estimate is shown only while
//! it holds: the time that the whole takes by it is the same, to a third, as by the part that was done at
//! half of the time that has passed; and when at least a tenth is done, in at least two seconds.

use std::time::{Duration, Instant};

use crate::output::notify;

/// Time between two lines without a terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(10);
/// Part of the work and time before which nothing is estimated.
const LEAST_PART: f64 = 0.1;
const LEAST_TIME: Duration = Duration::from_secs(2);
/// Ratio of two estimates of the whole time beyond which neither is shown.
const AGREE: f64 = 4.0 / 3.0;
/// Samples of the past that are kept, at most.
const KEPT: usize = 256;

/// When the work was started, and how much of it was done when.
#[derive(Debug, Clone)]
pub struct Pace {
    started: Instant,
    past: Past,
}

impl Pace {
    /// Begins with so much done by an earlier command, 0 to 1.
    pub fn from(fraction: f64) -> Self {
        Self { started: Instant::now(), past: Past::from(fraction) }
    }

    /// Time since the start.
    pub fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }

    /// What is left in words, when so much is done.
    pub fn left(&mut self, fraction: f64) -> String {
        match self.past.left(self.started.elapsed(), fraction) {
            Some(Duration::ZERO) => "all done".to_owned(),
            Some(left) => format!("about {} left", rounded(left)),
            None => "time left not known yet".to_owned(),
        }
    }
}

/// Parts of the work that were done at some times.
#[derive(Debug, Clone)]
struct Past {
    first: f64,
    /// With times that rise.
    samples: Vec<(Duration, f64)>,
}

impl Past {
    fn from(fraction: f64) -> Self {
        Self { first: fraction, samples: Vec::new() }
    }

    /// What is left by what is done now, if that is known.
    fn left(&mut self, elapsed: Duration, fraction: f64) -> Option<Duration> {
        self.keep(elapsed, fraction);
        let gained = fraction - self.first;
        if gained < LEAST_PART || elapsed < LEAST_TIME {
            return None;
        }
        let whole = |elapsed: Duration, gained: f64| elapsed.as_secs_f64() / gained;
        let (now, half) = (whole(elapsed, gained), elapsed / 2);
        let (then, done) = *self.samples.iter().rfind(|(at, _)| *at <= half)?;
        let ratio = now / whole(then, done - self.first);
        let holds = (1.0 / AGREE..=AGREE).contains(&ratio);
        (holds || fraction >= 1.0).then(|| elapsed.mul_f64((1.0 - fraction).max(0.0) / gained))
    }

    /// Keeps it if it is later than what is kept by a part of the time that has passed.
    fn keep(&mut self, elapsed: Duration, fraction: f64) {
        let apart = elapsed / (KEPT as u32 / 2);
        if self.samples.last().is_none_or(|(last, _)| elapsed > *last + apart) {
            self.samples.push((elapsed, fraction));
        }
        if self.samples.len() > KEPT {
            let mut place = 0;
            self.samples.retain(|_| {
                place += 1;
                place % 2 == 0
            });
        }
    }
}

/// A time in words, as coarsely as it is known.
fn rounded(time: Duration) -> String {
    match time.as_secs() {
        0..5 => "5 s".to_owned(),
        seconds @ 5..100 => format!("{} s", seconds.div_ceil(5) * 5),
        seconds @ 100..6000 => format!("{} min", seconds.div_ceil(60)),
        seconds => format!("{:.1} h", seconds as f64 / 3600.0),
    }
}

/// A line on standard error every ten seconds, for logs and for those who wait without a terminal.
#[derive(Debug)]
pub struct Lines {
    written: Instant,
}

impl Lines {
    /// The first one is due in ten seconds.
    pub fn begin() -> Self {
        Self { written: Instant::now() }
    }

    /// Says where the work is, if it is time.
    pub fn say(&mut self, text: impl FnOnce() -> String) {
        if self.written.elapsed() >= BETWEEN_LINES {
            self.written = Instant::now();
            notify(&format!("progress: {}", text()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The last of what is shown at these seconds and parts.
    fn left_after(first: f64, shown: impl IntoIterator<Item = (f64, f64)>) -> Option<Duration> {
        let mut past = Past::from(first);
        shown.into_iter().fold(None, |_, (second, part)| past.left(Duration::from_secs_f64(second), part))
    }

    /// Ten times a second, as long as that.
    fn seconds(count: u32) -> impl Iterator<Item = f64> {
        (1..=10 * count).map(|tenth| f64::from(tenth) / 10.0)
    }

    #[test]
    fn steady_work_ends_when_it_is_said_to() {
        for (first, count, rate) in [(0.0, 8, 0.02), (0.5, 30, 0.01), (0.0, 3000, 0.0003)] {
            let left = left_after(first, seconds(count).map(|second| (second, first + rate * second)));
            let expected = (1.0 - first) / rate - f64::from(count);
            assert!((left.unwrap().as_secs_f64() - expected).abs() < 1e-6 * expected, "{left:?}, {expected}");
        }
    }

    #[test]
    fn nothing_is_said_before_a_tenth_is_done_in_two_seconds() {
        assert_eq!(left_after(0.0, seconds(8).map(|second| (second, 0.005 * second))), None);
        assert_eq!(left_after(0.0, seconds(1).map(|second| (second, 0.5 * second))), None);
        let little_is_new = seconds(30).map(|second| (second, 0.5 + 0.001 * second));
        assert_eq!(left_after(0.5, little_is_new), None, "what an earlier command did says nothing");
    }

    /// A run of eight seconds is never said to take three minutes, whatever it does.
    #[test]
    fn what_is_left_is_at_most_nine_times_what_has_passed() {
        for power in [0.2, 0.5, 1.0, 2.0, 5.0] {
            let mut past = Past::from(0.0);
            for second in seconds(8) {
                let left = past.left(Duration::from_secs_f64(second), (second / 8.0).powf(power));
                assert!(
                    left.is_none_or(|left| left.as_secs_f64() <= 9.0 * second + 1e-6),
                    "{left:?} at {second}"
                );
            }
        }
    }

    #[test]
    fn nothing_is_said_while_work_stalls_or_leaps() {
        let stalled = seconds(40).map(|second| (second, if second < 20.0 { 0.01 * second } else { 0.2 }));
        assert_eq!(left_after(0.0, stalled), None);
        let leapt = seconds(40).map(|second| (second, if second < 30.0 { 0.1 } else { 0.6 }));
        assert_eq!(left_after(0.0, leapt), None);
    }

    #[test]
    fn times_are_as_coarse_as_they_are_known() {
        let words = [0, 5, 61, 99, 100, 3000, 7200].map(|seconds| rounded(Duration::from_secs(seconds)));
        assert_eq!(words, ["5 s", "5 s", "65 s", "100 s", "2 min", "50 min", "2.0 h"]);
    }
}
