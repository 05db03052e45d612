//! The same world with its lengths, masses and times scaled: there is no scale of its own in the engine. Powers of two
//! round nothing, so all is the same to the bit, under every rule.

use carom::DVec3;
use carom_scene::Scene;
use carom_scene::scene::{
    Boundary, Collider, Emitter, Force, Generator, Motion, PairPotential, Piece, RestitutionLaw,
    Shape, Sphere, Spring, Thermostat,
};

use super::pair::{Agreement, Law, Pair};
use super::trace::Frame;

/// Lengths a millionth, masses a million times, times some ten thousandths.
pub const SMALLER: Law = Law {
    name: "scaled down",
    pair: |scene, _| Some(pair(scene, Scale { length: -20, mass: 20, time: -14 })),
};

pub const LARGER: Law = Law {
    name: "scaled up",
    pair: |scene, _| Some(pair(scene, Scale { length: 20, mass: -20, time: 17 })),
};

/// Powers of two by which a world is scaled.
#[derive(Debug, Clone, Copy)]
struct Scale {
    length: i32,
    mass: i32,
    time: i32,
}

impl Scale {
    /// Factor of what has the dimension of these powers of a length, a mass and a time.
    fn of(self, length: i32, mass: i32, time: i32) -> f64 {
        2f64.powi(length * self.length + mass * self.mass + time * self.time)
    }
}

fn pair(scene: &Scene, scale: Scale) -> Pair {
    let back = Scale { length: -scale.length, mass: -scale.mass, time: -scale.time };
    Pair::new(scaled(scene, scale), Agreement::Bits, move |frame| scale_frame(frame, back))
}

fn scale_frame(frame: &mut Frame, scale: Scale) {
    let velocity = scale.of(1, 0, -1);
    frame.time *= scale.of(0, 0, 1);
    frame.extent *= scale.of(1, 0, 0);
    frame.speed *= velocity;
    frame.energy *= scale.of(2, 1, -2);
    frame.lost *= scale.of(2, 1, -2);
    for body in &mut frame.bodies {
        body.radius *= scale.of(1, 0, 0);
        body.position *= scale.of(1, 0, 0);
        body.velocity *= velocity;
        body.spin *= scale.of(0, 0, -1);
    }
}

fn scaled(scene: &Scene, scale: Scale) -> Scene {
    let mut scene = scene.clone();
    let (length, time) = (scale.of(1, 0, 0), scale.of(0, 0, 1));
    let simulation = &mut scene.simulation;
    simulation.frame_time *= time;
    simulation.duration *= time;
    simulation.exact.contact_duration *= time;
    simulation.exact.zone_tick *= time;
    simulation.exact.force_tick *= time;
    simulation.bisect.tolerance *= length;
    simulation.thermostat.iter_mut().for_each(|it| scale_thermostat(it, scale));
    if let Some(PairPotential::SquareWell { depth, .. }) = &mut simulation.pair_potential {
        *depth *= scale.of(2, 1, -2);
    }
    if let Boundary::Periodic { size, shear_rate, .. } = &mut simulation.boundary {
        scale_vector(size, length);
        *shear_rate *= scale.of(0, 0, -1);
    }
    scene.forces.iter_mut().for_each(|it| scale_force(it, scale));
    scene.spheres.iter_mut().for_each(|it| scale_sphere(it, scale));
    let laws = scene.material_pairs.iter_mut().filter_map(|it| it.restitution_law.as_mut());
    laws.for_each(|it| scale_law(it, scale));
    scene.generators.iter_mut().for_each(|it| scale_generator(it, scale));
    scene.springs.iter_mut().for_each(|it| scale_spring(it, scale));
    scene.colliders.iter_mut().for_each(|it| scale_collider(it, scale));
    for Emitter { position, period, sphere, .. } in &mut scene.emitters {
        scale_vector(position, length);
        *period *= time;
        scale_sphere(sphere, scale);
    }
    scene
}

