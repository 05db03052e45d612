//! The flat faces of colliders, each made once.

use std::collections::BTreeMap;

use super::face::{FlushFace, Outlines};
use crate::surface::Surface;

/// Faces among the surfaces of colliders.
pub(super) struct Faces<'a> {
    pub surfaces: &'a [Surface],
    /// Faces that were needed, by the numbers of the surfaces; `None` for what is not flat.
    known: BTreeMap<u32, Option<FlushFace>>,
    outlines: Outlines,
}

impl<'a> Faces<'a> {
    pub fn of(surfaces: &'a [Surface]) -> Self {
        Self { surfaces, known: BTreeMap::new(), outlines: Outlines::default() }
    }

    /// The face of a surface; `None` if it is not flat.
    pub fn face(&mut self, number: u32) -> Option<&FlushFace> {
        let Self { surfaces, known, outlines } = self;
        let make = || FlushFace::of(&surfaces[number as usize].form, outlines);
        known.entry(number).or_insert_with(make).as_ref()
    }

    /// Returns whether two faces are flush.
    pub fn are_flush(&mut self, numbers: [u32; 2]) -> bool {
        for number in numbers {
            self.face(number);
        }
        let [first, second] = numbers.map(|number| self.known.get(&number)?.as_ref());
        first.zip(second).is_some_and(|(first, second)| first.is_flush_with(second))
    }
}
