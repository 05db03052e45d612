//! When two spheres with wells meet.

use glam::DVec3;

use super::state::Flights;
use crate::contact_time::{sphere_sphere_leaving, sphere_sphere_linear};

/// Square of the part of the range within which the image of a bound pair is, with more than its rounding. In a box of at
/// least four ranges of a sphere the next image is farther, but at one instant.
const SURELY_INSIDE: f64 = 1.0 + 1e-9;

impl Flights {
    /// After what time \[s\] two spheres, by slot, meet at their cores or at the edge of their well. With them come
    /// the offset \[m\] and the relative velocity \[m/s\], the sum of their radii \[m\], and whether their cores touch
    /// without closing.
    ///
    /// A free pair enters the well; a bound one meets at the cores or else comes to the edge from inside.
    pub fn time_in_wells(
        &self,
        slots: [u32; 2],
        [offset, velocity]: [DVec3; 2],
        radius_sum: f64,
        only_touch: bool,
    ) -> Option<f64> {
        let wells = self.wells.as_ref()?;
        let edge = wells.range_ratio * radius_sum;
        if !wells.is_bound(slots.map(|slot| self.index_of[slot as usize])) {
            return sphere_sphere_linear(offset, velocity, edge);
        }
        if offset.length_squared() > edge * edge * SURELY_INSIDE {
            // It is another image than the one that is bound, which leaves before this one can enter.
            return None;
        }
        let at_cores = sphere_sphere_linear(offset, velocity, radius_sum);
        let at_cores = at_cores.filter(|_| !only_touch);
        at_cores.or_else(|| sphere_sphere_leaving(offset, velocity, edge))
    }
}
