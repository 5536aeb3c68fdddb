//! The last rows of a walk, and the error that linear interpolation to the next one makes (`density.rs`).

use hammerbeam_path::ContinuationPoint;

/// Rows before the interval that the estimate uses, the start of the interval included.
const KEPT: usize = 3;
/// Rows closer than this share of the next interval are left out of the estimate: rounding of `y` shows in
/// their chords.
const TOO_CLOSE: f64 = 1e-3;

/// A row as the estimate sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RowPlace {
    /// Arc length s [Hz].
    pub arc_length: f64,
    /// Frequency f [Hz].
    pub frequency_hz: f64,
    /// Maximum displacement y [m].
    pub displacement: f64,
}

impl RowPlace {
    pub fn new(point: &ContinuationPoint, displacement: f64) -> Self {
        Self { arc_length: point.arc_length, frequency_hz: point.parameter(), displacement }
    }
}

/// The last rows of a walk, the newest last.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct LastRows(pub Vec<RowPlace>);

impl LastRows {
    pub fn push(&mut self, place: RowPlace) {
        self.0 = self.with(place);
        let surplus = self.0.len().saturating_sub(KEPT);
        self.0.drain(..surplus);
    }

    /// Forgets all rows but the newest, where lengths are measured in another way from now on.
    pub fn keep_newest(&mut self) {
        let surplus = self.0.len().saturating_sub(1);
        self.0.drain(..surplus);
    }

    /// The rows and one more, without a row that is too close to the newest.
    fn with(&self, place: RowPlace) -> Vec<RowPlace> {
        let mut chain = self.0.clone();
        if let [.., before, last] = chain[..]
            && last.arc_length - before.arc_length < TOO_CLOSE * (place.arc_length - last.arc_length)
        {
            chain.remove(chain.len() - 2);
        }
        chain.push(place);
        chain
    }

    /// Estimated error of linear interpolation from the newest row to `end`, relative to the smaller
    /// displacement or to `least`, if that is more.
    ///
    /// * `slopes`: `df/ds` at both.
    pub fn estimate(&self, end: RowPlace, slopes: [f64; 2], least: f64) -> f64 {
        let chain = self.with(end);
        let [.., start, _] = chain[..] else { return 0.0 };
        let (h, rise) = (end.arc_length - start.arc_length, end.displacement - start.displacement);
        let size = start.displacement.min(end.displacement).max(least);
        let Some(newest) = chain.last_chunk().map(divided_difference) else { return rise.abs() / size };
        let earlier = chain[..chain.len() - 1].last_chunk().map_or(0.0, divided_difference);
        let bend = bend(start, end, slopes);
        let error = |u: f64, sag: f64| (sag * h * h * u * (1.0 - u) + rise * bend(u)).abs();
        let shares = (1..8).map(|k| f64::from(k) / 8.0);
        let smooth = shares.fold(0.0_f64, |worst, u| worst.max(error(u, newest)).max(error(u, earlier)));
        let kink = (newest - earlier).abs() * h * (end.arc_length - chain[chain.len() - 3].arc_length);
        (smooth + kink) / size
    }
}

/// `y[a, b, c]` over the arc length.
fn divided_difference(places: &[RowPlace; 3]) -> f64 {
    let chord = |a: RowPlace, b: RowPlace| (b.displacement - a.displacement) / (b.arc_length - a.arc_length);
    (chord(places[1], places[2]) - chord(places[0], places[1]))
        / (places[2].arc_length - places[0].arc_length)
}

/// `(f(u) - f_a)/(f_b - f_a) - u` of the cubic Hermite polynomial, as a function of the share u.
fn bend(start: RowPlace, end: RowPlace, slopes: [f64; 2]) -> impl Fn(f64) -> f64 {
    let h = end.arc_length - start.arc_length;
    let rise = end.frequency_hz - start.frequency_hz;
    move |u| {
        let v = 1.0 - u;
        let cubic = u * v * ((v - u) * -rise + h * (v * slopes[0] - u * slopes[1]));
        if rise == 0.0 { 1.0 } else { (cubic / rise).clamp(-1.0, 1.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Estimate of the interval from `s = 0` to `h`, after rows at `-2h` and `-h`, for `f(s)` with its slope
    /// and `y(s)`.
    fn estimate(h: f64, f: fn(f64) -> (f64, f64), y: fn(f64) -> f64) -> f64 {
        let place = |s: f64| RowPlace { arc_length: s, frequency_hz: f(s).0, displacement: y(s) };
        let mut rows = LastRows::default();
        [-2.0 * h, -h, 0.0].into_iter().for_each(|s| rows.push(place(s)));
        rows.estimate(place(h), [f(0.0).1, f(h).1], 0.0)
    }

    /// `f = s^2`, `y = 1 + s`: over the frequency a square root, which misses its chord by a quarter of the
    /// rise.
    #[test]
    fn beside_a_fold_the_error_is_a_quarter_of_the_rise() {
        let found = estimate(1e-2, |s| (s * s, 2.0 * s), |s| 1.0 + s);
        assert!((found - 0.25e-2).abs() < 1e-5, "{found}");
    }

    /// `y = 1 + s^2` over `f = s`: `h^2/4`.
    #[test]
    fn on_a_parabola_the_error_is_that_of_its_chord() {
        let found = estimate(1e-2, |s| (s, 1.0), |s| 1.0 + s * s);
        assert!((found - 0.25e-4).abs() < 1e-8, "{found}");
    }

    /// `y = 1 + max(0, s - v h)`: the error is `v (1 - v) h`.
    #[test]
    fn a_kink_is_not_underrated() {
        let h = 1e-2;
        let errors = [
            (0.1, estimate(h, |s| (s, 1.0), |s| 1.0 + (s - 1e-3).max(0.0))),
            (0.5, estimate(h, |s| (s, 1.0), |s| 1.0 + (s - 5e-3).max(0.0))),
            (0.9, estimate(h, |s| (s, 1.0), |s| 1.0 + (s - 9e-3).max(0.0))),
        ];
        for (share, found) in errors {
            let error = share * (1.0 - share) * h;
            assert!(found >= error, "{found} at {share}, true {error}");
        }
    }
}
