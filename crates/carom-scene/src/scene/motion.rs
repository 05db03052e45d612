//! How colliders move that do not move steadily.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rotation;
use super::values::{Quaternion, Vector, is_default};

/// A part of the motion of a collider, as a function of time.
///
/// Several parts act one after the other on the collider at rest, and each carries those before it along.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Motion {
    /// Moves steadily.
    Steady {
        /// Velocity, in m/s.
        velocity: Vector,
    },
    /// Moves to and fro along an axis: amplitude times the sine of the phase.
    Oscillate {
        /// Direction of the axis, of any length but zero. By default up.
        #[serde(default = "up")]
        axis: Vector,
        /// How far it comes to each side, in m.
        amplitude: f64,
        /// Periods per second, in Hz, >= 0.
        #[schemars(range(min = 0.0))]
        frequency: f64,
        /// Phase at the start, in degrees. By default 0: it begins in the middle, on its way along the axis.
        #[serde(default, skip_serializing_if = "is_default")]
        phase_degrees: f64,
    },
    /// Turns steadily about an axis through a pivot.
    Turn {
        /// Direction of the axis, of any length but zero. By default up.
        #[serde(default = "up")]
        axis: Vector,
        /// A point of the axis, from the position of the collider, in m. By default there.
        #[serde(default, skip_serializing_if = "is_default")]
        pivot: Vector,
        /// Angular velocity, in rad/s.
        rate: f64,
    },
    /// Turns to and fro about an axis through a pivot: amplitude times the sine of the phase.
    Swing {
        /// Direction of the axis, of any length but zero. By default up.
        #[serde(default = "up")]
        axis: Vector,
        /// A point of the axis, from the position of the collider, in m. By default there.
        #[serde(default, skip_serializing_if = "is_default")]
        pivot: Vector,
        /// How far it turns to each side, in degrees.
        amplitude_degrees: f64,
        /// Periods per second, in Hz, >= 0.
        #[schemars(range(min = 0.0))]
        frequency: f64,
        /// Phase at the start, in degrees. By default 0: it begins in the middle, on its way by the right-hand rule.
        #[serde(default, skip_serializing_if = "is_default")]
        phase_degrees: f64,
    },
    /// Moves and turns through poses at given times, and rests before and after. Velocities are continuous.
    Keyframes {
        /// Times of the poses, in s: two or more, ascending.
        times: Vec<f64>,
        /// Displacements from the position of the collider, in m, one for each time. By default none.
        #[serde(default, skip_serializing_if = "is_default")]
        positions: Vec<Vector>,
        /// Rotations from that of the collider, one for each time, about the axes of the world. By default none.
        #[schemars(with = "Vec<rotation::Rotation>")]
        #[serde(
            default,
            deserialize_with = "rotation::read_list",
            skip_serializing_if = "is_default"
        )]
        rotations: Vec<Quaternion>,
        /// The point about which it turns, from the position of the collider, in m. By default there.
        #[serde(default, skip_serializing_if = "is_default")]
        pivot: Vector,
        /// Whether it repeats, before and after. The last pose has to be the first. By default not.
        #[serde(default, skip_serializing_if = "is_default")]
        repeat: bool,
    },
}

impl Motion {
    /// Name of its kind, as it is written.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Steady { .. } => "steady",
            Self::Oscillate { .. } => "oscillate",
            Self::Turn { .. } => "turn",
            Self::Swing { .. } => "swing",
            Self::Keyframes { .. } => "keyframes",
        }
    }
}

fn up() -> Vector {
    [0.0, 1.0, 0.0]
}

/// One part as a table, several as a list of tables.
pub(super) mod one_or_more {
    use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
    use serde::de::{MapAccess, SeqAccess, Visitor};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::Motion;

    pub fn serialize<S: Serializer>(parts: &[Motion], serializer: S) -> Result<S::Ok, S::Error> {
        match parts {
            [part] => part.serialize(serializer),
            parts => parts.serialize(serializer),
        }
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<Motion>, D::Error> {
        deserializer.deserialize_any(Parts)
    }

    struct Parts;

    impl<'de> Visitor<'de> for Parts {
        type Value = Vec<Motion>;

        fn expecting(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
            formatter.write_str("a motion or a list of motions")
        }

        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Vec<Motion>, A::Error> {
            Ok(vec![Motion::deserialize(MapAccessDeserializer::new(map))?])
        }

        fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Vec<Motion>, A::Error> {
            Vec::deserialize(SeqAccessDeserializer::new(list))
        }
    }
}
