//! Shooting equations and a condition, as a problem for the path crate: unknowns `[nodes; f]` or, at grazing,
//! `[nodes; f; x]`, and the parameter `p`.

use hammerbeam_motion::exact::MotionError;
use hammerbeam_path::{
    DenseLu, Determinant, EvaluationError, Judge, PathProblem, SingularJacobian, TestValue,
};

use super::{
    condition::Condition,
    criticality::Criticality,
    deflated::other_eigenvalues,
    linear::Linear,
    marks,
    opposite::opposite_clearance,
    shooting::{CurveOrbit, Shooting},
};
use crate::by_rows::times;

/// The extended equations.
#[derive(Debug)]
pub(super) struct CurveProblem {
    pub shooting: Shooting,
    pub condition: Condition,
    /// Phase at which orbits are cut, unless it is an unknown [cycles].
    pub cut_phase: f64,
    /// What counts like a change of the orbit by its own size, of frequency and parameter.
    pub units: [f64; 2],
    weights: Vec<f64>,
    residual: Vec<f64>,
    /// `[R_x R_p]` by rows.
    jacobian: Vec<f64>,
    tests: Vec<f64>,
    criticality: Criticality,
    /// The last evaluated point.
    evaluated: Vec<f64>,
    lu: DenseLu,
    failure: Option<MotionError>,
}

impl CurveProblem {
    /// * `cut_phase`: phase at which orbits are cut, unless it is an unknown [cycles].
    /// * `units`: what counts like a change of the orbit by its own size, of frequency and parameter.
    pub fn new(shooting: Shooting, condition: Condition, cut_phase: f64, units: [f64; 2]) -> Self {
        let nodes = shooting.size() * shooting.count;
        let mut weights = vec![1.0 / shooting.count as f64; nodes];
        weights.push(units[0].powi(-2));
        if condition.has_phase() {
            weights.push(1.0);
        }
        weights.push(units[1].powi(-2));
        let unknowns = weights.len() - 1;
        Self {
            shooting,
            condition,
            cut_phase,
            units,
            residual: vec![0.0; unknowns],
            jacobian: vec![0.0; unknowns * (unknowns + 1)],
            weights,
            tests: Vec::new(),
            criticality: Criticality::new(),
            evaluated: Vec::new(),
            lu: DenseLu::new(),
            failure: None,
        }
    }

    pub fn failure(&self) -> Option<&MotionError> {
        self.failure.as_ref()
    }

    /// Which entry of a point is the frequency.
    pub fn frequency_index(&self) -> usize {
        self.shooting.size() * self.shooting.count
    }

    /// CurveOrbit of a point.
    pub fn place(&self, point: &[f64]) -> CurveOrbit {
        let nodes = self.shooting.size() * self.shooting.count;
        let phase = if self.condition.has_phase() { point[nodes + 1] } else { self.cut_phase };
        CurveOrbit {
            nodes: point[..nodes].to_vec(),
            frequency_hz: point[nodes],
            phase,
            value: point[point.len() - 1],
        }
    }

    /// Point of a place.
    pub fn point(&self, place: &CurveOrbit) -> Vec<f64> {
        let mut point = place.nodes.clone();
        point.push(place.frequency_hz);
        if self.condition.has_phase() {
            point.push(place.phase);
        }
        point.push(place.value);
        point
    }

    fn fill_shooting(&mut self, place: &CurveOrbit) {
        let (size, count) = (self.shooting.size(), self.shooting.count);
        let nodes = size * count;
        let width = self.weights.len();
        self.jacobian.fill(0.0);
        for (k, segment) in self.shooting.segments.iter().enumerate() {
            let next = (k + 1) % count * size;
            let by_phase = self.condition.has_phase().then(|| self.by_phase(place, k));
            for i in 0..size {
                let row = &mut self.jacobian[(k * size + i) * width..(k * size + i + 1) * width];
                row[k * size..(k + 1) * size].copy_from_slice(&segment.matrix[i * size..(i + 1) * size]);
                row[next + i] -= 1.0;
                row[nodes] = segment.by_frequency[i];
                row[width - 1] = segment.by_parameter[i];
                if let Some(by_phase) = &by_phase {
                    row[nodes + 1] = by_phase[i];
                }
                self.residual[k * size + i] = segment.end[i] - place.nodes[next + i];
            }
        }
    }

    /// Derivative of a segment by the phase at which it begins.
    fn by_phase(&self, place: &CurveOrbit, k: usize) -> Vec<f64> {
        let size = self.shooting.size();
        let stretch = self.shooting.stretch(k, place.frequency_hz, place.phase);
        let segment = &self.shooting.segments[k];
        let at_start = self.shooting.rate(place, stretch.start, &place.nodes[k * size..(k + 1) * size]);
        let at_end = self.shooting.rate(place, stretch.end, &segment.end);
        let carried = times(&segment.matrix, &at_start);
        at_end.iter().zip(carried).map(|(end, start)| (end - start) / place.frequency_hz).collect()
    }

