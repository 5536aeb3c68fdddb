//! The nodes of the two steps of that contact, and how fast a step converges with their number, by the
//! equations (S1) to (S5) of the book alone.

use hammerbeam::figure::{
    DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries, Figure, LabelSide,
};

use super::{Outcome, compared, flight::SettledMotion, gauss::Weight, style};

/// About half of the contact of a unit mass that enters a Hertz contact of unit constant with unit speed;
/// the whole takes 3.2.
const LENGTH: f64 = 1.5;

/// Lagrange's polynomials of nodes, at a place.
fn lagrange(nodes: &[f64], s: f64) -> Vec<f64> {
    let polynomial = |j: usize| {
        let others = nodes.iter().enumerate().filter(|(k, _)| *k != j);
        others.map(|(_, other)| (s - other) / (nodes[j] - other)).product()
    };
    (0..nodes.len()).map(polynomial).collect()
}

/// A step of a unit mass without a spring: `p'' = F`.
struct Step {
    weight: Weight,
    nodes: Vec<f64>,
    quadrature: Vec<(f64, f64)>,
}

impl Step {
    fn new(weight: Weight, count: usize) -> Self {
        let nodes = weight.rule(count).into_iter().map(|(node, _)| node).collect();
        Self { weight, nodes, quadrature: Weight::One.rule(60) }
    }

    /// Time `h c(s)`, (S5), and its derivative.
    fn clock(&self, s: f64) -> (f64, f64) {
        match self.weight {
            Weight::One => (LENGTH * s, LENGTH),
            Weight::Rising => (LENGTH * s * s, 2.0 * LENGTH * s),
        }
    }

    /// The weights (S4) of the displacement and of the velocity at a place.
    fn weights(&self, end: f64) -> [Vec<f64>; 2] {
        let mut weights = [vec![0.0; self.nodes.len()], vec![0.0; self.nodes.len()]];
        for &(point, weight) in &self.quadrature {
            let s = point * end;
            let (time, slope) = self.clock(s);
            let measure = weight * end * slope;
            for (j, value) in lagrange(&self.nodes, s).into_iter().enumerate() {
                weights[0][j] += value * measure * (self.clock(end).0 - time);
                weights[1][j] += value * measure;
            }
        }
        weights
    }

    /// Displacement and velocity at the end, by (S2) and (S3) with the force `-p^1.5`. The displacement
    /// depends on earlier forces alone, so putting one into the other converges.
    fn end(&self) -> [f64; 2] {
        let responses: Vec<Vec<f64>> =
            self.nodes.iter().map(|node| self.weights(*node)).map(|[displacement, _]| displacement).collect();
        let times: Vec<f64> = self.nodes.iter().map(|node| self.clock(*node).0).collect();
        let dot =
            |weights: &[f64], forces: &[f64]| weights.iter().zip(forces).map(|(a, b)| a * b).sum::<f64>();
        let mut forces = vec![0.0; self.nodes.len()];
        let mut change = f64::INFINITY;
        for _ in 0..100 {
            let displacements = responses.iter().zip(&times).map(|(row, time)| time + dot(row, &forces));
            let next: Vec<f64> = displacements.map(|p| -p.max(0.0).powf(1.5)).collect();
            change = next.iter().zip(&forces).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            forces = next;
        }
        assert!(change < 1e-15, "the forces converge: {change:e}");
        let [displacement, velocity] = self.weights(1.0);
        [LENGTH + dot(&displacement, &forces), 1.0 + dot(&velocity, &forces)]
    }
}

/// Draws the nodes and the convergence.
pub fn draw(motion: &SettledMotion) -> Outcome<Figure> {
    let exact = Step::new(Weight::Rising, 26).end();
    // First integral: v^2/2 + (2/5) p^2.5 = 1/2.
    let energy = 0.5 * exact[1] * exact[1] + 0.4 * exact[0].powf(2.5) - 0.5;
    assert!(energy.abs() < 1e-14, "the reference keeps the energy: {energy:e}");
    let error = |weight: Weight, count: usize| {
        let [displacement, velocity] = Step::new(weight, count).end();
        (displacement - exact[0]).hypot(velocity - exact[1])
    };
    let errors = |weight| (3..=13).map(move |count| (count as f64, error(weight, count)));
    let (graded, plain): (Vec<_>, Vec<_>) = (errors(Weight::Rising).collect(), errors(Weight::One).collect());
    let (of_twelve, plain_of_twelve) = (graded[9].1, plain[9].1);
    compared(&format!("collocation: twelve nodes leave {of_twelve:.1e} graded, {plain_of_twelve:.1e} not"));
    assert!(of_twelve < 2e-13 && plain_of_twelve > 1e-7, "grading is worth six digits");

    let convergence = DataPanel {
        uprights: vec![12.0],
        labels: vec![DataLabel { at: (12.0, 1e-3), text: "12 in Hammerbeam".into(), side: LabelSide::Left }],
        ..DataPanel::new(
            DataAxis::linear("Nodes in the step").between(2.5, 13.5),
            DataAxis::logarithmic("Error at the end of the step (–)").between(1e-15, 1e-1),
            vec![
                DataSeries::new("", DataLook::Pale, plain.clone()),
                DataSeries::new("", DataLook::Pale, graded.clone()),
                DataSeries::new("smooth, t = h s", DataLook::Circles(0), plain),
                DataSeries::new("graded, t = h s²", DataLook::Dots(1), graded),
            ],
        )
    };
    let description = "contact force with the nodes of two steps; error of a step over the number of nodes";
    let panels = vec![nodes(motion), convergence];
    Ok(DataDiagram { panels, description: description.to_owned() }.draw(&style())?)
}

/// The contact force, and the nodes of a step up to its middle and of one from there.
fn nodes(motion: &SettledMotion) -> DataPanel {
    let duration = 1e6 * (motion.contact[1] - motion.contact[0]);
    let force = motion.force_over_microseconds();
    let on_the_curve = |time: f64| {
        let after = force.partition_point(|(other, _)| *other < time).clamp(1, force.len() - 1);
        let ((t0, f0), (t1, f1)) = (force[after - 1], force[after]);
        (time, f0 + (time - t0) / (t1 - t0) * (f1 - f0))
    };
    let shares: Vec<f64> = Weight::Rising.rule(12).into_iter().map(|(s, _)| 0.5 * s * s).collect();
    let touch: Vec<_> = shares.iter().map(|share| on_the_curve(duration * share)).collect();
    let release: Vec<_> = shares.iter().map(|share| on_the_curve(duration * (1.0 - share))).collect();
    DataPanel::new(
        DataAxis::linear("Time from the touch (µs)").between(-5.0, duration + 5.0),
        DataAxis::linear("Contact force (N)").between(0.0, 1400.0),
        vec![
            DataSeries::new("contact force", DataLook::Line(0), force.clone()),
            DataSeries::new("nodes graded at the touch", DataLook::Dots(1), touch),
            DataSeries::new("at the release", DataLook::Dots(2), release),
        ],
    )
}
