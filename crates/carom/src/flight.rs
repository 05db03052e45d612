//! Free motion of a sphere in closed form. (placeholder until merged)
use glam::DVec3;
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    pub position: DVec3,
    pub velocity: DVec3,
    pub acceleration: DVec3,
    pub drag_rate: f64,
}
impl Flight {
    #[inline(always)]
    pub fn after(&self, t: f64) -> (DVec3, DVec3) {
        (
            self.position + t * self.velocity + (0.5 * t * t) * self.acceleration,
            self.velocity + t * self.acceleration,
        )
    }
    #[inline(always)]
    pub fn position_at(&self, t: f64) -> DVec3 {
        self.after(t).0
    }
    #[inline(always)]
    pub fn velocity_at(&self, t: f64) -> DVec3 {
        self.after(t).1
    }
}
