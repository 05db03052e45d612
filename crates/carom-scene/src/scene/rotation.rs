//! Rotations as people write them, to quaternions.

use carom::{DQuat, DVec3};
use schemars::JsonSchema;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::values::{Quaternion, Vector};

/// A rotation: a quaternion x, y, z, w of any length but zero, or a turn.
#[derive(JsonSchema)]
#[schemars(untagged)]
#[expect(dead_code, reason = "describes what `read` reads")]
pub(super) enum Rotation {
    /// A quaternion.
    Quaternion(Quaternion),
    /// A turn.
    Turn(Turn),
}

/// A turn: about an axis by an angle, by three angles, or so that +y points along a normal.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Turn {
    /// Axis of the turn, of any length but zero. The turn is counterclockwise, seen against the axis.
    axis: Option<Vector>,
    /// Angle of the turn about the axis, in degrees.
    degrees: Option<f64>,
    /// Angles about the fixed axes x, y and z, in degrees, applied about z first, then x, then y (the order of Unity's
    /// inspector).
    euler_degrees: Option<Vector>,
    /// Direction to which +y turns, of any length but zero: the normal of a half-space or rectangle.
    normal: Option<Vector>,
}

/// Reads a rotation in any of its forms.
pub(super) fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Quaternion, D::Error> {
    deserializer.deserialize_any(Reader)
}

/// Reads a rotation for a field that may be missing.
pub(super) fn read_some<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Quaternion>, D::Error> {
    read(deserializer).map(Some)
}

/// Reads a list of rotations.
pub(super) fn read_list<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<Quaternion>, D::Error> {
    struct One(Quaternion);

    impl<'de> Deserialize<'de> for One {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            read(deserializer).map(One)
        }
    }

    let list = Vec::deserialize(deserializer)?;
    Ok(list.into_iter().map(|One(rotation)| rotation).collect())
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = Quaternion;

    fn expecting(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        formatter.write_str(
            "a quaternion [x, y, z, w], { axis, degrees }, { euler_degrees }, or { normal }",
        )
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Quaternion, A::Error> {
        let quaternion = Quaternion::deserialize(SeqAccessDeserializer::new(list));
        quaternion.map_err(|error: A::Error| match error.to_string() {
            said if said.starts_with("invalid length 3,") => A::Error::custom(
                "has three numbers, a quaternion four: angles about x, y and z in degrees are \
                 { euler_degrees = [x, y, z] }",
            ),
            _ => error,
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<Quaternion, A::Error> {
        let turn = Turn::deserialize(MapAccessDeserializer::new(table))?;
        turn.quaternion().map_err(A::Error::custom)
    }
}

impl Turn {
    fn quaternion(&self) -> Result<Quaternion, String> {
        match *self {
            Self { axis: Some(axis), degrees: Some(angle), euler_degrees: None, normal: None } => {
                about(direction(axis, "axis")?, finite(angle)?)
            }
            Self { euler_degrees: Some(angles), axis: None, degrees: None, normal: None } => {
                let [x, y, z] = angles;
                let (x, y, z) = (finite(x)?, finite(y)?, finite(z)?);
                let turns = [(DVec3::Y, y), (DVec3::X, x), (DVec3::Z, z)];
                let turns = turns.map(|(axis, angle)| turn(axis, angle));
                Ok((turns[0] * turns[1] * turns[2]).to_array())
            }
            Self { normal: Some(normal), axis: None, degrees: None, euler_degrees: None } => {
                Ok(up_to(direction(normal, "normal")?).to_array())
            }
            _ => Err("needs `axis` with `degrees`, or `euler_degrees`, or `normal`".to_owned()),
        }
    }
}

fn about(axis: DVec3, degrees: f64) -> Result<Quaternion, String> {
    Ok(turn(axis, degrees).to_array())
}

/// A turn about a unit vector.
fn turn(axis: DVec3, degrees: f64) -> DQuat {
    let (sin, cos) = libm::sincos(0.5 * degrees.to_radians());
    let [x, y, z] = (axis * sin).to_array();
    DQuat::from_xyzw(x, y, z, cos)
}

/// The shortest turn of +y to a unit vector.
fn up_to(normal: DVec3) -> DQuat {
    // Straight down, every horizontal axis would do.
    if normal.x == 0.0 && normal.z == 0.0 && normal.y < 0.0 {
        return DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
    }
    // 1 + y, which would cancel near -1.
    let cosine = if normal.y < 0.0 {
        (normal.x * normal.x + normal.z * normal.z) / (1.0 - normal.y)
    } else {
        1.0 + normal.y
    };
    DQuat::from_xyzw(normal.z, 0.0, -normal.x, cosine).normalize()
}

/// The rotation of a camera at `position` that looks along its local -z at `target`, +y upward in the
/// picture (-z where it looks straight down).
pub(super) fn looking_at(position: Vector, target: Vector) -> Result<Quaternion, String> {
    let way = DVec3::from_array(target) - DVec3::from_array(position);
    let ahead = direction(way.to_array(), "the way from `position` to `look_at`")?;
    let yaw = libm::atan2(-ahead.x, -ahead.z).to_degrees();
    let pitch = libm::asin(ahead.y.clamp(-1.0, 1.0)).to_degrees();
    Ok((turn(DVec3::Y, yaw) * turn(DVec3::X, pitch)).to_array())
}

fn finite(angle: f64) -> Result<f64, String> {
    if angle.is_finite() { Ok(angle) } else { Err(format!("an angle cannot be {angle}")) }
}

fn direction(value: Vector, name: &str) -> Result<DVec3, String> {
    let unit = DVec3::from_array(value).try_normalize();
    unit.ok_or_else(|| format!("{name} must be finite and not zero, not {value:?}"))
}
