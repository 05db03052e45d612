//! Quantities of all spheres as arrays with a row for each sphere.

use carom::{DQuat, DVec3, SOLID_BALL, Sphere, SphereMotion, Spheres, World};

use crate::pointer::{Plain, Rows, RowsMut, Strided, require_count};
use crate::sphere::{coefficients, friction_of, refused};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// A quantity that all spheres have.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CaromQuantity {
    /// Centres [m]: 3 numbers.
    Positions = 0,
    /// Velocities [m/s]: 3 numbers.
    Velocities = 1,
    /// Radii [m]: 1 number.
    Radii = 2,
    /// Masses [kg]: 1 number.
    Masses = 3,
    /// Coefficients of restitution: 1 number.
    Restitutions = 4,
    /// Orientations: 4 numbers, a quaternion x, y, z, w.
    Orientations = 5,
    /// Angular velocities [rad/s]: 3 numbers.
    AngularVelocities = 6,
    /// Moments of inertia divided by m r^2: 1 number.
    InertiaFactors = 7,
    /// Coefficients of friction: 1 number, not a number if a sphere has none of its own.
    Frictions = 8,
    /// Coefficients of rolling friction: 1 number, as for friction.
    RollingFrictions = 9,
    /// Coefficients of spinning friction: 1 number, as for friction.
    SpinningFrictions = 10,
    /// Coefficients of tangential restitution: 1 number, as for friction.
    TangentialRestitutions = 11,
    /// Applied forces [N]: 3 numbers. They act until they are set again or removed by writing no
    /// rows.
    AppliedForces = 12,
}

impl CaromQuantity {
    const ALL: [(Self, &str); 13] = [
        (Self::Positions, "positions"),
        (Self::Velocities, "velocities"),
        (Self::Radii, "radii"),
        (Self::Masses, "masses"),
        (Self::Restitutions, "restitutions"),
        (Self::Orientations, "orientations"),
        (Self::AngularVelocities, "angular_velocities"),
        (Self::InertiaFactors, "inertia_factors"),
        (Self::Frictions, "frictions"),
        (Self::RollingFrictions, "rolling_frictions"),
        (Self::SpinningFrictions, "spinning_frictions"),
        (Self::TangentialRestitutions, "tangential_restitutions"),
        (Self::AppliedForces, "applied_forces"),
    ];

    /// Returns the quantity with this number, and its name.
    fn of(number: i32) -> Result<(Self, &'static str), Failure> {
        let found = usize::try_from(number).ok().and_then(|number| Self::ALL.get(number));
        let unknown =
            || Failure::new(CaromStatus::Argument, format!("there is no quantity {number}"));
        found.copied().ok_or_else(unknown)
    }

    /// Returns how many numbers a row has.
    fn width(self) -> usize {
        match self {
            Self::Positions | Self::Velocities | Self::AngularVelocities => 3,
            Self::AppliedForces => 3,
            Self::Orientations => 4,
            _ => 1,
        }
    }

    /// Returns a quantity of one number.
    fn number(self, spheres: &Spheres, index: usize) -> f64 {
        let coefficient = |which: usize| {
            let friction = spheres.frictions().get(index).copied().unwrap_or_default();
            coefficients(friction)[which]
        };
        match self {
            Self::Radii => spheres.radii()[index],
            Self::Masses => spheres.masses()[index],
            Self::Restitutions => spheres.restitutions()[index],
            Self::Frictions => coefficient(0),
            Self::RollingFrictions => coefficient(1),
            Self::SpinningFrictions => coefficient(2),
            Self::TangentialRestitutions => coefficient(3),
            // The list is empty if all are solid balls.
            _ => spheres.inertia_factors().get(index).copied().unwrap_or(SOLID_BALL),
        }
    }

    /// Returns a quantity of three numbers; empty if no sphere has it.
    fn vectors(self, spheres: &Spheres) -> &[DVec3] {
        match self {
            Self::Positions => spheres.positions(),
            Self::Velocities => spheres.velocities(),
            Self::AngularVelocities => spheres.angular_velocities(),
            _ => spheres.applied_forces(),
        }
    }

