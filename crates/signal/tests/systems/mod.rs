//! Series of the systems on which the authors of the methods tested them.

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

pub fn lorenz(start: f64, count: usize) -> Vec<f64> {
    flow(
        |[x, y, z]| [16.0 * (y - x), x * (45.92 - z) - y, x * y - 4.0 * z],
        [1.0 + start, 1.0, 20.0],
        0.01,
        5000,
        count,
    )
}

pub fn roessler(start: f64, count: usize) -> Vec<f64> {
    flow(|[x, y, z]| [-y - z, x + 0.15 * y, 0.2 + z * (x - 10.0)], [1.0 + start, 1.0, 0.0], 0.1, 5000, count)
}

pub fn henon(start: f64, count: usize) -> Vec<f64> {
    let (mut x, mut y) = (0.1 * start, 0.1);
    (0..count + 200)
        .map(|_| {
            (x, y) = (1.0 - 1.4 * x * x + y, 0.3 * x);
            x
        })
        .skip(200)
        .collect()
}

pub fn logistic(start: f64, count: usize) -> Vec<f64> {
    let mut x = 0.2 + 0.1 * start;
    (0..count + 200)
        .map(|_| {
            x = 4.0 * x * (1.0 - x);
            x
        })
        .skip(200)
        .collect()
}
