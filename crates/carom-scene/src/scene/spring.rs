//! Springs and threads.

use carom::{SphereId, SpringEnd, World};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Vector, is_default};

/// A spring with a damper, or a chain of them. Numbers of spheres begin at 0: the single spheres of the scene first,
/// then those of generators, each in the order of the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [
    { "required": ["spheres"] },
    { "required": ["sphere", "anchor"] },
    { "required": ["chain"] }
]))]
pub struct Spring {
    /// Numbers of the two joined spheres. Give this, `sphere` with `anchor`, or `chain`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spheres: Option<[u32; 2]>,
    /// Number of the sphere that is joined to a fixed point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<u32>,
    /// The fixed point, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor: Option<Vector>,
    /// Numbers of the first and the last sphere of a chain. Each sphere is joined to the next one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chain: Option<[u32; 2]>,
    /// Length without force, in m, >= 0. By default the length at the start.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest_length: Option<f64>,
    /// Stiffness, in N/m, >= 0.
    #[schemars(range(min = 0.0))]
    pub stiffness: f64,
    /// Damping, in kg/s, >= 0.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "is_default")]
    pub damping: f64,
    /// Whether it only pulls, as a thread; it is slack up to its rest length.
    #[serde(default, skip_serializing_if = "is_default")]
    pub only_pulls: bool,
}

impl Spring {
    /// Returns the springs of a world, between spheres by their places in it.
    pub fn all_of(world: &World) -> Vec<Self> {
        let ids = world.spheres().ids();
        world.springs().filter_map(|(_, spring)| Self::of(spring, ids)).collect()
    }

    /// The description of a spring between spheres of which these are the ids, ascending; `None` if one of its ends
    /// is not among them.
    pub fn of(spring: &carom::Spring, ids: &[SphereId]) -> Option<Self> {
        Self::naming(spring, |id| Some(ids.binary_search(&id).ok()? as u32))
    }

    /// The description of a spring of a running world, where spheres go by their ids; `None` if one of these needs
    /// more than 32 bits.
    pub fn by_ids(spring: &carom::Spring) -> Option<Self> {
        Self::naming(spring, |id| u32::try_from(id.number()).ok())
    }

    fn naming(spring: &carom::Spring, number: impl Fn(SphereId) -> Option<u32>) -> Option<Self> {
        let own = number(spring.sphere)?;
        let (spheres, sphere, anchor) = match spring.to {
            SpringEnd::Sphere(other) => (Some([own, number(other)?]), None, None),
            SpringEnd::Point(point) => (None, Some(own), Some(point.to_array())),
        };
        Some(Self {
            spheres,
            sphere,
            anchor,
            chain: None,
            rest_length: Some(spring.rest_length),
            stiffness: spring.stiffness,
            damping: spring.damping,
            only_pulls: spring.only_pulls,
        })
    }
}
