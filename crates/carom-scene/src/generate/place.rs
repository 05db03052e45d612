//! A place that a generator gives.

use carom::DVec3;

/// Where a generator puts a sphere or a collider.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// \[m\]
    pub center: DVec3,
    /// From 1 along each direction in which places are counted; 0 along others.
    pub numbers: [u32; 3],
}

impl Place {
    /// The one of this number, from 0.
    pub fn along(index: u32, center: DVec3) -> Self {
        Self { center, numbers: [index + 1, 0, 0] }
    }

    /// A name with the numbers of the place; none without a name.
    pub fn named(&self, name: &str) -> String {
        let numbers = self.numbers.iter().filter(|number| **number > 0).map(u32::to_string);
        let numbers = numbers.collect::<Vec<_>>().join("-");
        if name.is_empty() { String::new() } else { format!("{name} {numbers}") }
    }
}
