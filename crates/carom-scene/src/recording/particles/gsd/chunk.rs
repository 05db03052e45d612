//! Chunks of data: matrices of numbers of one kind.

use super::layout::width;

/// A matrix of numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chunk {
    pub rows: u64,
    pub columns: u32,
    pub kind: u8,
    pub bytes: Vec<u8>,
}

const UINT8: u8 = 1;
const UINT32: u8 = 3;
const UINT64: u8 = 4;
const FLOAT: u8 = 9;
const DOUBLE: u8 = 10;

impl Chunk {
    fn new<const N: usize>(
        kind: u8,
        columns: usize,
        numbers: impl ExactSizeIterator<Item = [u8; N]>,
    ) -> Self {
        let rows = (numbers.len() / columns) as u64;
        Self { rows, columns: columns as u32, kind, bytes: numbers.flatten().collect() }
    }

    /// Small whole numbers, one in each row.
    pub fn bytes(numbers: &[u8]) -> Self {
        Self::new(UINT8, 1, numbers.iter().map(|&it| [it]))
    }

    /// A whole number.
    pub fn uint32(number: u32) -> Self {
        Self::new(UINT32, 1, [number.to_le_bytes()].into_iter())
    }

    /// Whole numbers, one in each row.
    pub fn uint64(numbers: &[u64]) -> Self {
        Self::new(UINT64, 1, numbers.iter().map(|it| it.to_le_bytes()))
    }

    /// Numbers in single precision.
    pub fn single(numbers: &[f64], columns: usize) -> Self {
        Self::new(FLOAT, columns, numbers.iter().map(|&it| (it as f32).to_le_bytes()))
    }

    /// Numbers in double precision.
    pub fn double(numbers: &[f64], columns: usize) -> Self {
        Self::new(DOUBLE, columns, numbers.iter().map(|it| it.to_le_bytes()))
    }

    /// Returns all numbers, if they are real.
    pub fn reals(&self) -> Option<Vec<f64>> {
        let (floats, _) = self.bytes.as_chunks();
        let (doubles, _) = self.bytes.as_chunks();
        match self.kind {
            FLOAT => Some(floats.iter().map(|&it| f64::from(f32::from_le_bytes(it))).collect()),
            DOUBLE => Some(doubles.iter().map(|&it| f64::from_le_bytes(it)).collect()),
            _ => None,
        }
    }

    /// Returns all numbers, if they are whole and not negative.
    pub fn whole(&self) -> Option<Vec<u64>> {
        let is_signed = matches!(self.kind, 5..=8);
        let is_whole = matches!(self.kind, 1..=8);
        let width = width(self.kind).filter(|_| is_whole)? as usize;
        let number = |bytes: &[u8]| {
            let mut word = [0; 8];
            word[..width].copy_from_slice(bytes);
            let is_negative = is_signed && bytes.last().is_some_and(|&last| last >= 128);
            (!is_negative).then(|| u64::from_le_bytes(word))
        };
        self.bytes.chunks_exact(width).map(number).collect()
    }
}
