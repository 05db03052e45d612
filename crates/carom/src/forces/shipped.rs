//! Serialization of the forces of this crate. A force of another crate is code and cannot be written.

use std::any::Any;
use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, Serializer, ser};

use super::{
    Buoyancy, ConstantForce, Force, Gravity, MutualGravity, PointAttractor, QuadraticDrag,
    ViscousDrag, Vortex, Wind,
};
use crate::numbered::Numbered;

/// Defines [`Shipped`]: a variant for each force of this crate.
macro_rules! shipped {
    ($($variant:ident($force:ident)),* $(,)?) => {
        /// A force of this crate.
        #[derive(Debug, Clone, Copy, Serialize, Deserialize)]
        enum Shipped {
            $($variant($force)),*
        }

        impl Shipped {
            fn of(force: &dyn Force) -> Option<Self> {
                let force: &dyn Any = force;
                $(if let Some(&force) = force.downcast_ref::<$force>() {
                    return Some(Self::$variant(force));
                })*
                None
            }

            fn into_force(self) -> Arc<dyn Force> {
                match self {
                    $(Self::$variant(force) => Arc::new(force)),*
                }
            }
        }
    };
}

shipped! {
    Constant(ConstantForce),
    Drag(ViscousDrag),
    Gravity(Gravity),
    PointAttractor(PointAttractor),
    Wind(Wind),
    Vortex(Vortex),
    QuadraticDrag(QuadraticDrag),
    Buoyancy(Buoyancy),
    MutualGravity(MutualGravity),
}

/// The number of the first force that is of another crate.
pub(crate) fn first_foreign(forces: &Numbered<Arc<dyn Force>>) -> Option<u64> {
    let foreign =
        |(number, force): (u64, &Arc<dyn Force>)| Shipped::of(&**force).is_none().then_some(number);
    forces.iter().find_map(foreign)
}

pub(crate) fn serialize<S: Serializer>(
    forces: &Numbered<Arc<dyn Force>>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let shipped = |force: &Arc<dyn Force>| {
        Shipped::of(&**force).ok_or_else(|| ser::Error::custom("a force of another crate"))
    };
    forces.try_map(shipped)?.serialize(serializer)
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Numbered<Arc<dyn Force>>, D::Error> {
    let forces = Numbered::<Shipped>::deserialize(deserializer)?;
    forces.try_map(|force| Ok(force.into_force()))
}
