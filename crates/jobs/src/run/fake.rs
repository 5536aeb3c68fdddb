//! A solver without mechanics: branches that are plain curves, for tests of running and storing.

use std::{
    f64::consts::TAU,
    sync::atomic::{AtomicUsize, Ordering},
};

use hammerbeam_orbit::{
    BranchEventKind, Crossing, EventSet, OrbitMaxima, PeriodicSolution, Side, StopReason,
};
use hammerbeam_results::{end::BranchEnd, row::SolvedRow};

use super::{BranchOrigin, OrbitMatcher, Solver, Surveyed, Walk};

/// Half the width of the ring.
const RADIUS_HZ: f64 = 4.0;

/// One branch for each period multiple of 1 and 2; the harmonic one overhangs.
pub(crate) struct FakeSolver {
    pub range_hz: [f64; 2],
    pub step: f64,
    /// Length of the states it makes.
    pub state_length: usize,
    /// Shooting nodes for each solution.
    pub segments: usize,
    /// Whether walks of two periods panic.
    pub panics: bool,
    /// Steps of a harmonic branch from one flip to the next, if it has any.
    pub flips: Option<i64>,
    /// Frequency at which walks of two periods are lost, if they come from above [Hz].
    pub lost_hz: Option<f64>,
    /// The branch of two periods is a closed curve, `15 + 4 sin s`, and its upper and lower sides are lost
    /// after so many steps, if they have not come round.
    pub ring: Option<[i64; 2]>,
    /// Why walks of two periods end after a few steps, if they do.
    pub given_up: Option<StopReason>,
    /// Walks that were taken up again.
    pub resumed: AtomicUsize,
}

impl Default for FakeSolver {
    fn default() -> Self {
        Self {
            range_hz: [10.0, 20.0],
            step: 0.01,
            state_length: 4,
            segments: 2,
            panics: false,
            flips: None,
            lost_hz: None,
            ring: None,
            given_up: None,
            resumed: AtomicUsize::new(0),
        }
    }
}

impl FakeSolver {
    /// The solution at arc length `s`: frequency `15 + s + 2 sin s` for the harmonic branch.
    pub fn solution(&self, multiple: u32, s: f64) -> PeriodicSolution {
        let way = match (multiple, self.ring) {
            (1, _) => s + 2.0 * s.sin(),
            (_, Some(_)) => RADIUS_HZ * s.sin(),
            (_, None) => s,
        };
        let frequency_hz = (15.0 + way).clamp(self.range_hz[0], self.range_hz[1]);
        let rate = if self.ring.is_some() { 1.0 } else { 0.7 };
        let displacement = f64::from(multiple) * (1.0 + 0.1 * (rate * s).cos());
        let node = |segment: usize| {
            (0..self.state_length).map(|i| (s + (segment * self.state_length + i) as f64).sin()).collect()
        };
        PeriodicSolution {
            phase: 0.0,
            frequency_hz,
            period_multiple: multiple,
            nodes: (0..self.segments).map(node).collect(),
            floquet_multipliers: vec![[(3.0 * s).sin() * 1.2, 0.25], [0.5, -0.25]],
            on_circle: Vec::new(),
            residual: 1e-12,
            error_estimate: 1e-10,
            maxima: OrbitMaxima { displacement, acceleration: 10.0 * displacement, ..OrbitMaxima::default() },
        }
    }

    /// Arc length of the branch of two periods at a frequency, if it comes there.
    fn arc_length(&self, frequency_hz: f64) -> Option<f64> {
        let way = frequency_hz - 15.0;
        if self.ring.is_none() {
            return Some(way);
        }
        (way.abs() <= RADIUS_HZ).then(|| (way / RADIUS_HZ).asin())
    }
}

impl Solver for FakeSolver {
    fn find_harmonic(
        &self,
        _frequency_hz: f64,
        _interrupted: hammerbeam_orbit::Interruption<'_>,
    ) -> Result<PeriodicSolution, String> {
        Ok(self.solution(1, 0.0))
    }

    /// One solution of two periods at every frequency, none of three.
    fn survey(
        &self,
        frequency_hz: f64,
        _width_hz: f64,
        multiples: &[u32],
        _interrupted: hammerbeam_orbit::Interruption<'_>,
    ) -> Result<Surveyed, String> {
        match self.arc_length(frequency_hz).filter(|_| multiples.contains(&2)) {
            Some(s) => Ok(Surveyed { solutions: vec![self.solution(2, s)], incomplete: None }),
            None => Err("no solution".to_owned()),
        }
    }

    fn resonances_hz(&self) -> Vec<f64> {
        Vec::new()
    }

    fn probe(
        &self,
        _frequency_hz: f64,
        _multiples: &[u32],
        _interrupted: hammerbeam_orbit::Interruption<'_>,
    ) -> Result<Surveyed, String> {
        Ok(Surveyed { solutions: Vec::new(), incomplete: None })
    }

    fn root(&self, crossing: &Crossing) -> Result<PeriodicSolution, String> {
        Ok(PeriodicSolution {
            period_multiple: crossing.factor * crossing.orbit.period_multiple,
            ..crossing.orbit.clone()
        })
    }

