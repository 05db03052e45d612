//! Arrays of spheres: how many there are, and where they lie in memory.

use wasm_bindgen::prelude::wasm_bindgen;

use crate::place::{place, place_of_any};
use crate::world::World;

/// What every sphere has. A place holds until the world is stepped or changed.
#[wasm_bindgen]
impl World {
    /// How many spheres there are.
    #[wasm_bindgen(getter)]
    pub fn count(&self) -> usize {
        self.world.spheres().len()
    }

    /// Place of the centres \[m\], three `f64` each.
    #[wasm_bindgen(getter)]
    pub fn positions(&self) -> usize {
        place(self.world.spheres().positions())
    }

    /// Place of the velocities \[m/s\], three `f64` each.
    #[wasm_bindgen(getter)]
    pub fn velocities(&self) -> usize {
        place(self.world.spheres().velocities())
    }

    /// Place of the radii \[m\], `f64`.
    #[wasm_bindgen(getter)]
    pub fn radii(&self) -> usize {
        place(self.world.spheres().radii())
    }

    /// Place of the masses \[kg\], `f64`.
    #[wasm_bindgen(getter)]
    pub fn masses(&self) -> usize {
        place(self.world.spheres().masses())
    }

    /// Place of the ids, `f64`, ascending.
    #[wasm_bindgen(getter)]
    pub fn ids(&self) -> usize {
        place(self.description.members.ids())
    }

    /// Place of the colours (sRGB), three `f32` each.
    #[wasm_bindgen(getter)]
    pub fn colors(&self) -> usize {
        place(self.description.members.colors())
    }
}

/// What spheres have where one of them is unusual. A place holds until the world is stepped or changed;
/// there is none where all spheres are as usual.
#[wasm_bindgen]
impl World {
    /// Place of the orientations, quaternions x, y, z, w of four `f64` each; none while no sphere was
    /// ever turned.
    #[wasm_bindgen(getter)]
    pub fn orientations(&self) -> Option<usize> {
        place_of_any(self.world.spheres().orientations())
    }

    /// Place of the angular velocities \[rad/s\], three `f64` each; none while no sphere was ever turned.
    #[wasm_bindgen(getter, js_name = angularVelocities)]
    pub fn angular_velocities(&self) -> Option<usize> {
        place_of_any(self.world.spheres().angular_velocities())
    }

    /// Place of the moments of inertia divided by m r², `f64`; none while all spheres are solid balls.
    #[wasm_bindgen(getter, js_name = inertiaFactors)]
    pub fn inertia_factors(&self) -> Option<usize> {
        place_of_any(self.world.spheres().inertia_factors())
    }

    /// Place of the coefficients of friction, `f64`; none while no sphere says anything of friction.
    #[wasm_bindgen(getter)]
    pub fn frictions(&self) -> Option<usize> {
        place_of_any(&self.description.members.frictions().sliding)
    }

    /// Place of the coefficients of rolling friction, as [`Self::frictions`].
    #[wasm_bindgen(getter, js_name = rollingFrictions)]
    pub fn rolling_frictions(&self) -> Option<usize> {
        place_of_any(&self.description.members.frictions().rolling)
    }

    /// Place of the coefficients of spinning friction, as [`Self::frictions`].
    #[wasm_bindgen(getter, js_name = spinningFrictions)]
    pub fn spinning_frictions(&self) -> Option<usize> {
        place_of_any(&self.description.members.frictions().spinning)
    }

    /// Place of the coefficients of tangential restitution, as [`Self::frictions`].
    #[wasm_bindgen(getter, js_name = tangentialRestitutions)]
    pub fn tangential_restitutions(&self) -> Option<usize> {
        place_of_any(&self.description.members.frictions().tangential_restitution)
    }
}
