//! Solutions as columns of numbers.
//!
//! `frequency` as f64, then displacement, acceleration, force, impact velocity and the leading multiplier
//! (two columns) as f32, then contacts and flags as u16, all little-endian, over the solutions of all
//! branches end to end. 36 bytes a solution.

use super::content::{PageBranch, PageSolution};

/// The columns of all branches.
pub(super) fn pack(branches: &[PageBranch]) -> Vec<u8> {
    let solutions = || branches.iter().flat_map(|branch| &branch.solutions);
    let mut bytes: Vec<u8> = solutions().flat_map(|solution| solution.frequency_hz.to_le_bytes()).collect();
    let single: [fn(&PageSolution) -> f64; 6] = [
        |solution| solution.displacement_m,
        |solution| solution.acceleration_m_s2,
        |solution| solution.force_n,
        |solution| solution.impact_velocity_m_s,
        |solution| solution.leading_multiplier[0],
        |solution| solution.leading_multiplier[1],
    ];
    for column in single {
        bytes.extend(solutions().flat_map(|solution| (column(solution) as f32).to_le_bytes()));
    }
    let contacts = |solution: &PageSolution| u16::try_from(solution.contacts).unwrap_or(u16::MAX);
    bytes.extend(solutions().flat_map(|solution| contacts(solution).to_le_bytes()));
    bytes.extend(solutions().flat_map(|solution| flags(solution).to_le_bytes()));
    bytes
}

/// Stability and events as bits, from the lowest on.
fn flags(solution: &PageSolution) -> u16 {
    let bits = [
        solution.stable,
        solution.fold,
        solution.flip,
        solution.neimark_sacker,
        solution.branch_point,
        solution.grazing,
        solution.marginal,
    ];
    bits.iter().enumerate().map(|(bit, set)| u16::from(*set) << bit).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_column_is_where_its_description_says() {
        let solution = PageSolution {
            frequency_hz: 30.0000001,
            displacement_m: 1e-3,
            leading_multiplier: [f64::INFINITY, -2.0],
            contacts: 70_000,
            stable: true,
            grazing: true,
            marginal: true,
            ..PageSolution::default()
        };
        let branch = PageBranch { solutions: vec![solution; 2], ..PageBranch::default() };
        let bytes = pack(&[branch]);
        assert_eq!(bytes.len(), 2 * 36);
        assert_eq!(bytes[8..16], 30.000_000_1_f64.to_le_bytes());
        let single = |column: usize| {
            let at = 16 + 8 * column;
            f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
        };
        assert_eq!([single(0), single(4), single(5)], [1e-3, f32::INFINITY, -2.0]);
        assert_eq!(bytes[64..66], u16::MAX.to_le_bytes());
        assert_eq!(bytes[68..70], 0b110_0001_u16.to_le_bytes());
    }
}
