//! Motion in time: against the general integrator, closed forms, and what contacts must conserve.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::PI;

use crate::common::{beam_with, element, hertz, oscillator, paper_beam};
use hammerbeam_attractor::{AttractorError, ContactRecord, PoincareSection, Simulation, poincare};
use hammerbeam_motion::{
    Law, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{GeneralSettings, sample},
    law::{LinearStop, TwoSidedStop},
};

fn simulation(system: System, frequency_hz: f64) -> Simulation {
    let rest = vec![0.0; 2 * system.dof()];
    Simulation::new(system, frequency_hz, &rest, ExactSettings::default()).unwrap()
}

fn settled(system: System, frequency_hz: f64, periods: usize) -> Simulation {
    let mut simulation = simulation(system, frequency_hz);
    (0..periods).for_each(|_| simulation.skip_period().unwrap());
    simulation
}

fn contacts(simulation: &mut Simulation, periods: usize) -> Vec<ContactRecord> {
    (0..periods).flat_map(|_| simulation.period(0).unwrap().1).collect()
}

/// 200 samples of a period with several contacts, in flight and in contact, against the general integrator.
#[test]
fn samples_are_those_of_the_general_integrator() {
    for frequency_hz in [22.0, 36.0, 53.0] {
        let system = paper_beam();
        let mut simulation = settled(system.clone(), frequency_hz, 50);
        let start = simulation.state().to_vec();
        let phases: Vec<f64> = (0..200).map(|k| f64::from(k) / 200.0).collect();
        let stretch = Stretch { frequency_hz, start: 0.0, end: 1.0 };
        let expected =
            sample(&system, &stretch, &start, &phases, &GeneralSettings::with_tolerance(1e-13)).unwrap();
        let (samples, _) = simulation.period(200).unwrap();
        assert_eq!(samples.len(), 200);
        let n = system.dof();
        let rates = &system.model().natural_frequencies;
        let unit = |i: usize| if i < n { rates[i] } else { 1.0 };
        let largest = expected.iter().flatten().fold(0.0_f64, |largest, v| largest.max(v.abs()));
        for (found, expected) in samples.iter().zip(&expected) {
            for i in 0..2 * n {
                let error = (found.state[i] - expected[i]).abs() * unit(i) / largest;
                // Both integrators leave about 1e-9 after the contacts of the period.
                assert!(error < 1e-7, "{frequency_hz} Hz, {} s, entry {i}: {error:e}", found.time);
            }
        }
    }
}

/// Watching a motion does not change it.
#[test]
fn a_motion_that_is_written_down_is_bit_by_bit_the_same() {
    let (mut seen, mut unseen) = (settled(paper_beam(), 53.0, 20), settled(paper_beam(), 53.0, 20));
    for _ in 0..20 {
        seen.period(37).unwrap();
        unseen.skip_period().unwrap();
    }
    assert_eq!(seen.state(), unseen.state());
}

/// Contacts, their impulses and largest forces agree with the integrator's own maxima.
#[test]
fn contacts_agree_with_the_maxima_of_the_motion() {
    let mut simulation = settled(paper_beam(), 53.0, 100);
    let mut integrator = ExactIntegrator::new(paper_beam(), ExactSettings::default()).unwrap();
    for _ in 0..30 {
        let start = simulation.state().to_vec();
        let stretch = Stretch { frequency_hz: 53.0, start: 0.0, end: 1.0 };
        let maxima = integrator.observe(&[(stretch, &start)]).unwrap();
        let before = simulation.unfinished();
        let (_, ended) = simulation.period(3).unwrap();
        let after = simulation.unfinished();
        if !(before.is_empty() && after.is_empty()) || maxima.touches == 0 {
            continue;
        }
        assert_eq!(ended.len() as u32, maxima.touches);
        let sum: f64 = ended.iter().map(|contact| contact.impulse).sum();
        assert!((sum / maxima.impulse - 1.0).abs() < 1e-10, "{:e}", sum / maxima.impulse - 1.0);
        let peak = ended.iter().map(|contact| contact.peak_force).fold(0.0, f64::max);
        assert!((peak / maxima.contact_force - 1.0).abs() < 1e-5, "{peak} {}", maxima.contact_force);
        let speed =
            ended.iter().map(|contact| contact.begin.as_ref().unwrap().velocity.abs()).fold(0.0, f64::max);
        assert_eq!(speed, maxima.impact_velocity);
    }
}

/// A law without loss gives back all the energy of each contact, to 1e-8 of impulse times velocity of the
/// hardest contact: the error of a step is bounded against the whole motion.
#[test]
fn loss_free_laws_lose_no_energy_in_any_contact() {
    let laws = [
        hertz(4.5e9, 0.0),
        Law::Linear(LinearStop::with_gap(5e5, 0.0).unwrap()),
        Law::TwoSided(TwoSidedStop::new(5e5, 1e-4, 2e-4).unwrap()),
    ];
    for law in laws {
        let found = contacts(&mut settled(beam_with(0.015, law.clone()), 53.0, 50), 50);
        assert!(found.len() > 20, "{}", found.len());
        let energy = |contact: &ContactRecord| {
            contact.impulse * contact.begin.as_ref().map_or(0.0, |touch| touch.velocity.abs())
        };
        let hardest = found.iter().map(energy).fold(0.0, f64::max);
        for contact in found.iter().filter(|contact| contact.begin.is_some()) {
            assert!(contact.energy_lost.abs() < 1e-8 * hardest, "{law:?} {hardest} {contact:?}");
        }
    }
}

