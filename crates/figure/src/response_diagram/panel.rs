//! One panel: the data of one quantity, prepared for the page.

use super::{
    data::{
        MeasuredMotion, ResponseCurve, ResponseDiagram, ResponsePoint, ResponseQuantity, ResponseSettings,
    },
    joined::{EventPlace, JoinedEvents, join},
    labels::{LabelledLine, direct_labels, draw_label},
    quantity::PanelQuantity,
    spread::spread,
};
use crate::{
    decimate::decimate,
    error::FigureError,
    line::draw_stretches,
    marks::Mark,
    plot::Plot,
    scale::{Scale, ScaleChoice, ScaleKind, extent},
    stretch::{BranchSample, BranchStretch, LineLook, Vertex, stretches},
    style::{PeriodLook, Style, overlaid_look, period_look},
    svg::{PagePoint, SvgWriter},
    text::Text,
};

/// The data of one quantity.
pub(super) struct ResponsePanel {
    pub(super) quantity: PanelQuantity,
    pub(super) range_hz: (f64, f64),
    pub(super) scale: Scale,
    lines: Vec<BranchLine>,
    /// Of each of the other results.
    overlaid: Vec<Vec<BranchLine>>,
    events: JoinedEvents,
    measured: Vec<MeasuredPlaces>,
}

/// The measured points of a kind: places of those that are drawn, and the number of those beyond the axes.
pub(super) struct MeasuredPlaces {
    pub(super) motion: MeasuredMotion,
    pub(super) places: Vec<(f64, f64)>,
    pub(super) beyond: usize,
}

/// The stretches of a branch.
struct BranchLine {
    period_multiple: u32,
    stretches: Vec<BranchStretch>,
}

impl ResponsePanel {
    /// Collects what lies between the ends of the frequency axis.
    pub(super) fn new(
        diagram: &ResponseDiagram,
        quantity: ResponseQuantity,
        range_hz: (f64, f64),
        settings: &ResponseSettings,
    ) -> Result<Self, FigureError> {
        let choice = scale_choice(quantity, settings);
        let named = PanelQuantity::of(diagram, quantity, range_hz);
        let quantity = &named;
        let kind = choice.decide(visible_values(diagram, quantity, range_hz));
        let lines_of = |curves: &[ResponseCurve]| -> Vec<BranchLine> {
            curves.iter().map(|curve| line(curve, quantity, kind, range_hz)).collect()
        };
        let lines = lines_of(&diagram.curves);
        let overlaid: Vec<Vec<BranchLine>> =
            diagram.overlaid.iter().map(|other| lines_of(&other.curves)).collect();
        let all = lines.iter().chain(overlaid.iter().flatten());
        let vertices = all.flat_map(|line| &line.stretches).flat_map(|stretch| &stretch.vertices);
        let measured = MeasuredMotion::ALL.map(|motion| measured(diagram, quantity, kind, range_hz, motion));
        let measured: Vec<_> =
            measured.into_iter().filter(|of| of.beyond > 0 || !of.places.is_empty()).collect();
        let over = measured.iter().flat_map(|of| &of.places).map(|&(_, value)| value);
        let values = vertices.map(|vertex| vertex.y).chain(over);
        let ends = extent(values).ok_or_else(|| empty(diagram, quantity))?;
        let events = Mark::ALL.map(|mark| (mark, events(diagram, quantity, kind, range_hz, mark)));
        let (scale, across) = (Scale::around(kind, ends), Scale::exact(ScaleKind::Linear, range_hz));
        let events = join(&events, |place| (across.share(place.x), scale.share(place.y)));
        Ok(Self { quantity: named, range_hz, scale, lines, overlaid, events, measured })
    }

    /// What the vertical axis shows.
    pub(super) fn label(&self) -> Text {
        self.quantity.label()
    }

    /// Whether a line of this look is drawn.
    pub(super) fn has(&self, look: LineLook) -> bool {
        self.lines.iter().flat_map(|line| &line.stretches).any(|stretch| stretch.look == look)
    }

    /// Whether an event of a kind is drawn.
    pub(super) fn has_mark(&self, mark: Mark) -> bool {
        self.events.events.iter().any(|(present, ..)| *present == mark)
    }

    /// The period multiples drawn, each once, rising.
    pub(super) fn period_multiples(&self) -> Vec<u32> {
        let drawn = self.lines.iter().filter(|line| !line.stretches.is_empty());
        let mut multiples: Vec<u32> = drawn.map(|line| line.period_multiple).collect();
        multiples.sort_unstable();
        multiples.dedup();
        multiples
    }

