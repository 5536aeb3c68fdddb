//! Data for figures of every kind.

use std::f64::consts::TAU;

use hammerbeam_figure::{
    BasinAttractor, BasinMap, ConvergenceDiagram, DrawnMotion, ExponentDiagram, ExponentPoint, HoleDiagram,
    MotionKind, MultiplierDiagram, Multipliers, OrbitDiagram, OrbitImpulse, OrbitSample, SectionDiagram,
    SweepDiagram, SweepOrigin,
};

pub fn basins() -> BasinMap {
    let destination = |kind, branch, places| BasinAttractor { kind, branch, places };
    BasinMap {
        title: "Basins".to_owned(),
        x_label: "Initial displacement (mm)".to_owned(),
        y_label: "Initial velocity (m/s)".to_owned(),
        x_range: (-1.0, 1.0),
        y_range: (0.0, 2.0),
        cells_along: 2,
        cells: vec![1, 2, 1, 0],
        behind_stop: Vec::new(),
        attractors: vec![
            destination(MotionKind::Periodic { period: 3 }, Some(2), vec![(0.5, 0.5)]),
            destination(MotionKind::Chaotic, None, vec![]),
        ],
    }
}

pub fn sweep() -> SweepDiagram {
    let motion = |origin, frequency_hz: f64, kind, samples_m: &[f64]| DrawnMotion {
        origin,
        frequency_hz,
        kind,
        samples_m: samples_m.to_vec(),
        max_displacement_m: 2e-3,
    };
    let periodic = MotionKind::Periodic { period: 1 };
    let cloud: Vec<f64> = (0..100).map(|k| 1e-3 * f64::from(k) / 100.0).collect();
    SweepDiagram {
        title: "Sweep".to_owned(),
        motions: vec![
            motion(SweepOrigin::Up, 20.0, periodic, &[1e-3]),
            motion(SweepOrigin::Up, 21.0, MotionKind::Chaotic, &cloud),
            motion(SweepOrigin::Down, 21.0, periodic, &[0.5e-3, f64::NAN]),
        ],
    }
}

pub fn exponents() -> ExponentDiagram {
    let point = |frequency_hz, largest_per_s| ExponentPoint {
        frequency_hz,
        largest_per_s,
        half_width_per_s: 1.0,
        dimension: 2.0,
    };
    ExponentDiagram { title: String::new(), points: vec![point(40.0, -3.0), point(41.0, 8.0)] }
}

pub fn convergence() -> ConvergenceDiagram {
    let places = (1..50).map(f64::from).map(|time| (time, vec![1.0 + 1.0 / time, -1.0, f64::NAN]));
    ConvergenceDiagram { title: String::new(), frequency_hz: 40.0, places: places.collect() }
}

pub fn section() -> SectionDiagram {
    SectionDiagram { title: String::new(), frequency_hz: 40.0, points: vec![(1e-3, 0.1), (2e-3, -0.1)] }
}

pub fn multipliers() -> MultiplierDiagram {
    let solution = |frequency_hz: f64| {
        let (re, im) = (0.02 * frequency_hz, 0.3);
        let multipliers = vec![[re, im], [re, -im]];
        Multipliers { frequency_hz, stable: re.hypot(im) < 1.0, marginal: false, multipliers }
    };
    let solutions = (20..70).map(f64::from).map(solution).collect();
    MultiplierDiagram { title: String::new(), solutions }
}

/// A motion with two harmonics, of 10 and 30 Hz.
pub fn orbit() -> OrbitDiagram {
    let sample = |j: i32| {
        let t = TAU * f64::from(j) / 256.0;
        OrbitSample {
            displacement_m: 1e-3 * t.cos(),
            velocity_m_s: -t.sin(),
            acceleration_m_s2: 100.0 * t.cos() + 10.0 * (3.0 * t).cos(),
            forces_n: vec![t.cos().max(0.0), 0.0],
            supports_m: vec![1e-4 * t.cos()],
        }
    };
    OrbitDiagram {
        title: "Orbit".to_owned(),
        frequency_hz: 10.0,
        period_multiple: 1,
        samples: (0..256).map(sample).collect(),
        impulses: Vec::new(),
        filtered: None,
        element_names: Vec::new(),
        eigenfrequencies_hz: vec![18.0],
        support_names: Vec::new(),
    }
}

/// The same with two rigid stops, of which each is struck once.
pub fn struck() -> OrbitDiagram {
    let impulse = |element: usize, cycles: f64| OrbitImpulse {
        element,
        cycles,
        impulse_n_s: -0.5 - cycles,
        displacement_m: 1e-3 * (TAU * cycles).cos(),
        velocity_m_s: [-(TAU * cycles).sin(), 0.4],
        acceleration_m_s2: [50.0, 40.0],
    };
    let samples = orbit().samples.into_iter();
    let samples = samples.map(|sample| OrbitSample { forces_n: vec![0.0; 2], ..sample }).collect();
    OrbitDiagram { samples, impulses: vec![impulse(0, 0.2), impulse(1, 0.7)], ..orbit() }
}

/// A path that leaves its hole twice.
pub fn hole() -> HoleDiagram {
    let at = |j: i32| {
        let t = TAU * f64::from(j) / 256.0;
        [0.6e-3 * t.cos(), 0.3e-3 * t.sin()]
    };
    HoleDiagram {
        title: "Orbit".to_owned(),
        frequency_hz: 10.0,
        period_multiple: 1,
        clearance_m: 0.5e-3,
        names: ["tube.y".to_owned(), "tube.z".to_owned()],
        path_m: (0..256).map(at).collect(),
    }
}
