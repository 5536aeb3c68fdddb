//! Motions in time: what `simulate` wrote down, in chunks of whole periods, each with what the motion needs
//! to go on behind it with the same bits.
//!
//! Samples and sections are kept as numbers, so that tables are written without computing anything again.
//! Where the chunks are cut changes nothing in what they hold together.

use hammerbeam_attractor::{ContactRecord, SimulationCheckpoint};
use hammerbeam_motion::exact::{Jump, Touchdown};
use rusqlite::{Connection, Row as SqlRow, Transaction, params};

use super::{
    StoreError, blob, requests,
    simulation_layout::{SimulationLayout, check_length},
};

/// Periods of a motion that follow one another.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SimulatedChunk {
    /// Their number; those of a transient leave only the checkpoint.
    pub periods: u64,
    /// Of each sample: displacement [m], velocity [m/s] and acceleration [m/s^2] of the response point, then
    /// relative displacement [m] and force [N] of every local element.
    pub samples: Vec<f64>,
    /// Of each period, at the phase of the section: displacement [m] and velocity [m/s] of the response
    /// point, then the modal state.
    pub section: Vec<f64>,
    /// Contacts that ended in these periods, in the order in which they ended.
    pub contacts: Vec<SimulatedContact>,
    /// Those that are closed at the end.
    pub unfinished: Vec<SimulatedContact>,
    /// Where the motion is at the end.
    pub checkpoint: SimulationCheckpoint,
}

/// A contact of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedContact {
    /// Number of the local element.
    pub element: usize,
    /// The touch; `None` if it was closed when the first period was written down.
    pub touch: Option<SimulatedTouch>,
    /// When it opened [s]; `None` if it was still closed.
    pub end_s: Option<f64>,
    /// Integral of the magnitude of the force [N s].
    pub impulse: f64,
    /// Largest magnitude of the force [N].
    pub peak_force: f64,
    /// Energy that the structure did not get back [J].
    pub energy_lost: f64,
}

/// A touch: a point of the section at this contact.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulatedTouch {
    /// When it was [s].
    pub time_s: f64,
    /// Phase of the excitation [cycles].
    pub phase: f64,
    /// Speed of the impact [m/s].
    pub speed: f64,
    /// Displacement [m] and velocity [m/s] of the response point.
    pub response: [f64; 2],
}

/// Numbers of an open contact of a checkpoint, besides the states at its touch and right after that.
const OF_OPEN: usize = 8;

impl SimulatedContact {
    /// Numbers that it takes in the store.
    pub const NUMBERS: usize = 10;
}

impl SimulatedChunk {
    /// Whether the chunk has the lengths that follow from its number of periods.
    ///
    /// * `first`: the number of periods before it.
    fn check(&self, first: u64, layout: &SimulationLayout) -> Result<(), StoreError> {
        let written = |done: u64| done.saturating_sub(layout.transient_periods) as usize;
        let (before, after) = (written(first), written(first.saturating_add(self.periods)));
        let periods = after - before;
        let per_period = layout.samples_per_period as usize * layout.numbers_of_sample();
        check_length("samples of a motion", self.samples.len(), periods.saturating_mul(per_period))?;
        let section = periods.saturating_mul(layout.numbers_of_section());
        check_length("section of a motion", self.section.len(), section)?;
        let checkpoint = &self.checkpoint;
        check_length("state of a motion", checkpoint.state.len(), 2 * layout.dof)?;
        if !checkpoint.impact_speeds.is_empty() {
            check_length(
                "remembered impacts of a motion",
                checkpoint.impact_speeds.len(),
                layout.elements.len(),
            )?;
        }
        if checkpoint.periods != after as u64 {
            let found = checkpoint.periods.to_string();
            return Err(StoreError::Unknown { what: "number of periods of a checkpoint", found });
        }
        let contacts = self.contacts.iter().chain(&self.unfinished).map(|contact| contact.element);
        let mut elements = contacts.chain(checkpoint.open.iter().map(|record| record.element));
        elements.try_for_each(|element| layout.check_element(element))
    }
}

