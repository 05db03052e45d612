//! Measured quantities of a world.

use carom::{BodyPair, Overlap};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::world::World;

/// Sums over all spheres.
#[wasm_bindgen]
impl World {
    /// Returns the kinetic energy, with rotation \[J\].
    #[wasm_bindgen(js_name = kineticEnergy)]
    pub fn kinetic_energy(&self) -> f64 {
        self.world.kinetic_energy()
    }

    /// Returns the kinetic energy of rotation \[J\].
    #[wasm_bindgen(js_name = rotationalEnergy)]
    pub fn rotational_energy(&self) -> f64 {
        self.world.rotational_energy()
    }

    /// Returns the potential energy in all forces that have one \[J\].
    #[wasm_bindgen(js_name = potentialEnergy)]
    pub fn potential_energy(&self) -> f64 {
        self.world.potential_energy()
    }

    /// Returns the momentum \[kg m/s\].
    pub fn momentum(&self) -> Vec<f64> {
        self.world.momentum().to_array().to_vec()
    }

    /// Returns the angular momentum about the origin, with spin \[kg m²/s\].
    #[wasm_bindgen(js_name = angularMomentum)]
    pub fn angular_momentum(&self) -> Vec<f64> {
        self.world.angular_momentum().to_array().to_vec()
    }
}

/// The present state.
#[wasm_bindgen]
impl World {
    /// Returns whether spheres are rotated or rotate, or may start to by friction.
    #[wasm_bindgen(getter, js_name = hasSpin)]
    pub fn has_spin(&self) -> bool {
        self.world.has_spin()
    }

    /// Returns the longest frame in which motion on springs is certainly stable \[s\].
    #[wasm_bindgen(getter, js_name = longestStableFrame)]
    pub fn longest_stable_frame(&self) -> f64 {
        self.world.longest_stable_frame()
    }

    /// Returns the bodies that overlap by more than `tolerance` \[m\] in rows: 1 if the first is a collider or 0 if it
    /// is a sphere, ids, depth \[m\].
    ///
    /// # Errors
    /// [`Failure`] if the tolerance is negative or NaN.
    pub fn overlaps(&self, tolerance: f64) -> Result<Vec<f64>, Failure> {
        if tolerance.is_nan() || tolerance < 0.0 {
            let problem = format!("tolerance must be zero or positive, not {tolerance}");
            return Err(Failure::new(problem));
        }
        Ok(self.world.overlaps(tolerance).iter().flat_map(row).collect())
    }
}

fn row(overlap: &Overlap) -> [f64; 4] {
    let (is_collider, first, second) = match overlap.between {
        BodyPair::Spheres(first, second) => (0.0, first.number(), second.number()),
        BodyPair::Collider { collider, sphere } => (1.0, collider.number(), sphere.number()),
    };
    [is_collider, first as f64, second as f64, overlap.depth]
}
