//! A world that is stepped by frames and drawn at any time.

use carom::{Boundary, Collider, ColliderId, DQuat, DVec3, Pose, SphereId, StopRequest, World};
use carom_scene::{Scene, SceneError};

/// Largest difference of times that count as equal \[s\]: sums of frame times and k / rate differ
/// by rounding errors only, frames by much more.
const SAME_TIME: f64 = 1e-9;

/// State of a sphere in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Place in the order of appearance, from 0.
    pub number: u64,
    /// Centre \[m\].
    pub position: DVec3,
    /// Radius \[m\].
    pub radius: f64,
    /// Mass \[kg\].
    pub mass: f64,
    /// Rotation from the sphere's own coordinate system to the world's; `None` if spheres have no
    /// spin.
    pub orientation: Option<DQuat>,
}

/// A world that is stepped by the frames of its scene, and can also be shown between them.
///
/// At the time of a frame, positions are exactly those of the frame. Between two frames, spheres
/// and colliders are interpolated linearly, and rotate by the smaller angle. A sphere that is
/// missing in the second frame is shown until that frame; one that is missing in the first frame is
/// shown from the second on.
pub struct Running {
    world: World,
    frame_time: f64,
    /// The frame before the present state of the world.
    before: Frame,
}

/// Positions in a frame.
#[derive(Debug, Default)]
struct Frame {
    time: f64,
    spheres: Vec<(SphereId, Seen)>,
    poses: Vec<Pose>,
}

impl Running {
    /// Creates the world of a scene at its start.
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        let world = scene.world()?;
        let before = Frame { time: world.time(), ..Frame::default() };
        Ok(Self { world, frame_time: scene.simulation.frame_time, before })
    }

    /// World in the first frame that is not before the last time requested.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Sets a request that ends a frame early.
    pub fn set_stop_request(&mut self, request: StopRequest) {
        self.world.set_stop_request(Some(request));
    }

    /// Steps one frame.
    pub fn step(&mut self) -> Result<(), carom::Error> {
        self.before.time = self.world.time();
        self.before.spheres.clear();
        self.before.spheres.extend(spheres(&self.world));
        self.before.poses.clear();
        self.before.poses.extend(self.world.colliders().map(|(_, collider)| collider.pose));
        self.world.step(self.frame_time)?;
        Ok(())
    }

    /// Steps all frames up to `time` \[s\].
    pub fn go_to(&mut self, time: f64) -> Result<(), carom::Error> {
        while self.world.time() < time - SAME_TIME {
            self.step()?;
        }
        Ok(())
    }

    /// Fraction of the time between the previous frame and the present one; `None` at the present
    /// frame.
    fn part(&self, time: f64) -> Option<f64> {
        let h = self.world.time() - self.before.time;
        let part = (time - self.before.time) / h;
        (time < self.world.time() - SAME_TIME).then_some(part)
    }

    /// Spheres at `time` \[s\], which must have been reached.
    pub fn spheres(&self, time: f64) -> Vec<Seen> {
        let Some(part) = self.part(time) else {
            return spheres(&self.world).map(|(_, seen)| seen).collect();
        };
        let now = self.world.spheres();
        let boundary = self.world.settings().boundary;
        let between = |&(id, seen): &(SphereId, Seen)| {
            let Some(index) = now.index_of(id) else { return seen };
            let way = nearest(now.positions()[index] - seen.position, boundary);
            let turned = |before: DQuat| before.lerp(now.get(index).orientation, part);
            Seen {
                position: seen.position + part * way,
                orientation: seen.orientation.map(turned),
                ..seen
            }
        };
        self.before.spheres.iter().map(between).collect()
    }

    /// Poses of the colliders at `time` \[s\], which must have been reached.
    pub fn poses(&self, time: f64) -> Vec<Pose> {
        let Some(part) = self.part(time) else {
            return self.world.colliders().map(|(_, collider)| collider.pose).collect();
        };
        let between = |(before, (_, now)): (&Pose, (ColliderId, &Collider))| {
            if !now.motion.is_empty() {
                return now.pose_at(time);
            }
            Pose {
                position: before.position.lerp(now.pose.position, part),
                rotation: before.rotation.slerp(now.pose.rotation, part),
            }
        };
        self.before.poses.iter().zip(self.world.colliders()).map(between).collect()
    }
}

fn spheres(world: &World) -> impl Iterator<Item = (SphereId, Seen)> + '_ {
    let (spheres, has_spin) = (world.spheres(), world.has_spin());
    spheres.ids().iter().enumerate().map(move |(i, &id)| {
        let position = spheres.positions()[i];
        let (radius, mass) = (spheres.radii()[i], spheres.masses()[i]);
        let orientation = has_spin.then(|| spheres.get(i).orientation);
        (id, Seen { number: id.number(), position, radius, mass, orientation })
    })
}

