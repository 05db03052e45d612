//! Forces and springs of a world.

use std::sync::Arc;

use super::World;
use crate::error::{Error, Subject};
use crate::forces::{Force, Spring};
use crate::id::{ForceId, SpringId};
use crate::state::State;

impl World {
    /// Adds a force on every sphere.
    ///
    /// # Errors [`Error::Invalid`] if the parameters of the force are invalid, or it does not suit a periodic box.
    pub fn add_force(&mut self, force: impl Force + 'static) -> Result<ForceId, Error> {
        let id = ForceId(self.state.forces.next_number());
        self.check_force(id, &force)?;
        self.state.changed().forces.push(Arc::new(force));
        Ok(id)
    }

    /// All forces, in the order in which they are added up.
    pub fn forces(&self) -> impl ExactSizeIterator<Item = (ForceId, &dyn Force)> {
        self.state.forces.iter().map(|(number, force)| (ForceId(number), &**force))
    }

    /// Replaces a force; the next evaluation uses the new one.
    ///
    /// # Errors [`Error::Unknown`] if there is no such force, [`Error::Invalid`] if the parameters of the new one
    /// are invalid.
    pub fn set_force(&mut self, id: ForceId, force: impl Force + 'static) -> Result<(), Error> {
        let unknown = Error::Unknown(Subject::Force(id));
        self.check_force(id, &force)?;
        let place = self.state.forces.get_mut(id.0).ok_or(unknown)?;
        *place = Arc::new(force);
        self.state.changed();
        Ok(())
    }

    /// Removes a force from the world.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no such force.
    pub fn remove_force(&mut self, id: ForceId) -> Result<(), Error> {
        let removed = self.state.changed().forces.remove(id.0);
        removed.map(drop).ok_or(Error::Unknown(Subject::Force(id)))
    }

    /// Returns an error for a force whose parameters are invalid or that does not suit the boundary.
    fn check_force(&self, id: ForceId, force: &dyn Force) -> Result<(), Error> {
        force
            .validate()
            .and_then(|()| State::check_boundary(self.settings(), force))
            .map_err(|invalid| invalid.about(Subject::Force(id)))
    }

    /// Adds a spring between two spheres, or from one to a fixed point. Removing either sphere removes the spring.
    ///
    /// # Errors [`Error::Unknown`] if a sphere is not in the world, [`Error::Invalid`] for an invalid number, or
    /// both ends at one sphere.
    pub fn add_spring(&mut self, spring: Spring) -> Result<SpringId, Error> {
        let id = SpringId(self.state.springs.next_number());
        self.check_spring(id, &spring)?;
        self.state.changed().springs.push(spring);
        Ok(id)
    }

    /// All springs, in the order in which their forces are added up.
    pub fn springs(&self) -> impl ExactSizeIterator<Item = (SpringId, &Spring)> {
        self.state.springs.iter().map(|(number, spring)| (SpringId(number), spring))
    }

    /// Returns a spring.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no such spring (any more).
    pub fn spring(&self, id: SpringId) -> Result<Spring, Error> {
        self.state.springs.get(id.0).copied().ok_or(Error::Unknown(Subject::Spring(id)))
    }

    /// Replaces a spring; the next evaluation uses the new one.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no such spring; else as [`Self::add_spring`].
    pub fn set_spring(&mut self, id: SpringId, spring: Spring) -> Result<(), Error> {
        self.spring(id)?;
        self.check_spring(id, &spring)?;
        if let Some(place) = self.state.changed().springs.get_mut(id.0) {
            *place = spring;
        }
        Ok(())
    }

    /// Removes a spring from the world and returns it.
    ///
    /// # Errors
    /// [`Error::Unknown`] if there is no such spring.
    pub fn remove_spring(&mut self, id: SpringId) -> Result<Spring, Error> {
        let spring = self.spring(id)?;
        self.state.changed().springs.remove(id.0);
        Ok(spring)
    }

    /// Returns an error for a spring with invalid numbers, or at spheres that are not in the world.
    fn check_spring(&self, id: SpringId, spring: &Spring) -> Result<(), Error> {
        spring.validate().map_err(|invalid| invalid.about(Subject::Spring(id)))?;
        spring.spheres().try_for_each(|sphere| self.index_of(sphere).map(drop))
    }
}
