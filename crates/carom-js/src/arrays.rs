//! Arrays of spheres: their number, and the addresses of their values in memory.

use wasm_bindgen::prelude::wasm_bindgen;

use crate::place::{place, place_of_any};
use crate::world::World;

/// Values that every sphere has. An address is valid until the world is stepped or changed.
#[wasm_bindgen]
impl World {
    /// Returns the number of spheres.
    #[wasm_bindgen(getter)]
    pub fn count(&self) -> usize {
        self.world.spheres().len()
    }

    /// Returns the address of the centres \[m\], three `f64` each.
    #[wasm_bindgen(getter)]
    pub fn positions(&self) -> usize {
        place(self.world.spheres().positions())
    }

    /// Returns the address of the velocities \[m/s\], three `f64` each.
    #[wasm_bindgen(getter)]
    pub fn velocities(&self) -> usize {
        place(self.world.spheres().velocities())
    }

    /// Returns the address of the radii \[m\], `f64`.
    #[wasm_bindgen(getter)]
    pub fn radii(&self) -> usize {
        place(self.world.spheres().radii())
    }

    /// Returns the address of the masses \[kg\], `f64`.
    #[wasm_bindgen(getter)]
    pub fn masses(&self) -> usize {
        place(self.world.spheres().masses())
    }

    /// Returns the address of the coefficients of restitution, `f64`.
    #[wasm_bindgen(getter)]
    pub fn restitutions(&self) -> usize {
        place(self.world.spheres().restitutions())
    }

    /// Returns the address of the ids, `f64`, ascending.
    #[wasm_bindgen(getter)]
    pub fn ids(&self) -> usize {
        place(self.description.members.ids())
    }

    /// Returns the address of the colours (sRGB), three `f32` each.
    #[wasm_bindgen(getter)]
    pub fn colors(&self) -> usize {
        place(self.description.members.colors())
    }
}

/// Values that are stored only if at least one sphere differs from the default; otherwise the
/// address is `undefined`. An address is valid until the world is stepped or changed.
#[wasm_bindgen]
impl World {
    /// Returns the address of the orientations, quaternions x, y, z, w of four `f64` each; none if
    /// no sphere ever rotated.
    #[wasm_bindgen(getter)]
    pub fn orientations(&self) -> Option<usize> {
        place_of_any(self.world.spheres().orientations())
    }

    /// Returns the address of the angular velocities \[rad/s\], three `f64` each; none if no sphere
    /// ever rotated.
    #[wasm_bindgen(getter, js_name = angularVelocities)]
    pub fn angular_velocities(&self) -> Option<usize> {
        place_of_any(self.world.spheres().angular_velocities())
    }

    /// Returns the address of the moments of inertia divided by m r², `f64`; none if all spheres
    /// are solid balls.
    #[wasm_bindgen(getter, js_name = inertiaFactors)]
    pub fn inertia_factors(&self) -> Option<usize> {
        place_of_any(self.world.spheres().inertia_factors())
    }

    /// Returns the address of the forces applied to single spheres \[N\], three `f64` each; none if there are none.
    #[wasm_bindgen(getter, js_name = appliedForces)]
    pub fn applied_forces(&self) -> Option<usize> {
        place_of_any(self.world.spheres().applied_forces())
    }

    /// Returns the address of the coefficients of friction, `f64`; none if no sphere has its own
    /// friction.
    #[wasm_bindgen(getter)]
    pub fn frictions(&self) -> Option<usize> {
        place_of_any(&self.description.members.frictions().sliding)
    }

    /// Returns the address of the coefficients of rolling friction, as [`Self::frictions`].
    #[wasm_bindgen(getter, js_name = rollingFrictions)]
    pub fn rolling_frictions(&self) -> Option<usize> {
        place_of_any(&self.description.members.frictions().rolling)
    }

    /// Returns the address of the coefficients of spinning friction, as [`Self::frictions`].
    #[wasm_bindgen(getter, js_name = spinningFrictions)]
    pub fn spinning_frictions(&self) -> Option<usize> {
        place_of_any(&self.description.members.frictions().spinning)
    }

    /// Returns the address of the coefficients of tangential restitution, as [`Self::frictions`].
    #[wasm_bindgen(getter, js_name = tangentialRestitutions)]
    pub fn tangential_restitutions(&self) -> Option<usize> {
        place_of_any(&self.description.members.frictions().tangential_restitution)
    }
}
