//! Single spheres: add, read, change, remove.

use carom::{DQuat, DVec3, Error, Friction, Mass, Sphere, SphereId, World};
use carom_scene::Budget;

use crate::pointer::{Out, Plain, Rows, RowsMut, Strided, read, tell};
use crate::status::{CaromStatus, Failure, call};
use crate::world::{CaromWorld, Inner};

/// A sphere. carom_sphere() returns one with default values.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaromSphere {
    /// Centre [m].
    pub position: [f64; 3],
    /// Velocity [m/s].
    pub velocity: [f64; 3],
    /// Radius [m], > 0.
    pub radius: f64,
    /// Mass [kg], > 0.
    pub mass: f64,
    /// Density [kg/m^3], from which the mass is computed; 0 if `mass` is given. Reading a sphere
    /// gives 0.
    pub density: f64,
    /// Coefficient of restitution in [0, 1].
    pub restitution: f64,
    /// Coefficient of friction, >= 0; not a number (NAN) if the touching body decides.
    pub friction: f64,
    /// Coefficient of rolling friction, as `friction`.
    pub rolling_friction: f64,
    /// Coefficient of spinning friction, as `friction`.
    pub spinning_friction: f64,
    /// Coefficient of tangential restitution in [0, 1], or not a number.
    pub tangential_restitution: f64,
    /// Orientation: a quaternion x, y, z, w of any length but zero.
    pub orientation: [f64; 4],
    /// Angular velocity [rad/s].
    pub angular_velocity: [f64; 3],
    /// Moment of inertia divided by m r^2, > 0: 2/5 for a solid ball, 2/3 for a thin shell.
    pub inertia_factor: f64,
}

// SAFETY: a structure of numbers.
unsafe impl Plain for CaromSphere {}

impl From<Sphere> for CaromSphere {
    fn from(sphere: Sphere) -> Self {
        let [friction, rolling_friction, spinning_friction, tangential_restitution] =
            coefficients(sphere.friction);
        Self {
            position: sphere.position.to_array(),
            velocity: sphere.velocity.to_array(),
            radius: sphere.radius,
            mass: sphere.kilograms(),
            density: 0.0,
            restitution: sphere.restitution,
            friction,
            rolling_friction,
            spinning_friction,
            tangential_restitution,
            orientation: sphere.orientation.to_array(),
            angular_velocity: sphere.angular_velocity.to_array(),
            inertia_factor: sphere.inertia_factor,
        }
    }
}

impl From<CaromSphere> for Sphere {
    /// Converts without checking numbers.
    fn from(sphere: CaromSphere) -> Self {
        let mass = match sphere.density {
            0.0 => Mass::Kilograms(sphere.mass),
            density => Mass::Density(density),
        };
        Self::new(DVec3::from_array(sphere.position), sphere.radius)
            .with_velocity(DVec3::from_array(sphere.velocity))
            .with_mass(mass)
            .with_restitution(sphere.restitution)
            .with_friction(friction_of([
                sphere.friction,
                sphere.rolling_friction,
                sphere.spinning_friction,
                sphere.tangential_restitution,
            ]))
            .with_orientation(DQuat::from_array(sphere.orientation))
            .with_angular_velocity(DVec3::from_array(sphere.angular_velocity))
            .with_inertia_factor(sphere.inertia_factor)
    }
}

/// Returns the coefficients of sliding, rolling and spinning friction, and of tangential
/// restitution; not a number for a missing one.
pub(crate) fn coefficients(friction: Friction) -> [f64; 4] {
    let Friction { sliding, rolling, spinning, tangential_restitution, .. } = friction;
    [sliding, rolling, spinning, tangential_restitution].map(|it| it.unwrap_or(f64::NAN))
}

/// Returns the friction with these coefficients.
pub(crate) fn friction_of(coefficients: [f64; 4]) -> Friction {
    let mut friction = Friction::default();
    [friction.sliding, friction.rolling, friction.spinning, friction.tangential_restitution] =
        coefficients.map(|it| (!it.is_nan()).then_some(it));
    friction
}

/// Returns a solid ball of 1 kg and radius 1 m at rest at the origin, with restitution 1 and
/// without its own friction.
#[unsafe(no_mangle)]
pub extern "C" fn carom_sphere() -> CaromSphere {
    Sphere::new(DVec3::ZERO, 1.0).into()
}