    /// Draws marks and lines: unstable lines under marginal and stable ones, grazing marks below all lines,
    /// other marks above them.
    pub(super) fn draw(&self, svg: &mut SvgWriter, plot: &Plot, style: &Style) {
        for (place, lines) in self.overlaid.iter().enumerate() {
            draw_thin(svg, plot, style, (lines, overlaid_look(place)));
        }
        let marks = self.marks(plot, style);
        for (mark, places) in marks.iter().filter(|(mark, _)| mark.is_behind()) {
            mark.draw(svg, places, style.mark_radius);
        }
        for look in LineLook::ALL.into_iter().rev() {
            self.draw_lines(svg, plot, style, look);
        }
        for (mark, places) in marks.iter().filter(|(mark, _)| !mark.is_behind()) {
            mark.draw(svg, places, style.mark_radius);
        }
        for of in &self.measured {
            let places: Vec<PagePoint> = of.places.iter().map(|&(x, y)| plot.place(x, y)).collect();
            of.motion.dot(1.1 * style.mark_radius).draw(svg, &places);
        }
        self.draw_labels(svg, plot, (&marks, style));
    }

    /// Names beside the lines of each kind of solutions, where there are several and one fits.
    fn draw_labels(
        &self,
        svg: &mut SvgWriter,
        plot: &Plot,
        (marks, style): (&[(Mark, Vec<PagePoint>)], &Style),
    ) {
        let stretch = |stretch: &BranchStretch| (stretch.look, on_page(&stretch.vertices, plot, style));
        let lines = self.lines.iter().map(|line| LabelledLine {
            period_multiple: line.period_multiple,
            stretches: line.stretches.iter().map(stretch).collect(),
        });
        let lines: Vec<LabelledLine> = lines.collect();
        let measured = self.measured.iter().flat_map(|of| &of.places).map(|&(x, y)| plot.place(x, y));
        let marks: Vec<PagePoint> =
            marks.iter().flat_map(|(_, places)| places).copied().chain(measured).collect();
        for label in direct_labels(&lines, &marks, plot.area, style) {
            draw_label(svg, &label, style);
        }
    }

    /// Measured points by kind.
    pub(super) fn measured(&self) -> &[MeasuredPlaces] {
        &self.measured
    }

    fn draw_lines(&self, svg: &mut SvgWriter, plot: &Plot, style: &Style, of: LineLook) {
        for line in &self.lines {
            let look = period_look(line.period_multiple);
            let stretches = line.stretches.iter().filter(|stretch| stretch.look == of);
            let stretches: Vec<_> =
                stretches.map(|stretch| on_page(&stretch.vertices, plot, style)).collect();
            draw_stretches(svg, &stretches, of, look, style);
        }
    }

    /// The marks that are drawn, and where.
    pub(super) fn marks(&self, plot: &Plot, style: &Style) -> Vec<(Mark, Vec<PagePoint>)> {
        spread(&self.events, plot, style)
    }

    /// Branch points that have the mark of a flip.
    pub(super) fn branches_at_flips(&self) -> usize {
        self.events.branches_at_flips
    }

    /// Number of events of a kind, drawn or not.
    pub(super) fn count(&self, mark: Mark) -> usize {
        self.events.events.iter().filter(|(present, ..)| *present == mark).map(|(_, _, count)| count).sum()
    }
}

/// Draws the lines of other results.
fn draw_thin(svg: &mut SvgWriter, plot: &Plot, style: &Style, (lines, look): (&[BranchLine], PeriodLook)) {
    for of in LineLook::ALL.into_iter().rev() {
        let stretches = lines.iter().flat_map(|line| &line.stretches).filter(|stretch| stretch.look == of);
        let stretches: Vec<_> = stretches.map(|stretch| on_page(&stretch.vertices, plot, style)).collect();
        draw_stretches(svg, &stretches, of, look, &style.thin());
    }
}

fn scale_choice(quantity: ResponseQuantity, settings: &ResponseSettings) -> ScaleChoice {
    match quantity {
        ResponseQuantity::Displacement | ResponseQuantity::Output => settings.displacement_scale,
        ResponseQuantity::Acceleration => settings.acceleration_scale,
        ResponseQuantity::ContactForce | ResponseQuantity::ImpactVelocity => settings.contact_scale,
    }
}

