//! When spheres leave their neighbour regions.

use glam::DVec3;

use super::Neighbours;
use crate::axis_motion::{AlongAxis, AxisMotion};
use crate::rule::exact::flights::{Body, Species};
use crate::rule::exact::neighbours::level::Level;
use crate::rule::exact::neighbours::region::CROSSING;

impl Neighbours {
    /// A lower bound of the time at which the sphere leaves its neighbour region, on the world's clock \[s\].
    #[inline(always)]
    pub fn crossing_time(&self, slot: u32, body: &Body, species: &Species, now: f64) -> f64 {
        let Level { grid, half_edges, .. } = &self.levels[species.level as usize];
        let center = self.regions[slot as usize].center;
        let center_here = center + self.shift_from_box(slot);
        let half_edges = CROSSING * half_edges;
        if grid.is_closed() && species.flies_straight() {
            // Without branches on the direction, which the processor cannot predict. What is at rest
            // on a side has 0 / 0 there, which is never the least.
            let (mut velocity, mut place) = (body.velocity, body.position);
            if let Some(sliding) = &self.sliding {
                (velocity, place) = (sliding.in_search(velocity), sliding.in_search(place));
            }
            let offset = center_here - (place + (now - body.time) * velocity);
            let distance = half_edges + DVec3::ONE.copysign(velocity) * offset;
            let first = (distance.max(DVec3::ZERO) / velocity.abs()).min_element();
            return (now + first).max(now.next_up());
        }
        let (mut position, mut velocity) = body.state_at(species, now);
        if let Some(sliding) = &self.sliding {
            (velocity, position) = (sliding.in_search(velocity), sliding.in_search(position));
        }
        let offset = center_here - position;
        let (low, high) = grid.without_ends(center, offset - half_edges, offset + half_edges);
        let mut first = f64::INFINITY;
        for axis in 0..3 {
            let motion = AxisMotion {
                velocity: velocity[axis],
                acceleration: species.acceleration[axis],
                drag_rate: species.drag_rate,
            };
            first = first.min(motion.leaves(low[axis], high[axis]));
        }
        // The clock has to move on, however fast the sphere is.
        (now + first).max(now.next_up())
    }

    /// A lower bound of the time at which a sphere leaves its neighbour region, on the world's clock \[s\]. The
    /// sphere has this centre \[m\] and velocity \[m/s\] `now`, and accelerations between these bounds along each
    /// axis \[m/s²\].
    pub fn crossing_time_within(
        &self,
        (slot, level): (u32, u32),
        (position, velocity): (DVec3, DVec3),
        [least, most]: [DVec3; 2],
        now: f64,
    ) -> f64 {
        let Level { grid, half_edges, .. } = &self.levels[level as usize];
        let center = self.regions[slot as usize].center;
        let offset = center + self.shift_from_box(slot) - position;
        let half_edges = CROSSING * half_edges;
        let (low, high) = grid.without_ends(center, offset - half_edges, offset + half_edges);
        let mut first = f64::INFINITY;
        for axis in 0..3 {
            let motion = |acceleration| AxisMotion {
                velocity: velocity[axis],
                acceleration,
                drag_rate: 0.0,
            };
            let upward = motion(most[axis]).leaves(f64::NEG_INFINITY, high[axis]);
            let downward = motion(least[axis]).leaves(low[axis], f64::INFINITY);
            first = first.min(upward).min(downward);
        }
        (now + first).max(now.next_up())
    }

    /// Whether a sphere at `position` \[m\] cannot leave its neighbour region if it moves no farther than `way`
    /// \[m\] along each axis.
    pub fn stays_within(&self, slot: u32, level: u32, position: DVec3, way: DVec3) -> bool {
        let Level { half_edges, .. } = &self.levels[level as usize];
        let offset = self.region(slot).center + self.shift_from_box(slot) - position;
        (offset.abs() + way).cmple(CROSSING * half_edges).all()
    }
}
