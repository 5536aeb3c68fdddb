use hammerbeam_motion::*;
use hammerbeam_motion::law::HertzStop;
use hammerbeam_orbit::*;
use hammerbeam_structure::*;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let get = |i: usize, d: f64| args.get(i).map_or(d, |s| s.parse().unwrap());
    let (lo, hi, f0, step) = (get(1, 19.0), get(2, 110.0), get(3, 110.0), get(4, 0.02));
    let beam = Beam { length: 0.2579822, elements: 44, section: Section::rectangle(0.0298, 0.002).unwrap(), youngs_modulus: 2.1e11, density: 7800.0,
        left: End::Clamped, right: End::Free, points: vec![BeamPoint { name: "contact".into(), at: 0.2432157, mass: 0.03756, rotary_inertia: 1.59e-8, ..Default::default() }] };
    let s = beam.structure().unwrap().with_support_motion(&["left"]).unwrap();
    let r = s.reduce(&Reduction::FreeInterface { cut_off_hz: 1000.0 }, &Damping::modal(0.015), &["contact"]).unwrap();
    let p = r.model.point("contact").unwrap().clone();
    let load = Load { support: vec![Harmonic { order: 1, amplitude: 0.5015e-3, phase: 0.0 }], forces: vec![] };
    let el = LocalElement { name: "stop".into(), shape: p.shape.iter().map(|x| -x).collect(), support_ratio: 0.0, law: Law::Hertz(HertzStop::with_gap(4.5e9, 0.0).unwrap()) };
    let system = System::new(r.model, &load, vec![el]).unwrap();
    let response = Response { shape: p.shape, support_ratio: p.support_ratio };
    let settings = OrbitSettings { max_step_hz: step, ..Default::default() };
    let t0 = std::time::Instant::now();
    let start = find_start(&system, &response, f0, 1, &settings).unwrap();
    eprintln!("start {:?} in {:?}: {:?} {:?}", start.frequency_hz, t0.elapsed(), start.maxima, start.floquet_multipliers);
    for side in [Side::Down, Side::Up] {
        let t0 = std::time::Instant::now();
        let mut walk = BranchWalk::new(&system, &response, &start, side, (lo, hi), &settings).unwrap();
        let mut rows = Vec::new();
        let mut folds = 0; let mut n = 0; let mut grazing = 0;
        let reason = loop {
            rows.clear();
            let r = walk.step(&mut rows).unwrap();
            for row in &rows {
                n += 1;
                let s = &row.solution;
                println!("{:.9} {:.6e} {:.6e} {} {:.6e} {} {}", s.frequency_hz, s.maxima.displacement, s.maxima.acceleration, s.stable(), s.floquet_multipliers[0][0].hypot(s.floquet_multipliers[0][1]), s.maxima.contacts, row.events.label());
                if row.events.fold { folds += 1; eprintln!("fold {:.8} y {:.5} mu {:?}", s.frequency_hz, s.maxima.displacement * 1e3, s.floquet_multipliers[0]); }
                if row.events.grazing { grazing += 1; }
            }
            if let Some(r) = r { break r; }
        };
        let t = t0.elapsed().as_secs_f64();
        eprintln!("{side:?}: {n} solutions {folds} folds {grazing} grazing {reason:?}, {} evaluations, {:.3} s, {:.0}/s", walk.evaluations(), t, n as f64 / t);
    }
}
