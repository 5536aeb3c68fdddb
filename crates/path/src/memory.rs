//! The memory of a branch: has this stretch been walked before?
//!
//! Every accepted point is kept as a *sketch*, a projection of `√w_i z_i` to eight numbers (all of them when
//! `n + 1 ≤ 8`, else the parameter and seven sums with fixed random signs, which keep lengths on average),
//! with its tangent: 170 bytes a point whatever `n`, and up to a hundred more of cells where steps are as
//! long as they may be. Only the unknowns with [memory weights](crate::Judge::memory_weights) count, so
//! points of the same path in other unknowns compare. Neighbouring points make a segment with its cubic
//! Hermite interpolant. Segments are found through square cells in the plane of the first two sketch
//! coordinates. Where the unknowns have outgrown the units of the start, steps are long in these: such a
//! segment is in cells that are larger by a power of four, so that none is in more than some forty, whatever
//! its length.
//!
//! A point is on a stored stretch if it is within the tolerance of the interpolant (and a tenth of the
//! segment's length), runs parallel to it, has its signature, and its determinant. A stretch walked with the
//! same orientation must be met in the same direction: the returning sheet of a narrow fold, which runs the
//! other way, is not a retrace. Close behind a corner nothing is met that lies close before it, but for what
//! is the same to rounding; the segment that ends at the corner, or behind it where the judge computed it, is
//! not met at all.

use std::collections::HashMap;

use crate::{corrector::Candidate, point::ContinuationPoint, settings::Settings, state::in_units};

const SKETCH: usize = 8;
const NONE: u32 = u32::MAX;
/// Cells along the longest step: among dense folds, where steps are short, thousands of segments would lie in
/// a cell as long as that.
const CELLS_A_STEP: f64 = 4.0;
/// Cells of one size along a segment; a longer one is in larger cells. A step that is as long as it may be
/// has half as many.
const MOST_CELLS: f64 = 16.0;
/// Size of a cell over the size of the next smaller ones.
const LARGER: f64 = 4.0;
/// Segments this recent belong to the step that is being made.
const RECENT: usize = 2;
/// Up to so many times the largest defect behind a corner nothing is met that lies as near before it, unless
/// it is the same but for rounding: where several paths meet, the one on which the path goes on is as near to
/// the one on which it came.
const BESIDE_CORNER: f64 = 10.0;
/// Errors of points after the shortest steps, in what rounding leaves of a correction.
const ROUNDED: f64 = 100.0;

type Sketch = [f64; SKETCH];
/// Size, as a power, and place of a cell.
type Cell = (i32, i64, i64);

#[derive(Debug, Clone)]
struct Vertex {
    place: Sketch,
    tangent: Sketch,
    arc_length: f64,
    orientation: f64,
    log_determinant: f64,
    signature: u64,
}

/// How near a stretch is met.
#[derive(Debug, Clone, Copy)]
struct Nearness {
    /// Of points.
    tolerance: f64,
    rounding: f64,
    /// The step does not lead away from the last corner: of stretches beside it only what is the same to
    /// rounding is met.
    is_beside: bool,
}

/// All accepted points of one follower in order, indexed by place.
#[derive(Debug, Clone)]
pub(crate) struct PathMemory {
    roots: Vec<f64>,
    cell: f64,
    tolerance: f64,
    rounding: f64,
    largest_defect: f64,
    vertices: Vec<Vertex>,
    /// Arc length of the last corner.
    corner: f64,
    heads: HashMap<Cell, u32>,
    /// Sizes of cells that are in use.
    sizes: i32,
    /// (segment, next link of the same cell); segment `k` ends at vertex `k`.
    links: Vec<(u32, u32)>,
}

impl PathMemory {
    /// * `weights`: the memory weights of the problem.
    pub fn new(weights: &[f64], settings: &Settings) -> Self {
        let parameter_root = weights[weights.len() - 1].sqrt();
        Self {
            roots: weights.iter().map(|w| w.sqrt()).collect(),
            cell: settings.max_step_length.min(4.0 * settings.max_parameter_step * parameter_root)
                / CELLS_A_STEP,
            tolerance: 10.0 * settings.correction_tolerance,
            rounding: ROUNDED * settings.correction_floor,
            largest_defect: settings.sheet_distance,
            vertices: Vec::new(),
            corner: f64::NEG_INFINITY,
            heads: HashMap::new(),
            sizes: 1,
            links: Vec::new(),
        }
    }

    /// Adds the next accepted point of the branch, whose unknowns have these units (one for the units of the
    /// memory).
    pub fn remember(&mut self, point: &ContinuationPoint, units: &[f64]) {
        let tangent = in_units(&point.tangent, units);
        let vertex = Vertex {
            place: self.sketch(&in_units(&point.point, units)),
            tangent: self.sketch(&tangent),
            arc_length: point.arc_length,
            orientation: point.orientation,
            log_determinant: self.log_determinant(point.log_determinant, &tangent),
            signature: point.signature,
        };
        if point.events.corner {
            self.corner = point.arc_length;
        }
        self.vertices.push(vertex);
        // A segment that ends at a corner has the tangent behind it, and so no interpolant.
        if self.vertices.len() > 1 && !point.events.corner {
            self.enter_cells(self.vertices.len() - 1);
        }
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.corner = f64::NEG_INFINITY;
        self.heads.clear();
        self.sizes = 1;
        self.links.clear();
    }

