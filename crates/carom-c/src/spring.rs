//! Springs between two spheres, or from one to a fixed point.

use carom::{DVec3, SphereId, Spring, SpringEnd, SpringId};

use crate::pointer::{Out, Plain, read, tell};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// A spring with a damper, between the centres of two spheres or from one to a fixed point. At the
/// length l it pulls with stiffness (l - rest_length) + damping dl/dt. It is removed with either
/// sphere. carom_spring() returns one with default values.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaromSpring {
    /// Id of the sphere at the first end.
    pub sphere: u64,
    /// Id of the sphere at the second end, a different one; ignored if `to_point` is 1.
    pub other: u64,
    /// 1 for a spring that ends at `point`, 0 for one that ends at the sphere `other`.
    pub to_point: u32,
    /// 1 for a thread, which only pulls and is slack up to its rest length; 0 for a spring that
    /// pushes, too.
    pub only_pulls: u32,
    /// The fixed point [m]; ignored if `to_point` is 0.
    pub point: [f64; 3],
    /// Length without force [m], >= 0.
    pub rest_length: f64,
    /// Stiffness [N/m], >= 0.
    pub stiffness: f64,
    /// Damping [kg/s], >= 0.
    pub damping: f64,
}

// SAFETY: a structure of numbers.
unsafe impl Plain for CaromSpring {}

impl From<Spring> for CaromSpring {
    fn from(spring: Spring) -> Self {
        let (other, to_point, point) = match spring.to {
            SpringEnd::Sphere(other) => (other.number(), 0, [0.0; 3]),
            SpringEnd::Point(point) => (0, 1, point.to_array()),
        };
        Self {
            sphere: spring.sphere.number(),
            other,
            to_point,
            only_pulls: spring.only_pulls.into(),
            point,
            rest_length: spring.rest_length,
            stiffness: spring.stiffness,
            damping: spring.damping,
        }
    }
}

impl CaromSpring {
    /// Converts to the spring of the physics, without checking numbers.
    fn physical(&self) -> Result<Spring, Failure> {
        if self.to_point > 1 || self.only_pulls > 1 {
            let problem = "`to_point` and `only_pulls` must be 0 or 1 each";
            return Err(Failure::new(CaromStatus::Invalid, problem));
        }
        let to = match self.to_point {
            0 => SpringEnd::Sphere(SphereId::from_number(self.other)),
            _ => SpringEnd::Point(DVec3::from_array(self.point)),
        };
        let (sphere, only_pulls) = (SphereId::from_number(self.sphere), self.only_pulls == 1);
        let Self { rest_length, stiffness, damping, .. } = *self;
        Ok(Spring { sphere, to, rest_length, stiffness, damping, only_pulls })
    }
}

/// Returns a spring of 1 N/m without damping and with rest length 0, from sphere 0 to the origin.
#[unsafe(no_mangle)]
pub extern "C" fn carom_spring() -> CaromSpring {
    Spring::to_point(SphereId::from_number(0), DVec3::ZERO, 0.0).into()
}

/// Adds a spring. Writes its id, which is never reused, to `id`, which may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_spring(
    world: CaromWorld,
    spring: *const CaromSpring,
    id: *mut u64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let spring = unsafe { read(spring, "spring") }?.physical()?;
        let number = world.with(|inner| Ok(inner.world.add_spring(spring)?.number()))?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(id, number) };
        Ok(())
    })
}

/// Reads a spring by its id.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_spring(
    world: CaromWorld,
    id: u64,
    spring: *mut CaromSpring,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(spring, "spring") }?;
        let spring = world.with(|inner| Ok(inner.world.spring(SpringId::from_number(id))?))?;
        place.set(spring.into());
        Ok(())
    })
}

/// Replaces a spring, which keeps its id.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_spring(
    world: CaromWorld,
    id: u64,
    spring: *const CaromSpring,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let spring = unsafe { read(spring, "spring") }?.physical()?;
        world.with(|inner| Ok(inner.world.set_spring(SpringId::from_number(id), spring)?))
    })
}

/// Removes a spring; its spheres stay.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_remove_spring(world: CaromWorld, id: u64) -> CaromStatus {
    call(|| {
        world.with(|inner| {
            let id = SpringId::from_number(id);
            inner.world.remove_spring(id)?;
            Ok(())
        })
    })
}
