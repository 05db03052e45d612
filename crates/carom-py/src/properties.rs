//! Python properties that read and set arrays of spheres.

/// Defines a property for each quantity of spheres on an engine, by its methods `quantity` and
/// `set_quantity`.
///
/// `numbers`, `vectors` and `rotations` are the shapes of the arrays in docstrings.
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
                    "Forces applied to single spheres [N], shape ", $vectors, ", besides \
                     those that act on all. They act until they are set again; a new sphere has \
                     none."
                );
            orientations, set_orientations, Orientations:
                concat!(
                    "Orientations, quaternions x, y, z, w, shape ", $rotations, "; assigned ones \
                     may have any length but zero."
                );
            angular_velocities, set_angular_velocities, AngularVelocities:
                concat!("Angular velocities [rad/s], shape ", $vectors, ".");
            inertia_factors, set_inertia_factors, InertiaFactors:
                concat!("Moments of inertia divided by m r², shape ", $numbers, ".");
            frictions, set_frictions, Frictions:
                concat!(
                    "Coefficients of friction, >= 0, shape ", $numbers, ". nan for a sphere \
                     without its own: then the coefficient of the touching body counts."
                );
            rolling_frictions, set_rolling_frictions, RollingFrictions:
                concat!(
                    "Coefficients of rolling friction, >= 0, shape ", $numbers, ". nan for a \
                     sphere without its own."
                );
            spinning_frictions, set_spinning_frictions, SpinningFrictions:
                concat!(
                    "Coefficients of spinning friction, >= 0, shape ", $numbers, ". nan for a \
                     sphere without its own."
                );
            tangential_restitutions, set_tangential_restitutions, TangentialRestitutions:
                concat!(
                    "Coefficients of tangential restitution in [0, 1], shape ", $numbers, ". nan \
                     for a sphere without its own."
                );
        }
    };
    ($engine:ident; $($get:ident, $set:ident, $quantity:ident: $doc:expr;)*) => {
        /// Arrays of spheres, in ascending order of id. Each is made at its first read and stays
        /// the same object until spheres are added or removed; every frame updates it. The next
        /// call applies values written into it; assignment sets a whole quantity.
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
