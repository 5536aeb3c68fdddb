//! The elements of lumped masses in the spaces where they are drawn.

use crate::structure_diagram::data::{SketchCarrier, SketchLumped, SketchStop, StopKind, StructureDiagram};

/// An element between a mass and its right neighbour.
#[derive(Debug, Clone, Copy)]
pub(super) enum Element {
    Spring,
    Damper,
    /// A stop, and whether it is hit from the left.
    Stop {
        kind: StopKind,
        has_gap: bool,
        from_left: bool,
    },
}

/// An element in its lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lane {
    pub(super) element: Element,
    /// Its left and its right end.
    pub(super) ends: [Foot; 2],
}

/// Where an element ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Foot {
    Mass,
    /// The ground, or a support, which moves.
    Ground {
        support: Option<usize>,
    },
}

/// Elements between masses that are no neighbours: numbers of the masses and what joins them.
pub(super) struct Bridge {
    pub(super) masses: [usize; 2],
    pub(super) element: Element,
}

/// Every element in the space where it is drawn.
pub(super) fn arrange(diagram: &StructureDiagram, lumped: &SketchLumped) -> (Vec<Vec<Lane>>, Vec<Bridge>) {
    let count = lumped.masses.len();
    let mut spaces: Vec<Vec<Lane>> = vec![Vec::new(); count + 1];
    let mut bridges = Vec::new();
    let ground = Foot::Ground { support: diagram.support_of("ground") };
    for link in &lumped.links {
        let element = if link.is_damper { Element::Damper } else { Element::Spring };
        match link.between {
            [Some(a), Some(b)] => join(&mut spaces, &mut bridges, [a, b], element),
            [Some(mass), None] | [None, Some(mass)] => {
                fix(&mut spaces, mass, mass + 1 == count && count > 1, element, ground);
            }
            [None, None] => {}
        }
    }
    let number = |name: &str| lumped.masses.iter().position(|mass| mass == name);
    for stop in &diagram.stops {
        let Some(mass) = number(&stop.point) else { continue };
        for from_left in sides(stop) {
            let element = Element::Stop { kind: stop.kind, has_gap: stop.has_gap, from_left };
            match &stop.carrier {
                SketchCarrier::Point(other) => match number(other) {
                    Some(other) => {
                        // The second mass carries the stop, and the first one hits it.
                        let comes_from_left = if other > mass { from_left } else { !from_left };
                        let element = Element::Stop {
                            kind: stop.kind,
                            has_gap: stop.has_gap,
                            from_left: comes_from_left,
                        };
                        join(&mut spaces, &mut bridges, [mass, other], element);
                    }
                    None => fix(&mut spaces, mass, from_left, element, ground),
                },
                SketchCarrier::Support(number) => {
                    let support = Some(*number);
                    fix(&mut spaces, mass, from_left, element, Foot::Ground { support });
                }
                SketchCarrier::Space => {
                    fix(&mut spaces, mass, from_left, element, Foot::Ground { support: None });
                }
            }
        }
    }
    (spaces, bridges)
}

/// Whether a stop is hit from its left, for each side with a stop.
fn sides(stop: &SketchStop) -> Vec<bool> {
    match stop.kind {
        StopKind::TwoSided => vec![true, false],
        StopKind::Always => vec![false],
        _ => vec![stop.above],
    }
}

fn join(spaces: &mut [Vec<Lane>], bridges: &mut Vec<Bridge>, [a, b]: [usize; 2], element: Element) {
    let (low, high) = (a.min(b), a.max(b));
    if high == low + 1 {
        spaces[high].push(Lane { element, ends: [Foot::Mass, Foot::Mass] });
    } else if high > low {
        bridges.push(Bridge { masses: [low, high], element });
    }
}

/// Joins a mass to the ground, on its right side or on its left.
fn fix(spaces: &mut [Vec<Lane>], mass: usize, on_right: bool, element: Element, ground: Foot) {
    let (space, ends) =
        if on_right { (mass + 1, [Foot::Mass, ground]) } else { (mass, [ground, Foot::Mass]) };
    spaces[space].push(Lane { element, ends });
}
