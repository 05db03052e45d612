//! The run of a world as the laws see it.

use carom::{Boundary, DVec3, World};

/// A run, frame by frame.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    pub boundary: Boundary,
    /// The start, and the end of each frame.
    pub frames: Vec<Frame>,
}

/// A world at the end of a frame.
#[derive(Debug, Clone, Default)]
pub struct Frame {
    /// Time \[s\].
    pub time: f64,
    /// Spheres in ascending order of id.
    pub bodies: Vec<Body>,
    /// Farthest point of a sphere from the origin along an axis \[m\].
    pub extent: f64,
    /// Largest speed of a point of a sphere \[m/s\].
    pub speed: f64,
    /// Energy that contacts took in the frame \[J\].
    pub lost: f64,
    /// Kinetic energy \[J\].
    pub energy: f64,
    /// Events and sweeps of the frame.
    pub work: u64,
    /// Whether spheres were in zones during the frame, for which laws about events do not hold.
    pub in_zone: bool,
    /// Whether a contact persists.
    pub in_contact: bool,
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    pub id: u64,
    pub radius: f64,
    pub position: DVec3,
    pub velocity: DVec3,
    /// Angular velocity \[rad/s\].
    pub spin: DVec3,
}

impl Trace {
    /// Creates the trace of a run that begins with this world.
    pub fn new(world: &World) -> Self {
        Self { boundary: world.settings().boundary, frames: vec![Frame::of(world)] }
    }

    /// Returns the number of frames before more than `most` work was done; all if there is less.
    pub fn until_work(&self, most: u64) -> usize {
        let mut work = 0;
        let is_before = |frame: &&Frame| {
            work += frame.work;
            work <= most
        };
        self.frames.iter().take_while(is_before).count()
    }
}

impl Frame {
    /// Records a world before its first frame.
    fn of(world: &World) -> Self {
        let spheres = world.spheres();
        let bodies = spheres.ids().iter().enumerate();
        let bodies: Vec<Body> = bodies
            .map(|(index, id)| Body {
                id: id.number(),
                radius: spheres.radii()[index],
                position: spheres.positions()[index],
                velocity: spheres.velocities()[index],
                spin: spheres.angular_velocities().get(index).copied().unwrap_or_default(),
            })
            .collect();
        let most = |of: fn(&Body) -> f64| bodies.iter().map(of).fold(0.0, f64::max);
        Self {
            time: world.time(),
            extent: most(|body| body.position.abs().max_element() + body.radius),
            speed: most(|body| body.velocity.length() + body.radius * body.spin.length()),
            bodies,
            energy: world.kinetic_energy(),
            ..Self::default()
        }
    }

    /// Records a world after a step.
    pub fn after_step(world: &World) -> Self {
        let report = world.report();
        Self {
            lost: report.energy_account.contacts,
            work: report.work.events + report.work.sweeps,
            in_zone: report.zone_account.joined > 0 || report.zone_account.spheres > 0,
            in_contact: !world.contacts().is_empty(),
            ..Self::of(world)
        }
    }

    /// Adds the energy, work and contacts of the frame before, so that both count as one.
    pub fn add_before(&mut self, before: &Self) {
        self.lost += before.lost;
        self.work += before.work;
        self.in_zone |= before.in_zone;
        self.in_contact |= before.in_contact;
    }
}
