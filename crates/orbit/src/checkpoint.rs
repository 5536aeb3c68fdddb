//! Storing a walk between two steps, and taking it up again with the same bits.
//!
//! A walk is stored in two parts: the *checkpoint*, all that the follower knows (a few kilobytes, replaced
//! every time), and the *journal*, the accepted points by which the follower recognises a stretch that it has
//! walked before (appended to). All numbers are little-endian, floats by their bits.

mod bytes;

use hammerbeam_motion::{Parameter, System};
use hammerbeam_path::{
    Checkpoint, Counters, Follower, History, Node, ParameterRange, PathState, PathStop, TestRecord,
};

use crate::{
    BranchWalk, OrbitError, OrbitSettings, Response,
    continuation_parameter::ContinuationParameter,
    shooting::ShootingProblem,
    solve::integrator,
    state_scale::{StateScale, state_of_rest},
    walk::{
        Effort, Growth, LastRows, OrbitPath, Origin, RowPlace, RowRecord, counted_operations,
        length_per_norm, path_settings,
    },
};
use bytes::{Reader, Writer};

/// First word of a checkpoint; the last digit is the version of the format.
const MAGIC: u64 = 0x4842_5741_4c4b_000d;

impl BranchWalk {
    /// All that is needed, beside the journal, to go on from the present point.
    #[must_use]
    pub fn checkpoint(&self) -> Vec<u8> {
        let mut out = Writer::default();
        let Self { path, record, growth, effort, starts_with_present } = self;
        let (state, tests) = (path.follower.state(), path.follower.tests());
        out.word(MAGIC);
        write_varied(&mut out, path.problem.period_multiple(), path.problem.varied());
        out.word(path.problem.segments() as u64);
        out.float(path.problem.phase());
        out.word(u64::from(path.problem.is_asymmetric()));
        out.floats(path.problem.scale().values());
        out.point(&state.current);
        out.point(&state.start);
        out.word(state.history.used as u64);
        out.word(state.history.nodes.len() as u64);
        for node in &state.history.nodes {
            out.floats(&node.point);
            out.floats(&node.tangent);
        }
        out.word(state.most_earlier as u64);
        for value in [state.step_length, state.orientation, state.parameter_sign, state.change_ahead] {
            out.float(value);
        }
        out.floats(&state.units);
        out.tests(&tests.values);
        out.tests(&tests.before);
        out.floats(&tests.noted);
        out.word(u64::from(tests.zeros_near));
        out.word(numbers_word(state.outside));
        let Counters { evaluations, factorisations, accepted, rejected, short_steps } =
            path.follower.counters();
        let counts = [evaluations, factorisations, accepted, rejected, short_steps];
        counts.iter().for_each(|&count| out.word(count));
        out.word(record.evaluations_between);
        out.word(end_word(state.stop));
        out.word(record.last_rows.0.len() as u64);
        for place in &record.last_rows.0 {
            [place.arc_length, place.frequency_hz, place.displacement]
                .iter()
                .for_each(|&value| out.float(value));
        }
        out.word(record.touches.len() as u64);
        record.touches.iter().for_each(|&touches| out.word(u64::from(touches)));
        out.word(numbers_word(record.outside));
        out.word(u64::from(*starts_with_present));
        out.word(u64::from(path.origin.is_some()));
        if let Some(origin) = &path.origin {
            out.float(origin.phase);
            out.point(&origin.point);
        }
        out.float(growth.amplitude);
        out.float(growth.parameter);
        out.word(self.operations());
        out.word(effort.mark.0);
        out.float(effort.mark.1);
        out.bytes
    }

    /// The points accepted since the journal was taken last, the start first. A point without unknowns marks
    /// that those before it are to be forgotten.
    #[must_use]
    pub fn take_journal(&mut self) -> Vec<u8> {
        let mut out = Writer::default();
        self.path.journal.drain(..).for_each(|point| out.point(&point));
        out.bytes
    }

