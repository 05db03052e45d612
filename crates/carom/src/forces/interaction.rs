use std::fmt::Debug;

use glam::DVec3;

use super::ForceDerivatives;
use crate::id::SphereId;
use crate::settings::nearest_image;

/// A force between spheres: the force on one depends on the states of others.
/// [`Force::interaction`](crate::Force::interaction) of a [`Force`](crate::Force) returns it.
///
/// Every rule evaluates it for all spheres at one instant. The rule `exact` does so thirty to sixty times in each step of
/// up to 32 spheres, not in the order of time, and follows it to rounding; forces between more spheres it holds from one
/// force tick to the next. For reproducible bits sums need a fixed order.
///
/// ```
/// use carom::{DVec3, Force, Interaction, Sphere, SphereState, SphereStates, World};
///
/// /// Every two spheres repel each other with the same force [N].
/// #[derive(Debug)]
/// struct Repulsion(f64);
///
/// impl Force for Repulsion {
///     fn on(&self, _sphere: &SphereState, _time: f64) -> DVec3 {
///         DVec3::ZERO
///     }
///
///     fn interaction(&self) -> Option<&dyn Interaction> {
///         Some(self)
///     }
/// }
///
/// impl Interaction for Repulsion {
///     fn add_forces(&self, spheres: &SphereStates, _time: f64, forces: &mut [DVec3]) {
///         for i in 0..spheres.len() {
///             for j in 0..i {
///                 let apart = spheres.offset(j, i).normalize_or_zero();
///                 forces[i] += self.0 * apart;
///                 forces[j] -= self.0 * apart;
///             }
///         }
///     }
/// }
///
/// let mut world = World::default();
/// world.add_force(Repulsion(2.0))?;
/// world.add_sphere(Sphere::new(DVec3::ZERO, 0.1))?;
/// world.add_sphere(Sphere::new(DVec3::X, 0.1))?;
/// world.step(0.5)?;
/// assert!(world.spheres().velocities()[1].distance(DVec3::X) < 1e-14);
/// assert_eq!(world.momentum(), DVec3::ZERO);
/// # Ok::<(), carom::Error>(())
/// ```
pub trait Interaction: Debug + Send + Sync {
    /// Adds the force on each sphere \[N\] to `forces`, at this time \[s\] of the world's clock.
    fn add_forces(&self, spheres: &SphereStates, time: f64, forces: &mut [DVec3]);

    /// Potential energy \[J\] of all spheres together; 0 (the default) where there is none.
    fn potential_energy(&self, _spheres: &SphereStates, _time: f64) -> f64 {
        0.0
    }

    /// Derivatives of the forces, for derivatives of whole runs: calls `add` with the indices of a sphere and of
    /// one on whose state its force depends, and with these derivatives. Returns whether they are known; false (the
    /// default) where they are not.
    fn add_derivatives(
        &self,
        _spheres: &SphereStates,
        _time: f64,
        _add: &mut dyn FnMut([usize; 2], &ForceDerivatives),
    ) -> bool {
        false
    }

    /// Whether the forces depend on velocities (the default). Where the rule `exact` holds forces that do not, it
    /// evaluates them only in the middle of a force tick.
    fn depends_on_velocity(&self) -> bool {
        true
    }

    /// Whether it is meaningful in a periodic box, where spheres act by their nearest images (the default). A world
    /// with such a box refuses it otherwise.
    fn suits_periodic_box(&self) -> bool {
        true
    }
}

/// The states of all spheres at one instant: arrays of one length, in ascending order of id.
#[derive(Debug, Clone, Copy)]
pub struct SphereStates<'a> {
    /// Ids, ascending.
    pub ids: &'a [SphereId],
    /// Centres \[m\].
    pub positions: &'a [DVec3],
    /// Velocities \[m/s\].
    pub velocities: &'a [DVec3],
    /// Radii \[m\].
    pub radii: &'a [f64],
    /// Masses \[kg\].
    pub masses: &'a [f64],
    /// Edges of the periodic box \[m\], infinite along open axes.
    pub period: DVec3,
}

impl SphereStates<'_> {
    /// Returns the number of spheres.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Index of a sphere in the arrays; `None` if it is not in the world.
    pub fn index_of(&self, id: SphereId) -> Option<usize> {
        // Where none was removed, ids count up with the index.
        let first = self.ids.first()?.number();
        let guess = usize::try_from(id.number().checked_sub(first)?).ok()?;
        match self.ids.get(guess) {
            Some(&found) if found == id => Some(guess),
            _ => self.ids.binary_search(&id).ok(),
        }
    }

    /// Returns the offset from the centre of the sphere at one index to that of another \[m\]; in a
    /// periodic box to its nearest image.
    pub fn offset(&self, from: usize, to: usize) -> DVec3 {
        self.offset_between(self.positions[from], self.positions[to])
    }

    /// Returns the offset from one place to another \[m\]; in a periodic box to its nearest image.
    pub fn offset_between(&self, from: DVec3, to: DVec3) -> DVec3 {
        if self.period == DVec3::INFINITY {
            to - from
        } else {
            nearest_image(to - from, self.period)
        }
    }
}