    /// Returns a sphere with another value of this quantity.
    fn changed(self, sphere: Sphere, values: &[f64]) -> Sphere {
        let value = values[0];
        let coefficient = |which: usize| {
            let mut all = coefficients(sphere.friction);
            all[which] = value;
            sphere.with_friction(friction_of(all))
        };
        match self {
            Self::Radii => sphere.with_radius(value),
            Self::Masses => sphere.with_mass(value),
            Self::Restitutions => sphere.with_restitution(value),
            Self::Orientations => sphere.with_orientation(DQuat::from_slice(values)),
            Self::AngularVelocities => sphere.with_angular_velocity(DVec3::from_slice(values)),
            Self::InertiaFactors => sphere.with_inertia_factor(value),
            Self::Frictions => coefficient(0),
            Self::RollingFrictions => coefficient(1),
            Self::SpinningFrictions => coefficient(2),
            Self::TangentialRestitutions => coefficient(3),
            Self::Positions => sphere.with_position(DVec3::from_slice(values)),
            Self::Velocities => sphere.with_velocity(DVec3::from_slice(values)),
            Self::AppliedForces => sphere,
        }
    }
}

/// A number in an array of the program, with 64 or 32 bits.
trait Number: Plain + Into<f64> {
    fn of(number: f64) -> Self;
}

impl Number for f64 {
    fn of(number: f64) -> Self {
        number
    }
}

impl Number for f32 {
    fn of(number: f64) -> Self {
        number as Self
    }
}

/// Reads the number of spheres, which is the number of rows in every array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_count(world: CaromWorld, count: *mut usize) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    let place = unsafe { crate::pointer::Out::new(count, "count") };
    world.measure(place, |inner| inner.world.spheres().len())
}

/// Reads a quantity (CaromQuantity) of all spheres into rows in ascending order of id, with
/// `stride` bytes from one row to the next (0: no gaps). `count` must be the number of spheres.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_read(
    world: CaromWorld,
    quantity: i32,
    values: *mut f64,
    stride: usize,
    count: usize,
) -> CaromStatus {
    // SAFETY: the caller's array is null or has this layout, as the header demands.
    unsafe { read(world, quantity, values, Strided { stride, count }) }
}

/// Reads a quantity as carom_world_read() does, in 32-bit numbers for drawing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_read_f32(
    world: CaromWorld,
    quantity: i32,
    values: *mut f32,
    stride: usize,
    count: usize,
) -> CaromStatus {
    // SAFETY: the caller's array is null or has this layout, as the header demands.
    unsafe { read(world, quantity, values, Strided { stride, count }) }
}

/// Writes a quantity (CaromQuantity) of all spheres from rows in the layout of carom_world_read().
/// If a number is refused, none is written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_write(
    world: CaromWorld,
    quantity: i32,
    values: *const f64,
    stride: usize,
    count: usize,
) -> CaromStatus {
    // SAFETY: the caller's array is null or has this layout, as the header demands.
    unsafe { write(world, quantity, values, Strided { stride, count }) }
}

/// Writes a quantity as carom_world_write() does, from 32-bit numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_write_f32(
    world: CaromWorld,
    quantity: i32,
    values: *const f32,
    stride: usize,
    count: usize,
) -> CaromStatus {
    // SAFETY: the caller's array is null or has this layout, as the header demands.
    unsafe { write(world, quantity, values, Strided { stride, count }) }
}

/// # Safety
/// As [`RowsMut::new`].
unsafe fn read<T: Number>(
    world: CaromWorld,
    quantity: i32,
    values: *mut T,
    array: Strided,
) -> CaromStatus {
    call(|| {
        let (quantity, name) = CaromQuantity::of(quantity)?;
        // SAFETY: the caller promises such an array.
        let mut rows = unsafe { RowsMut::new(values, array, quantity.width(), name) }?;
        world.with(|inner| {
            let spheres = inner.world.spheres();
            require_count(name, rows.count(), spheres.len())?;
            for row in 0..rows.count() {
                read_row(quantity, spheres, row, &mut rows);
            }
            Ok(())
        })
    })
}

