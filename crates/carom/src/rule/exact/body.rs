//! Spheres as the rule keeps them: in flight since their last event.

use glam::DVec3;

use crate::flight::Flight;

/// One sphere in flight: all that a prediction reads of it, in one line of cache.
///
/// It is moved only when something happens to it, so where it is follows from this alone, however
/// many frames have passed since.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Body {
    /// Centre at `time` \[m\]. In a periodic box it counts on across the faces.
    pub position: DVec3,
    /// Velocity at `time` \[m/s\].
    pub velocity: DVec3,
    /// Start of the flight, on the world's clock \[s\].
    pub time: f64,
    /// Its place among the kinds.
    pub kind: u32,
    /// Grows whenever its flight begins anew: a prediction made with another number is void. Odd
    /// if an impact began it.
    pub flights: u32,
}

/// What spheres of one kind share: constants of their flight and of their impacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kind {
    /// \[m\]
    pub radius: f64,
    /// \[kg\]
    pub mass: f64,
    pub restitution: f64,
    /// Of everything but drag \[m/s²\]; with the forces of lasting contacts.
    pub acceleration: DVec3,
    /// k / m \[1/s\]
    pub drag_rate: f64,
    /// Size class, of those in which neighbours are looked for.
    pub level: u32,
    /// The cluster whose lasting contacts bear it. Such a sphere is of a kind of its own.
    pub cluster: Option<u32>,
    /// Itself, or what it is without contact forces.
    pub free: u32,
}

impl Kind {
    /// Whether nothing bends or slows the flight.
    #[inline(always)]
    pub fn flies_straight(&self) -> bool {
        self.acceleration == DVec3::ZERO && self.drag_rate == 0.0
    }

    /// Whether two spheres see each other move in a straight line at constant speed, and no
    /// persistent contact holds both of them.
    #[inline(always)]
    pub fn flies_like(&self, other: &Self) -> bool {
        self.acceleration == other.acceleration
            && self.drag_rate == 0.0
            && other.drag_rate == 0.0
            && (self.cluster.is_none() || other.cluster.is_none())
    }
}

impl Body {
    /// The flight from its start, whose own time is 0 there.
    #[inline]
    pub fn flight(&self, kind: &Kind) -> Flight {
        Flight {
            position: self.position,
            velocity: self.velocity,
            acceleration: kind.acceleration,
            drag_rate: kind.drag_rate,
        }
    }

    /// Centre \[m\] and velocity \[m/s\] at `time` \[s\].
    #[inline]
    pub fn state_at(&self, kind: &Kind, time: f64) -> (DVec3, DVec3) {
        self.flight(kind).after(time - self.time)
    }

    /// The flight from `time` \[s\] on.
    pub fn flight_from(&self, kind: &Kind, time: f64) -> Flight {
        let (position, velocity) = self.state_at(kind, time);
        Flight { position, velocity, ..self.flight(kind) }
    }

    /// Ends the flight and begins another from this state, at `time` \[s\].
    pub fn begin_flight(&mut self, position: DVec3, velocity: DVec3, time: f64) {
        (self.position, self.velocity, self.time) = (position, velocity, time);
        self.flights = (self.flights | 1).wrapping_add(1);
    }

    /// Makes the flight that begins one after an impact.
    pub fn strike(&mut self) {
        self.flights |= 1;
    }

    /// Whether an impact began the flight.
    #[inline(always)]
    pub fn is_struck(&self) -> bool {
        self.flights & 1 == 1
    }
}
