//! The properties by which Python reads and sets arrays of spheres.

/// Gives an engine a property for each quantity of spheres, by its methods `quantity` and
/// `set_quantity`.
///
/// `numbers`, `vectors` and `rotations` are the shapes of its arrays, as its users read them.
macro_rules! sphere_properties {
    (
        $engine:ident,
        numbers $numbers:literal,
        vectors $vectors:literal,
        rotations $rotations:literal
    ) => {
        sphere_properties! { $engine;
            positions, set_positions, Positions:
                concat!("Centres [m], shape ", $vectors, ".");
            velocities, set_velocities, Velocities:
                concat!("Velocities [m/s], shape ", $vectors, ".");
            radii, set_radii, Radii:
                concat!("Radii [m], shape ", $numbers, ".");
            masses, set_masses, Masses:
                concat!("Masses [kg], shape ", $numbers, ".");
            restitutions, set_restitutions, Restitutions:
                concat!("Coefficients of restitution in [0, 1], shape ", $numbers, ".");
            applied_forces, set_applied_forces, AppliedForces:
                concat!(
                    "Forces applied to single spheres [N], shape ", $vectors, ", besides those \
                     that act on all; held until they are set again. Spheres that come into the \
                     world have none."
                );
            orientations, set_orientations, Orientations:
                concat!(
                    "How spheres are turned, quaternions x, y, z, w, shape ", $rotations, "; those \
                     assigned may have any length but zero."
                );
            angular_velocities, set_angular_velocities, AngularVelocities:
                concat!("Angular velocities, along the axes [rad/s], shape ", $vectors, ".");
            inertia_factors, set_inertia_factors, InertiaFactors:
                concat!("Moments of inertia divided by m r², shape ", $numbers, ".");
            frictions, set_frictions, Frictions:
                concat!(
                    "Coefficients of friction, >= 0, shape ", $numbers, ". nan where a sphere says \
                     nothing of it: then the coefficient of what it touches counts."
                );
            rolling_frictions, set_rolling_frictions, RollingFrictions:
                concat!(
                    "Coefficients of rolling friction, >= 0, shape ", $numbers, ". nan where a \
                     sphere says nothing of it."
                );
            spinning_frictions, set_spinning_frictions, SpinningFrictions:
                concat!(
                    "Coefficients of spinning friction, >= 0, shape ", $numbers, ". nan where a \
                     sphere says nothing of it."
                );
            tangential_restitutions, set_tangential_restitutions, TangentialRestitutions:
                concat!(
                    "Coefficients of tangential restitution in [0, 1], shape ", $numbers, ". nan \
                     where a sphere says nothing of it."
                );
        }
    };
    ($engine:ident; $($get:ident, $set:ident, $quantity:ident: $doc:expr;)*) => {
        /// Arrays of spheres, in ascending order of id. Each is made at its first read, and then
        /// the same object for as long as no sphere comes or goes: every frame writes into it. What
        /// is written into it, the next call takes over; a whole quantity is set by assignment.
        #[pymethods]
        impl $engine {
            $(
                #[doc = $doc]
                #[getter]
                fn $get(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
                    self.quantity(py, Quantity::$quantity)
                }

                #[setter]
                fn $set(&self, values: &Bound<'_, PyAny>) -> PyResult<()> {
                    self.set_quantity(Quantity::$quantity, values)
                }
            )*
        }
    };
}

pub(crate) use sphere_properties;
