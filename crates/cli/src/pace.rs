//! How long work still takes, and the lines that say so where no bar can be shown.
//!
//! What is left is estimated from the part that was done since this command began. That supposes that the
//! rest goes on as fast, which work does not where new branches turn up. So there are two estimates of the
//! time that the whole takes: by the part that is done now, and by that at half of the time that has passed.
//! Where they are the same to a third, one number is shown; up to a factor of four, the range between them;
//! else nothing. Nothing is shown either before a tenth is done in at least four seconds, nor where next to
//! nothing was done in the second half of the time, nor where the upper end is more than nine times what has
//! passed.

use std::{
    fmt::{self, Display, Formatter},
    time::{Duration, Instant},
};

use crate::output::notify;

/// Time between two lines without a terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(10);
/// Part of the work that this command has before it, and time, before which nothing is estimated.
const LEAST_PART: f64 = 0.1;
const LEAST_TIME: Duration = Duration::from_secs(4);
/// Ratio of two estimates of the whole time up to which they are one, and beyond which neither is shown.
const AGREE: f64 = 4.0 / 3.0;
const APART: f64 = 4.0;
/// Work of the second half of the time, in parts of that of the first, below which it has stalled.
const STALLED: f64 = 0.1;
/// Largest ratio of the time that is left to that which has passed.
const LONGEST: f64 = 9.0;
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
            Some(left) => left.to_string(),
            None => "time left not known yet".to_owned(),
        }
    }
}

/// The time that is left, from the least to the greatest estimate.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Left {
    least: Duration,
    most: Duration,
}

impl Display for Left {
    fn fmt(&self, to: &mut Formatter<'_>) -> fmt::Result {
        let [least, most] = [self.least, self.most].map(rounded);
        match (self.least, self.most) {
            (_, Duration::ZERO) => write!(to, "all done"),
            _ if least == most => write!(to, "about {most} left"),
            (Duration::ZERO, _) => write!(to, "up to {most} left"),
            _ => write!(to, "{least} to {most} left"),
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
    fn left(&mut self, elapsed: Duration, fraction: f64) -> Option<Left> {
        self.keep(elapsed, fraction);
        if fraction >= 1.0 {
            return Some(Left { least: Duration::ZERO, most: Duration::ZERO });
        }
        let gained = fraction - self.first;
        if gained < LEAST_PART * (1.0 - self.first) || elapsed < LEAST_TIME {
            return None;
        }
        let (at_half, then) = *self.samples.iter().rfind(|(at, _)| *at <= elapsed / 2)?;
        let [by_half, since] = [then - self.first, fraction - then];
        if by_half <= 0.0 || since < STALLED * by_half {
            return None;
        }
        let (passed, to_do) = (elapsed.as_secs_f64(), 1.0 - self.first);
        let whole_now = to_do * passed / gained;
        let whole_then = to_do * at_half.as_secs_f64() / by_half;
        let ratio = (whole_now / whole_then).max(whole_then / whole_now);
        let [least, most] = match ratio {
            ratio if ratio <= AGREE => [whole_now; 2],
            ratio if ratio <= APART => [whole_now.min(whole_then), whole_now.max(whole_then)],
            _ => return None,
        }
        .map(|whole| Duration::from_secs_f64((whole - passed).max(0.0)));
        (most <= elapsed.mul_f64(LONGEST)).then_some(Left { least, most })
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
        if self.is_due(Instant::now()) {
            notify(&format!("progress: {}", text()));
        }
    }

    /// Whether ten seconds have passed since the last line, which then counts as written.
    fn is_due(&mut self, now: Instant) -> bool {
        let is_due = now.duration_since(self.written) >= BETWEEN_LINES;
        if is_due {
            self.written = now;
        }
        is_due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The last of what is shown at these seconds and parts.
    fn left_after(first: f64, shown: impl IntoIterator<Item = (f64, f64)>) -> Option<Left> {
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
            let Left { least, most } = left.unwrap();
            assert_eq!(least, most);
            assert!((most.as_secs_f64() - expected).abs() < 1e-6 * expected, "{most:?}, {expected}");
        }
    }

    #[test]
    fn nothing_is_said_before_a_tenth_is_done_in_four_seconds() {
        assert_eq!(left_after(0.0, seconds(8).map(|second| (second, 0.005 * second))), None);
        assert_eq!(left_after(0.0, seconds(3).map(|second| (second, 0.2 * second))), None);
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
                    left.is_none_or(|left| left.most.as_secs_f64() <= 9.0 * second + 1e-6),
                    "{left:?} at {second}"
                );
            }
        }
    }

    #[test]
    fn nothing_is_said_while_work_stalls_or_leaps() {
        let stalled = seconds(40).map(|second| (second, if second < 20.0 { 0.01 * second } else { 0.2 }));
        assert_eq!(left_after(0.0, stalled), None);
        let leapt = seconds(40).map(|second| (second, if second < 30.0 { 0.1 } else { 0.9 }));
        assert_eq!(left_after(0.0, leapt), None);
    }

    /// Work done as the root or the square of the time: by the two estimates the whole takes 40 s or 28.3 s,
    /// and 160 s or 320 s of which 80 s have passed.
    #[test]
    fn a_range_is_shown_where_two_estimates_differ() {
        let slower = seconds(20).map(|second| (second, (second / 80.0).sqrt()));
        let left = left_after(0.0, slower).unwrap();
        assert!((left.most.as_secs_f64() - 20.0).abs() < 1e-6, "{left:?}");
        assert!((left.least.as_secs_f64() - (10.0 / 0.125_f64.sqrt() - 20.0)).abs() < 1e-6, "{left:?}");
        let faster = seconds(80).map(|second| (second, (second / 80.0).powi(2) / 2.0));
        let left = left_after(0.0, faster).unwrap();
        assert!((left.least.as_secs_f64() - 80.0).abs() < 2.0, "{left:?}");
        assert!((left.most.as_secs_f64() - 240.0).abs() < 6.0, "{left:?}");
    }

    #[test]
    fn what_is_left_reads_as_a_number_or_a_range() {
        let words = [(20, 60), (0, 60), (21, 24), (200, 500), (0, 0), (0, 4)].map(|(least, most)| {
            let [least, most] = [least, most].map(Duration::from_secs);
            Left { least, most }.to_string()
        });
        let expected = [
            "20 s to 60 s left",
            "up to 60 s left",
            "about 25 s left",
            "4 min to 9 min left",
            "all done",
            "about 5 s left",
        ];
        assert_eq!(words, expected);
    }

    #[test]
    fn a_line_is_due_every_ten_seconds() {
        let mut lines = Lines::begin();
        let begun = lines.written;
        let due: Vec<u64> =
            (0..600).filter(|tenth| lines.is_due(begun + Duration::from_millis(100 * tenth))).collect();
        assert_eq!(due, [100, 200, 300, 400, 500]);
    }

    #[test]
    fn times_are_as_coarse_as_they_are_known() {
        let words = [0, 5, 61, 99, 100, 3000, 7200].map(|seconds| rounded(Duration::from_secs(seconds)));
        assert_eq!(words, ["5 s", "5 s", "65 s", "100 s", "2 min", "50 min", "2.0 h"]);
    }
}