    /// Takes up a walk from its checkpoint and the whole of its journal.
    ///
    /// # Errors
    /// [`OrbitError::Checkpoint`] if the bytes do not belong to a walk of this system; [`OrbitError::Path`]
    /// for an empty range.
    pub fn resume(
        system: &System,
        response: &Response,
        (checkpoint, journal): (&[u8], &[u8]),
        range: (f64, f64),
        settings: &OrbitSettings,
    ) -> Result<Self, OrbitError> {
        let mut reader = Reader { bytes: checkpoint };
        let length = length_per_norm(range);
        let Stored { mut problem, state, evaluations_between, last_rows } =
            read(&mut reader, system, response, (settings, length)).ok_or(OrbitError::Checkpoint)??;
        let beside = read_walk(&mut reader, problem.node_size() + 1).ok_or(OrbitError::Checkpoint)?;
        if settings.locates_stability_changes {
            problem.watch_stability();
        }
        let within = ParameterRange::new(range.0, range.1)?;
        let mut follower =
            Follower::resume(&mut problem, state, within, path_settings(settings, system, length));
        let mut reader = Reader { bytes: journal };
        let shortest = problem.node_size() + 1;
        while !reader.bytes.is_empty() {
            let point = reader.point().ok_or(OrbitError::Checkpoint)?;
            if point.point.is_empty() {
                follower.forget();
                continue;
            }
            if point.point.len() < shortest || point.tangent.len() != point.point.len() {
                return Err(OrbitError::Checkpoint);
            }
            follower.remember(&point);
        }
        let (journal, settings) = (Vec::new(), *settings);
        let Beside { touches, outside, starts_with_present, origin, growth, effort } = beside;
        let path = OrbitPath { problem, follower, settings, range, journal, origin, measures_anew: false };
        let record =
            RowRecord { touches, outside, last_rows, shape: response.shape.clone(), evaluations_between };
        let mut walk = Self { path, record, growth, effort, starts_with_present };
        walk.effort.counted = counted_operations(&walk.path, walk.evaluations());
        Ok(walk)
    }
}

/// What a checkpoint holds.
struct Stored {
    problem: ShootingProblem,
    state: Checkpoint,
    evaluations_between: u64,
    last_rows: LastRows,
}

/// What a checkpoint holds; `None` if the bytes do not fit.
fn read(
    reader: &mut Reader<'_>,
    system: &System,
    response: &Response,
    (settings, length): (&OrbitSettings, f64),
) -> Option<Result<Stored, OrbitError>> {
    if reader.word()? != MAGIC {
        return None;
    }
    let (period_multiple, varied) = read_varied(reader)?;
    let segments = usize::try_from(reader.word()?).ok()?;
    let phase = reader.float()?;
    let is_asymmetric = reader.word()? != 0;
    let scale = StateScale::from_values(reader.floats()?);
    let on_orbit = (0.0..f64::from(period_multiple)).contains(&phase);
    if scale.values().len() != 2 * system.dof() || segments == 0 || !on_orbit {
        return None;
    }
    let scale = scale.about(state_of_rest(system));
    let point_length = segments.checked_mul(scale.values().len())?.checked_add(1)?;
    let integrator = match integrator(system, response, settings) {
        Ok(integrator) => integrator,
        Err(error) => return Some(Err(error)),
    };
    let mut state = read_follower(reader, point_length)?;
    if ![1, scale.values().len()].contains(&state.state.units.len()) {
        return None;
    }
    let evaluations_between = reader.word()?;
    state.state.stop = end_of_word(reader.word()?)?;
    let mut last_rows = LastRows::default();
    for _ in 0..reader.word()? {
        last_rows.0.push(RowPlace {
            arc_length: reader.float()?,
            frequency_hz: reader.float()?,
            displacement: reader.float()?,
        });
    }
    let mut problem =
        ShootingProblem::new(integrator, (period_multiple, segments), scale, length).starting_at(phase);
    problem.set_asymmetric(is_asymmetric);
    if let Err(error) = problem.vary(varied) {
        return Some(Err(error.into()));
    }
    Some(Ok(Stored { problem, state, evaluations_between, last_rows }))
}

