//! Choice of the delay.

/// Smaller of the first minimum of the average mutual information and the first lag with an autocorrelation
/// below `1 - 1/e`; at least 1.
pub(super) fn choose(series: &[f64]) -> usize {
    let longest = series.len() / 10;
    let by_correlation = (1..longest).find(|&lag| autocorrelation(series, lag) < 1.0 - (-1.0_f64).exp());
    let until = by_correlation.unwrap_or(longest).max(1);
    // Lags beyond the other one do not matter.
    let bins = Bins::new(series);
    let mut before = bins.information(1);
    for lag in 2..=until {
        let now = bins.information(lag);
        if now > before {
            return lag - 1;
        }
        before = now;
    }
    until
}

fn autocorrelation(series: &[f64], lag: usize) -> f64 {
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    let product = |lag: usize| {
        let pairs = series.iter().zip(&series[lag..]);
        pairs.map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>() / (series.len() - lag) as f64
    };
    product(lag) / product(0)
}

/// Bins of equally many values, by rank.
struct Bins {
    /// Bin of each value.
    of: Vec<usize>,
    count: usize,
}

impl Bins {
    fn new(series: &[f64]) -> Self {
        // 8 to 32 bins, with about five pairs in each pair of bins.
        let count = ((series.len() as f64 / 5.0).sqrt() as usize).clamp(8, 32);
        let mut order: Vec<usize> = (0..series.len()).collect();
        order.sort_by(|&a, &b| series[a].total_cmp(&series[b]));
        let mut of = vec![0; series.len()];
        for (rank, &index) in order.iter().enumerate() {
            of[index] = rank * count / series.len();
        }
        Self { of, count }
    }

    /// Average mutual information of values a lag apart [nats].
    fn information(&self, lag: usize) -> f64 {
        let n = self.count;
        let (mut joint, mut first, mut second) = (vec![0.0; n * n], vec![0.0; n], vec![0.0; n]);
        let total = (self.of.len() - lag) as f64;
        for (&a, &b) in self.of.iter().zip(&self.of[lag..]) {
            joint[a * n + b] += 1.0 / total;
            first[a] += 1.0 / total;
            second[b] += 1.0 / total;
        }
        let term = |(at, p): (usize, &f64)| {
            if *p > 0.0 { p * (p / (first[at / n] * second[at % n])).ln() } else { 0.0 }
        };
        joint.iter().enumerate().map(term).sum()
    }
}
