//! Nodes of a beam: every point is one, and the elements between them are as equal as possible.

use crate::StructureError;

/// Positions closer than this part of the length are one node.
const SAME_PLACE: f64 = 1e-9;
/// Shortest stretch between two points, as a part of the length; shorter elements cost digits.
const SHORTEST_STRETCH: f64 = 1e-4;
/// Elements on a short stretch, where there are enough.
const LOCAL_ELEMENTS: usize = 4;
/// Most elements of a beam: the dense eigenproblem grows with the cube.
pub(crate) const MOST_ELEMENTS: usize = 1000;

/// Node positions and the node of every place asked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mesh {
    /// Positions [m], ascending, from 0 to the length.
    pub positions: Vec<f64>,
    /// Index of the node of each place, in the order given.
    pub nodes: Vec<usize>,
}

/// Divides a beam into `elements` elements with a node at each of the named places.
///
/// * `length`: of the beam [m].
/// * `places`: names and positions [m] within the beam.
///
/// # Errors
/// Too few or too many elements, or places too close to each other.
pub(crate) fn divide(length: f64, elements: usize, places: &[(&str, f64)]) -> Result<Mesh, StructureError> {
    let corners = corners(length, places)?;
    let needed = corners.len() - 1;
    if elements < needed {
        return Err(StructureError::TooFewElements { found: elements, needed });
    }
    if elements > MOST_ELEMENTS {
        return Err(StructureError::TooManyElements { found: elements, allowed: MOST_ELEMENTS });
    }
    let stretches: Vec<f64> = corners.windows(2).map(|ends| ends[1] - ends[0]).collect();
    let counts = share(elements, &stretches);
    let mut positions = Vec::with_capacity(elements + 1);
    let mut first_nodes = Vec::with_capacity(corners.len());
    for (stretch, &count) in counts.iter().enumerate() {
        first_nodes.push(positions.len());
        positions.extend((0..count).map(|i| corners[stretch] + stretches[stretch] * i as f64 / count as f64));
    }
    first_nodes.push(positions.len());
    positions.push(length);
    let nodes = places.iter().map(|&(_, at)| first_nodes[nearest(&corners, at)]).collect();
    Ok(Mesh { positions, nodes })
}

/// Distinct positions of both ends and all places, ascending.
fn corners(length: f64, places: &[(&str, f64)]) -> Result<Vec<f64>, StructureError> {
    let mut sorted: Vec<(&str, f64)> =
        [("left", 0.0), ("right", length)].into_iter().chain(places.iter().copied()).collect();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    let allowed = SHORTEST_STRETCH * length;
    for pair in sorted.windows(2) {
        let ((first, from), (second, to)) = (pair[0], pair[1]);
        let distance = to - from;
        if distance > SAME_PLACE * length && distance < allowed {
            return Err(StructureError::PointsTooClose {
                first: first.into(),
                second: second.into(),
                distance,
                allowed,
            });
        }
    }
    let mut corners: Vec<f64> = sorted.into_iter().map(|(_, at)| at).collect();
    corners.dedup_by(|a, b| (*a - *b).abs() <= SAME_PLACE * length);
    if let Some(last) = corners.last_mut() {
        *last = length;
    }
    Ok(corners)
}

/// Index of the corner nearest to a position.
fn nearest(corners: &[f64], at: f64) -> usize {
    let mut best = 0;
    for (index, corner) in corners.iter().enumerate() {
        if (corner - at).abs() < (corners[best] - at).abs() {
            best = index;
        }
    }
    best
}

/// Number of elements of each stretch.
///
/// Each gets its start, and every further element goes to the stretch whose elements are longest.
fn share(elements: usize, stretches: &[f64]) -> Vec<usize> {
    let mut counts = start(elements, stretches);
    for _ in counts.iter().sum()..elements {
        let mut longest = 0;
        for index in 1..stretches.len() {
            if stretches[index] * counts[longest] as f64 > stretches[longest] * counts[index] as f64 {
                longest = index;
            }
        }
        counts[longest] += 1;
    }
    counts
}

/// What each stretch starts with: one element, and up to four on a short one.
///
/// Forces at points bend the beam locally, and the residual flexibility modes need elements there. More than
/// one is given only while they are at least half as long as the mean and take half of all at most.
fn start(elements: usize, stretches: &[f64]) -> Vec<usize> {
    let mean = stretches.iter().sum::<f64>() / elements as f64;
    let most = (elements / (2 * stretches.len())).min(LOCAL_ELEMENTS);
    stretches.iter().map(|stretch| most.min((2.0 * stretch / mean) as usize).max(1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_exactly_a_node() {
        let mesh =
            divide(0.2579822, 44, &[("contact", 0.2432157), ("left", 0.0), ("right", 0.2579822)]).unwrap();
        assert_eq!(mesh.positions.len(), 45);
        assert_eq!(mesh.positions[mesh.nodes[0]], 0.2432157);
        assert_eq!((mesh.nodes[1], mesh.nodes[2]), (0, 44));
        assert!(mesh.positions.windows(2).all(|ends| ends[1] > ends[0]));
    }

    #[test]
    fn elements_are_shared_so_that_the_longest_is_shortest() {
        assert_eq!(share(10, &[3.0, 1.0, 1.0]), vec![6, 2, 2]);
        assert_eq!(share(3, &[3.0, 1.0, 1e-3]), vec![1, 1, 1]);
    }

    #[test]
    fn a_short_stretch_has_four_elements_unless_they_would_be_tiny() {
        assert_eq!(share(44, &[0.2432157, 0.0147665]), vec![40, 4]);
        assert_eq!(share(44, &[0.2432157, 0.0001]), vec![43, 1]);
    }

    #[test]
    fn points_at_one_place_share_a_node() {
        let mesh = divide(1.0, 4, &[("a", 0.5), ("b", 0.5), ("c", 1.0)]).unwrap();
        assert_eq!(mesh.nodes, vec![2, 2, 4]);
    }

    #[test]
    fn too_few_elements_and_too_close_points_are_refused() {
        let error = divide(1.0, 1, &[("a", 0.5)]).unwrap_err();
        assert_eq!(error, StructureError::TooFewElements { found: 1, needed: 2 });
        assert!(matches!(
            divide(1.0, 9, &[("a", 0.5), ("b", 0.50001)]),
            Err(StructureError::PointsTooClose { .. })
        ));
        assert!(matches!(divide(1.0, 1001, &[]), Err(StructureError::TooManyElements { .. })));
    }
}
