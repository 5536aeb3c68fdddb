use hammerbeam_motion::*;
use hammerbeam_motion::exact::*;
use hammerbeam_motion::law::HertzStop;
use hammerbeam_orbit::*;
use hammerbeam_structure::*;
fn main() {
    let beam = Beam { length: 0.2579822, elements: 44, section: Section::rectangle(0.0298, 0.002).unwrap(), youngs_modulus: 2.1e11, density: 7800.0,
        left: End::Clamped, right: End::Free, points: vec![BeamPoint { name: "contact".into(), at: 0.2432157, mass: 0.03756, rotary_inertia: 1.59e-8, ..Default::default() }] };
    let s = beam.structure().unwrap().with_support_motion(&["left"]).unwrap();
    let r = s.reduce(&Reduction::FreeInterface { cut_off_hz: 1000.0 }, &Damping::modal(0.015), &["contact"]).unwrap();
    let p = r.model.point("contact").unwrap().clone();
    let load = Load { support: vec![Harmonic { order: 1, amplitude: 0.5015e-3, phase: 0.0 }], forces: vec![] };
    let el = LocalElement { name: "stop".into(), shape: p.shape.iter().map(|x| -x).collect(), support_ratio: 0.0, law: Law::Hertz(HertzStop::with_gap(4.5e9, 0.0).unwrap()) };
    let system = System::new(r.model, &load, vec![el]).unwrap();
    let response = Response { shape: p.shape, support_ratio: p.support_ratio };
    let settings = OrbitSettings { max_step_hz: 0.02, ..Default::default() };
    let start = find_start(&system, &response, 30.0, 1, &settings).unwrap();
    let mut walk = BranchWalk::new(&system, &response, &start, Side::Up, (19.0, 110.0), &settings).unwrap();
    let mut rows = Vec::new();
    while walk.step(&mut rows).unwrap().is_none() {}
    let last = &rows[rows.len() - 1].solution;
    let mut x = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-11 }).unwrap();
    for tol in [1e-11] {
    for k in -20..=20 {
        let f = last.frequency_hz + 2e-10 * k as f64;
        let stretch = Stretch { frequency_hz: f, start: 0.0, end: 1.0 };
        let mut x = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: tol }).unwrap();
        let flow = x.flow(&stretch, &last.nodes[0]).unwrap();
        println!("== {k} {:.17e} {:.17e} {:?} {:?}", flow.state[0], flow.state[11], x.touches(), x.counts());
    } }
    let stretch = Stretch { frequency_hz: last.frequency_hz, start: 0.0, end: 1.0 };
    let g = general::advance(&system, &stretch, &last.nodes[0], &general::GeneralSettings::with_tolerance(1e-12)).unwrap();
    println!("{:.17e} {:.17e}", g.flow.state[0], g.flow.state[11]);
}
