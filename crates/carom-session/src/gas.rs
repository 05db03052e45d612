//! What is measured of spheres as of the molecules of a gas: temperature and pressure.

use carom::{BodyPair, Boundary, ColliderId, DVec3, Shape, Sides, StepReport, World};

/// Motion of spheres relative to that of all together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ThermalMotion {
    /// Temperature times Boltzmann's constant \[J\]: the mean of `m v²` along one direction, over those in
    /// which there is any.
    pub energy: f64,
    /// In how many directions there is any.
    pub directions: u8,
}

/// The motion of all spheres relative to that of all together.
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
    // Less than this part of the rest is rounding.
    const NOTHING: f64 = 1e-20;
    let least = NOTHING * along.max_element();
    let directions = along.to_array().iter().filter(|energy| **energy > least).count();
    let energy = along.element_sum() / (spheres.len() * directions.max(1)) as f64;
    ThermalMotion { energy, directions: directions as u8 }
}

/// Walls at right angles have normals with a cosine below this: rotations in files have some ten digits.
const SQUARE: f64 = 1e-9;

/// The face of a half-space: where `normal` times a place is `offset` \[m\].
#[derive(Debug, Clone, Copy)]
struct Plane {
    id: ColliderId,
    normal: DVec3,
    offset: f64,
}

impl Plane {
    /// Whether its normal is opposite to that of the other.
    fn faces(&self, other: &Self) -> bool {
        (self.normal + other.normal).length() < SQUARE
    }
}

/// Where spheres are shut in, so that they have a pressure.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Enclosure {
    /// In a closed container with an inner surface of `area` \[m²\].
    Container { collider: ColliderId, area: f64 },
    /// In a box of half-spaces with an inner surface of `area` \[m²\].
    HalfSpaces { colliders: [ColliderId; 6], area: f64 },
    /// In a periodic box of `volume` \[m³\].
    Periodic { volume: f64 },
}

impl Enclosure {
    /// That of a world: its periodic box, its first container that is closed, or the box that its
    /// half-spaces are the walls of.
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

    /// The box whose walls are all half-spaces there are, if these are the walls of one.
    fn of_half_spaces(world: &World) -> Option<Self> {
        let solid = world.colliders().filter(|(_, it)| it.shape == Shape::HalfSpace && !it.trigger);
        let planes = solid.map(|(id, it)| {
            let normal = it.pose.rotation.normalize() * DVec3::Y;
            Plane { id, normal, offset: normal.dot(it.pose.position) }
        });
        let mut planes: [Plane; 6] = planes.collect::<Vec<_>>().try_into().ok()?;
        // Walls beside the ones that they face.
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

    /// What the impacts of a step add to the pressure: impulses on the container \[N s\], in a
    /// periodic box the virial `r J` of the impacts \[N m s\], r being the distance of the centres.
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

    /// Pressure \[Pa\] where [`Self::pressing`] grows by `rate` a second, of `count` spheres that move so:
    /// force by area on a container; in a periodic box, by the virial theorem,
    /// `(N k T + Σ r J / (d t)) / V`, along the d directions of the motion.
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
