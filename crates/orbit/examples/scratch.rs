#![allow(clippy::all, clippy::unwrap_used, clippy::print_stdout, missing_docs, dead_code)]
#[path = "../tests/common/mod.rs"]
mod common;
use common::{beam, walk};
use hammerbeam_orbit::{OrbitSettings, Side, find_start};
fn main() {
    let beam = beam();
    let settings = OrbitSettings { max_step_hz: 0.001, ..OrbitSettings::default() };
    let mode = std::env::args().nth(1).unwrap_or_default();
    if mode == "starts" {
        let t = std::time::Instant::now();
        let mut missing = vec![];
        for k in 0..1203 {
            let f = 20.0 + 60.0 * k as f64 / 1203.0;
            if find_start(&beam.0, &beam.1, f, 1, &OrbitSettings::default()).is_err() {
                missing.push(f);
            }
        }
        println!("{} missing {:?} {:?}", missing.len(), t.elapsed(), &missing[..missing.len().min(20)]);
        return;
    }
    let from: f64 = std::env::args().nth(2).unwrap().parse().unwrap();
    let to: f64 = std::env::args().nth(3).unwrap().parse().unwrap();
    let start =
        hammerbeam_orbit::reach_orbit(&beam.0, &beam.1, (from, 1), &OrbitSettings::default(), &mut || false)
            .unwrap();
    let t = std::time::Instant::now();
    for _ in 0..3 {
        let (rows, ev) = walk(
            &beam.0,
            &beam.1,
            &start,
            if to > from { Side::Up } else { Side::Down },
            (from.min(to), from.max(to)),
            &settings,
        );
        println!("{} {} {:?}", rows.len(), ev, t.elapsed());
    }
}