/// Shortest periodic image of a displacement \[m\].
fn nearest(way: DVec3, boundary: Boundary) -> DVec3 {
    let Boundary::Periodic { size } = boundary else {
        return way;
    };
    // An open axis has one image only.
    let along = |way: f64, size: f64| {
        if size.is_finite() { way - (way / size).round() * size } else { way }
    };
    DVec3::new(along(way.x, size.x), along(way.y, size.y), along(way.z, size.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use carom_scene::Library;

    fn running(scene: &str, changes: &[&str]) -> Running {
        let changes: Vec<_> = changes.iter().map(|text| text.parse().unwrap()).collect();
        Running::new(&Library::new().find(scene, &changes).unwrap().0).unwrap()
    }

    #[test]
    fn at_the_time_of_a_frame_spheres_are_those_of_the_frame() {
        let mut running = running("simtest1", &[]);
        let mut world = Library::new().find("simtest1", &[]).unwrap().0.world().unwrap();
        // Frames of 0.02 s: every tenth coincides with one of 5 per second.
        for film_frame in 1..=20 {
            (0..10).for_each(|_| drop(world.step(0.02).unwrap().clone()));
            let time = f64::from(film_frame) / 5.0;
            running.go_to(time).unwrap();
            let seen: Vec<_> = running.spheres(time).iter().map(|seen| seen.position).collect();
            assert_eq!(seen, world.spheres().positions());
            assert_eq!(running.world().state_hash(), world.state_hash());
        }
    }

    #[test]
    fn between_two_frames_spheres_are_on_the_way() {
        let mut running = running("tutorial2", &["simulation.frame_time=0.5"]);
        running.go_to(0.75).unwrap();
        let at = |time| running.spheres(time)[0].position;
        let (before, now) = (at(0.5 + 1e-8), at(1.0));
        // The previous frame is 1e-8 s away, at speeds of a few m/s.
        assert!((at(0.75) - 0.5 * (before + now)).length() < 1e-6);
        assert!(before != now);
    }

    #[test]
    fn between_two_frames_spheres_turn_the_shorter_way() {
        let mut running = running("tutorial2", &["simulation.frame_time=0.5"]);
        assert_eq!(running.spheres(0.0)[0].orientation, None);
        let ball = carom::Sphere::new(DVec3::new(1e3, 0.0, 0.0), 1.0)
            .with_orientation(DQuat::from_rotation_y(3.0))
            .with_angular_velocity(DVec3::Y);
        running.world.add_sphere(ball).unwrap();
        running.go_to(0.75).unwrap();
        let at = |time| running.spheres(time).last().unwrap().orientation.unwrap();
        // From 3.5 to 4 rad, where the sign of the quaternion changes.
        for (time, angle) in [(0.75, 3.75), (1.0, 4.0)] {
            let expected = DQuat::from_rotation_y(angle);
            // The angle is zero up to the rounding of its cosine.
            assert!(at(time).angle_between(expected) < 1e-6, "{time}: {}", at(time));
        }
    }

    #[test]
    fn an_emitted_sphere_is_not_seen_before_its_first_frame() {
        let changes = ["simulation.frame_time=0.5", "simulation.rule=exact"];
        let mut running = running("simtest1", &changes);
        // The second sphere is emitted at 0.7 s.
        running.go_to(0.6).unwrap();
        assert_eq!([0.6, 0.8, 1.0].map(|time| running.spheres(time).len()), [1, 1, 2]);
    }

    #[test]
    fn through_the_side_of_a_periodic_box_the_way_is_short() {
        let boundary = Boundary::Periodic { size: DVec3::new(2.0, f64::INFINITY, 2.0) };
        let way = nearest(DVec3::new(-1.6, -1.6, 0.3), boundary);
        // One rounding error of numbers up to 2.
        assert!((way - DVec3::new(0.4, -1.6, 0.3)).length() < 1e-15, "{way}");
    }

    #[test]
    fn a_moved_surface_is_seen_on_its_way() {
        let mut running =
            running("simtest1", &["simulation.frame_time=0.5", "colliders.0.velocity=[2, 0, 0]"]);
        running.go_to(0.75).unwrap();
        // 0.75 s at 2 m/s; one or two rounding errors of numbers up to 2.
        assert!((running.poses(0.75)[0].position.x - 1.5).abs() < 1e-15);
    }
}
