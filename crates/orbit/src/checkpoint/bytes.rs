//! Numbers and points of a path as bytes, and back.

use hammerbeam_path::{ContinuationPoint, PathEvents, TestKind, TestValue};

#[derive(Default)]
pub(super) struct Writer {
    pub bytes: Vec<u8>,
}

impl Writer {
    pub fn word(&mut self, value: u64) {
        self.bytes.extend_from_slice(&value.to_le_bytes());
    }

    pub fn float(&mut self, value: f64) {
        self.word(value.to_bits());
    }

    pub fn floats(&mut self, values: &[f64]) {
        self.word(values.len() as u64);
        values.iter().for_each(|&value| self.float(value));
    }

    /// The kind stands above what is left out.
    pub fn tests(&mut self, tests: &[TestValue]) {
        self.word(tests.len() as u64);
        for test in tests {
            let &TestValue { kind, value, count, undecided, left_out } = test;
            self.float(value);
            self.word(u64::from(count));
            self.word(u64::from(undecided));
            self.word(u64::from(left_out) | u64::from(kind == TestKind::NearJump) << 32);
        }
    }

    pub fn point(&mut self, point: &ContinuationPoint) {
        self.floats(&point.point);
        self.floats(&point.tangent);
        for value in [point.arc_length, point.orientation, point.log_determinant] {
            self.float(value);
        }
        self.word(point.signature);
        self.float(point.correction_norm);
        self.float(point.residual_norm);
        let PathEvents { fold, branch_point, signature_change, corner, zeros } = point.events;
        let bits = [fold, branch_point, signature_change, corner];
        let bits: u64 = bits.iter().enumerate().map(|(i, &set)| u64::from(set) << i).sum();
        self.word(bits | u64::from(zeros) << 32);
        self.float(point.uncertainty);
        self.word(point.evaluations);
    }
}

pub(super) struct Reader<'a> {
    pub bytes: &'a [u8],
}

impl Reader<'_> {
    pub fn word(&mut self) -> Option<u64> {
        let (word, rest) = self.bytes.split_first_chunk::<8>()?;
        self.bytes = rest;
        Some(u64::from_le_bytes(*word))
    }

    pub fn float(&mut self) -> Option<f64> {
        self.word().map(f64::from_bits)
    }

    pub fn floats(&mut self) -> Option<Vec<f64>> {
        let length = usize::try_from(self.word()?).ok()?;
        if length > self.bytes.len() / 8 {
            return None;
        }
        (0..length).map(|_| self.float()).collect()
    }

    pub fn tests(&mut self) -> Option<Vec<TestValue>> {
        let count = self.word()?;
        let test = |_| {
            let value = self.float()?;
            let [count, undecided, last] = [self.word()?, self.word()?, self.word()?];
            let kind = match last >> 32 {
                0 => TestKind::SignChange,
                1 => TestKind::NearJump,
                _ => return None,
            };
            let number = |word: u64| u32::try_from(word).ok();
            let (count, undecided) = (number(count)?, number(undecided)?);
            Some(TestValue { kind, value, count, undecided, left_out: number(last & 0xffff_ffff)? })
        };
        (0..count).map(test).collect()
    }

    pub fn point(&mut self) -> Option<ContinuationPoint> {
        Some(ContinuationPoint {
            point: self.floats()?,
            tangent: self.floats()?,
            arc_length: self.float()?,
            orientation: self.float()?,
            log_determinant: self.float()?,
            signature: self.word()?,
            correction_norm: self.float()?,
            residual_norm: self.float()?,
            events: {
                let bits = self.word()?;
                let set = |bit: u64| bits >> bit & 1 == 1;
                PathEvents {
                    fold: set(0),
                    branch_point: set(1),
                    signature_change: set(2),
                    corner: set(3),
                    zeros: (bits >> 32) as u32,
                }
            },
            uncertainty: self.float()?,
            evaluations: self.word()?,
        })
    }
}
