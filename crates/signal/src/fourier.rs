//! Discrete Fourier transforms of real series: `X_k = sum_n x_n exp(-2 pi i k n / N)`, `k = 0 .. N/2`.

use realfft::{RealFftPlanner, num_complex::Complex};

/// The transform, `N/2 + 1` values.
pub(crate) fn forward(series: Vec<f64>) -> Vec<Complex<f64>> {
    let mut series = series;
    let transform = RealFftPlanner::new().plan_fft_forward(series.len());
    let mut spectrum = transform.make_output_vec();
    transform.process(&mut series, &mut spectrum).expect("the lengths match the plan");
    spectrum
}

/// The series of a transform, `N` values; the imaginary parts of the first value and, for even `N`, of the
/// last one are ignored.
pub(crate) fn backward(mut spectrum: Vec<Complex<f64>>, length: usize) -> Vec<f64> {
    let transform = RealFftPlanner::new().plan_fft_inverse(length);
    spectrum[0].im = 0.0;
    if length.is_multiple_of(2) {
        spectrum[length / 2].im = 0.0;
    }
    let mut series = transform.make_output_vec();
    transform.process(&mut spectrum, &mut series).expect("the lengths match the plan");
    series.iter_mut().for_each(|value| *value /= length as f64);
    series
}
