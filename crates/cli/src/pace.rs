//! How long work still takes, and the lines that say so where no bar can be shown.
//!
//! What is left is estimated from the part that was done since this command began, and only when that says
//! something: at least a tenth, and two seconds. So an estimate is never more than nine times what has
//! passed.

use std::time::{Duration, Instant};

/// Time between two lines without a terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(10);
/// Part of the work and time before which nothing is estimated.
const LEAST_PART: f64 = 0.1;
const LEAST_TIME: Duration = Duration::from_secs(2);

/// When the work was begun, and how much of it was done then by an earlier command.
#[derive(Debug, Clone, Copy)]
pub struct Pace {
    begun: Instant,
    first: f64,
}

impl Pace {
    /// Begins with so much done, 0 to 1.
    pub fn from(fraction: f64) -> Self {
        Self { begun: Instant::now(), first: fraction }
    }

    /// Time since the beginning.
    pub fn elapsed(&self) -> Duration {
        self.begun.elapsed()
    }

    /// What is left in words, when so much is done.
    pub fn left(&self, fraction: f64) -> String {
        match left(self.elapsed(), self.first, fraction) {
            Some(Duration::ZERO) => "all done".to_owned(),
            Some(left) => format!("about {} left", rounded(left)),
            None => "time left not known yet".to_owned(),
        }
    }
}

fn left(elapsed: Duration, first: f64, fraction: f64) -> Option<Duration> {
    let gained = fraction - first;
    let known = gained >= LEAST_PART && elapsed >= LEAST_TIME;
    known.then(|| elapsed.mul_f64((1.0 - fraction).max(0.0) / gained))
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
    told: Instant,
}

impl Lines {
    /// The first one is due in ten seconds.
    pub fn begin() -> Self {
        Self { told: Instant::now() }
    }

    /// Says where the work is, if it is time.
    pub fn say(&mut self, text: impl FnOnce() -> String) {
        if self.told.elapsed() >= BETWEEN_LINES {
            self.told = Instant::now();
            anstream::eprintln!("progress: {}", text());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_estimate_is_at_most_nine_times_what_has_passed() {
        let seconds = Duration::from_secs;
        assert_eq!(left(seconds(8), 0.0, 0.04), None);
        assert_eq!(left(seconds(1), 0.0, 0.5), None);
        assert_eq!(left(seconds(30), 0.5, 0.55), None, "what an earlier command did says nothing");
        assert_eq!(left(seconds(30), 0.5, 0.75), Some(seconds(30)));
        let longest = left(seconds(3), 0.0, 0.1).unwrap();
        assert!((longest.as_secs_f64() - 27.0).abs() < 1e-6, "{longest:?}");
    }

    #[test]
    fn times_are_as_coarse_as_they_are_known() {
        let words = [0, 5, 61, 99, 100, 3000, 7200].map(|seconds| rounded(Duration::from_secs(seconds)));
        assert_eq!(words, ["5 s", "5 s", "65 s", "100 s", "2 min", "50 min", "2.0 h"]);
    }
}
