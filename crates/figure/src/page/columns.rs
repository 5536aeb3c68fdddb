//! Solutions as columns of numbers.
//!
//! Over the solutions of all branches end to end, packed as `packed.rs` describes: `frequency` as f64; the
//! parameter as f64, of branches over another parameter than the frequency alone, which come last;
//! displacement, acceleration, force, impact velocity, the leading multiplier (two columns) and the energy as
//! f32; contacts and flags as u16; then each output as f32.

use super::{
    content::{PageBranch, PageOutput, PageSolution},
    packed::Packer,
};

/// The columns of all branches and of outputs over them.
pub(super) fn pack(branches: &[PageBranch], outputs: &[PageOutput]) -> Vec<u8> {
    let solutions = || branches.iter().flat_map(|branch| &branch.solutions);
    let mut packer = Packer::default();
    packer.double(solutions().map(|solution| solution.frequency_hz));
    let others = branches.iter().filter(|branch| branch.over > 0);
    packer.double(others.flat_map(|branch| &branch.solutions).map(|solution| solution.parameter));
    let single: [fn(&PageSolution) -> f64; 7] = [
        |solution| solution.displacement_m,
        |solution| solution.acceleration_m_s2,
        |solution| solution.force_n,
        |solution| solution.impact_velocity_m_s,
        |solution| solution.leading_multiplier[0],
        |solution| solution.leading_multiplier[1],
        |solution| solution.energy_j,
    ];
    for column in single {
        packer.single(solutions().map(column));
    }
    packer.whole(solutions().map(|solution| u64::from(solution.contacts.min(u32::from(u16::MAX)))), 2);
    packer.whole(solutions().map(flags), 2);
    for output in outputs {
        packer.single(output.values.iter().copied());
    }
    packer.finish()
}

/// Stability and events as bits, from the lowest on.
fn flags(solution: &PageSolution) -> u64 {
    let bits = [
        solution.stable,
        solution.fold,
        solution.flip,
        solution.neimark_sacker,
        solution.branch_point,
        solution.grazing,
        solution.marginal,
    ];
    bits.iter().enumerate().map(|(bit, set)| u64::from(*set) << bit).sum()
}

#[cfg(test)]
mod tests {
    use super::{super::packed::tests::Unpacker, *};

    #[test]
    fn every_column_is_where_its_description_says() {
        let solution = PageSolution {
            frequency_hz: 30.0000001,
            parameter: 0.25,
            displacement_m: 1e-3,
            leading_multiplier: [f64::INFINITY, -2.0],
            energy_j: 8.0,
            contacts: 70_000,
            stable: true,
            grazing: true,
            marginal: true,
            ..PageSolution::default()
        };
        let over =
            |over: u32, count| PageBranch { over, solutions: vec![solution; count], ..PageBranch::default() };
        let output = PageOutput { values: vec![0.5, -0.25, 1.0], ..PageOutput::default() };
        let mut columns = Unpacker::new(&pack(&[over(0, 2), over(1, 1)], &[output]));
        assert_eq!(columns.double(3), [30.000_000_1; 3]);
        assert_eq!(columns.double(1), [0.25]);
        let single: Vec<Vec<f32>> = (0..7).map(|_| columns.single(3)).collect();
        assert_eq!(
            [single[0][2], single[4][2], single[5][2], single[6][2]],
            [1e-3, f32::INFINITY, -2.0, 8.0]
        );
        assert_eq!(columns.whole(3, 2), [u64::from(u16::MAX); 3]);
        assert_eq!(columns.whole(3, 2), [0b110_0001; 3]);
        assert_eq!(columns.single(3), [0.5, -0.25, 1.0]);
        assert!(columns.is_at_the_end());
    }
}
