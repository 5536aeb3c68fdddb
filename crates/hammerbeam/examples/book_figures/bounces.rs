//! Bounces on contacts that lose energy: their loops of force over penetration, and the ratio of speeds that
//! comes out. Forces are those of the laws of Hammerbeam; motions are the first integrals of the page.

use std::f64::consts::PI;

use hammerbeam::{
    figure::{DataAxis, DataDiagram, DataLook, DataPanel, DataSeries, Figure},
    motion::{
        Law,
        law::{HertzStop, HuntCrossleyStop, LinearStop, RestitutionModel, RestitutionStop},
    },
};

use super::{Outcome, compared, style};

/// Constant of the Hertz contact that a unit mass of unit speed penetrates by 1, (L6); its largest force.
const HERTZ: f64 = 1.25;
const POINTS: i32 = 4000;

/// A bounce, in units of the one without loss: penetrations, their rates, and the ratio of speeds.
struct Bounce {
    motion: Vec<(f64, f64)>,
    comes_out: f64,
}

/// `e_out` of `(1 + e) y = ln((1 + y)/(1 - e y))`, (L8), by bisection.
pub fn ratio_of_speeds(y: f64) -> f64 {
    let (mut low, mut high) = (0.0, (1.0_f64).min(1.0 / y));
    for _ in 0..200 {
        let e = 0.5 * (low + high);
        let excess = (1.0 + e) * y - y.ln_1p() + (-e * y).ln_1p();
        if excess > 0.0 { low = e } else { high = e }
    }
    0.5 * (low + high)
}

impl Bounce {
    /// On a spring with a damper, (L3).
    fn damped(ratio: f64) -> Outcome<(Self, Law)> {
        let law: Law = LinearStop::with_gap(1.0, 0.0)?.with_damping(2.0 * ratio)?.into();
        let slowed = (1.0 - ratio * ratio).sqrt();
        let duration = (PI - 2.0 * ratio.asin()) / slowed;
        let at = |k: i32| {
            let t = duration * f64::from(k) / f64::from(POINTS);
            let (sine, cosine) = (slowed * t).sin_cos();
            let decay = (-ratio * t).exp();
            (decay * sine / slowed, decay * (cosine - ratio / slowed * sine))
        };
        let motion: Vec<(f64, f64)> = (0..=POINTS).map(at).collect();
        let (penetration, rate) = at(POINTS);
        let pressure = law.pressure().map_or(penetration, |pressure| pressure.at(penetration, rate));
        assert!(pressure.abs() < 1e-12, "the force ends where the pressure vanishes: {pressure:e}");
        let restitution = (-ratio / slowed * (PI - 2.0 * ratio.asin())).exp();
        assert!((-rate - restitution).abs() < 1e-12, "(L4): {rate} for {restitution}");
        Ok((Self { motion, comes_out: -rate }, law))
    }

    /// On a Hertz contact with the loss y, by its first integral: `p^2.5 = F(1) - F(u)` with the rate u and
    /// `F(u) = 2 (u/y - ln(1 + y u)/y^2)`.
    fn hertz(y: f64) -> Self {
        let comes_out = if y > 0.0 { ratio_of_speeds(y) } else { 1.0 };
        let integral = |u: f64| if y > 0.0 { 2.0 * (u / y - (y * u).ln_1p() / (y * y)) } else { u * u };
        let at = |k: i32| {
            // The rate changes slowly at both ends, where the force is small.
            let share = 0.5 - 0.5 * (PI * f64::from(k) / f64::from(POINTS)).cos();
            let u = 1.0 - share * (1.0 + comes_out);
            ((integral(1.0) - integral(u)).max(0.0).powf(0.4), u)
        };
        Self { motion: (0..=POINTS).map(at).collect(), comes_out }
    }

    /// The force of a law over the penetration, over a unit of force. Its area is the energy that is lost.
    fn force(&self, law: &Law, unit: f64) -> Vec<(f64, f64)> {
        // At the touch the force is that just inside: the force of a damper sets in with a jump.
        let at = |&(p, rate): &(f64, f64)| (p, -law.force(p.max(1e-12), rate).value);
        let force: Vec<(f64, f64)> = self.motion.iter().map(at).collect();
        let area: f64 =
            force.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum();
        let lost = 0.5 * (1.0 - self.comes_out * self.comes_out);
        assert!((area - lost).abs() < 1e-6, "{law:?}: the loop has the area {area}, {lost} is lost");
        force.into_iter().map(|(p, f)| (p, f / unit)).collect()
    }
}

