//! Forces: gravity, drag, and functions of the program.

use std::ffi::c_void;
use std::fmt::{self, Debug};

use carom::{DVec3, Force, ForceId, SphereState};
use carom_scene::scene;

use crate::pointer::{Rows, Strided, tell};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// The state of a sphere that a force may depend on.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaromSphereState {
    /// Centre [m].
    pub position: [f64; 3],
    /// Velocity [m/s].
    pub velocity: [f64; 3],
    /// Radius [m].
    pub radius: f64,
    /// Mass [kg].
    pub mass: f64,
}

/// A function that writes the force [N] on a sphere in this state at this time [s] to the three
/// numbers of `force`.
pub type CaromForceFunction = Option<
    unsafe extern "C" fn(
        sphere: *const CaromSphereState,
        time: f64,
        force: *mut f64,
        user_data: *mut c_void,
    ),
>;

/// A function that returns the potential energy [J] of a sphere in this state at this time [s].
pub type CaromPotentialFunction = Option<
    unsafe extern "C" fn(sphere: *const CaromSphereState, time: f64, user_data: *mut c_void) -> f64,
>;

/// A function that frees the data of a force.
pub type CaromDestroyFunction = Option<unsafe extern "C" fn(user_data: *mut c_void)>;

/// A force that is a function of the program. It may depend only on its arguments and `user_data`,
/// must return (no exception, no longjmp), and must not use the world that it acts in.
///
/// The thread that steps a world calls it; if the library was built with the feature `rayon`, other
/// threads do so, too. For the same bits everywhere it must not use functions whose result depends
/// on the platform (sin, exp, ...). The rule `exact` calls it some
/// tens of times in each step of a sphere, not in the order of time.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct CaromForce {
    /// The function.
    pub force: CaromForceFunction,
    /// The function of its potential energy, which accounts for all of its work, or null. Without one the work of
    /// the force is measured: carom_world_energy_account().
    pub potential_energy: CaromPotentialFunction,
    /// Passed to the functions.
    pub user_data: *mut c_void,
    /// Called once when no world and no snapshot uses the force any more; may be null. Called only
    /// for a force that was added.
    pub destroy: CaromDestroyFunction,
}

/// A force of the program in a world.
struct Function(CaromForce);

// SAFETY: `CaromForce` states which threads call its functions; the program is responsible for
// `user_data` there.
unsafe impl Send for Function {}
// SAFETY: as `Send`.
unsafe impl Sync for Function {}

impl Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Function")
    }
}

impl Drop for Function {
    fn drop(&mut self) {
        if let Some(destroy) = self.0.destroy {
            // SAFETY: a function of the program, with its own data, called this once.
            unsafe { destroy(self.0.user_data) }
        }
    }
}

impl Force for Function {
    fn on(&self, sphere: &SphereState, time: f64) -> DVec3 {
        let (state, mut force) = (told(sphere), [0.0; 3]);
        if let Some(function) = self.0.force {
            // SAFETY: a function of the program, with its own data; state and force outlive the call.
            unsafe { function(&raw const state, time, force.as_mut_ptr(), self.0.user_data) }
        }
        DVec3::from_array(force)
    }

    fn potential_energy(&self, sphere: &SphereState, time: f64) -> f64 {
        let state = told(sphere);
        self.0.potential_energy.map_or(0.0, |function| {
            // SAFETY: a function of the program, with its own data; the state outlives the call.
            unsafe { function(&raw const state, time, self.0.user_data) }
        })
    }

    fn is_conservative(&self) -> bool {
        self.0.potential_energy.is_some()
    }
}

fn told(sphere: &SphereState) -> CaromSphereState {
    let SphereState { position, velocity, radius, mass } = *sphere;
    let (position, velocity) = (position.to_array(), velocity.to_array());
    CaromSphereState { position, velocity, radius, mass }
}

/// Adds a force that is a function of the program. Writes its id to `id`, which may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_force(
    world: CaromWorld,
    force: *const CaromForce,
    id: *mut u64,
) -> CaromStatus {
    call(|| {
        if force.is_null() {
            return Err(Failure::new(CaromStatus::Null, "force is a null pointer"));
        }
        // SAFETY: it leads to such a structure, as the header demands.
        let force = unsafe { force.read_unaligned() };
        if force.force.is_none() {
            return Err(Failure::new(CaromStatus::Null, "the function of the force is null"));
        }
        let number = world.with(|inner| {
            let id = inner.world.add_force(Function(force))?;
            inner.described.add_function();
            Ok(id.number())
        })?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(id, number) };
        Ok(())
    })
}

/// Adds gravity: the same acceleration [m/s^2], three numbers, for every sphere. Writes its id to
/// `id`, which may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_gravity(
    world: CaromWorld,
    acceleration: *const f64,
    id: *mut u64,
) -> CaromStatus {
    call(|| {
        let one = Strided { stride: 0, count: 1 };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let acceleration = unsafe { Rows::new(acceleration, one, 3, "acceleration") }?.row(0);
        let number = add_described(world, scene::Force::Gravity { acceleration })?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(id, number) };
        Ok(())
    })
}

/// Adds viscous drag: a force against the velocity, in proportion to a coefficient [kg/s], >= 0.
/// Writes its id to `id`, which may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_drag(
    world: CaromWorld,
    coefficient: f64,
    id: *mut u64,
) -> CaromStatus {
    call(|| {
        let number = add_described(world, scene::Force::ViscousDrag { coefficient })?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(id, number) };
        Ok(())
    })
}

fn add_described(world: CaromWorld, force: scene::Force) -> Result<u64, Failure> {
    world.with(|inner| {
        let id = force.add_to(&mut inner.world)?;
        inner.described.scene_mut().forces.push(force);
        Ok(id.number())
    })
}

/// Removes a force.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_remove_force(world: CaromWorld, id: u64) -> CaromStatus {
    call(|| {
        world.with(|inner| {
            // Looked up first, because removing an unknown force would restart all flights.
            let place = inner.world.forces().position(|(own, _)| own.number() == id);
            let place = place.ok_or_else(|| Failure::unknown("force", id))?;
            inner.world.remove_force(ForceId::from_number(id))?;
            inner.described.scene_mut().forces.remove(place);
            Ok(())
        })
    })
}