/// An undamped mass on a soft spring that strikes a stop of stiffness k at speed v stays for half a period
/// `pi/sqrt(k)`, with the impulse 2 v and the largest force `v sqrt(k)`: here with `k = 1e8` and the spring's
/// 1 N/m, to parts in a million.
#[test]
fn an_impact_on_a_linear_stop_is_half_a_sine() {
    let stop = element(&[1.0], 0.0, Law::Linear(LinearStop::with_gap(1e8, 0.5).unwrap()));
    let system = oscillator(1.0, 0.0, 0.0, vec![stop]);
    let mut simulation = Simulation::new(system, 0.1, &[0.0, 1.0], ExactSettings::default()).unwrap();
    let found = contacts(&mut simulation, 1);
    let touch = found[0].begin.as_ref().unwrap();
    // x = sin t reaches 0.5 at pi/6, with the speed cos(pi/6).
    assert!((touch.time - PI / 6.0).abs() < 1e-12, "{}", touch.time);
    let speed = (PI / 6.0).cos();
    assert!((touch.velocity - speed).abs() < 1e-12);
    assert!((found[0].end.unwrap() - touch.time - PI * 1e-4).abs() < 1e-3 * PI * 1e-4);
    // The spring pulls at 0.5 m for as long.
    assert!((found[0].impulse - 2.0 * speed + 0.5 * PI * 1e-4).abs() < 1e-6);
    assert!((found[0].peak_force / (speed * 1e4) - 1.0).abs() < 1e-4);
}

/// A contact that lasts over the ends of periods is one contact: the same as in one long period.
#[test]
fn contacts_are_joined_over_the_ends_of_periods() {
    let stop = || element(&[1.0], 0.0, Law::Linear(LinearStop::with_gap(3.0, 0.1).unwrap()));
    let system = || oscillator(1.0, 0.0, 0.0, vec![stop()]);
    let state = [0.0, 1.0];
    // Free motion: the frequency only cuts it into periods.
    let of = |frequency_hz: f64, periods: usize| {
        let mut simulation =
            Simulation::new(system(), frequency_hz, &state, ExactSettings::default()).unwrap();
        contacts(&mut simulation, periods)
    };
    let (whole, pieces) = (of(1.0 / 30.0, 1), of(1.0, 30));
    assert!(whole.len() >= 4 && whole.len() == pieces.len(), "{} {}", whole.len(), pieces.len());
    for (a, b) in whole.iter().zip(&pieces) {
        let (from, to) = (a.begin.as_ref().unwrap().time, b.begin.as_ref().unwrap().time);
        assert!((from - to).abs() < 1e-9 && (a.end.unwrap() - b.end.unwrap()).abs() < 1e-9);
        assert!((a.impulse - b.impulse).abs() < 1e-9 && (a.peak_force - b.peak_force).abs() < 1e-6);
    }
}

/// At a touch the clearance is zero, and the reported velocity agrees with the state.
#[test]
fn section_at_touches_lies_on_the_stop() {
    let mut simulation = settled(paper_beam(), 53.0, 100);
    let points = poincare(&mut simulation, PoincareSection::Touch { element: 0 }, 50).unwrap();
    assert!(points.len() > 50);
    let system = paper_beam();
    for point in points {
        let [r, velocity, _] = system.relative_motion(0, 53.0, point.phase, &point.state);
        assert!(r.abs() < 1e-15 + 1e-9 * velocity / 53.0, "{r}");
        assert!((velocity - point.impact_velocity).abs() < 1e-9 * velocity.abs());
    }
}

#[test]
fn stroboscopic_section_of_a_harmonic_motion_is_one_point() {
    let mut simulation = settled(paper_beam(), 36.0, 400);
    let points = poincare(&mut simulation, PoincareSection::Stroboscopic { phase: 0.25 }, 5).unwrap();
    let first = &points[0].state;
    let size = first.iter().fold(0.0_f64, |size, v| size.max(v.abs()));
    for point in &points {
        let off = point.state.iter().zip(first).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9 * size, "{off}");
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let settings = ExactSettings::default();
    let of = |frequency_hz, state: &[f64]| Simulation::new(paper_beam(), frequency_hz, state, settings);
    assert!(matches!(of(0.0, &[0.0; 12]), Err(AttractorError::Input { what: "the frequency", .. })));
    assert!(matches!(of(30.0, &[0.0; 3]), Err(AttractorError::StateLength { found: 3, expected: 12 })));
    assert!(matches!(of(30.0, &[f64::NAN; 12]), Err(AttractorError::Input { .. })));
    let mut simulation = simulation(paper_beam(), 30.0);
    assert!(matches!(simulation.period(2_000_000), Err(AttractorError::Input { .. })));
    let section = |section| poincare(&mut settled(paper_beam(), 30.0, 0), section, 1);
    assert!(matches!(section(PoincareSection::Touch { element: 7 }), Err(AttractorError::Input { .. })));
    assert!(matches!(
        section(PoincareSection::Stroboscopic { phase: 1.5 }),
        Err(AttractorError::Input { .. })
    ));
}
