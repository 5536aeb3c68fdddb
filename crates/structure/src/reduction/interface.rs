//! Places of coordinates within a selection of them.

/// Positions in `selection` of those `coordinates` that it holds.
pub(super) fn places(selection: &[usize], coordinates: &[usize]) -> Vec<usize> {
    coordinates.iter().filter_map(|wanted| selection.iter().position(|index| index == wanted)).collect()
}

/// `first`, then what of `second` is not in it.
pub(super) fn joined(first: &[usize], second: &[usize]) -> Vec<usize> {
    let mut all = first.to_vec();
    for &index in second {
        if !all.contains(&index) {
            all.push(index);
        }
    }
    all
}
