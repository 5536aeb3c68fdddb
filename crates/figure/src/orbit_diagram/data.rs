//! The data of an orbit, and its description in words.

use crate::{
    chart::{Chart, ChartPanel, Measure},
    frequency_unit::FrequencyUnit,
    legend::LegendEntry,
    text::plain_number,
};

/// Number of impulses up to which each is described.
const FEW: usize = 4;
/// An orbit in samples at equal steps over its period, both ends of which are the same instant and are given
/// once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitDiagram {
    /// Title above the figures; may be empty.
    pub title: String,
    /// Excitation frequency (Hz).
    pub frequency_hz: f64,
    /// Orbit period over excitation period, from 1.
    pub period_multiple: u32,
    /// The samples.
    pub samples: Vec<OrbitSample>,
    /// Impacts on rigid stops, in their order in time.
    pub impulses: Vec<OrbitImpulse>,
    /// The acceleration after a low-pass filter, as an instrument shows it.
    pub filtered: Option<FilteredAcceleration>,
    /// Names of the local elements; those without one are numbered.
    pub element_names: Vec<String>,
    /// Eigenfrequencies of the structure without its local elements (Hz), marked in the spectrum.
    pub eigenfrequencies_hz: Vec<f64>,
    /// Names of the supports that move, where there are several.
    pub support_names: Vec<String>,
}

/// The settled acceleration after a low-pass filter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FilteredAcceleration {
    /// Cut-off frequency (Hz).
    pub cut_off_hz: f64,
    /// One value for each sample of the orbit (m/s²).
    pub values_m_s2: Vec<f64>,
}

/// A sample of an orbit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitSample {
    /// Displacement of the response point (m).
    pub displacement_m: f64,
    /// Its velocity (m/s).
    pub velocity_m_s: f64,
    /// Its acceleration (m/s²).
    pub acceleration_m_s2: f64,
    /// Forces of the local elements (N), with the same number of them in each sample.
    pub forces_n: Vec<f64>,
    /// Displacements of the supports that move (m), with the same number of them in each sample.
    pub supports_m: Vec<f64>,
}

/// An impact on a rigid stop.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitImpulse {
    /// Number of the local element, from 0, as among the forces of a sample.
    pub element: usize,
    /// Excitation periods since phase 0 in the first period of the orbit.
    pub cycles: f64,
    /// Impulse along the relative displacement of the element, as its forces are (N s).
    pub impulse_n_s: f64,
    /// Displacement of the response point (m).
    pub displacement_m: f64,
    /// Its velocity before and after the impact (m/s).
    pub velocity_m_s: [f64; 2],
    /// Its acceleration before and after the impact, without the impulse (m/s²).
    pub acceleration_m_s2: [f64; 2],
}

impl OrbitImpulse {
    /// Velocity after the impact less that before it (m/s).
    pub(super) fn velocity_jump(&self) -> f64 {
        self.velocity_m_s[1] - self.velocity_m_s[0]
    }
}

impl OrbitDiagram {
    pub(super) fn element_name(&self, element: usize) -> String {
        let name = self.element_names.get(element).filter(|name| !name.is_empty());
        name.cloned().unwrap_or_else(|| format!("local element {}", element + 1))
    }

    pub(super) fn periods(&self) -> f64 {
        f64::from(self.period_multiple.max(1))
    }

    /// Values over the time, closed at the end of the period.
    pub(super) fn over_time(&self, value: impl Fn(&OrbitSample) -> f64) -> Vec<(f64, f64)> {
        self.closed(&self.samples.iter().map(value).collect::<Vec<f64>>())
    }

    pub(super) fn closed(&self, values: &[f64]) -> Vec<(f64, f64)> {
        let step = self.periods() / values.len().max(1) as f64;
        let closed = values.iter().chain(values.first()).enumerate();
        closed.map(|(k, value)| (k as f64 * step, *value)).collect()
    }

    /// Number and size of the impulses.
    pub(super) fn impulses_in_words(&self) -> String {
        let size = |impulse: &OrbitImpulse| impulse.impulse_n_s.abs();
        let digits = |value: f64| plain_number(format!("{value:.3e}").parse().unwrap_or(value));
        let sum: f64 = self.impulses.iter().map(size).sum();
        match self.impulses.len() {
            1 => format!("impulse of the impact on a rigid stop: {} N s", digits(sum)),
            count @ 2..=FEW => {
                let each: Vec<String> = self.impulses.iter().map(|impulse| digits(size(impulse))).collect();
                format!("impulses of {count} impacts on rigid stops: {} N s", each.join(", "))
            }
            count => {
                let largest = self.impulses.iter().map(size).fold(0.0, f64::max);
                let (sum, largest) = (digits(sum), digits(largest));
                format!("{count} impacts on rigid stops: together {sum} N s, the largest {largest} N s")
            }
        }
    }

    pub(super) fn chart(
        &self,
        (what, unit): (&str, FrequencyUnit),
        x: Measure,
        panels: Vec<ChartPanel>,
        legend: Vec<Vec<LegendEntry>>,
        aspect: Option<f64>,
    ) -> Chart {
        let (frequency, multiple) = (unit.words(self.frequency_hz), self.period_multiple);
        let mut description =
            format!("{what}, at {frequency}, period {multiple}, {} samples", self.samples.len());
        if !self.impulses.is_empty() {
            description.push_str(&format!("; {}", self.impulses_in_words()));
        }
        Chart { title: self.title.clone(), x, panels, legend, description, aspect }
    }
}
