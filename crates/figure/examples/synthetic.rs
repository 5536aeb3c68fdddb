//! Draws made-up branches shaped like those of an impacting beam, to look at and to time: `synthetic
//! [FOLDER]`.

use std::{f64::consts::TAU, fs, path::PathBuf, time::Instant};

use hammerbeam_figure::{
    Figure, ResponseCurve, ResponseDiagram, ResponsePoint, ResponseQuantity, ResponseSettings, ScaleChoice,
    Style,
};

/// A hardening peak: centre [Hz], half width [Hz], height [mm], lean [Hz].
type Peak = (f64, f64, f64, f64);

const HARMONIC: &[Peak] = &[
    (19.7, 0.12, 1.6, 0.35),
    (23.0, 0.15, 2.0, 0.4),
    (27.4, 0.2, 2.3, 0.55),
    (33.0, 0.9, 3.4, 1.4),
    (35.8, 0.8, 4.3, 1.6),
    (38.2, 0.5, 2.2, 0.2),
    (46.9, 0.5, 1.1, 0.9),
    (69.6, 0.7, 0.7, 0.5),
];
const HALF: &[Peak] = &[(64.0, 1.2, 6.0, 3.0), (70.0, 1.4, 7.5, 3.5), (92.8, 0.6, 1.3, 0.8)];
const THIRD: &[Peak] = &[(97.0, 1.5, 10.0, 3.5), (103.0, 1.6, 14.0, 6.0)];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder =
        PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "/tmp/hammerbeam-figure".to_owned()));
    fs::create_dir_all(&folder)?;
    let harmonic = branch(1, HARMONIC, (19.0, 110.0), 100_000);
    let all = vec![
        harmonic.clone(),
        branch(2, HALF, (57.0, 110.0), 40_000),
        branch(3, THIRD, (87.0, 110.0), 20_000),
    ];
    let harmonic = ResponseDiagram {
        title: String::new(),
        curves: vec![harmonic],
        frequency_range_hz: Some((19.0, 110.0)),
        ..ResponseDiagram::default()
    };
    let all = ResponseDiagram {
        title: "Clamped beam with an elastic stop".to_owned(),
        curves: all,
        ..harmonic.clone()
    };
    write(&folder, "displacement", &harmonic, &[ResponseQuantity::Displacement], &logarithmic())?;
    write(&folder, "acceleration", &harmonic, &[ResponseQuantity::Acceleration], &logarithmic())?;
    write(&folder, "linear", &harmonic, &[ResponseQuantity::Displacement], &ResponseSettings::default())?;
    let dense = ResponseDiagram {
        curves: vec![many_folds()],
        title: String::new(),
        frequency_range_hz: None,
        ..ResponseDiagram::default()
    };
    write(&folder, "dense", &dense, &[ResponseQuantity::Displacement], &ResponseSettings::default())?;
    let both = [ResponseQuantity::Displacement, ResponseQuantity::Acceleration];
    write(&folder, "all", &all, &both, &logarithmic())?;
    // Nine periods beside each other, to be looked at in grey as well.
    let lines = (1..10).map(|period| {
        let peaks = [(30.0 + f64::from(period), 2.0, 10.0 - f64::from(period), 6.0)];
        let mut line = branch(period, &peaks, (20.0, 60.0), 2000);
        line.points.iter_mut().for_each(|point| point.grazing = false);
        line
    });
    let periods = ResponseDiagram { curves: lines.collect(), frequency_range_hz: None, ..all.clone() };
    write(&folder, "periods", &periods, &[ResponseQuantity::Displacement], &ResponseSettings::default())?;
    let column = ResponseSettings { style: Style::single_column(), ..logarithmic() };
    write(&folder, "column", &all, &both, &column)
}

fn logarithmic() -> ResponseSettings {
    ResponseSettings { displacement_scale: ScaleChoice::Logarithmic, ..ResponseSettings::default() }
}

