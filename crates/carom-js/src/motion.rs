//! Changes of the motion of single spheres and colliders.

use carom::{DQuat, DVec3, Pose};
use carom_scene::part::{self, only};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::failure::Failure;
use crate::find;
use crate::world::World;

/// Vectors are three numbers each; `web/package/src` sees to that.
#[wasm_bindgen]
impl World {
    /// Applies an impulse \[N s\] to a sphere at its centre.
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::apply_impulse`].
    #[wasm_bindgen(js_name = applyImpulse)]
    pub fn apply_impulse(&mut self, id: f64, impulse: &[f64]) -> Result<(), Failure> {
        let (sphere, _) = find::sphere(&self.world, id)?;
        Ok(self.world.apply_impulse(sphere, DVec3::from_slice(impulse))?)
    }

    /// Applies an impulse \[N s\] to a sphere at a point \[m\].
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::apply_impulse_at`].
    #[wasm_bindgen(js_name = applyImpulseAt)]
    pub fn apply_impulse_at(
        &mut self,
        id: f64,
        impulse: &[f64],
        point: &[f64],
    ) -> Result<(), Failure> {
        let (sphere, _) = find::sphere(&self.world, id)?;
        let (impulse, point) = (DVec3::from_slice(impulse), DVec3::from_slice(point));
        Ok(self.world.apply_impulse_at(sphere, impulse, point)?)
    }

    /// Strikes a sphere with the cue that the only sphere of `text` is struck with.
    ///
    /// # Errors
    /// [`Failure`] if the sphere is not in the world or the description is invalid.
    pub fn strike(&mut self, id: f64, text: &str) -> Result<(), Failure> {
        let (sphere, index) = find::sphere(&self.world, id)?;
        let part = part::read(text)?;
        // Making a world checks the numbers, with the fields in errors.
        part.world()?;
        let strike = only(&part.spheres)?.strike.as_ref();
        let strike = strike.ok_or_else(|| Failure::new("strike: there is none"))?;
        let radius = self.world.spheres().radii()[index];
        Ok(self.world.strike(sphere, strike.on_radius(radius)).map(drop)?)
    }

    /// Applies a force \[N\] to each sphere, three numbers each in the order of the arrays; none removes these forces.
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::set_applied_forces`].
    #[wasm_bindgen(js_name = setAppliedForces)]
    pub fn set_applied_forces(&mut self, forces: &[f64]) -> Result<(), Failure> {
        let forces: Vec<DVec3> = forces.chunks_exact(3).map(DVec3::from_slice).collect();
        Ok(self.world.set_applied_forces(&forces)?)
    }

    /// Sets the velocity of a sphere \[m/s\].
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::set_velocity`].
    #[wasm_bindgen(js_name = setVelocity)]
    pub fn set_velocity(&mut self, id: f64, velocity: &[f64]) -> Result<(), Failure> {
        let (sphere, _) = find::sphere(&self.world, id)?;
        Ok(self.world.set_velocity(sphere, DVec3::from_slice(velocity))?)
    }

    /// Sets the angular velocity of a sphere \[rad/s\].
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::set_angular_velocity`].
    #[wasm_bindgen(js_name = setAngularVelocity)]
    pub fn set_angular_velocity(&mut self, id: f64, velocity: &[f64]) -> Result<(), Failure> {
        let (sphere, _) = find::sphere(&self.world, id)?;
        Ok(self.world.set_angular_velocity(sphere, DVec3::from_slice(velocity))?)
    }

    /// Sets the velocities of a collider so that it reaches a pose after `dt` \[s\]: a position \[m\] and a rotation
    /// x, y, z, w; what is missing stays.
    ///
    /// # Errors
    /// [`Failure`] as [`carom::World::set_next_pose`].
    #[wasm_bindgen(js_name = setNextPose)]
    pub fn set_next_pose(
        &mut self,
        id: f64,
        position: Option<Vec<f64>>,
        rotation: Option<Vec<f64>>,
        dt: f64,
    ) -> Result<(), Failure> {
        let (collider, _) = find::collider(&self.world, id)?;
        let now = self.world.collider(collider)?.pose;
        let pose = Pose {
            position: position.map_or(now.position, |it| DVec3::from_slice(&it)),
            rotation: rotation.map_or(now.rotation, |it| DQuat::from_slice(&it)),
        };
        Ok(self.world.set_next_pose(collider, pose, dt)?)
    }
}
