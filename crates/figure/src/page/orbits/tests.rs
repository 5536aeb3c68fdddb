//! Records are decoded according to their specification.

use super::{
    coder::NumberModel,
    decoder::Decoder,
    record::{
        DECADES, KINDS, Of, STEPS, STEPS_OF_A_DECADE, STEPS_OF_MODES, Stepped, displacement_change, rounded,
        velocity_change,
    },
    *,
};

struct Reader<'a> {
    decoder: Decoder<'a>,
    kinds: [NumberModel; KINDS],
}

impl Reader<'_> {
    fn size(&mut self) -> f64 {
        f64::from(f32::from_bits(self.decoder.plain(16) << 16))
    }

    fn numbers(&mut self, of: Of, count: usize) -> Vec<i32> {
        self.kinds[of as usize].begin();
        (0..count).map(|_| self.decoder.number(&mut self.kinds[of as usize])).collect()
    }

    fn counts(&mut self, of: Of, count: usize) -> Vec<i32> {
        let order = self.numbers(Of::Head, 1)[0] as usize;
        let mut counts = self.numbers(of, count);
        // Each order is a sum over the one below.
        for _ in 0..order {
            let mut sum = 0;
            counts.iter_mut().for_each(|count| {
                sum += *count;
                *count = sum;
            });
        }
        counts
    }

    fn series(&mut self, of: Of, count: usize) -> Stepped {
        let size = self.size();
        Stepped { size, counts: self.counts(of, count) }
    }

    fn continued(&mut self, of: Of, count: usize, change: impl Fn(&Stepped, usize) -> f64) -> Stepped {
        let size = self.size();
        let mut series = Stepped { size, counts: Vec::new() };
        for (k, missed) in self.numbers(of, count).into_iter().enumerate() {
            let expected = if k == 0 { 0 } else { series.counts[k - 1] + rounded(change(&series, k - 1)) };
            series.counts.push(expected + missed);
        }
        series
    }
}

/// Numbers of impulses, each with its element.
type Impulses = Vec<(i32, [f64; 5])>;

/// Displacement, velocity, acceleration, support, forces, modes, spectrum, the three of contacts; then
/// numbers of impulses.
fn read(record: &[u8]) -> (Vec<Vec<f64>>, Impulses) {
    let kinds = std::array::from_fn(|_| NumberModel::default());
    let mut reader = Reader { decoder: Decoder::new(record), kinds };
    let counts = reader.numbers(Of::Head, 8);
    let [samples, elements, of_support, modes, of_mode, harmonics, inside, impulses] =
        std::array::from_fn(|k| counts[k] as usize);
    let distance_s = reader.size();
    let acceleration = reader.series(Of::Acceleration, 2 * samples);
    let velocity = reader
        .continued(Of::Velocity, samples, |own, k| velocity_change(&acceleration, own.size, distance_s, k));
    let displacement = reader.continued(Of::Displacement, samples, |own, k| {
        displacement_change((&acceleration, &velocity), own.size, distance_s, k)
    });
    let values = |series: &Stepped| -> Vec<f64> {
        series.counts.iter().map(|count| series.size * f64::from(*count)).collect()
    };
    let mut all = vec![values(&displacement), values(&velocity), values(&acceleration)];
    all.push(values(&reader.series(Of::Support, of_support)));
    all.extend((0..elements).map(|_| values(&reader.series(Of::Forces, 2 * samples))));
    let size = reader.size();
    all.extend((0..modes).map(|_| values(&Stepped { size, counts: reader.counts(Of::Modes, of_mode) })));
    all.push(values(&Stepped {
        size: 1.0 / STEPS_OF_A_DECADE,
        counts: reader.counts(Of::Spectrum, harmonics),
    }));
    for size in [1.0, displacement.size, velocity.size] {
        all.push(values(&Stepped { size, counts: reader.counts(Of::InContacts, inside) }));
    }
    let impulse = |_| {
        let element = reader.numbers(Of::Head, 1)[0];
        (element, std::array::from_fn(|_| f64::from(f32::from_bits(reader.decoder.plain(32)))))
    };
    (all, (0..impulses).map(impulse).collect())
}

fn orbit(samples: usize) -> PageOrbit {
    let times = || (0..samples).map(|k| k as f64);
    PageOrbit {
        duration_s: 2.0,
        displacement_m: times().map(|t| 1e-3 * (0.3 * t).sin()).collect(),
        velocity_m_s: times().map(|t| if t % 2.0 == 0.0 { -1e4 } else { 1e4 }).collect(),
        in_contacts: vec![(3, 0.5e-3, -1.0), (3, 0.75e-3, 0.0), (samples - 1, 1e-3, 1.0)],
        impulses: vec![
            PageImpulse {
                element: 1,
                cycles: 0.75,
                impulse_n_s: -0.5,
                displacement_m: 2e-3,
                velocity_m_s: [1.0, -0.25],
            };
            2
        ],
        acceleration_m_s2: times().map(|t| [-t, t]).collect(),
        forces_n: vec![times().map(|t| [t, 0.0]).collect(), vec![[f64::NAN, 0.0]; samples]],
        support_m: vec![0.25; samples / 2],
        modes: [1.0, 1e-2].map(|size| (0..samples / 2).map(|k| size * (k as f64).cos()).collect()).to_vec(),
        spectrum_m_s2: vec![100.0, 0.0, 1e-3, 1e-2],
    }
}