fn write(
    folder: &std::path::Path,
    name: &str,
    diagram: &ResponseDiagram,
    quantities: &[ResponseQuantity],
    settings: &ResponseSettings,
) -> Result<(), Box<dyn std::error::Error>> {
    let start = Instant::now();
    let figure: Figure = diagram.draw_with(quantities, settings)?;
    let drawn = start.elapsed();
    let png = figure.png(300.0)?;
    let report = format!(
        "{name}: {:.0} kB SVG in {drawn:.1?}, {:.0} kB PNG in {:.1?}\n{}\n",
        figure.svg().len() as f64 / 1e3,
        png.len() as f64 / 1e3,
        start.elapsed() - drawn,
        figure.description(),
    );
    fs::write(folder.join(format!("{name}.txt")), report)?;
    fs::write(folder.join(format!("{name}.svg")), figure.svg())?;
    fs::write(folder.join(format!("{name}.png")), png)?;
    Ok(())
}

/// A branch over peaks that lean to higher frequencies; between the folds of a peak it is unstable.
fn branch(period_multiple: u32, peaks: &[Peak], (from, to): (f64, f64), count: usize) -> ResponseCurve {
    let mut points: Vec<ResponsePoint> = (0..count)
        .map(|i| to - (to - from) * i as f64 / (count - 1) as f64)
        .map(|s| point(peaks, s, period_multiple))
        .collect();
    let aperiodic = |f: f64| period_multiple < 3 && (41.0..52.0).contains(&f) || (78.0..91.0).contains(&f);
    for i in 1..count - 1 {
        let (before, here, after) =
            (points[i - 1].frequency_hz, points[i].frequency_hz, points[i + 1].frequency_hz);
        points[i].fold = (here - before) * (after - here) < 0.0;
        points[i].stable = after < here && !aperiodic(here);
        points[i].flip = aperiodic(here) != aperiodic(after) && !points[i].fold;
        points[i].grazing = here < 60.0 && i.is_multiple_of(count / 500);
        points[i].neimark_sacker = period_multiple == 1 && i == count / 3;
        points[i].branch_point = period_multiple == 1 && i == count / 4;
    }
    ResponseCurve { period_multiple, points }
}

/// A branch that turns 1600 times and changes its stability 3300 times.
fn many_folds() -> ResponseCurve {
    let wave = |i: u32| {
        let s = f64::from(i) / 1e5;
        let fine = (5e3 * s).sin();
        ResponsePoint {
            frequency_hz: 20.0 + 80.0 * s + 0.1 * fine,
            displacement_m: 1e-3 * (1.0 + 0.9 * (40.0 * s).sin() + 0.02 * fine),
            acceleration_m_s2: 1.0,
            stable: !(i / 20).is_multiple_of(3),
            fold: i.is_multiple_of(63),
            grazing: i.is_multiple_of(50),
            ..ResponsePoint::default()
        }
    };
    ResponseCurve { period_multiple: 1, points: (0..100_000).map(wave).collect() }
}

fn point(peaks: &[Peak], s: f64, period_multiple: u32) -> ResponsePoint {
    let shares: Vec<f64> =
        peaks.iter().map(|(centre, width, ..)| 1.0 / (1.0 + ((s - centre) / width).powi(2))).collect();
    let sum =
        |of: fn(&Peak) -> f64| peaks.iter().zip(&shares).map(|(peak, share)| of(peak) * share).sum::<f64>();
    let wiggle = if s < 30.0 { 0.02 * (40.0 * s).sin() } else { 0.0 };
    let frequency_hz = s + sum(|peak| peak.3) + wiggle;
    let displacement_mm = (0.35 + 12.0 / s) * f64::from(period_multiple).sqrt() * 0.8 + sum(|peak| peak.2);
    let impact = 1.0 + 6.0 * (0.5 + 0.5 * (s / 5.0).sin()).powi(2) + 3.0 * sum(|peak| peak.2);
    let acceleration_m_s2 = 0.6e-3 * displacement_mm * (TAU * frequency_hz).powi(2) * impact;
    ResponsePoint {
        frequency_hz,
        displacement_m: 1e-3 * displacement_mm,
        acceleration_m_s2,
        stable: true,
        ..ResponsePoint::default()
    }
}