fn empty(diagram: &ResponseDiagram, quantity: &PanelQuantity) -> FigureError {
    let points = diagram.curves.iter().map(|curve| curve.points.len()).sum();
    FigureError::Empty { quantity: quantity.name(), curves: diagram.curves.len(), points }
}

fn visible_values(
    diagram: &ResponseDiagram,
    quantity: &PanelQuantity,
    (from, to): (f64, f64),
) -> impl Iterator<Item = f64> {
    let inside = diagram.all_points().filter(move |point| (from..=to).contains(&point.frequency_hz));
    inside.map(move |point| quantity.value(point)).filter(|&value| ScaleKind::Linear.shows(value))
}

fn line(
    curve: &ResponseCurve,
    quantity: &PanelQuantity,
    kind: ScaleKind,
    range_hz: (f64, f64),
) -> BranchLine {
    let samples: Vec<BranchSample> = curve.points.iter().map(|point| sample(point, quantity, kind)).collect();
    BranchLine { period_multiple: curve.period_multiple, stretches: stretches(&samples, range_hz) }
}

fn sample(point: &ResponsePoint, quantity: &PanelQuantity, kind: ScaleKind) -> BranchSample {
    let value = quantity.value(point);
    BranchSample {
        x: point.frequency_hz,
        y: if kind.shows(value) && ScaleKind::Linear.shows(point.frequency_hz) { value } else { f64::NAN },
        look: LineLook::of(point.stable, point.marginal),
        bifurcation: point.fold || point.flip || point.neimark_sacker || point.branch_point,
    }
}

/// Places of the events of a kind, in order along the branches.
fn events(
    diagram: &ResponseDiagram,
    quantity: &PanelQuantity,
    kind: ScaleKind,
    (from, to): (f64, f64),
    mark: Mark,
) -> Vec<EventPlace> {
    let of_curve = |points: &[ResponsePoint]| -> Vec<EventPlace> {
        let here =
            |index: &usize| is(points, *index, mark) && (from..=to).contains(&points[*index].frequency_hz);
        let place = |index: usize| EventPlace {
            x: points[index].frequency_hz,
            y: quantity.value(&points[index]),
            of_stable: is_beside_stable(points, index),
        };
        (0..points.len()).filter(here).map(place).filter(|place| kind.shows(place.y)).collect()
    };
    diagram.curves.iter().flat_map(|curve| of_curve(&curve.points)).collect()
}

/// Whether a point or one beside it is stable.
fn is_beside_stable(points: &[ResponsePoint], index: usize) -> bool {
    let neighbours = [index.checked_sub(1), Some(index), index.checked_add(1)];
    neighbours.into_iter().flatten().filter_map(|index| points.get(index)).any(|point| point.stable)
}

/// The measured points of a kind.
fn measured(
    diagram: &ResponseDiagram,
    quantity: &PanelQuantity,
    kind: ScaleKind,
    (from, to): (f64, f64),
    motion: MeasuredMotion,
) -> MeasuredPlaces {
    let marks = diagram.measured.iter().filter(|mark| mark.motion == motion);
    let all = marks.map(|mark| (mark.frequency_hz, quantity.measured(mark))).filter(|(_, y)| !y.is_nan());
    let (places, beyond): (Vec<_>, Vec<_>) =
        all.partition(|&(x, y)| (from..=to).contains(&x) && kind.shows(y));
    MeasuredPlaces { motion, places, beyond: beyond.len() }
}

/// Whether the point with this index has that mark. Flips and Neimark-Sacker points between unstable
/// solutions have no observable effect: they have their own mark.
fn is(points: &[ResponsePoint], index: usize, mark: Mark) -> bool {
    let point = &points[index];
    let beside_stable = || is_beside_stable(points, index);
    match mark {
        Mark::Grazing => point.grazing,
        Mark::Fold => point.fold,
        // Made of both.
        Mark::FoldAtGrazing => false,
        Mark::Flip => point.flip && beside_stable(),
        Mark::NeimarkSacker => point.neimark_sacker && beside_stable(),
        Mark::BranchPoint => point.branch_point,
        Mark::OfUnstable => (point.flip || point.neimark_sacker) && !beside_stable(),
    }
}

fn on_page(vertices: &[Vertex], plot: &Plot, style: &Style) -> Vec<PagePoint> {
    let points: Vec<PagePoint> = vertices.iter().map(|vertex| plot.place(vertex.x, vertex.y)).collect();
    let keep: Vec<bool> = vertices.iter().map(|vertex| vertex.keep).collect();
    decimate(&points, &keep, style.line_tolerance).into_iter().map(|i| points[i]).collect()
}
