//! Ids: the numbers by which the parts of a world are named.

use std::fmt::{self, Display};

/// Defines an id: a number from 0 that a world gives once and never again.
macro_rules! id {
    ($(#[$about:meta])* $name:ident, $things:literal) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name(pub(crate) u64);

        impl $name {
            /// The id with this number. One that a world has not given names nothing there.
            pub fn from_number(number: u64) -> Self {
                Self(number)
            }

            #[doc = concat!("Place in the order in which ", $things, " came into the world, from 0.")]
            pub fn number(self) -> u64 {
                self.0
            }
        }

        impl Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                Display::fmt(&self.0, f)
            }
        }
    };
}

id!(
    /// Names a sphere for as long as it lives; never given twice in one world.
    ///
    /// The number counts up in the order of adding and emission, from 0.
    SphereId,
    "spheres"
);

id!(
    /// Names a collider of a world.
    ColliderId,
    "colliders"
);

id!(
    /// Names an emitter of a world.
    EmitterId,
    "emitters"
);

id!(
    /// Names a spring of a world.
    SpringId,
    "springs"
);

id!(
    /// Names a force of a world.
    ForceId,
    "forces"
);
