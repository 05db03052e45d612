//! Motion of a sphere in flight along one axis.

/// Velocity \[m/s\], acceleration of everything but drag \[m/s²\] and rate of drag \[1/s\].
pub(super) struct AxisMotion {
    pub velocity: f64,
    pub acceleration: f64,
    pub drag_rate: f64,
}

impl AxisMotion {
    /// A time \[s\] before which the motion stays between `low` < 0 and `high` > 0 \[m\] from
    /// where it is. Without drag it is when it gets there.
    #[inline(always)]
    pub fn leaves(&self, low: f64, high: f64) -> f64 {
        if self.acceleration == 0.0 && self.drag_rate == 0.0 {
            let distance = if self.velocity > 0.0 { high.max(0.0) } else { low.min(0.0) };
            return if self.velocity == 0.0 { f64::INFINITY } else { distance / self.velocity };
        }
        self.reaches(high, 1.0).min(self.reaches(-low, -1.0))
    }

    /// Likewise for one side, `distance` \[m\] away in the direction of `sign`.
    #[inline(never)]
    fn reaches(&self, distance: f64, sign: f64) -> f64 {
        let (velocity, acceleration) = (sign * self.velocity, sign * self.acceleration);
        let distance = distance.max(0.0);
        if distance == f64::INFINITY {
            return f64::INFINITY;
        }
        // Drag slows down: with it the sphere is never ahead of where it would be without, nor of
        // where its terminal velocity would take it if that is faster.
        let without_drag = first_passage(distance, velocity, acceleration);
        if self.drag_rate == 0.0 {
            return without_drag;
        }
        let fastest = velocity.max(acceleration / self.drag_rate);
        let at_fastest = if fastest > 0.0 { distance / fastest } else { f64::INFINITY };
        if velocity >= 0.0 { without_drag.max(at_fastest) } else { at_fastest }
    }
}

/// Smallest `t >= 0` with `v t + a t² / 2 = distance >= 0`; infinite if there is none.
fn first_passage(distance: f64, v: f64, a: f64) -> f64 {
    if a == 0.0 {
        return if v > 0.0 { distance / v } else { f64::INFINITY };
    }
    let discriminant = v * v + 2.0 * a * distance;
    if discriminant < 0.0 || (a < 0.0 && v <= 0.0) {
        return f64::INFINITY;
    }
    let root = discriminant.sqrt();
    // Either form is free of cancellation where it is used.
    if v >= 0.0 {
        if v + root > 0.0 { 2.0 * distance / (v + root) } else { 0.0 }
    } else {
        (root - v) / a
    }
}
