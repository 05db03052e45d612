//! The derivative of an impact, followed backwards.

use glam::DVec3;

use super::saltation::{Change, First, Saltation};
use super::state::SphereTangent;
use super::variation::Variation;

/// Derivatives of a number by the inputs of an impact.
struct Inputs {
    spheres: [SphereTangent; 2],
    radii: [f64; 2],
    masses: [f64; 2],
    restitution: f64,
    sliding: f64,
    /// Derivatives by the position and the velocity of body 1 if it is a surface.
    surface: [DVec3; 2],
    /// Derivatives by the rotation of the surface; NaN if these are not known.
    rotation: DVec3,
}

impl Saltation {
    /// Replaces derivatives with respect to the motion after the impact by derivatives with respect to the motion
    /// before, and adds those with respect to the other inputs of the impact to a gradient.
    pub fn pass_back(&self, spheres: &mut [SphereTangent], gradient: &mut Variation) {
        let second = self.second.place;
        let mut after = [SphereTangent::default(), spheres[second]];
        if let First::Sphere(first) = &self.first {
            after[0] = spheres[first.place];
        }
        let of_companions = self.companions.iter();
        let by_delay: f64 =
            of_companions.map(|&(place, lost)| lost.dot(spheres[place].velocity)).sum();
        let inputs = self.inputs((&after, by_delay));
        self.add_to_gradient(&inputs, gradient);
        spheres[second] = inputs.spheres[1];
        if let First::Sphere(first) = &self.first {
            spheres[first.place] = inputs.spheres[0];
        }
    }

    /// Returns the derivatives by all inputs of a number whose derivatives by the motion after the impact and by its
    /// delay are given.
    fn inputs(&self, (after, by_delay): (&[SphereTangent; 2], f64)) -> Inputs {
        let by = |change: &Change| {
            let [first, last] = self.apply(change);
            first.dot(&after[0]) + last.dot(&after[1]) + by_delay * self.delay(change)
        };
        let of_second = |of: fn(DVec3) -> SphereTangent| {
            let change = |axis| Change {
                spheres: [SphereTangent::default(), of(axis)],
                ..Change::default()
            };
            DVec3::from_array(DVec3::AXES.map(|axis| by(&change(axis))))
        };
        let is_rough = self.sliding.value > 0.0;
        let second = SphereTangent {
            position: of_second(|position| SphereTangent { position, ..SphereTangent::default() }),
            velocity: of_second(|velocity| SphereTangent { velocity, ..SphereTangent::default() }),
            angular_velocity: match is_rough {
                true => of_second(|angular_velocity| SphereTangent {
                    angular_velocity,
                    ..SphereTangent::default()
                }),
                // Smooth bodies keep their spins.
                false => after[1].angular_velocity,
            },
        };
        let by_radii = |radii| by(&Change { radii, ..Change::default() });
        let radius = by_radii([0.0, 1.0]);
        let mut inputs = Inputs {
            spheres: [SphereTangent::default(), second],
            radii: [0.0, radius],
            masses: [0.0; 2],
            restitution: by(&Change { restitution: 1.0, ..Change::default() }),
            sliding: 0.0,
            surface: [DVec3::ZERO; 2],
            rotation: DVec3::NAN,
        };
        if is_rough {
            inputs.sliding = by(&Change { sliding: 1.0, ..Change::default() });
        }
        // A change of both bodies alike does nothing but to remain after the impact.
        let place = after[0].position + after[1].position - second.position;
        let velocity = after[0].velocity + after[1].velocity - second.velocity;
        match &self.first {
            First::Sphere(first) => {
                // Only the sum of the speeds of both rims counts, and only the ratio of the masses.
                let turned = second.angular_velocity - after[1].angular_velocity;
                let turned = first.radius / self.second.radius * turned;
                let angular_velocity = after[0].angular_velocity + turned;
                inputs.spheres[0] = SphereTangent { position: place, velocity, angular_velocity };
                inputs.radii[0] = if is_rough { by_radii([1.0, 0.0]) } else { radius };
                let mass = by(&Change { masses: [0.0, 1.0], ..Change::default() });
                inputs.masses = [-self.second.mass / first.mass * mass, mass];
            }
            First::Surface(surface) => {
                inputs.surface = [place, velocity];
                let by_rotation =
                    |surface_rotation| by(&Change { surface_rotation, ..Change::default() });
                if surface.pivot.is_some() {
                    inputs.rotation = DVec3::from_array(DVec3::AXES.map(by_rotation));
                }
            }
        }
        inputs
    }

    /// Adds derivatives by the inputs of the impact to a gradient.
    fn add_to_gradient(&self, inputs: &Inputs, gradient: &mut Variation) {
        let restitution = self.restitution.combined.by_bodies.map(|it| it * inputs.restitution);
        let friction = self.sliding.by_bodies.map(|it| it * inputs.sliding);
        let mut add_sphere = |id, body: usize| {
            let sphere = gradient.sphere_mut(id);
            sphere.radius += inputs.radii[body];
            sphere.mass += inputs.masses[body];
            sphere.restitution += restitution[body];
            sphere.friction += friction[body];
        };
        add_sphere(self.second.id, 1);
        match &self.first {
            First::Sphere(first) => add_sphere(first.id, 0),
            First::Surface(surface) => {
                let [place, velocity] = inputs.surface;
                let collider = gradient.collider_mut(surface.collider);
                collider.position += place;
                collider.velocity += velocity + self.time * place;
                collider.rotation += inputs.rotation;
                collider.restitution += restitution[0];
                collider.friction += friction[0];
            }
        }
    }
}
