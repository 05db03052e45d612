//! What spheres bounce off.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::finish::Finish;
use super::material::RestitutionLaw;
use super::mesh::{self, HeightField, Mesh};
use super::motion::{self, Motion};
use super::rotation;
use super::track::Track;
use super::values::{
    Color, Quaternion, Vector, all_groups, are_all_groups, first_group, is_default, is_first_group,
    one, unturned,
};

/// A fixed or moving shape that spheres bounce off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Collider {
    /// Name, for reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Shape.
    pub shape: Shape,
    /// Position of its centre, in m.
    #[serde(default)]
    pub position: Vector,
    /// Rotation about its centre.
    #[schemars(with = "rotation::Rotation")]
    #[serde(default = "unturned", deserialize_with = "rotation::read")]
    pub rotation: Quaternion,
    /// Velocity of its centre, in m/s.
    #[serde(default, skip_serializing_if = "is_default")]
    pub velocity: Vector,
    /// Angular velocity about its centre, in rad/s.
    #[serde(default, skip_serializing_if = "is_default")]
    pub angular_velocity: Vector,
    /// Velocity of the material along the surface, in its own coordinates, in m/s, as of a conveyor belt: friction feels
    /// it, and the shape stays.
    #[serde(default, skip_serializing_if = "is_default")]
    pub surface_velocity: Vector,
    /// Motion about where it is at rest, instead of velocities: one, or a list of parts that act one after the other.
    /// By default none.
    #[schemars(with = "OneOrMore<Motion>")]
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "motion::one_or_more")]
    pub motion: Vec<Motion>,
    /// Name of its material, whose fields count where its own are missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Coefficient of restitution in [0, 1].
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default = "one")]
    pub restitution: f64,
    /// Restitution by the speed of approach; beside it `restitution` does not count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution_law: Option<RestitutionLaw>,
    /// Coulomb's coefficient of friction, >= 0, under the rules `exact` and `contact`. If missing, the other body's
    /// value counts.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Coefficient of rolling friction, >= 0. If missing, the other body's value counts.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_friction: Option<f64>,
    /// Coefficient of spinning friction, >= 0. If missing, the other body's value counts.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spinning_friction: Option<f64>,
    /// Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential_restitution: Option<f64>,
    /// Compliance of the surface: the frequency of its vibration across the normal divided by that along it, in [1, 2],
    /// instead of a tangential restitution. 1.7 for cushions of a pool table; by default rigid.
    #[schemars(range(min = 1.0, max = 2.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cushion: Option<f64>,
    /// Whether it only reports spheres and deflects none.
    #[serde(default, skip_serializing_if = "is_default")]
    pub trigger: bool,
    /// Whether a sphere that enters this trigger leaves the scene, as in the pocket of a billiard table.
    #[serde(default, skip_serializing_if = "is_default")]
    pub capture: bool,
    /// Speed that an impact adds along the normal, in m/s, >= 0: a sphere that comes with v leaves with e v + kick.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "is_default")]
    pub kick: f64,
    /// Groups that it is in, one bit for each of 32: `0b101` is the first and the third. By default the first.
    #[serde(default = "first_group", skip_serializing_if = "is_first_group")]
    pub groups: u32,
    /// Groups that it collides with, one bit for each; by default all. Two bodies collide if each is in a group that the
    /// other collides with.
    #[serde(default = "all_groups", skip_serializing_if = "are_all_groups")]
    pub collides_with: u32,
    /// A number for programs to find it by; no part of the physics.
    #[serde(default, skip_serializing_if = "is_default")]
    pub user_data: u64,
    /// Whether it is drawn; true by default.
    #[serde(default = "yes", skip_serializing_if = "is_true")]
    pub visible: bool,
    /// Colour. If missing, that of the scene's colliders.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// How its surface reflects light.
    #[serde(default, skip_serializing_if = "is_default")]
    pub finish: Finish,
}

impl Collider {
    /// A solid collider at the origin that does not move, not turned, without a name.
    pub fn new(shape: Shape) -> Self {
        Self {
            name: String::new(),
            shape,
            position: [0.0; 3],
            rotation: unturned(),
            velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
            surface_velocity: [0.0; 3],
            motion: Vec::new(),
            material: None,
            restitution: 1.0,
            restitution_law: None,
            friction: None,
            rolling_friction: None,
            spinning_friction: None,
            tangential_restitution: None,
            cushion: None,
            trigger: false,
            capture: false,
            kick: 0.0,
            groups: first_group(),
            collides_with: all_groups(),
            user_data: 0,
            visible: true,
            color: None,
            finish: Finish::default(),
        }
    }
}

