//! Corners: planes at rest at right angles to each other, such as a floor, or a floor and a wall.

use glam::DVec3;

use crate::norm::Norm;
use crate::rule::exact::contacts::contact_scale::TOUCHING;
use crate::rule::exact::features::{are_within, is_over_face, separation};
use crate::surface::{Form, Surface};

/// Planes at right angles to each other, at most.
pub(crate) const MOST_PLANES: usize = 3;

/// A plane at rest on which a sphere may lie.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane<'a> {
    /// Number of its surface.
    pub surface: u32,
    pub normal: DVec3,
    pub form: &'a Form,
    /// Offset \[m\] from the plane to its image on which the sphere lies.
    pub image: DVec3,
}

impl<'a> Plane<'a> {
    /// The surface with this number, if it is a plane at rest for a sphere with this centre \[m\] and velocity
    /// \[m/s\], not an edge.
    pub fn under(state: [DVec3; 2], surface: u32, surfaces: &'a [Surface]) -> Option<Self> {
        let (form, motion) = surfaces[surface as usize].place();
        let normal = match form {
            _ if !motion.is_at_rest() => return None,
            Form::HalfSpace { normal, .. } => *normal,
            Form::Rectangle(rectangle) => {
                (are_within(rectangle, state) == [true; 2]).then_some(rectangle.normal)?
            }
            Form::Band(band) => {
                let normal = band.flat_normal()?;
                is_over_face(band, state).then_some(normal)?
            }
            Form::Facet(facet) => facet.holds(state).then_some(facet.frame.normal)?,
            _ => return None,
        };
        Some(Self { surface, normal, form, image: DVec3::ZERO })
    }

    /// The image of the plane at this offset \[m\].
    pub fn at_image(self, image: DVec3) -> Self {
        Self { image, ..self }
    }

    /// Whether no part of an image of a form, at this offset \[m\], is above the plane, up to the rounding of its
    /// coordinates and of a sphere's centre \[m\]. A sphere that stays on the plane then passes over the image.
    pub fn is_above(&self, form: &Form, image: DVec3, center: DVec3) -> bool {
        let coordinates = self.form.coordinates() + form.coordinates() + center.norm();
        let foot = self.foot_of(center - self.image) + (self.image - image);
        form.height_above([foot, self.normal]) <= TOUCHING * coordinates
    }

    /// Returns the point of the plane nearest to the centre \[m\] of a sphere that touches it.
    pub fn foot_of(&self, center: DVec3) -> DVec3 {
        separation(self.form, center, 0.0, true).map_or(center, |it| it.point)
    }
}

/// Planes whose normals have no axis in common: the force of one does not change that of another, not even by
/// rounding.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Corner<'a> {
    /// Ascending by surface.
    planes: [Option<Plane<'a>>; MOST_PLANES],
}

impl<'a> Corner<'a> {
    /// Adds a plane. Returns `None` and adds nothing where the planes would make no corner.
    #[must_use]
    pub fn add(&mut self, plane: Plane<'a>) -> Option<()> {
        let is_apart = |other: Plane| other.normal * plane.normal == DVec3::ZERO;
        if !self.planes().all(is_apart) {
            return None;
        }
        *self.planes.iter_mut().find(|place| place.is_none())? = Some(plane);
        self.planes.sort_unstable_by_key(|plane| plane.map_or(u32::MAX, |it| it.surface));
        Some(())
    }

    pub fn planes(&self) -> impl Iterator<Item = Plane<'a>> {
        self.planes.into_iter().flatten()
    }
}