    fn begin<'a>(&'a self, origin: &BranchOrigin, side: Side) -> Result<Box<dyn Walk + 'a>, String> {
        let (multiple, frequency_hz) = match origin {
            BranchOrigin::Found(start) => (start.period_multiple, start.frequency_hz),
            BranchOrigin::Crossing(crossing) => {
                (crossing.factor * crossing.orbit.period_multiple, crossing.orbit.frequency_hz)
            }
        };
        let at = if multiple == 1 { Some(0.0) } else { self.arc_length(frequency_hz) };
        let at = at.ok_or("it does not come there")?;
        let steps = (at / self.step).round() as i64;
        let direction = if side == Side::Up { 1 } else { -1 };
        Ok(Box::new(FakeWalk { solver: self, multiple, steps, direction, journal: Vec::new(), walked: 0 }))
    }

    fn resume<'a>(&'a self, checkpoint: &[u8], journal: &[u8]) -> Result<Box<dyn Walk + 'a>, String> {
        self.resumed.fetch_add(1, Ordering::Relaxed);
        let number = |index: usize| {
            let bytes = checkpoint.get(8 * index..8 * index + 8).ok_or("the checkpoint is too short")?;
            Ok::<i64, String>(i64::from_le_bytes(bytes.try_into().expect("eight bytes")))
        };
        let multiple = u32::try_from(number(0)?).map_err(|error| error.to_string())?;
        let (steps, direction, walked) = (number(1)?, number(2)?, number(3)?);
        if journal.len() as i64 != walked {
            return Err(format!("the journal has {} steps, {walked} were walked", journal.len()));
        }
        Ok(Box::new(FakeWalk { solver: self, multiple, steps, direction, journal: Vec::new(), walked }))
    }

    fn matcher<'a>(&'a self, solution: &'a PeriodicSolution) -> Result<Box<dyn OrbitMatcher + 'a>, String> {
        Ok(Box::new(FakeMatch(solution)))
    }
}

struct FakeMatch<'a>(&'a PeriodicSolution);

impl OrbitMatcher for FakeMatch<'_> {
    fn distance(&self, (_, state): (f64, &[f64])) -> f64 {
        state.iter().zip(&self.0.nodes[0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    fn is_near(&self, guess: (f64, &[f64])) -> bool {
        self.distance(guess) < 1e-3
    }
}

struct FakeWalk<'a> {
    solver: &'a FakeSolver,
    multiple: u32,
    steps: i64,
    direction: i64,
    journal: Vec<u8>,
    walked: i64,
}

impl FakeWalk<'_> {
    /// Whether the walk comes to this frequency from above.
    fn is_lost(&self, frequency_hz: f64, lost_hz: f64) -> bool {
        let before_hz = frequency_hz + self.solver.step;
        self.multiple == 2 && self.direction < 0 && frequency_hz <= lost_hz && lost_hz < before_hz
    }
}

impl Walk for FakeWalk<'_> {
    fn step(&mut self, rows: &mut Vec<SolvedRow>) -> Result<Option<BranchEnd>, String> {
        assert!(!(self.solver.panics && self.multiple == 2), "a panic that was asked for");
        self.steps += self.direction;
        self.walked += 1;
        self.journal.push(1);
        let solution = self.solver.solution(self.multiple, self.steps as f64 * self.solver.step);
        let frequency_hz = solution.frequency_hz;
        let fold = self.multiple == 1 && self.steps % 209 == 0;
        let flip = self.multiple == 1 && self.solver.flips.is_some_and(|steps| self.steps % steps == 0);
        rows.push(SolvedRow {
            solution,
            parameter: frequency_hz,
            events: EventSet::of([(fold, BranchEventKind::Fold), (flip, BranchEventKind::Flip)]),
            located: None,
        });
        let [low, high] = self.solver.range_hz;
        let ring = self.solver.ring.filter(|_| self.multiple == 2);
        let lost_after = ring.map(|[up, down]| if self.direction > 0 { up } else { down });
        let is_lost_on_ring = lost_after == Some(self.walked);
        if is_lost_on_ring || self.solver.lost_hz.is_some_and(|lost| self.is_lost(frequency_hz, lost)) {
            let doubt = "lost where it was to be".to_owned();
            let reason = StopReason::StepTooShort {
                place: frequency_hz,
                step: 1e-9,
                residual: 1.0,
                doubt,
                has_no_losses: false,
            };
            return Ok(Some(reason.into()));
        }
        if let Some(reason) = self.solver.given_up.as_ref().filter(|_| self.multiple == 2 && self.walked == 5)
        {
            return Ok(Some(reason.clone().into()));
        }
        if ring.is_some() && self.walked as f64 * self.solver.step >= TAU {
            return Ok(Some(StopReason::Closed.into()));
        }
        let is_end = frequency_hz <= low || frequency_hz >= high;
        Ok(is_end.then_some(StopReason::RangeEnd { place: frequency_hz }.into()))
    }

    fn checkpoint(&self) -> Option<Vec<u8>> {
        let numbers = [i64::from(self.multiple), self.steps, self.direction, self.walked];
        Some(numbers.iter().flat_map(|number| number.to_le_bytes()).collect())
    }

    fn take_journal(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.journal)
    }
}