/// Half a step, with the rounding of its size to the upper half of an f32, and of the values.
fn half_a_step(steps: f64) -> f64 {
    0.5 / steps * (1.0 + 2.0_f64.powi(-7)) + 1e-6
}

#[track_caller]
fn assert_near(found: &[f64], meant: &[f64], tolerance: f64) {
    assert_eq!(found.len(), meant.len());
    for (found, meant) in found.iter().zip(meant) {
        assert!((found - meant).abs() <= tolerance, "{found} {meant}");
    }
}

#[test]
fn values_are_good_to_half_a_step() {
    let orbit = orbit(200);
    let record = orbit.record().0;
    assert!(record.len().is_multiple_of(3));
    let (series, impulses) = read(&record);
    assert_eq!(series.len(), 12);
    let good = half_a_step(STEPS);
    assert_near(&series[0], &orbit.displacement_m, good * 2e-3);
    assert_near(&series[1], &orbit.velocity_m_s, good * 2e4);
    assert_near(&series[2], orbit.acceleration_m_s2.as_flattened(), good * 398.0);
    assert_near(&series[3], &orbit.support_m, 1e-7);
    assert_near(&series[4], orbit.forces_n[0].as_flattened(), good * 199.0);
    assert_near(&series[5], &[0.0; 400], 0.0);
    assert_near(&series[6], &orbit.modes[0], half_a_step(STEPS_OF_MODES) * 2.0);
    assert_near(&series[7], &orbit.modes[1], half_a_step(STEPS_OF_MODES) * 2.0);
    assert_near(&series[9], &[3.0, 3.0, 199.0], 0.0);
    assert_near(&series[10], &[0.5e-3, 0.75e-3, 1e-3], good * 2e-3);
    // Steps of the velocity are those of its samples.
    assert_near(&series[11], &[-1.0, 0.0, 1.0], good * 2e4);
    assert_eq!(impulses, [(1, [0.75, -0.5, f64::from(2e-3_f32), 1.0, -0.25]); 2]);
}

/// The tallest plots of an orbit have 300 pixels, the structure in motion moves over 190; a spectrum has its
/// decades and a third more on less than 260.
#[test]
fn what_is_rounded_is_less_than_half_a_pixel() {
    assert!(half_a_step(STEPS) * 300.0 < 0.2);
    assert!(half_a_step(STEPS_OF_MODES) * 190.0 < 0.2);
    assert!(half_a_step(STEPS_OF_A_DECADE) * 260.0 / (DECADES + 0.3) < 0.5);
}

#[test]
fn spectra_are_logarithms_and_what_is_far_below_the_largest_stands_at_the_depth_that_is_drawn() {
    let (series, _) = read(&orbit(10).record().0);
    assert_near(&series[8], &[2.0, 2.0 - DECADES, -3.0, -2.0], 0.5 / STEPS_OF_A_DECADE + 1e-12);
    let (still, _) = read(&PageOrbit { spectrum_m_s2: vec![0.0; 3], ..PageOrbit::default() }.record().0);
    assert!(still[4].iter().all(|level| *level <= -300.0), "no amplitude is none");
}

/// `y = a cos(wt)`: velocity and displacement follow from the acceleration to a step or so; with it they cost
/// less than half a byte a value.
#[test]
fn a_harmonic_motion_takes_less_than_half_a_byte_a_value() {
    let count = 192;
    let of = |k: f64| std::f64::consts::TAU * k / f64::from(count);
    let harmonic = PageOrbit {
        duration_s: 1.0,
        displacement_m: (0..count).map(|k| 1e-3 * of(f64::from(k)).cos()).collect(),
        velocity_m_s: (0..count).map(|k| -1e-3 * std::f64::consts::TAU * of(f64::from(k)).sin()).collect(),
        acceleration_m_s2: (0..count)
            .map(|k| {
                [0.0, 0.5].map(|half| -1e-3 * std::f64::consts::TAU.powi(2) * of(f64::from(k) + half).cos())
            })
            .collect(),
        ..PageOrbit::default()
    };
    assert!(harmonic.record().0.len() < 4 * 192 / 2, "{}", harmonic.record().0.len());
}

#[test]
fn an_orbit_without_anything_or_of_odd_numbers_is_a_record() {
    let (series, impulses) = read(&PageOrbit::default().record().0);
    assert!(series.iter().all(Vec::is_empty) && impulses.is_empty());
    let odd = PageOrbit {
        duration_s: f64::NAN,
        displacement_m: vec![f64::NAN, f64::INFINITY, 1e300],
        velocity_m_s: vec![-1e300, 0.0, 1e-300],
        acceleration_m_s2: vec![[1e300, -1e300]; 3],
        ..PageOrbit::default()
    };
    let (series, _) = read(&odd.record().0);
    assert_eq!([series[0].len(), series[1].len(), series[2].len()], [3, 3, 6]);
}

#[test]
fn records_stand_in_the_order_of_the_solutions_and_within_their_budget() {
    let (mut records, length) = (OrbitRecords::default(), orbit(10).record().0.len());
    for solution in [7, 0, 7] {
        assert!(records.insert(solution, orbit(10).record(), 3 * length));
    }
    assert!(records.insert(9, orbit(10).record(), 3 * length));
    assert!(!records.insert(8, orbit(10).record(), 3 * length));
    assert_eq!(records.solutions(), [0, 7, 9]);
    assert_eq!(records.lengths(), [length; 3]);
    assert_eq!(records.bytes().len(), 3 * length);
}