    /// Arc length of an earlier stretch that runs through this (oriented) candidate, if there is one.
    pub fn meets(&self, candidate: &Candidate, orientation: f64, units: &[f64]) -> Option<f64> {
        let tangent = in_units(&candidate.node.tangent, units);
        let probe = Vertex {
            place: self.sketch(&in_units(&candidate.node.point, units)),
            tangent: self.sketch(&tangent),
            arc_length: 0.0,
            orientation,
            log_determinant: self.log_determinant(candidate.log_determinant, &tangent),
            signature: candidate.signature,
        };
        // Points are as accurate as their units are large; the largest bounds all.
        let unit = units.iter().fold(1.0, |most: f64, &unit| most.max(unit));
        let near = Nearness {
            tolerance: unit * self.tolerance,
            rounding: unit * self.rounding,
            is_beside: self.is_beside_corner(&probe),
        };
        (0..self.sizes).find_map(|size| {
            let (_, i, j) = self.cell_of(size, &probe.place);
            (-1..=1)
                .flat_map(|di| (-1..=1).map(move |dj| (size, i.saturating_add(di), j.saturating_add(dj))))
                .find_map(|cell| self.meets_in(cell, &probe, near))
        })
    }

    /// How far beside a corner is.
    fn beside(&self) -> f64 {
        BESIDE_CORNER * self.largest_defect
    }

    /// Whether a step to here does not lead away from the last corner.
    fn is_beside_corner(&self, probe: &Vertex) -> bool {
        let step = |last: &Vertex| norm(&subtract(&probe.place, &last.place));
        let ends = self.vertices.last().map_or(0.0, |last| last.arc_length + step(last));
        ends - self.corner < self.beside()
    }

    fn meets_in(&self, cell: Cell, probe: &Vertex, near: Nearness) -> Option<f64> {
        let mut link = self.heads.get(&cell).copied().unwrap_or(NONE);
        while link != NONE {
            let (segment, next) = self.links[link as usize];
            let segment = segment as usize;
            let is_recent = segment + RECENT >= self.vertices.len();
            // What lies before a corner belongs to no step behind it.
            if !is_recent || near.is_beside && self.vertices[segment].arc_length <= self.corner {
                let found = self.meets_segment(segment, probe, near);
                if found.is_some() {
                    return found;
                }
            }
            link = next;
        }
        None
    }

    fn meets_segment(&self, segment: usize, probe: &Vertex, near: Nearness) -> Option<f64> {
        let (a, b) = (&self.vertices[segment - 1], &self.vertices[segment]);
        let margin = near.tolerance + self.largest_defect;
        let (low, high) = (a.place[0].min(b.place[0]), a.place[0].max(b.place[0]));
        let is_near = probe.place[0] >= low - margin && probe.place[0] <= high + margin;
        if !is_near || !same_kind(a, b, probe) {
            return None;
        }
        let (share, distance, cosine) = nearest(a, b, probe)?;
        let wanted = if a.orientation == probe.orientation { cosine } else { -cosine };
        let allowed = if near.is_beside && b.arc_length > self.corner - self.beside() {
            near.rounding
        } else {
            near.tolerance + 0.25 * defect(a, b).min(self.largest_defect)
        };
        let tolerance = allowed.min(0.1 * length(a, b));
        let met = distance <= tolerance && wanted > 0.99;
        met.then_some(a.arc_length + share * (b.arc_length - a.arc_length))
    }

    /// `ln |det|` with the tangent at unit length in the norm of the memory.
    fn log_determinant(&self, log_determinant: f64, tangent: &[f64]) -> f64 {
        let (unknowns, parameter) = (self.roots.len() - 1, tangent.len() - 1);
        let kept = tangent[..unknowns].iter().chain([&tangent[parameter]]);
        let square: f64 = kept.zip(&self.roots).map(|(t, r)| (t * r).powi(2)).sum();
        log_determinant + 0.5 * square.ln()
    }

    /// The parameter first, then `√w x` itself or seven signed sums of it.
    fn sketch(&self, z: &[f64]) -> Sketch {
        let n = self.roots.len() - 1;
        let mut sketch = [0.0; SKETCH];
        sketch[0] = self.roots[n] * z[z.len() - 1];
        if n < SKETCH {
            for i in 0..n {
                sketch[i + 1] = self.roots[i] * z[i];
            }
            return sketch;
        }
        let size = 1.0 / ((SKETCH - 1) as f64).sqrt();
        for i in 0..n {
            let value = size * self.roots[i] * z[i];
            let bits = mix(i as u64);
            for (j, s) in sketch[1..].iter_mut().enumerate() {
                *s += if (bits >> j) & 1 == 0 { value } else { -value };
            }
        }
        sketch
    }