fn scale_thermostat(thermostat: &mut Thermostat, scale: Scale) {
    match thermostat {
        Thermostat::Andersen { frequency, temperature, .. } => {
            *frequency *= scale.of(0, 0, -1);
            *temperature *= scale.of(2, 1, -2);
        }
        Thermostat::Rescale { interval, temperature } => {
            *interval *= scale.of(0, 0, 1);
            *temperature *= scale.of(2, 1, -2);
        }
        Thermostat::WhiteNoise { interval, strength, .. } => {
            *interval *= scale.of(0, 0, 1);
            *strength *= scale.of(2, 0, -3);
        }
    }
}

fn scale_vector(vector: &mut [f64; 3], factor: f64) {
    *vector = (factor * DVec3::from_array(*vector)).to_array();
}

fn scale_sphere(sphere: &mut Sphere, scale: Scale) {
    scale_vector(&mut sphere.position, scale.of(1, 0, 0));
    scale_vector(&mut sphere.velocity, scale.of(1, 0, -1));
    scale_vector(&mut sphere.angular_velocity, scale.of(0, 0, -1));
    sphere.restitution_law.iter_mut().for_each(|it| scale_law(it, scale));
    let sizes = sphere.radius.iter_mut().chain(&mut sphere.diameter);
    sizes.for_each(|it| *it *= scale.of(1, 0, 0));
    sphere.growth_speed *= scale.of(1, 0, -1);
    if sphere.density.is_none() {
        // What says neither has a kilogram.
        *sphere.mass.get_or_insert(1.0) *= scale.of(0, 1, 0);
    }
    sphere.density.iter_mut().for_each(|it| *it *= scale.of(-3, 1, 0));
}

/// Scales a dense fluid; worlds have no other generators.
fn scale_generator(generator: &mut Generator, scale: Scale) {
    let Generator::DenseFluid(fluid) = generator else { return };
    fluid.temperature *= scale.of(2, 1, -2);
    fluid.radius_range.iter_mut().flatten().for_each(|it| *it *= scale.of(1, 0, 0));
    let corners = fluid.min.iter_mut().chain(&mut fluid.max);
    corners.for_each(|it| scale_vector(it, scale.of(1, 0, 0)));
    scale_sphere(&mut fluid.sphere, scale);
}

fn scale_law(law: &mut RestitutionLaw, scale: Scale) {
    let (RestitutionLaw::PowerLaw { speed, .. }
    | RestitutionLaw::Viscoelastic { speed }
    | RestitutionLaw::Cutoff { speed, .. }) = law;
    *speed *= scale.of(1, 0, -1);
}

fn scale_spring(spring: &mut Spring, scale: Scale) {
    spring.anchor.iter_mut().for_each(|it| scale_vector(it, scale.of(1, 0, 0)));
    spring.rest_length.iter_mut().for_each(|it| *it *= scale.of(1, 0, 0));
    spring.stiffness *= scale.of(0, 1, -2);
    spring.damping *= scale.of(0, 1, -1);
}

fn scale_collider(collider: &mut Collider, scale: Scale) {
    let length = scale.of(1, 0, 0);
    collider.kick *= scale.of(1, 0, -1);
    collider.restitution_law.iter_mut().for_each(|it| scale_law(it, scale));
    scale_vector(&mut collider.position, length);
    scale_vector(&mut collider.velocity, scale.of(1, 0, -1));
    scale_vector(&mut collider.surface_velocity, scale.of(1, 0, -1));
    scale_vector(&mut collider.angular_velocity, scale.of(0, 0, -1));
    collider.motion.iter_mut().for_each(|it| scale_motion(it, scale));
    match &mut collider.shape {
        Shape::Sphere { radius } => *radius *= length,
        Shape::Rectangle { size_x, size_z } => {
            *size_x *= length;
            *size_z *= length;
        }
        Shape::HalfSpace => {}
        Shape::Mesh(mesh) => mesh.scale *= length,
        Shape::HeightField(field) => {
            field.size_x *= length;
            field.size_z *= length;
            field.heights.iter_mut().flatten().for_each(|height| *height *= length);
        }
        Shape::Track(track) => {
            track.radius *= length;
            track.pieces.iter_mut().for_each(|it| scale_piece(it, length));
        }
        Shape::Box { size } | Shape::Container { size, .. } => scale_vector(size, length),
        Shape::Disc { radius } | Shape::Bowl { radius, .. } => *radius *= length,
        Shape::Cylinder { radius: a, height: b }
        | Shape::Capsule { radius: a, length: b }
        | Shape::Pipe { radius: a, length: b, .. }
        | Shape::Torus { ring_radius: a, tube_radius: b } => {
            *a *= length;
            *b *= length;
        }
        Shape::Cone { bottom_radius, top_radius, height }
        | Shape::Funnel { bottom_radius, top_radius, height } => {
            *bottom_radius *= length;
            *top_radius *= length;
            *height *= length;
        }
    }
}

