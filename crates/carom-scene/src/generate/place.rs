//! Places of generated spheres and colliders.

use carom::DVec3;

/// Where a generator puts a sphere or a collider.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Position \[m\].
    pub center: DVec3,
    /// Numbers of the place, from 1, along each direction in which the generator counts; 0 for
    /// others.
    pub numbers: [u32; 3],
}

impl Place {
    /// Place with one number; `index` starts at 0.
    pub fn along(index: u32, center: DVec3) -> Self {
        Self { center, numbers: [index + 1, 0, 0] }
    }

    /// Appends the numbers of the place to a name; an empty name stays empty.
    pub fn named(&self, name: &str) -> String {
        let numbers = self.numbers.iter().filter(|number| **number > 0).map(u32::to_string);
        let numbers = numbers.collect::<Vec<_>>().join("-");
        if name.is_empty() { String::new() } else { format!("{name} {numbers}") }
    }
}