    fn fill_condition(&mut self, linear: Linear) {
        let width = self.weights.len();
        let nodes = self.shooting.size() * self.shooting.count;
        for (index, (value, gradient)) in linear.values.iter().zip(&linear.rows).enumerate() {
            let row = &mut self.jacobian[(nodes + index) * width..(nodes + index + 1) * width];
            row[..=nodes].copy_from_slice(&gradient[..=nodes]);
            row[width - 1] = gradient[nodes + 1];
            if let Some(by_phase) = gradient.get(nodes + 2) {
                row[nodes + 1] = *by_phase;
            }
            self.residual[nodes + index] = *value;
        }
        self.tests = linear.tests;
    }

    fn evaluate_at(&mut self, place: &CurveOrbit) -> Result<bool, MotionError> {
        self.shooting.evaluate(place)?;
        self.fill_shooting(place);
        let Some(linear) = self.condition.evaluate(&mut self.shooting, place)? else { return Ok(false) };
        self.fill_condition(linear);
        Ok(true)
    }

    /// The coefficient of the normal form at the last evaluated place, where it can be computed.
    fn coefficient(&mut self) -> Option<f64> {
        if let Some(coefficient) = self.criticality.known_at(&self.evaluated) {
            return coefficient;
        }
        let place = self.place(&self.evaluated);
        let coefficient = self.condition.criticality(&mut self.shooting, &place).ok().flatten();
        self.criticality.keep(&self.evaluated, coefficient);
        coefficient
    }

    /// Adapts the condition and its test functions to an accepted point, at which the equations were
    /// evaluated last.
    ///
    /// * `zeros`: of the test functions, found there.
    pub fn renew(&mut self, zeros: u32) {
        let coefficient = self.coefficient();
        let at_zero = marks::criticality_bit(&self.condition).is_some_and(|bit| zeros >> bit & 1 == 1);
        self.criticality.renew(coefficient, at_zero);
        self.condition.renew(&self.shooting);
    }

    /// The multipliers that the condition does not hold, at the last evaluated place.
    pub fn other_multipliers(&self) -> Vec<[f64; 2]> {
        let size = self.shooting.size();
        let critical = self.condition.critical_vectors(&self.shooting);
        let others = other_eigenvalues(size, self.shooting.monodromy(), &critical);
        others.unwrap_or_else(|_| vec![[0.0, 0.0]; size - critical.len()])
    }

    /// `[R_x R_p]` by rows.
    #[cfg(test)]
    pub fn jacobian(&self) -> &[f64] {
        &self.jacobian
    }
}

impl PathProblem for CurveProblem {
    fn unknowns(&self) -> usize {
        self.residual.len()
    }

    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn evaluate(&mut self, point: &[f64]) -> Result<(), EvaluationError> {
        self.failure = None;
        self.evaluated = point.to_vec();
        let place = self.place(point);
        if place.frequency_hz.is_nan() || place.frequency_hz <= 0.0 {
            return Err(EvaluationError::OutsideDomain);
        }
        match self.evaluate_at(&place) {
            Ok(true) => Ok(()),
            Ok(false) => Err(EvaluationError::NotFinite),
            Err(error) => {
                let outside = matches!(error, MotionError::Parameter(_));
                self.failure = Some(error);
                Err(if outside { EvaluationError::OutsideDomain } else { EvaluationError::NotFinite })
            }
        }
    }

    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn factorise(&mut self, row: &[f64]) -> Result<Determinant, SingularJacobian> {
        self.lu.factorise_bordered(&self.jacobian, row)
    }

    fn solve(&self, right_hand_side: &mut [f64]) {
        self.lu.solve(right_hand_side);
    }

    /// In the order of `marks.rs`.
    fn tests(&mut self, _: &[u32], values: &mut Vec<TestValue>) {
        values.clear();
        let criticality = self.coefficient();
        let criticality = self.criticality.test(criticality);
        values.extend(marks::tests(&self.condition, &self.tests, &self.other_multipliers(), criticality));
        // Where it cannot be followed there it has no value.
        let place = self.place(&self.evaluated);
        let opposite = opposite_clearance(&mut self.shooting, &place).unwrap_or(Some(f64::INFINITY));
        values.extend(opposite.map(marks::signed));
    }

    fn judge(&mut self) -> &mut dyn Judge {
        self
    }
}

impl Judge for CurveProblem {
    /// Without the contact that a grazing orbit touches, unless it passes it: whether that touch is counted
    /// is rounding.
    fn signature(&self) -> u64 {
        let shooting = &self.shooting;
        let is_touched = |number: usize| match (&self.condition, &shooting.passing) {
            (Condition::Touch(touch), None) => touch.number(shooting) == number,
            _ => false,
        };
        let touches = shooting.touches.iter().enumerate();
        let words = touches.map(|(k, &t)| if is_touched(k) { 0 } else { u64::from(t) });
        words.fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ word).wrapping_mul(0x0100_0000_01b3))
    }
}
