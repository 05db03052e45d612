//! Scales of shapes of triangles.

use super::collider::Shape;
use super::mesh::{HeightField, Mesh};
use super::track::{Piece, Track};

impl Shape {
    /// Returns the scale of a mesh, the length of a height field along local x \[m\], or the radius of the gutter of a
    /// track \[m\]; `None` of another shape.
    pub fn scale(&self) -> Option<f64> {
        match self {
            Self::Mesh(mesh) => Some(mesh.scale),
            Self::HeightField(field) => Some(field.size_x),
            Self::Track(track) => Some(track.radius),
            _ => None,
        }
    }

    /// Returns the same shape with all its lengths in proportion to a [`Self::scale`]; `None` if it has none, or that is
    /// not positive and finite.
    pub fn scaled(&self, scale: f64) -> Option<Self> {
        let factor = scale / self.scale()?;
        if !(scale > 0.0 && factor.is_finite()) {
            return None;
        }
        match self {
            Self::Mesh(mesh) => Some(Self::Mesh(mesh.with_scale(scale))),
            Self::HeightField(field) => {
                let times = |row: &Vec<f64>| row.iter().map(|it| factor * it).collect();
                let heights = field.heights.iter().map(times).collect();
                let field = HeightField::new([scale, factor * field.size_z], heights);
                Some(Self::HeightField(field))
            }
            Self::Track(track) => Some(Self::Track(track.with_radius(scale))),
            _ => None,
        }
    }
}

impl Mesh {
    fn with_scale(&self, scale: f64) -> Self {
        let mut scaled = Self::listed(self.vertices.clone(), self.triangles.clone());
        scaled.file.clone_from(&self.file);
        (scaled.scale, scaled.one_sided) = (scale, self.one_sided);
        scaled
    }
}

impl Track {
    fn with_radius(&self, radius: f64) -> Self {
        let factor = radius / self.radius;
        let pieces = self.pieces.iter().map(|it| it.scaled(factor)).collect();
        let mut scaled = Self::new(radius, pieces);
        (scaled.arc_degrees, scaled.sides) = (self.arc_degrees, self.sides);
        (scaled.facet_degrees, scaled.pitch_degrees) = (self.facet_degrees, self.pitch_degrees);
        scaled
    }
}

impl Piece {
    fn scaled(&self, factor: f64) -> Self {
        match *self {
            Self::Straight { length } => Self::Straight { length: factor * length },
            Self::Curve { radius, degrees, bank_degrees } => {
                Self::Curve { radius: factor * radius, degrees, bank_degrees }
            }
            Self::Bend { radius, degrees, shift } => {
                Self::Bend { radius: factor * radius, degrees, shift: factor * shift }
            }
            Self::Gap { length, drop, pitch_degrees } => {
                Self::Gap { length: factor * length, drop: factor * drop, pitch_degrees }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lengths_of_a_shape_grow_with_its_scale() {
        let triangle =
            Mesh::listed(vec![[0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]], vec![[0, 1, 2]]);
        let field = HeightField::new([2.0, 4.0], vec![vec![0.0, 1.0], vec![0.5, 0.0]]);
        let curve = Piece::Curve { radius: 1.0, degrees: 90.0, bank_degrees: 0.0 };
        let gap = Piece::Gap { length: 1.0, drop: 0.2, pitch_degrees: None };
        let track = Track::new(0.1, vec![Piece::Straight { length: 1.0 }, gap, curve]);
        for shape in [Shape::Mesh(triangle), Shape::HeightField(field), Shape::Track(track)] {
            let doubled = shape.scaled(2.0 * shape.scale().unwrap()).unwrap();
            let bounds = [&shape, &doubled].map(|it| match it.physical().unwrap() {
                carom::Shape::Mesh(mesh) => mesh.bounds(),
                _ => unreachable!("a mesh"),
            });
            for (small, large) in bounds[0].into_iter().zip(bounds[1]) {
                // Powers of two do not round; a curve has sines.
                assert!((2.0 * small - large).length() <= 1e-15 * large.length(), "{shape:?}");
            }
        }
        assert_eq!(Shape::HalfSpace.scaled(2.0), None);
    }
}
