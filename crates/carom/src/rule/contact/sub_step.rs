//! A sub-step: its length, and the speeds that separate impacts from resting contacts.

use glam::DVec3;

/// Overlaps up to this part of the sum of radii are left as they are, so that a contact that rests does
/// not come and go.
pub(super) const SLOP: f64 = 0.0005;
/// Part of a larger overlap that a sub-step corrects. With the whole overlap, opening one contact would close the
/// next, and a heap would never rest.
pub(super) const RELAXATION: f64 = 0.3;
/// Largest growth factor of a contact's starting impulse per sub-step, besides [`GROWTH_BY_WEIGHT`] times the
/// impulse that its effective mass gains in free fall over one.
pub(super) const GROWTH: f64 = 3.0;
const GROWTH_BY_WEIGHT: f64 = 4.0;
/// A contact that pressed before bounces only above this multiple of the speed of free fall over a sub-step: its
/// neighbours shake it by about that much.
const RESTING: f64 = 10.0;
/// A new contact bounces only above this multiple of the relative speed that its bodies gain in a sub-step: slower
/// ones would meet again within it.
const NEW: f64 = 2.0;
/// A new contact of a body that presses on something bounces only above [`RESTING`] times the speed of free fall
/// over a sub-step along its normal, and in any direction above this multiple: it is shaken, too.
const SHAKEN: f64 = 0.5;

/// A sub-step.
#[derive(Debug, Clone, Copy)]
pub(super) struct SubStep {
    /// Time at its start since the start of the frame \[s\].
    pub time: f64,
    /// Length \[s\].
    pub h: f64,
    /// Speed of approach above which a new contact of two spheres is an impact \[m/s\].
    pub impact_speed: f64,
    /// Speed of approach above which a contact that pressed before is an impact \[m/s\].
    pub resting_speed: f64,
    /// Speed that forces give a sphere in the sub-step at most \[m/s\].
    fall: f64,
    /// The acceleration of all spheres \[m/s²\], where it is one and constant.
    pub common_acceleration: Option<DVec3>,
    /// Growth allowed to a starting impulse, divided by the effective mass \[m/s\].
    pub growth: f64,
}

impl SubStep {
    /// A sub-step of `h` \[s\] from a `time` \[s\] on, in which forces change velocities by at most `change`
    /// \[m/s\].
    pub fn new(time: f64, h: f64, common_acceleration: Option<DVec3>, change: f64) -> Self {
        // For two spheres relative to each other.
        let (fall, difference) = match common_acceleration {
            Some(acceleration) => (h * acceleration.length(), 0.0),
            None => (change, 2.0 * change),
        };
        Self {
            time,
            h,
            impact_speed: NEW * difference,
            resting_speed: RESTING * fall,
            fall,
            common_acceleration,
            growth: GROWTH_BY_WEIGHT * fall,
        }
    }

    /// Returns by how much [`Self::resting_speed`] is higher where a surface accelerates beside the
    /// sphere \[m/s²\].
    pub fn resting_speed_at(&self, acceleration: DVec3) -> f64 {
        RESTING * self.h * acceleration.length()
    }

    /// Returns by how much [`Self::growth`] is larger beside a surface with this acceleration
    /// \[m/s²\].
    pub fn growth_at(&self, acceleration: DVec3) -> f64 {
        GROWTH_BY_WEIGHT * self.h * acceleration.length()
    }

    /// Speed of approach above which a new contact of a sphere that presses on something is an impact \[m/s\], for
    /// an acceleration by forces along the normal \[m/s²\].
    pub fn shaken_speed(&self, along: f64) -> f64 {
        let [by_weight, least] = self.shaken();
        by_weight * along.abs() + least
    }

    /// [`Self::shaken_speed`] divided by the acceleration along the normal \[s\], and its least value \[m/s\].
    pub fn shaken(&self) -> [f64; 2] {
        [RESTING * self.h, SHAKEN * self.fall]
    }

    /// Speed of approach above which a new contact with a surface is an impact \[m/s\], for a sphere
    /// that is pressed to it with this acceleration \[m/s²\].
    pub fn surface_impact_speed(&self, pressing: f64) -> f64 {
        NEW * self.h * pressing
    }
}
