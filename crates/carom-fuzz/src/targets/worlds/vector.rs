//! Vectors of worlds, and how large these are.

/// Half the width of the enclosure of the spheres \[m\].
pub const HALF: f64 = 2.0;

pub type Vector = [f64; 3];

pub fn scaled(vector: Vector, factor: f64) -> Vector {
    vector.map(|it| factor * it)
}

pub fn sum(one: Vector, other: Vector) -> Vector {
    [0, 1, 2].map(|axis| one[axis] + other[axis])
}