/// Draws three families of loops.
pub fn draw_loops() -> Outcome<Figure> {
    let (mut damped, mut lossy, mut restitution) = (Vec::new(), Vec::new(), Vec::new());
    let look = |number: usize| if number == 0 { DataLook::Pale } else { DataLook::Line(number - 1) };
    let hertz = HertzStop::with_gap(HERTZ, 0.0)?;
    for (number, ratio) in [0.0, 0.1, 0.3, 0.6].into_iter().enumerate() {
        let (bounce, law) = Bounce::damped(ratio)?;
        damped.push(DataSeries::new(&format!("ζ = {ratio}"), look(number), bounce.force(&law, 1.0)));
    }
    for (number, loss) in [0.0, 0.1, 0.3, 1.0].into_iter().enumerate() {
        let law = HuntCrossleyStop::new(hertz, loss)?.into();
        let force = Bounce::hertz(1.5 * loss).force(&law, HERTZ);
        lossy.push(DataSeries::new(&format!("a v = {loss}"), look(number), force));
    }
    for (number, (model, name)) in [
        (RestitutionModel::LeeWang, "Lee–Wang"),
        (RestitutionModel::LankaraniNikravesh, "Lankarani"),
        (RestitutionModel::HuntCrossley, "Hunt–Crossley"),
        (RestitutionModel::Flores, "Flores"),
    ]
    .into_iter()
    .enumerate()
    {
        let law = Law::from(RestitutionStop::new(hertz, model, 0.6)?).struck_at(1.0);
        let force = Bounce::hertz(model.factor(0.6)).force(&law, HERTZ);
        restitution.push(DataSeries::new(name, DataLook::Line(number), force));
    }
    let panel = |heading: &str, series| DataPanel {
        heading: heading.to_owned(),
        ..DataPanel::new(
            DataAxis::linear("Penetration (–)").between(0.0, 1.05),
            DataAxis::linear("Force (–)").between(0.0, 1.25),
            series,
        )
    };
    let panels = vec![
        panel("Linear with damper (L3)", damped),
        panel("Hunt–Crossley (L7)", lossy),
        panel("Restitution e = 0.6 (L9)", restitution),
    ];
    let description = "force over penetration of one bounce: a linear stop with dampers, Hunt-Crossley with \
                       losses, four models with e = 0.6"
        .to_owned();
    Ok(DataDiagram { panels, description }.draw(&style())?)
}

/// Every model, what comes out of it for e = 0.9, 0.7, 0.5 and 0.3 as `crates/motion/tests/bounces.rs` has
/// it, and its name.
const MODELS: [(RestitutionModel, [f64; 4], &str); 7] = [
    (RestitutionModel::HuntCrossley, [0.909_016, 0.768_000, 0.662_962, 0.581_288], "Hunt–Crossley"),
    (RestitutionModel::HerbertMcWhannell, [0.900_893, 0.722_683, 0.593_624, 0.519_967], "Herbert–McWhannell"),
    (RestitutionModel::LeeWang, [0.952_370, 0.869_343, 0.799_199, 0.738_995], "Lee–Wang"),
    (
        RestitutionModel::LankaraniNikravesh,
        [0.913_177, 0.795_973, 0.725_241, 0.684_225],
        "Lankarani–Nikravesh",
    ),
    (RestitutionModel::Gonthier, [0.876_435, 0.669_581, 0.487_741, 0.304_225], "Gonthier"),
    (RestitutionModel::Flores, [0.893_921, 0.683_184, 0.470_445, 0.256_208], "Flores"),
    (RestitutionModel::HuGuo, [0.899_900, 0.697_297, 0.487_741, 0.270_658], "Hu–Guo"),
];

/// Draws what comes out of each model, and compares (L8) with the table of the page.
pub fn draw_restitution() -> Outcome<Figure> {
    let mut off: f64 = 0.0;
    for (model, expected, name) in MODELS {
        for (e, expected) in [0.9, 0.7, 0.5, 0.3].into_iter().zip(expected) {
            let found = ratio_of_speeds(model.factor(e));
            assert!((found - expected).abs() < 1e-6, "{name} {e}: {found} for {expected}");
            off = off.max((found - expected).abs());
        }
    }
    compared(&format!("restitution: the table of (L8) off by {off:.1e}"));
    let curve = |model: RestitutionModel| {
        let e = (1..=200).map(|k| f64::from(k) / 200.0);
        e.map(move |e| (e, if e < 1.0 { ratio_of_speeds(model.factor(e)) } else { 1.0 }))
    };
    let goes_in = || DataAxis::linear("Coefficient of restitution that goes in (–)").between(0.0, 1.0);
    let left = MODELS[..4].iter().enumerate();
    let left = left.map(|(k, (model, _, name))| DataSeries::new(name, DataLook::Line(k), curve(*model)));
    let equality = DataSeries::new("equality", DataLook::Pale, [(0.0, 0.0), (1.0, 1.0)]);
    let left = DataPanel {
        heading: "Models that leave some speed at e = 0".to_owned(),
        ..DataPanel::new(
            goes_in(),
            DataAxis::linear("Ratio of speeds that comes out (–)").between(0.0, 1.0),
            [equality].into_iter().chain(left).collect(),
        )
    };
    let right = MODELS[4..].iter().enumerate();
    let right = right.map(|(k, (model, _, name))| {
        let off: Vec<(f64, f64)> = curve(*model).map(|(e, out)| (e, out - e)).collect();
        let largest = off.iter().map(|(_, off)| off.abs()).fold(0.0, f64::max);
        compared(&format!("restitution: {name} is off by {largest:.3} at most"));
        assert!(*model != RestitutionModel::Flores || largest < 0.05, "Flores is within 0.05 for every e");
        DataSeries::new(name, DataLook::Line(k), off)
    });
    let right = DataPanel {
        heading: "Models that leave none".to_owned(),
        levels: vec![0.0],
        ..DataPanel::new(
            goes_in(),
            DataAxis::linear("Comes out minus goes in (–)").between(-0.06, 0.02),
            right.collect(),
        )
    };
    let description = "ratio of speeds that comes out over the coefficient that goes in, for seven laws";
    let panels = vec![left, right];
    Ok(DataDiagram { panels, description: description.to_owned() }.draw(&style())?)
}