    fn cell_of(&self, size: i32, place: &Sketch) -> Cell {
        let cell = self.cell * LARGER.powi(size);
        (size, (place[0] / cell).floor() as i64, (place[1] / cell).floor() as i64)
    }

    /// Enters the segment that ends at vertex `k` into the cells along it, half a cell apart at most.
    fn enter_cells(&mut self, k: usize) {
        let (a, b) = (self.vertices[k - 1].place, self.vertices[k].place);
        let span = (b[0] - a[0]).abs().max((b[1] - a[1]).abs());
        let cells = span / self.cell;
        let size = (cells / MOST_CELLS).log(LARGER).ceil().max(0.0) as i32;
        self.sizes = self.sizes.max(size + 1);
        let samples = (2.0 * cells / LARGER.powi(size)).ceil().clamp(1.0, 2.0 * MOST_CELLS) as usize;
        let mut last = None;
        for i in 0..=samples {
            let share = i as f64 / samples as f64;
            let mut place = a;
            place[0] += share * (b[0] - a[0]);
            place[1] += share * (b[1] - a[1]);
            let cell = self.cell_of(size, &place);
            if last != Some(cell) {
                let next = self.heads.insert(cell, self.links.len() as u32).unwrap_or(NONE);
                self.links.push((k as u32, next));
                last = Some(cell);
            }
        }
    }
}

/// Signature of either end, and a determinant as on the segment: interpolation leaves it some room.
fn same_kind(a: &Vertex, b: &Vertex, probe: &Vertex) -> bool {
    let (low, high) = (a.log_determinant.min(b.log_determinant), a.log_determinant.max(b.log_determinant));
    let room = 0.1 + 0.25 * (high - low);
    let signature = probe.signature == a.signature || probe.signature == b.signature;
    signature && probe.log_determinant >= low - room && probe.log_determinant <= high + room
}

/// Share of the segment, distance and cosine between the tangents at the nearest place of the Hermite
/// interpolant.
fn nearest(a: &Vertex, b: &Vertex, probe: &Vertex) -> Option<(f64, f64, f64)> {
    let chord = subtract(&b.place, &a.place);
    let length = length(a, b);
    let mut share = dot(&subtract(&probe.place, &a.place), &chord) / dot(&chord, &chord);
    let (mut offset, mut slope) = (chord, chord);
    for _ in 0..3 {
        if !(-0.1..=1.1).contains(&share) {
            return None;
        }
        (offset, slope) = interpolant(a, b, length, share, &probe.place);
        share += dot(&offset, &slope) / dot(&slope, &slope);
    }
    let cosine =
        dot(&slope, &probe.tangent) / (dot(&slope, &slope) * dot(&probe.tangent, &probe.tangent)).sqrt();
    let inside = (0.0..=1.0).contains(&share);
    inside.then(|| (share, norm(&offset), cosine))
}

/// Offset of `place` from the cubic Hermite interpolant at this share, and the slope of the interpolant by
/// share.
fn interpolant(a: &Vertex, b: &Vertex, length: f64, share: f64, place: &Sketch) -> (Sketch, Sketch) {
    let (s, r) = (share, 1.0 - share);
    let (mut offset, mut slope) = ([0.0; SKETCH], [0.0; SKETCH]);
    for i in 0..SKETCH {
        let rise = b.place[i] - a.place[i];
        let (ta, tb) = (length * a.tangent[i], length * b.tangent[i]);
        let value = a.place[i] + s * s * (3.0 - 2.0 * s) * rise + s * r * (r * ta - s * tb);
        offset[i] = place[i] - value;
        slope[i] = 6.0 * s * r * rise + r * (r - 2.0 * s) * ta + s * (s - 2.0 * r) * tb;
    }
    (offset, slope)
}

/// `‖b − a − L (t_a + t_b)/2‖`: a bound in practice for the error of the interpolant, which has one order
/// more.
fn defect(a: &Vertex, b: &Vertex) -> f64 {
    let (chord, length) = (subtract(&b.place, &a.place), length(a, b));
    norm(&std::array::from_fn(|i| chord[i] - 0.5 * length * (a.tangent[i] + b.tangent[i])))
}

/// Length of the segment in full space, to which the sketched tangents belong.
fn length(a: &Vertex, b: &Vertex) -> f64 {
    b.arc_length - a.arc_length
}

fn norm(a: &Sketch) -> f64 {
    dot(a, a).sqrt()
}

fn subtract(a: &Sketch, b: &Sketch) -> Sketch {
    std::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: &Sketch, b: &Sketch) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Random bits from a number (splitmix64; Steele, Lea and Flood, OOPSLA 2014).
fn mix(number: u64) -> u64 {
    let mut z = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests;