fn scale_piece(piece: &mut Piece, factor: f64) {
    match piece {
        Piece::Straight { length } => *length *= factor,
        Piece::Curve { radius, .. } => *radius *= factor,
        Piece::Bend { radius, shift, .. } => {
            *radius *= factor;
            *shift *= factor;
        }
        Piece::Gap { length, drop, .. } => {
            *length *= factor;
            *drop *= factor;
        }
    }
}

fn scale_motion(motion: &mut Motion, scale: Scale) {
    let (length, rate) = (scale.of(1, 0, 0), scale.of(0, 0, -1));
    match motion {
        Motion::Steady { velocity } => scale_vector(velocity, scale.of(1, 0, -1)),
        Motion::Oscillate { amplitude, frequency, .. } => {
            *amplitude *= length;
            *frequency *= rate;
        }
        Motion::Turn { pivot, rate: it, .. } => {
            scale_vector(pivot, length);
            *it *= rate;
        }
        Motion::Swing { pivot, frequency, .. } => {
            scale_vector(pivot, length);
            *frequency *= rate;
        }
        Motion::Keyframes { times, positions, pivot, .. } => {
            scale_vector(pivot, length);
            positions.iter_mut().for_each(|it| scale_vector(it, length));
            times.iter_mut().for_each(|it| *it /= rate);
        }
    }
}

fn scale_force(force: &mut Force, scale: Scale) {
    let (length, velocity) = (scale.of(1, 0, 0), scale.of(1, 0, -1));
    let (acceleration, drag, per_volume) =
        (scale.of(1, 0, -2), scale.of(0, 1, -1), scale.of(-3, 1, 0));
    match force {
        Force::Constant { force } => scale_vector(force, scale.of(1, 1, -2)),
        Force::Gravity { acceleration: it } => scale_vector(it, acceleration),
        Force::ViscousDrag { coefficient } => *coefficient *= drag,
        Force::PointAttractor { position, gravitational_parameter, softening } => {
            scale_vector(position, length);
            *gravitational_parameter *= scale.of(3, 0, -2);
            *softening *= length;
        }
        Force::MutualGravity { constant, softening, opening_angle: _ } => {
            *constant *= scale.of(3, -1, -2);
            *softening *= length;
        }
        Force::Wind { velocity: it, coefficient } => {
            scale_vector(it, velocity);
            *coefficient *= drag;
        }
        Force::Vortex { position, axis: _, circulation, core_radius, coefficient } => {
            scale_vector(position, length);
            *circulation *= scale.of(2, 0, -1);
            *core_radius *= length;
            *coefficient *= drag;
        }
        Force::QuadraticDrag { density, drag_coefficient: _, viscosity, wind } => {
            *density *= per_volume;
            *viscosity *= scale.of(-1, 1, -1);
            scale_vector(wind, velocity);
        }
        Force::Buoyancy { density, surface_height, gravity } => {
            *density *= per_volume;
            *surface_height *= length;
            scale_vector(gravity, acceleration);
        }
    }
}