/// Shape of a collider in its own coordinates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Shape {
    /// A sphere.
    Sphere {
        /// In m, > 0
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
    },
    /// A rectangle in its local xz plane that faces local +y. Spheres pass it from behind.
    Rectangle {
        /// Full length along local x, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        size_x: f64,
        /// Full length along local z, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        size_z: f64,
    },
    /// Everything below the local xz plane.
    HalfSpace,
    /// A box of six rectangles that face outward.
    Box {
        /// Full lengths along local x, y, z, in m, each > 0.
        size: Vector,
    },
    /// A hollow box. Its walls have no thickness; spheres bounce off both sides.
    Container {
        /// Full lengths along local x, y, z, in m, each > 0.
        size: Vector,
        /// Sides without a wall: one, or a list. By default none.
        #[schemars(with = "OneOrMore<Side>")]
        #[serde(default, skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
        open: Vec<Side>,
    },
    /// A surface of triangles: the path of a file, or a table.
    Mesh(
        #[schemars(with = "mesh::PathOrMesh")]
        #[serde(deserialize_with = "mesh::read")]
        Mesh,
    ),
    /// Ground over a rectangle in the local xz plane about the origin, given by heights.
    HeightField(HeightField),
    /// A gutter along a path, as of a marble run.
    Track(Track),
    /// A solid cylinder about local y.
    Cylinder {
        /// In m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
        /// Full length along local y, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        height: f64,
    },
    /// A solid cone about local y, or the frustum of one.
    Cone {
        /// Radius at the lower end, in m, >= 0.
        #[schemars(range(min = 0.0))]
        bottom_radius: f64,
        /// Radius at the upper end, in m, >= 0; by default 0. One of the two is > 0.
        #[schemars(range(min = 0.0))]
        #[serde(default)]
        top_radius: f64,
        /// Full length along local y, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        height: f64,
    },
    /// All within a radius of a line along local y.
    Capsule {
        /// In m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
        /// Length of the line, in m, > 0. The capsule is longer by twice the radius.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        length: f64,
    },
    /// A disc in its local xz plane that faces local +y. Spheres pass it from behind.
    Disc {
        /// In m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
    },
    /// A solid ring about local y: all within a radius of a circle.
    Torus {
        /// Radius of the circle, in m, larger than that of the tube.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        ring_radius: f64,
        /// Radius of the tube, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        tube_radius: f64,
    },
    /// A hollow cylinder about local y. Its wall has no thickness; spheres bounce off both sides.
    Pipe {
        /// In m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
        /// Full length along local y, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        length: f64,
        /// Ends with a wall: one, or a list. By default none.
        #[schemars(with = "OneOrMore<End>")]
        #[serde(default, skip_serializing_if = "Vec::is_empty", with = "one_or_more")]
        closed: Vec<End>,
    },
    /// A hollow sphere that is open towards local +y. Its wall has no thickness; spheres bounce off both sides.
    Bowl {
        /// In m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
        /// Angle between local +y and the rim as seen from the centre, in degrees, in [0, 180): 0 of a whole sphere. By
        /// default 90.
        #[schemars(range(min = 0.0), extend("exclusiveMaximum" = 180.0))]
        #[serde(default = "quarter", skip_serializing_if = "is_quarter")]
        opening_degrees: f64,
    },
    /// A hollow cone about local y, open at both ends. Its wall has no thickness; spheres bounce off both sides.
    Funnel {
        /// Radius of the lower opening, in m, >= 0.
        #[schemars(range(min = 0.0))]
        bottom_radius: f64,
        /// Radius of the upper opening, in m, >= 0. One of the two is > 0.
        #[schemars(range(min = 0.0))]
        top_radius: f64,
        /// Full length along local y, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        height: f64,
    },
}

/// An end of a pipe in its own coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// Towards -y.
    Bottom,
    /// Towards +y.
    Top,
}

/// A side of a box in its own coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Towards -x.
    Left,
    /// Towards +x.
    Right,
    /// Towards -y.
    Bottom,
    /// Towards +y.
    Top,
    /// Towards -z.
    Back,
    /// Towards +z.
    Front,
}

/// One of them, or several.
#[derive(JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "OneOrMore{T}")]
#[expect(dead_code, reason = "describes what is written")]
enum OneOrMore<T> {
    /// One.
    One(T),
    /// A list.
    More(Vec<T>),
}

fn quarter() -> f64 {
    90.0
}

fn is_quarter(degrees: &f64) -> bool {
    *degrees == quarter()
}

/// One as a word, others as a list.
mod one_or_more {
    use std::marker::PhantomData;

    use serde::de::value::{SeqAccessDeserializer, StrDeserializer};
    use serde::de::{SeqAccess, Visitor};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<T: Serialize, S: Serializer>(
        items: &[T],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match items {
            [item] => item.serialize(serializer),
            items => items.serialize(serializer),
        }
    }

    pub fn deserialize<'de, T: Word<'de>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<T>, D::Error> {
        deserializer.deserialize_any(Words(PhantomData))
    }

    /// What is written as a word.
    pub trait Word<'de>: Deserialize<'de> {
        const EXPECTED: &'static str;
    }

    impl Word<'_> for super::Side {
        const EXPECTED: &'static str = "a side or a list of sides";
    }

    impl Word<'_> for super::End {
        const EXPECTED: &'static str = "an end or a list of ends";
    }

    struct Words<T>(PhantomData<T>);

    impl<'de, T: Word<'de>> Visitor<'de> for Words<T> {
        type Value = Vec<T>;

        fn expecting(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
            formatter.write_str(T::EXPECTED)
        }

        fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<Vec<T>, E> {
            Ok(vec![T::deserialize(StrDeserializer::new(word))?])
        }

        fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Vec<T>, A::Error> {
            Vec::deserialize(SeqAccessDeserializer::new(list))
        }
    }
}

fn yes() -> bool {
    true
}

fn is_true(value: &bool) -> bool {
    *value
}
