//! Temperature and pressure of spheres as the molecules of a gas.

use carom::{BodyPair, Boundary, ColliderId, DVec3, Shape, Sides, StepReport, World};

/// Motion of the spheres relative to their centre of mass.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ThermalMotion {
    /// Temperature times Boltzmann's constant \[J\]: the mean of `m v²` per direction, over the
    /// directions in which spheres move.
    pub energy: f64,
    /// Number of directions in which spheres move.
    pub directions: u8,
}

/// Measures the motion of all spheres relative to their centre of mass.
pub(crate) fn thermal_motion(world: &World) -> ThermalMotion {
    let spheres = world.spheres();
    let moving = || spheres.masses().iter().zip(spheres.velocities());
    let (mass, momentum) = moving()
        .fold((0.0, DVec3::ZERO), |(mass, momentum), (m, v)| (mass + m, momentum + *m * *v));
    if spheres.is_empty() {
        return ThermalMotion::default();
    }
    let drift = momentum / mass;
    let along: DVec3 = moving().map(|(m, v)| *m * (*v - drift) * (*v - drift)).sum();
    // A smaller part of the largest energy is a rounding error.
    const NOTHING: f64 = 1e-20;
    let least = NOTHING * along.max_element();
    let directions = along.to_array().iter().filter(|energy| **energy > least).count();
    let energy = along.element_sum() / (spheres.len() * directions.max(1)) as f64;
    ThermalMotion { energy, directions: directions as u8 }
}

/// Largest cosine between normals that count as perpendicular: rotations in files have about ten
/// digits.
const SQUARE: f64 = 1e-9;

/// Surface of a half-space: points whose product with `normal` is `offset` \[m\].
#[derive(Debug, Clone, Copy)]
struct Plane {
    id: ColliderId,
    normal: DVec3,
    offset: f64,
}

impl Plane {
    /// Whether the normals are opposite.
    fn faces(&self, other: &Self) -> bool {
        (self.normal + other.normal).length() < SQUARE
    }
}

/// Closed space around the spheres, in which the pressure is measured.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Enclosure {
    /// A closed container with an inner surface of `area` \[m²\].
    Container { collider: ColliderId, area: f64 },
    /// A box of half-spaces with an inner surface of `area` \[m²\].
    HalfSpaces { colliders: [ColliderId; 6], area: f64 },
    /// A periodic box of `volume` \[m³\].
    Periodic { volume: f64 },
}

impl Enclosure {
    /// Finds the enclosure of a world: its periodic box, its first closed container, or the box
    /// formed by its half-spaces.
    pub fn of(world: &World) -> Option<Self> {
        if let Boundary::Periodic { size } = world.settings().boundary {
            return size.is_finite().then(|| Self::Periodic { volume: size.element_product() });
        }
        let container = world.colliders().find_map(|(collider, it)| match it.shape {
            Shape::Container { size, open: Sides::NONE } => {
                let area = 2.0 * size.dot(DVec3::new(size.y, size.z, size.x));
                Some(Self::Container { collider, area })
            }
            _ => None,
        });
        container.or_else(|| Self::of_half_spaces(world))
    }

    /// Finds the box formed by half-spaces: there must be six, in perpendicular pairs that face
    /// each other.
    fn of_half_spaces(world: &World) -> Option<Self> {
        let solid = world.colliders().filter(|(_, it)| it.shape == Shape::HalfSpace && !it.trigger);
        let planes = solid.map(|(id, it)| {
            let normal = it.pose.rotation.normalize() * DVec3::Y;
            Plane { id, normal, offset: normal.dot(it.pose.position) }
        });
        let mut planes: [Plane; 6] = planes.collect::<Vec<_>>().try_into().ok()?;
        // Place each wall next to the one that it faces.
        for i in [0, 2, 4] {
            let opposite = (i + 1..6).find(|&j| planes[i].faces(&planes[j]))?;
            planes.swap(i + 1, opposite);
        }
        let [x, y, z] = [0, 2, 4].map(|i| planes[i].normal);
        let is_square = [x.dot(y), y.dot(z), z.dot(x)].iter().all(|cos| cos.abs() < SQUARE);
        let [x, y, z] = [0, 2, 4].map(|i| -planes[i].offset - planes[i + 1].offset);
        let colliders = planes.map(|plane| plane.id);
        let area = 2.0 * (x * y + y * z + z * x);
        (is_square && x.min(y).min(z) > 0.0).then_some(Self::HalfSpaces { colliders, area })
    }

    /// Contribution of a step to the pressure. For a container or box it is the sum of the impulses
    /// on the walls \[N s\]; in a periodic box it is the virial `r J` of the impacts \[N m s\],
    /// where r is the distance of the centres.
    pub fn pressing(&self, report: &StepReport, world: &World) -> f64 {
        let radius = |id| world.sphere(id).map_or(0.0, |sphere| sphere.radius);
        let impacts = report.impacts.iter();
        impacts
            .map(|impact| match (self, impact.between) {
                (Self::Container { collider, .. }, BodyPair::Collider { collider: hit, .. })
                    if *collider == hit =>
                {
                    impact.impulse
                }
                (Self::HalfSpaces { colliders, .. }, BodyPair::Collider { collider: hit, .. })
                    if colliders.contains(&hit) =>
                {
                    impact.impulse
                }
                (Self::Periodic { .. }, BodyPair::Spheres(first, second)) => {
                    (radius(first) + radius(second)) * impact.impulse
                }
                _ => 0.0,
            })
            .sum()
    }

    /// Pressure \[Pa\] of `count` spheres with this motion, if [`Self::pressing`] grows by `rate`
    /// per second. In a container it is force divided by area; in a periodic box it follows from
    /// the virial theorem, `(N k T + Σ r J / (d t)) / V`, where d is the number of directions of
    /// the motion.
    pub fn pressure(&self, rate: f64, count: usize, motion: ThermalMotion) -> f64 {
        match self {
            Self::Container { area, .. } | Self::HalfSpaces { area, .. } => rate / area,
            Self::Periodic { volume } => {
                let directions = f64::from(motion.directions.max(1));
                (count as f64 * motion.energy + rate / directions) / volume
            }
        }
    }
}