/// Adds a sphere, which may overlap others. Writes its id, which is never reused, to `id`, which
/// may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_sphere(
    world: CaromWorld,
    sphere: *const CaromSphere,
    id: *mut u64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let sphere = unsafe { read(sphere, "sphere") }?;
        let number = world.with(|inner| Ok(inner.world.add_sphere(sphere.into())?.number()))?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        unsafe { tell(id, number) };
        Ok(())
    })
}

/// Adds `count` spheres, with `stride` bytes from one to the next (0: sizeof(CaromSphere)), all or
/// none. Writes their ids to `ids`, `count` of them without gaps; it may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_add_spheres(
    world: CaromWorld,
    spheres: *const CaromSphere,
    stride: usize,
    count: usize,
    ids: *mut u64,
) -> CaromStatus {
    call(|| {
        refuse_too_many(count)?;
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let spheres = unsafe { Rows::new(spheres, Strided { stride, count }, 1, "spheres") }?;
        let added = world.with(|inner| add_all(inner, &spheres))?;
        if !ids.is_null() {
            // SAFETY: the caller's array is null or has this layout, as the header demands.
            let mut ids = unsafe { RowsMut::new(ids, Strided { stride: 0, count }, 1, "ids") }?;
            added.iter().enumerate().for_each(|(row, id)| ids.set_row(row, [id.number()]));
        }
        Ok(())
    })
}

/// Refuses more spheres than a scene may have: such a count is a mistake and would read beyond the
/// array.
pub(crate) fn refuse_too_many(count: usize) -> Result<(), Failure> {
    let most = Budget::MOST.spheres;
    if count as u64 > most {
        let problem = format!("{count} spheres are more than the {most} that one call may add");
        return Err(Failure::new(CaromStatus::Length, problem));
    }
    Ok(())
}

/// Adds all spheres, or none.
fn add_all(inner: &mut Inner, rows: &Rows<'_, CaromSphere>) -> Result<Vec<SphereId>, Failure> {
    let spheres: Vec<Sphere> = rows.values().map(Sphere::from).collect();
    // A separate world checks them first, because ids of the world would be used up before an
    // invalid sphere.
    let mut check = World::default();
    for (row, &sphere) in spheres.iter().enumerate() {
        check.add_sphere(sphere).map_err(|error| refused("spheres", row, error))?;
    }
    let add = |sphere| Ok(inner.world.add_sphere(sphere)?);
    spheres.into_iter().map(add).collect()
}

/// Returns the error of a row of an array.
pub(crate) fn refused(name: &str, row: usize, error: Error) -> Failure {
    let problem = match &error {
        Error::Invalid { source, .. } => source.to_string(),
        other => other.to_string(),
    };
    Failure { message: format!("{name}[{row}]: {problem}"), ..Failure::from(error) }
}

/// Reads a sphere by its id.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_sphere(
    world: CaromWorld,
    id: u64,
    sphere: *mut CaromSphere,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(sphere, "sphere") }?;
        let sphere = world.with(|inner| Ok(inner.world.sphere(SphereId::from_number(id))?))?;
        place.set(sphere.into());
        Ok(())
    })
}

/// Replaces a sphere, which keeps its id and its applied force.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_sphere(
    world: CaromWorld,
    id: u64,
    sphere: *const CaromSphere,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let sphere = unsafe { read(sphere, "sphere") }?;
        let sphere: carom::Sphere = sphere.into();
        world.with(|inner| {
            let own = SphereId::from_number(id);
            // What programs in C cannot name stays as it is.
            let before = inner.world.sphere(own)?;
            let sphere = sphere.with_groups(before.groups).with_user_data(before.user_data);
            Ok(inner.world.set_sphere(own, sphere)?)
        })
    })
}

/// Removes `count` spheres by their ids, which are without gaps: all or none. Later spheres move up
/// in the arrays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_remove_spheres(
    world: CaromWorld,
    ids: *const u64,
    count: usize,
) -> CaromStatus {
    call(|| {
        refuse_too_many(count)?;
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let ids = unsafe { Rows::new(ids, Strided { stride: 0, count }, 1, "ids") }?;
        let ids: Vec<SphereId> = ids.values().map(SphereId::from_number).collect();
        world.with(|inner| Ok(inner.world.remove_spheres(&ids)?))
    })
}

/// Reads the index of a sphere in all arrays. It changes when earlier spheres are removed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_index_of(
    world: CaromWorld,
    id: u64,
    index: *mut usize,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(index, "index") }?;
        let found = world.with(|inner| {
            let spheres = inner.world.spheres();
            let index = spheres.index_of(SphereId::from_number(id));
            index.ok_or_else(|| Failure::unknown("sphere", id))
        })?;
        place.set(found);
        Ok(())
    })
}