/// The follower, but for why it stopped; `None` if its points do not have this length.
fn read_follower(reader: &mut Reader<'_>, point_length: usize) -> Option<Checkpoint> {
    let (current, start) = (reader.point()?, reader.point()?);
    let used = usize::try_from(reader.word()?).ok()?;
    let mut nodes = Vec::new();
    for _ in 0..reader.word()? {
        nodes.push(Node { point: reader.floats()?, tangent: reader.floats()? });
    }
    let history = History { nodes, used };
    let fits = |values: &[f64]| values.len() == point_length;
    let points = [&current.point, &current.tangent, &start.point, &start.tangent];
    let of_nodes = history.nodes.iter().flat_map(|node| [&node.point, &node.tangent]);
    if used == 0
        || used > history.nodes.len()
        || !points.into_iter().chain(of_nodes).all(|values| fits(values))
    {
        return None;
    }
    let mut state = PathState {
        current,
        start,
        history,
        most_earlier: usize::try_from(reader.word()?).ok()?,
        step_length: reader.float()?,
        orientation: reader.float()?,
        parameter_sign: reader.float()?,
        change_ahead: reader.float()?,
        units: reader.floats()?,
        outside: None,
        stop: None,
    };
    let tests = TestRecord {
        values: reader.tests()?,
        before: reader.tests()?,
        noted: reader.floats()?,
        zeros_near: u32::try_from(reader.word()?).ok()?,
    };
    state.outside = numbers_of(reader.word()?);
    let counters = Counters {
        evaluations: reader.word()?,
        factorisations: reader.word()?,
        accepted: reader.word()?,
        rejected: reader.word()?,
        short_steps: reader.word()?,
    };
    Some(Checkpoint { state, tests, counters })
}

/// The period and what varies: a word with the period below and the code of the parameter above, 0 for the
/// frequency, and the fixed frequency, if there is one.
fn write_varied(out: &mut Writer, period_multiple: u32, varied: ContinuationParameter) {
    let (kind, number) = varied.parameter().map_or((0, 0), Parameter::code);
    out.word(u64::from(period_multiple) | u64::from(kind) << 32 | (number as u64) << 40);
    if let ContinuationParameter::Other { frequency_hz, .. } = varied {
        out.float(frequency_hz);
    }
}

fn read_varied(reader: &mut Reader<'_>) -> Option<(u32, ContinuationParameter)> {
    let word = reader.word()?;
    let (kind, number) = ((word >> 32) as u8, usize::try_from(word >> 40).ok()?);
    if kind == 0 {
        return Some((word as u32, ContinuationParameter::Frequency));
    }
    let parameter = Parameter::of_code((kind, number))?;
    Some((word as u32, ContinuationParameter::Other { parameter, frequency_hz: reader.float()? }))
}

/// What a walk knows beside its follower.
struct Beside {
    touches: Vec<u32>,
    outside: Option<(u32, u32)>,
    starts_with_present: bool,
    origin: Option<Origin>,
    growth: Growth,
    effort: Effort,
}

/// What a walk knows beside its follower, the start as an orbit of one segment, of that length; `None` if the
/// bytes do not fit or are too many.
fn read_walk(reader: &mut Reader<'_>, length: usize) -> Option<Beside> {
    let touches = (0..reader.word()?).map(|_| u32::try_from(reader.word()?).ok()).collect::<Option<_>>()?;
    let outside = numbers_of(reader.word()?);
    let starts_with_present = reader.word()? != 0;
    let origin = match reader.word()? {
        0 => None,
        _ => Some(Origin { phase: reader.float()?, point: reader.point()? }),
    };
    let growth = Growth { amplitude: reader.float()?, parameter: reader.float()? };
    let effort = Effort { spent: reader.word()?, mark: (reader.word()?, reader.float()?), counted: 0 };
    let fits = origin
        .as_ref()
        .is_none_or(|origin| origin.point.point.len() == length && origin.point.tangent.len() == length);
    (fits && reader.bytes.is_empty()).then_some(Beside {
        touches,
        outside,
        starts_with_present,
        origin,
        growth,
        effort,
    })
}

/// Two small numbers, or the largest word where they are not known.
fn numbers_word(numbers: Option<(u32, u32)>) -> u64 {
    numbers.map_or(u64::MAX, |(least, most)| u64::from(most) << 32 | u64::from(least))
}

fn numbers_of(word: u64) -> Option<(u32, u32)> {
    (word != u64::MAX).then_some(((word & 0xffff_ffff) as u32, (word >> 32) as u32))
}

/// The ends at which the last point already lies. A walk that stopped for another reason may be tried again.
fn end_word(stop: Option<PathStop>) -> u64 {
    match stop {
        Some(PathStop::RangeEnd) => 1,
        Some(PathStop::Closed) => 2,
        _ => 0,
    }
}

fn end_of_word(word: u64) -> Option<Option<PathStop>> {
    match word {
        0 => Some(None),
        1 => Some(Some(PathStop::RangeEnd)),
        2 => Some(Some(PathStop::Closed)),
        _ => None,
    }
}
