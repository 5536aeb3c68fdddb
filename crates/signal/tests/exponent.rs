//! Largest exponents of series of systems whose exponents their authors give.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_signal::exponent::*;

type State = [f64; 3];

fn flow(field: impl Fn(State) -> State, start: State, step: f64, skipped: usize, count: usize) -> Vec<f64> {
    const INNER: usize = 5;
    let h = step / INNER as f64;
    let add = |u: State, by: f64, v: State| [u[0] + by * v[0], u[1] + by * v[1], u[2] + by * v[2]];
    let mut u = start;
    let mut series = Vec::new();
    for k in 0..skipped + count {
        for _ in 0..INNER {
            let k1 = field(u);
            let k2 = field(add(u, h / 2.0, k1));
            let k3 = field(add(u, h / 2.0, k2));
            let k4 = field(add(u, h, k3));
            u = add(add(add(add(u, h / 6.0, k1), h / 3.0, k2), h / 3.0, k3), h / 6.0, k4);
        }
        if k >= skipped {
            series.push(u[0]);
        }
    }
    series
}

fn lorenz(start: f64, count: usize) -> Vec<f64> {
    flow(|[x, y, z]| [16.0 * (y - x), x * (45.92 - z) - y, x * y - 4.0 * z], [1.0 + start, 1.0, 20.0], 0.01, 5000, count)
}

fn roessler(start: f64, count: usize) -> Vec<f64> {
    flow(|[x, y, z]| [-y - z, x + 0.15 * y, 0.2 + z * (x - 10.0)], [1.0 + start, 1.0, 0.0], 0.1, 5000, count)
}

fn henon(start: f64, count: usize) -> Vec<f64> {
    let (mut x, mut y) = (0.1 * start, 0.1);
    (0..count + 200).map(|_| { (x, y) = (1.0 - 1.4 * x * x + y, 0.3 * x); x }).skip(200).collect()
}

fn logistic(start: f64, count: usize) -> Vec<f64> {
    let mut x = 0.2 + 0.1 * start;
    (0..count + 200).map(|_| { x = 4.0 * x * (1.0 - x); x }).skip(200).collect()
}

#[test]
fn explore() {
    for (name, series, rate, dim, delay, expected) in [
        ("lorenz", lorenz as fn(f64, usize) -> Vec<f64>, 100.0, 3, 11, 1.50),
        ("roessler", roessler, 10.0, 3, 8, 0.090),
        ("henon", henon, 1.0, 2, 1, 0.418),
        ("logistic", logistic, 1.0, 2, 1, 0.693),
    ] {
        for count in [500, 2000, 5000, 20000] {
            if count < 2000 && rate > 1.0 { continue; }
            let mut lines = vec![Vec::new(); 3];
            let mut text = String::new();
            for s in 0..5 {
                let x = series(f64::from(s) * 0.137, count);
                let auto = embedding(&x, &EmbeddingChoice::default()).unwrap();
                let e = embedding(&x, &EmbeddingChoice { delay: Some(delay), dimension: Some(dim), theiler_window: None }).unwrap();
                let p = |v: f64| format!("{:+.0}", 100.0 * (v / expected - 1.0));
                let d = DivergenceSettings::default();
                lines[0].push(rosenstein(&x, rate, &e, &d).map_or_else(|e| e.to_string(), |r| format!("{}(±{:.0})[{}-{}]", p(r.exponent.value), 100.0*r.exponent.half_width/expected, r.fit.0, r.fit.1)));
                lines[1].push(kantz(&x, rate, &e, &d).map_or_else(|e| e.to_string(), |r| format!("{}(±{:.0})[{}-{}]", p(r.exponent.value), 100.0*r.exponent.half_width/expected, r.fit.0, r.fit.1)));
                for div in [1.0, 2.0, 3.0, 5.0, 8.0] {
                  for large in [0.03, 0.1] {
                    let range = 1.0;
                    let _ = range;
                    let ev = if rate > 1.0 { (e.mean_period / div) as usize } else { div as usize };
                    let r = x.iter().fold(0.0_f64, |a, b| a.max(b.abs())) * if name == "logistic" {1.0} else {2.0};
                    let w = wolf(&x, rate, &e, &WolfSettings { evolution: Some(ev), largest: Some(large * r), smallest: None });
                    lines[2].push(w.map_or_else(|_| "x".into(), |w| format!("{ev}/{large}:{}", p(w.exponent.value))));
                  }
                }
                text += &format!(" d{} m{} T{:.0}", auto.delay, auto.dimension, auto.mean_period);
            }
            println!("{name} {count}: {text}\n  ros {}\n  kan {}\n  wolf {}", lines[0].join(" "), lines[1].join(" "), lines[2].join(" "));
        }
    }
}
