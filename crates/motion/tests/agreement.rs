//! The exact integrator against the general one.

mod common;

use hammerbeam_motion::{Stretch, exact::{ExactIntegrator, ExactSettings}, general};

#[test]
fn scratch() {
    let system = common::paper_beam();
    for f in [36.0, 53.0, 22.0] {
    let stretch = Stretch { frequency_hz: f, start: 0.0, end: 1.0 };
    let mut reference = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-14 }).unwrap();
    let mut state = vec![0.0; 12];
    for _ in 0..200 { state = reference.advance(&stretch, &state).unwrap(); }
    let t0 = std::time::Instant::now();
    let general = general::advance(&system, &stretch, &state, &general::GeneralSettings::with_tolerance(1e-12)).unwrap();
    let tg = t0.elapsed();
    let best = reference.flow(&stretch, &state).unwrap();
    println!("f {f} general {:?} {:?} touches {:?} counts {:?}", general.counts, tg, reference.touches(), reference.counts());
    let scale = |i: usize| if i < 6 { system.model().natural_frequencies[i] } else { 1.0 };
    let compare = |a: &hammerbeam_motion::Flow, b: &hammerbeam_motion::Flow| {
        let (mut ds, mut ns, mut dm, mut nm, mut df, mut nf) = (0.0f64, 0.0f64, 0.0f64, 0.0f64, 0.0f64, 0.0f64);
        for i in 0..12 {
            ds = ds.max((a.state[i] - b.state[i]).abs() * scale(i)); ns = ns.max(b.state[i].abs() * scale(i));
            df = df.max((a.by_frequency[i] - b.by_frequency[i]).abs() * scale(i)); nf = nf.max(b.by_frequency[i].abs() * scale(i));
            for j in 0..12 { dm = dm.max((a.by_state[(i, j)] - b.by_state[(i, j)]).abs() * scale(i) / scale(j)); nm = nm.max(b.by_state[(i, j)].abs() * scale(i) / scale(j)); }
        }
        (ds / ns, dm / nm, df / nf)
    };
    println!("  general vs 1e-18: {:?}", compare(&general.flow, &best));
    for tol in [1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-16] {
        let mut exact = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: tol }).unwrap();
        let flow = exact.flow(&stretch, &state).unwrap();
        let c = exact.counts();
        let t0 = std::time::Instant::now();
        for _ in 0..1000 { exact.flow(&stretch, &state).unwrap(); }
        let t1 = t0.elapsed();
        for _ in 0..1000 { exact.advance(&stretch, &state).unwrap(); }
        println!("  {tol:.0e} {:?} looks {} steps {} solves {} {:.1} us {:.1} us", compare(&flow, &best), c.looks, c.steps, c.solves, t1.as_secs_f64() * 1e3, (t0.elapsed() - t1).as_secs_f64() * 1e3);
    }
    }
}