/// Goes through the chunks of a request, in their order; all is of one moment, even while a command
/// writes.
pub fn each_simulated<E: From<StoreError>>(
    connection: &Connection,
    request: i64,
    layout: &SimulationLayout,
    mut take: impl FnMut(SimulatedChunk) -> Result<(), E>,
) -> Result<(), E> {
    let select = "SELECT done, first, periods, samples, section, contacts, unfinished, observed, state,
        open, impact_speeds FROM request LEFT JOIN simulated ON simulated.request = request.id
        WHERE request.id = ?1 ORDER BY first";
    let mut statement = connection.prepare(select).map_err(StoreError::from)?;
    let mut rows = statement.query([request]).map_err(StoreError::from)?;
    let (mut found, mut done) = (0_u64, 0);
    let damaged = |found, done| E::from(StoreError::DamagedMotion { request, found, done });
    while let Some(row) = rows.next().map_err(StoreError::from)? {
        done = count(row, 0)?;
        let first: Option<i64> = row.get(1).map_err(StoreError::from)?;
        // A request without chunks has one row, without them.
        let Some(first) = first else { break };
        if u64::try_from(first) != Ok(found) {
            return Err(damaged(found, done));
        }
        let chunk = chunk(row)?;
        chunk.check(found, layout)?;
        found = found.saturating_add(chunk.periods);
        take(chunk)?;
    }
    if found == done { Ok(()) } else { Err(damaged(found, done)) }
}

/// Adds periods to a request.
pub fn append_simulated(
    transaction: Transaction<'_>,
    request: i64,
    first: u64,
    chunk: &SimulatedChunk,
) -> Result<(), StoreError> {
    requests::advance(&transaction, request, (first, first + chunk.periods))?;
    let SimulationCheckpoint { state, periods: observed, open, impact_speeds } = &chunk.checkpoint;
    let insert = "INSERT INTO simulated (request, first, periods, samples, section, contacts, unfinished,
        observed, state, open, impact_speeds)
        VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)";
    let values = params![
        request,
        first as i64,
        chunk.periods as i64,
        blob::pack(&chunk.samples),
        blob::pack(&chunk.section),
        blob::pack(chunk.contacts.iter().map(numbers_of).collect::<Vec<_>>().iter().flatten()),
        blob::pack(chunk.unfinished.iter().map(numbers_of).collect::<Vec<_>>().iter().flatten()),
        *observed as i64,
        blob::pack(state),
        blob::pack(&open.iter().flat_map(|record| open_numbers(record, state.len())).collect::<Vec<_>>()),
        blob::pack(impact_speeds),
    ];
    transaction.execute(insert, values)?;
    transaction.commit()?;
    Ok(())
}
fn chunk(row: &SqlRow<'_>) -> Result<SimulatedChunk, StoreError> {
    Ok(SimulatedChunk {
        periods: count(row, 2)?,
        samples: numbers(row, 3, "samples of a motion", 1)?,
        section: numbers(row, 4, "section of a motion", 1)?,
        contacts: contacts(row, 5)?,
        unfinished: contacts(row, 6)?,
        checkpoint: checkpoint(row)?,
    })
}

/// A number of periods.
fn count(row: &SqlRow<'_>, place: usize) -> Result<u64, StoreError> {
    let number: i64 = row.get(place)?;
    let unknown = |_| StoreError::Unknown { what: "number of periods", found: number.to_string() };
    u64::try_from(number).map_err(unknown)
}

/// The number of an element or of a contact.
fn index(number: f64) -> Result<usize, StoreError> {
    let whole = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
    let unknown = || StoreError::Unknown { what: "number in a contact", found: number.to_string() };
    whole.then_some(number as usize).ok_or_else(unknown)
}

/// Numbers that come in rows of a width.
fn numbers(row: &SqlRow<'_>, place: usize, what: &'static str, width: usize) -> Result<Vec<f64>, StoreError> {
    let bytes: Vec<u8> = row.get(place)?;
    // Bytes of a part of a row are refused as one row more than there is.
    let expected = bytes.len().div_ceil(8 * width) * width;
    blob::unpack(what, &bytes, expected)
}

