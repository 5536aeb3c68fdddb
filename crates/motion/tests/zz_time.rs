mod common;
use hammerbeam_motion::{Stretch, exact::{ExactIntegrator, ExactSettings}};
#[test]
fn time() {
    let system = common::paper_beam();
    for f in [36.0, 22.0, 53.0] {
        let state = common::settled(&system, f, 100, 0.0);
        let s = Stretch { frequency_hz: f, start: 0.0, end: 1.0 };
        let mut e = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-9 }).unwrap();
        let mut best = [f64::INFINITY; 2];
        for _ in 0..60 {
            let t = std::time::Instant::now();
            for _ in 0..40 { e.flow(&s, &state).unwrap(); }
            best[0] = best[0].min(t.elapsed().as_secs_f64() / 40.0);
            let t = std::time::Instant::now();
            for _ in 0..40 { e.advance(&s, &state).unwrap(); }
            best[1] = best[1].min(t.elapsed().as_secs_f64() / 40.0);
        }
        println!("{f}: flow {:.2} us, advance {:.2} us", best[0] * 1e6, best[1] * 1e6);
    }
}
