//! Motion of a sphere in flight along one axis.

/// Velocity \[m/s\], acceleration of everything but drag \[m/s²\] and rate of drag \[1/s\].
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct AxisMotion {
    pub velocity: f64,
    pub acceleration: f64,
    pub drag_rate: f64,
}

/// A motion along one axis for some time.
pub(crate) trait AlongAxis {
    /// A lower bound of the time \[s\] at which the motion leaves the interval from `low` < 0 to `high` > 0 \[m\]
    /// about its start; without drag it is the time itself. Infinite if it does not leave within its time.
    fn leaves(&self, low: f64, high: f64) -> f64;

    /// Displacement in a time \[m\]; `None` where that has no simple form.
    fn way(&self, time: f64) -> Option<f64>;
}

impl AlongAxis for AxisMotion {
    #[inline(always)]
    fn leaves(&self, low: f64, high: f64) -> f64 {
        if self.acceleration == 0.0 && self.drag_rate == 0.0 {
            let distance = if self.velocity > 0.0 { high.max(0.0) } else { low.min(0.0) };
            return if self.velocity == 0.0 { f64::INFINITY } else { distance / self.velocity };
        }
        self.reaches(high, 1.0).min(self.reaches(-low, -1.0))
    }

    fn way(&self, time: f64) -> Option<f64> {
        let way = time * (self.velocity + 0.5 * self.acceleration * time);
        (self.drag_rate == 0.0).then_some(way)
    }
}

impl AxisMotion {
    /// A lower bound of the time \[s\] at which the motion reaches one side, `distance` \[m\] away in the direction
    /// of `sign`.
    #[inline(never)]
    fn reaches(&self, distance: f64, sign: f64) -> f64 {
        let (velocity, acceleration) = (sign * self.velocity, sign * self.acceleration);
        let distance = distance.max(0.0);
        if distance == f64::INFINITY {
            return f64::INFINITY;
        }
        // Drag only slows down: the sphere is never ahead of its motion without drag, nor of a motion at its
        // terminal velocity if that is faster.
        let without_drag = first_passage(distance, velocity, acceleration);
        if self.drag_rate == 0.0 {
            return without_drag;
        }
        let fastest = velocity.max(acceleration / self.drag_rate);
        let at_fastest = if fastest > 0.0 { distance / fastest } else { f64::INFINITY };
        let bound = if velocity >= 0.0 {
            without_drag
        } else {
            // On its way back drag adds to the acceleration, never by more than now.
            first_passage(distance, velocity, acceleration - self.drag_rate * velocity)
        };
        bound.max(at_fastest)
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

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::flight::Flight;

    /// When a motion really gets to a distance \[m\], by small steps \[s\]; none before the `end` \[s\].
    fn arrival(motion: &AxisMotion, distance: f64, step: f64, end: f64) -> Option<f64> {
        let flight = Flight {
            position: DVec3::ZERO,
            velocity: motion.velocity * DVec3::X,
            acceleration: motion.acceleration * DVec3::X,
            drag_rate: motion.drag_rate,
        };
        let steps = (end / step) as u32;
        let mut times = (0..steps).map(|count| step * f64::from(count));
        times.find(|&time| flight.position_at(time).x >= distance)
    }

    #[test]
    fn a_motion_leaves_no_later_than_it_does_and_hardly_earlier_under_weak_drag() {
        let (distance, step) = (0.5, 1e-3);
        for drag_rate in [0.0, 1e-6, 1e-4, 1e-2, 1.0] {
            for velocity in [-30.0, -5.0, -0.1, 0.0, 0.1, 5.0] {
                for acceleration in [-9.81, 0.0, 9.81] {
                    let motion = AxisMotion { velocity, acceleration, drag_rate };
                    let bound = motion.leaves(f64::NEG_INFINITY, distance);
                    let Some(arrival) = arrival(&motion, distance, step, 10.0) else { continue };
                    assert!(bound <= arrival, "{bound} {arrival} {velocity} {acceleration}");
                    // Found to one step; drag changes times by parts of about γ t.
                    let least = (arrival - step) * (1.0 - drag_rate * arrival);
                    assert!(bound >= least, "{bound} {arrival} {velocity} {acceleration}");
                }
            }
        }
    }
}
