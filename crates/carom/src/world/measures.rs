//! Measures of a world: energies, momenta, overlaps.

use glam::DVec3;

use super::World;
use super::passages::Passages;
use crate::detect::Separation;
use crate::detect::contact::{Bodies, Contact};
use crate::detect::contacts::{self, Search};
use crate::detect::image_overlaps;
use crate::detect::instant::Instant;
use crate::invariants;
use crate::report::{BodyPair, Overlap};
use crate::shear::Shear;

impl World {
    /// Kinetic energy \[J\] of translation and rotation. In a box in steady shear
    /// ([`Settings::shear_rate`](crate::Settings::shear_rate)) it is that of the motion relative to the mean flow.
    pub fn kinetic_energy(&self) -> f64 {
        invariants::kinetic_energy(self.spheres(), Shear::of(self.settings()))
    }

    /// Kinetic energy of rotation \[J\].
    pub fn rotational_energy(&self) -> f64 {
        invariants::rotational_energy(self.spheres())
    }

    /// Potential energy \[J\] in all forces, springs and pair potentials that have one.
    pub fn potential_energy(&self) -> f64 {
        self.state.potential_energy(self.time())
    }

    /// Kinetic and potential energy \[J\].
    pub fn total_energy(&self) -> f64 {
        self.state.total_energy(self.time())
    }

    /// Momentum \[kg m/s\].
    pub fn momentum(&self) -> DVec3 {
        invariants::momentum(self.spheres())
    }

    /// Angular momentum about the origin \[kg m²/s\], with that of spin.
    pub fn angular_momentum(&self) -> DVec3 {
        invariants::angular_momentum(self.spheres())
    }

    /// The longest frame \[s\] in which motion on springs is certainly stable. It is infinite without springs, and
    /// under the rule `exact`, which shortens its force ticks for them. The other rules refuse longer frames; `contact`
    /// shortens its sub-steps. By explicit Euler the motion grows in all frames, unless it is damped.
    ///
    /// A frame has to be shorter than `2 / w`, with the fastest frequency w (Hairer, Lubich, Wanner, *Geometric
    /// Numerical Integration*, I.5.2); sub-steps are at most `1 / w`.
    pub fn longest_stable_frame(&self) -> f64 {
        self.state.longest_stable_frame()
    }

    /// Whether spheres are rotated or rotate, or may begin to: an emitter emits such spheres, or a sphere, an
    /// emitter or a solid collider has friction under the rules `exact` or `contact`.
    pub fn has_spin(&self) -> bool {
        let emitted = || self.emitters().map(|(_, emitter)| emitter.sphere);
        self.state.spheres.motion.spin.is_any()
            || emitted().any(|sphere| sphere.is_turned())
            || (self.settings().rule.has_friction() && self.is_rough())
    }

    /// Whether friction of some body is above zero. It acts under some rules only:
    /// [`Rule::has_friction`](crate::Rule::has_friction).
    pub fn is_rough(&self) -> bool {
        let colliders = self.colliders().filter(|(_, collider)| !collider.trigger);
        let of_colliders = colliders.map(|(_, collider)| collider.friction);
        let of_emitted = self.emitters().map(|(_, emitter)| emitter.sphere.friction);
        let of_pairs = self.material_pairs().iter().map(|pair| pair.friction);
        let sphere_frictions = self.spheres().frictions().iter().copied();
        sphere_frictions
            .chain(of_colliders)
            .chain(of_pairs)
            .chain(of_emitted)
            .any(|friction| friction.acts())
    }

    /// Spheres that overlap each other (where spheres collide) or a solid collider by more than
    /// `tolerance` \[m\], in order of their bodies, each two bodies once; in a periodic box across its
    /// faces, too. Under `exact` and `contact`, which let no sphere sink in, one that passes a collider from behind
    /// does not overlap it.
    pub fn overlaps(&self, tolerance: f64) -> Vec<Overlap> {
        let mut overlaps = Vec::new();
        let now = self.state.now();
        let passages = Passages::of(&self.state);
        contacts::visit_overlaps(&now, tolerance, &mut Search::default(), |contact| {
            if !passages.has(contact.bodies, &contact.separation) {
                overlaps.push(Overlap::of(contact, &now.system));
            }
        });
        let passes = |bodies, separation: &Separation| passages.has(bodies, separation);
        self.add_overlaps_of_images(&now, tolerance, passes, &mut overlaps);
        in_order(&mut overlaps);
        overlaps
    }

    /// The first overlap, as [`Self::overlaps`] lists it, for which `is_sought` holds; `None` without one. The
    /// search stops at the first pair of spheres and keeps no list of them: many spheres in one place have more
    /// pairs than there is memory. Of several overlaps, the same one is found each time.
    pub fn find_overlap(&self, mut is_sought: impl FnMut(&Overlap) -> bool) -> Option<Overlap> {
        let now = self.state.now();
        let mut search = Search::default();
        let of = |contact: &Contact| Overlap::of(contact, &now.system);
        let pair = contacts::find_overlapping_pair(&now, &mut search, |it| is_sought(&of(it)));
        if let Some(contact) = pair {
            return Some(of(&contact));
        }
        let mut overlaps = Vec::new();
        contacts::visit_overlapping_surfaces(&now, 0.0, &mut search, |contact| {
            overlaps.push(of(contact));
        });
        self.add_overlaps_of_images(&now, 0.0, |_, _| false, &mut overlaps);
        in_order(&mut overlaps);
        overlaps.into_iter().find(is_sought)
    }

    /// Adds the overlaps across the faces of a periodic box.
    fn add_overlaps_of_images(
        &self,
        now: &Instant,
        tolerance: f64,
        passes: impl Fn(Bodies, &Separation) -> bool,
        overlaps: &mut Vec<Overlap>,
    ) {
        let period = now.system.settings.boundary.period();
        if period.is_finite_mask().any() {
            image_overlaps::visit(now, tolerance, passes, |bodies, depth| {
                overlaps.push(Overlap { between: BodyPair::of(bodies, &now.system), depth });
            });
        }
    }

    /// Whether a sphere at `center` with `radius` \[m\] would touch or overlap a solid collider.
    pub fn meets_collider(&self, center: DVec3, radius: f64) -> bool {
        contacts::meets_surface(&self.state.now().system, center, radius)
    }
}

/// Sorts overlaps by their bodies. A box has several surfaces: the deepest overlap counts.
fn in_order(overlaps: &mut Vec<Overlap>) {
    let order =
        |a: &Overlap, b: &Overlap| a.between.cmp(&b.between).then(b.depth.total_cmp(&a.depth));
    overlaps.sort_by(order);
    overlaps.dedup_by_key(|overlap| overlap.between);
}