/// What is not there is stored as no number.
fn numbers_of(contact: &SimulatedContact) -> [f64; SimulatedContact::NUMBERS] {
    let of_touch = |read: fn(&SimulatedTouch) -> f64| contact.touch.as_ref().map_or(f64::NAN, read);
    [
        contact.element as f64,
        of_touch(|touch| touch.time_s),
        of_touch(|touch| touch.phase),
        of_touch(|touch| touch.speed),
        of_touch(|touch| touch.response[0]),
        of_touch(|touch| touch.response[1]),
        contact.end_s.unwrap_or(f64::NAN),
        contact.impulse,
        contact.peak_force,
        contact.energy_lost,
    ]
}

fn contacts(row: &SqlRow<'_>, place: usize) -> Result<Vec<SimulatedContact>, StoreError> {
    let numbers = numbers(row, place, "contacts of a motion", SimulatedContact::NUMBERS)?;
    let contact = |[
        element,
        time_s,
        phase,
        speed,
        displacement,
        velocity,
        end_s,
        impulse,
        peak_force,
        energy_lost,
    ]: &[f64; SimulatedContact::NUMBERS]| {
        let touch = SimulatedTouch {
            time_s: *time_s,
            phase: *phase,
            speed: *speed,
            response: [*displacement, *velocity],
        };
        Ok(SimulatedContact {
            element: index(*element)?,
            touch: some(*time_s).map(|_| touch),
            end_s: some(*end_s),
            impulse: *impulse,
            peak_force: *peak_force,
            energy_lost: *energy_lost,
        })
    };
    numbers.as_chunks().0.iter().map(contact).collect()
}

fn some(number: f64) -> Option<f64> {
    (!number.is_nan()).then_some(number)
}

/// A contact that is open in a checkpoint: [`OF_OPEN`] numbers, the state at its touch, and that right after
/// it.
fn open_numbers(record: &ContactRecord, state_length: usize) -> Vec<f64> {
    let nothing = vec![f64::NAN; state_length];
    let (touch, jump) = (record.begin.as_ref(), record.jump.as_ref());
    let mut numbers = vec![
        record.element as f64,
        record.contact as f64,
        record.impulse,
        record.peak_force,
        record.energy_lost,
        touch.map_or(f64::NAN, |touch| touch.time),
        touch.map_or(f64::NAN, |touch| touch.velocity),
        jump.map_or(f64::NAN, |jump| jump.impulse),
    ];
    numbers.extend(touch.map_or(&nothing, |touch| &touch.state));
    numbers.extend(jump.map_or(&nothing, |jump| &jump.state));
    numbers
}

fn checkpoint(row: &SqlRow<'_>) -> Result<SimulationCheckpoint, StoreError> {
    let state = numbers(row, 8, "state of a motion", 1)?;
    let width = OF_OPEN + 2 * state.len();
    let open = numbers(row, 9, "open contacts of a motion", width)?;
    Ok(SimulationCheckpoint {
        periods: count(row, 7)?,
        open: open
            .chunks_exact(width)
            .map(|numbers| open_record(numbers, state.len()))
            .collect::<Result<_, _>>()?,
        impact_speeds: numbers(row, 10, "remembered impacts of a motion", 1)?,
        state,
    })
}

fn open_record(numbers: &[f64], state_length: usize) -> Result<ContactRecord, StoreError> {
    let (first, states) = numbers.split_at(OF_OPEN);
    let (at, behind) = states.split_at(state_length);
    Ok(ContactRecord {
        element: index(first[0])?,
        contact: index(first[1])?,
        begin: some(first[5]).map(|time| Touchdown { time, velocity: first[6], state: at.to_vec() }),
        jump: some(first[7]).map(|impulse| Jump { impulse, state: behind.to_vec() }),
        end: None,
        impulse: first[2],
        peak_force: first[3],
        energy_lost: first[4],
    })
}