fn read_row<T: Number>(
    quantity: CaromQuantity,
    spheres: &Spheres,
    row: usize,
    rows: &mut RowsMut<'_, T>,
) {
    match quantity.width() {
        1 => rows.set_row(row, [T::of(quantity.number(spheres, row))]),
        4 => {
            let orientation = spheres.orientations().get(row).copied().unwrap_or_default();
            rows.set_row(row, orientation.to_array().map(T::of));
        }
        _ => {
            let vector = quantity.vectors(spheres).get(row).copied().unwrap_or_default();
            rows.set_row(row, vector.to_array().map(T::of));
        }
    }
}

/// # Safety
/// As [`Rows::new`].
unsafe fn write<T: Number>(
    world: CaromWorld,
    quantity: i32,
    values: *const T,
    array: Strided,
) -> CaromStatus {
    call(|| {
        let (quantity, name) = CaromQuantity::of(quantity)?;
        // SAFETY: the caller promises such an array.
        let rows = unsafe { Rows::new(values, array, quantity.width(), name) }?;
        world.with(|inner| {
            // No rows remove the applied forces.
            if quantity == CaromQuantity::AppliedForces && rows.count() == 0 {
                return Ok(inner.world.set_applied_forces(&[])?);
            }
            require_count(name, rows.count(), inner.world.spheres().len())?;
            match quantity.width() {
                1 => set_others(&mut inner.world, (quantity, name), |row| rows.row::<1>(row)),
                4 => set_others(&mut inner.world, (quantity, name), |row| rows.row::<4>(row)),
                _ => {
                    let vector = |row| DVec3::from_array(rows.row::<3>(row).map(T::into));
                    set_vectors(&mut inner.world, (quantity, name), vector)
                }
            }
        })
    })
}

/// Sets vectors of all spheres, or of none.
fn set_vectors(
    world: &mut World,
    (quantity, name): (CaromQuantity, &str),
    vector: impl Fn(usize) -> DVec3,
) -> Result<(), Failure> {
    let spheres = world.spheres();
    let new: Vec<DVec3> = (0..spheres.len()).map(&vector).collect();
    if let Some(row) = new.iter().position(|vector| !vector.is_finite()) {
        let problem = format!("{name}[{row}]: must be finite");
        return Err(Failure::new(CaromStatus::Invalid, problem));
    }
    let ids = spheres.ids().iter();
    let motion = |(&id, (&position, &velocity))| SphereMotion { id, position, velocity };
    let motions: Vec<SphereMotion> = match quantity {
        CaromQuantity::AppliedForces => return Ok(world.set_applied_forces(&new)?),
        CaromQuantity::AngularVelocities => {
            return set_others(world, (quantity, name), |row| new[row].to_array());
        }
        CaromQuantity::Positions => {
            let both = new.iter().zip(spheres.velocities());
            ids.zip(both).map(motion).collect()
        }
        _ => {
            let both = spheres.positions().iter().zip(&new);
            ids.zip(both).map(motion).collect()
        }
    };
    Ok(world.set_motions(&motions)?)
}

/// Sets a quantity that is no motion, for all spheres or for none.
fn set_others<T: Into<f64>, const N: usize>(
    world: &mut World,
    (quantity, name): (CaromQuantity, &str),
    values: impl Fn(usize) -> [T; N],
) -> Result<(), Failure> {
    let spheres = world.spheres();
    let (ids, mut check) = (spheres.ids().to_vec(), World::default());
    let changed = |row: usize| quantity.changed(spheres.get(row), &values(row).map(T::into));
    let changed: Vec<Sphere> = (0..ids.len()).map(changed).collect();
    // A separate world checks them first.
    for (row, &sphere) in changed.iter().enumerate() {
        check.add_sphere(sphere).map_err(|error| refused(name, row, error))?;
    }
    let mut both = ids.into_iter().zip(changed);
    both.try_for_each(|(id, sphere)| Ok(world.set_sphere(id, sphere)?))
}
