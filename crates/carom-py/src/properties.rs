//! The properties by which Python reads and sets arrays of spheres.

/// Gives an engine a property for each quantity of spheres, by its methods `quantity` and
/// `set_quantity`.
///
/// `numbers` and `vectors` are the shapes of its arrays, as its users read them.
macro_rules! sphere_properties {
    ($engine:ident, numbers $numbers:literal, vectors $vectors:literal) => {
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
        }
    };
    ($engine:ident; $($get:ident, $set:ident, $quantity:ident: $doc:expr;)*) => {
        /// Arrays of spheres, in ascending order of id. Each is made at its first read, and then
        /// the same object for as long as no sphere comes or goes: every frame writes into it. It
        /// cannot be written to; to set a quantity, assign to the attribute.
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
