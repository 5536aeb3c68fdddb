//! Bounds on the particular solution (`drive.rs`) and on its derivatives: sums of the amplitudes of its
//! orders, and what secular loads can reach.

use faer::c64;

use super::{
    drive::{Drive, Order},
    majorant::Majorant,
    output::Output,
};

impl Drive {
    /// Bounds on the second and third derivative of the particular part of output `index` until `until`.
    pub fn bounds(&self, index: usize, output: &Output, until: f64) -> (f64, f64) {
        let mut bounds = (0.0, 0.0);
        for order in &self.orders {
            let w = order.order * self.circular_frequency;
            let amplitude = magnitude(order.outputs[index].0);
            bounds.0 += amplitude * w * w;
            bounds.1 += amplitude * w * w * w;
        }
        for load in &self.secular {
            let [_, _, second, third] = load.bounds(output, until);
            bounds.0 += second;
            bounds.1 += third;
        }
        bounds
    }

    /// Bound on the fourth derivative of the particular part of output `index` until `until`.
    pub fn fourth_bound(&self, index: usize, output: &Output, until: f64) -> f64 {
        let of_order = |order: &Order| {
            magnitude(order.outputs[index].0) * (order.order * self.circular_frequency).powi(4)
        };
        self.orders.iter().map(of_order).sum::<f64>() + self.secular_bound::<5>(output, until)
    }

    /// Bound on the fifth derivative of the particular part of output `index` until `until`.
    pub fn fifth_bound(&self, index: usize, output: &Output, until: f64) -> f64 {
        let of_order = |order: &Order| {
            magnitude(order.outputs[index].0) * (order.order * self.circular_frequency).powi(5)
        };
        self.orders.iter().map(of_order).sum::<f64>() + self.secular_bound::<6>(output, until)
    }

    /// Bounds on all derivatives of each part of output `index` until `until`: of the orders, then of secular
    /// loads.
    pub fn majorants(&self, index: usize, output: &Output, until: f64) -> impl Iterator<Item = Majorant> {
        let of_order = move |order: &Order| {
            let rate = order.order * self.circular_frequency;
            Majorant { speed: magnitude(order.outputs[index].0) * rate, rate, acceleration: 0.0 }
        };
        let secular = self.secular.iter().map(move |load| load.majorant(output, until));
        self.orders.iter().map(of_order).chain(secular)
    }

    /// Largest value that the part of secular loads in an output can take until `until`, for rounding
    /// margins.
    pub fn secular_magnitude(&self, output: &Output, until: f64) -> f64 {
        self.secular_bound::<1>(output, until)
    }

    /// Largest velocity that the part of secular loads in an output can take until `until`.
    pub fn secular_speed(&self, output: &Output, until: f64) -> f64 {
        self.secular_bound::<2>(output, until)
    }

    /// Bound on the derivative `N - 1` of the part of secular loads in an output until `until`.
    fn secular_bound<const N: usize>(&self, output: &Output, until: f64) -> f64 {
        self.secular.iter().map(|load| load.bounds::<N>(output, until)[N - 1]).sum()
    }

    /// Circular frequency of the highest order [rad/s].
    pub fn fastest(&self) -> f64 {
        self.orders.iter().map(|order| order.order).fold(0.0, f64::max) * self.circular_frequency
    }

    /// Largest velocity that the steady part of output `index` can take.
    pub fn speed(&self, index: usize) -> f64 {
        let of_order =
            |order: &Order| magnitude(order.outputs[index].0) * order.order * self.circular_frequency;
        self.orders.iter().map(of_order).sum()
    }

    /// Largest value that the steady part of output `index` can take, for rounding margins.
    pub fn magnitude(&self, index: usize) -> f64 {
        self.orders.iter().map(|order| magnitude(order.outputs[index].0)).sum()
    }
}

/// Magnitude of an amplitude; as far from the ends of the range of numbers as amplitudes are, no care is
/// needed.
fn magnitude(amplitude: c64) -> f64 {
    amplitude.norm_sqr().sqrt()
}
