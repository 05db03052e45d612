//! Groups: bodies that touch at one instant, directly or through others.

use super::member::Member;
use super::touch::Touch;
use crate::detect::contact::Bodies;
use crate::rule::exact::contacts::contact_scale::ContactScale;

/// Bodies that touch at one instant.
pub(crate) struct Group {
    /// Time on the world's clock \[s\].
    pub time: f64,
    /// Ascending by index.
    pub members: Vec<Member>,
    /// Touches in the order of their bodies.
    pub touches: Vec<Touch>,
    /// Largest speed among the members before the impact \[m/s\].
    pub fastest: f64,
}

impl Group {
    /// Place among the members of the sphere at an index of the world's arrays.
    pub fn place_of(&self, index: u32) -> Option<usize> {
        self.members.binary_search_by_key(&index, |member| member.index).ok()
    }

    /// The scale of a contact of the group. Where one contact is curved, the spheres that it moves have the error
    /// of its path in all their contacts.
    pub fn scale(&self, touch: &Touch) -> ContactScale {
        let is_curved = self.touches.iter().any(Touch::is_curved);
        let is_on_curve = |place: usize| self.members[place].species.is_curved;
        let is_on_curves = self.touches.iter().all(|touch| {
            (touch.first.is_some() || !touch.is_curved()) && touch.places().all(is_on_curve)
        });
        touch.places().map(|place| &self.members[place]).fold(
            ContactScale { is_curved, is_on_curves, ..ContactScale::default() },
            |scale, member| scale.with(member.position, member.velocity, &member.species),
        )
    }

    /// Whether two bodies touch in the group.
    pub fn has(&self, bodies: Bodies) -> bool {
        self.touches.binary_search_by_key(&bodies, |touch| touch.bodies).is_ok()
    }
}
