//! Steady shear of a periodic box: the boxes above and below slide along x (Lees and Edwards, J. Phys. C 5, 1921
//! (1972); `docs/physics/shear.md`).

use glam::DVec3;

use crate::settings::Settings;

/// A periodic box in steady shear: the mean velocity is `rate` y along x.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Shear {
    /// Shear rate \[1/s\].
    pub rate: f64,
    /// Edges of the box \[m\]; infinite along an open axis, finite along x and y.
    pub period: DVec3,
}

impl Shear {
    /// The shear of a world with these settings; `None` at the rate 0.
    pub fn of(settings: &Settings) -> Option<Self> {
        let Settings { boundary, shear_rate: rate, .. } = *settings;
        (rate != 0.0).then(|| Self { rate, period: boundary.period() })
    }

    /// Velocity of the box above relative to this one \[m/s\].
    pub fn speed(&self) -> f64 {
        self.rate * self.period.y
    }

    /// Mean velocity of spheres at a place \[m/s\].
    pub fn velocity_at(&self, place: DVec3) -> DVec3 {
        DVec3::new(self.rate * place.y, 0.0, 0.0)
    }

    /// Returns how far the box above has slid along x at `time` \[s\]: a number of edges, and a
    /// rest of less than one \[m\].
    pub fn slide(&self, time: f64) -> (f64, f64) {
        let way = self.speed() * time;
        // The remainder is exact, so the same image gets the same place from any count of edges.
        let rest = libm::fmod(way, self.period.x);
        (((way - rest) / self.period.x).round(), rest)
    }

    /// The image of a sphere this number of boxes away, at `time` \[s\]: its offset from the sphere \[m\] and its
    /// velocity relative to it \[m/s\].
    pub fn image(&self, offset: [i32; 3], time: f64) -> [DVec3; 2] {
        let rest = self.slide(time).1;
        let beside = rest - (rest / self.period.x).round() * self.period.x;
        let up = f64::from(offset[1]);
        let across = if offset[2] == 0 { 0.0 } else { f64::from(offset[2]) * self.period.z };
        let along = f64::from(offset[0]) * self.period.x + up * beside;
        let velocity = DVec3::new(up * self.speed(), 0.0, 0.0);
        [DVec3::new(along, up * self.period.y, across), velocity]
    }

    /// The image of a state, with a place \[m\] and a velocity \[m/s\], in the box about the origin at `time` \[s\].
    pub fn wrapped(&self, [place, velocity]: [DVec3; 2], time: f64) -> [DVec3; 2] {
        let up = boxes(place.y, self.period.y);
        let across = if self.period.z.is_finite() { boxes(place.z, self.period.z) } else { 0.0 };
        let mut place = place;
        place.y -= up * self.period.y;
        if across != 0.0 {
            place.z -= across * self.period.z;
        }
        if up != 0.0 {
            place.x -= up * self.slide(time).1;
        }
        place.x -= boxes(place.x, self.period.x) * self.period.x;
        [place, velocity - up * DVec3::new(self.speed(), 0.0, 0.0)]
    }

    /// The image of a way that is nearest at `time` \[s\], with the velocity of that image relative to the box about
    /// the origin \[m/s\].
    pub fn nearest(&self, way: DVec3, time: f64) -> [DVec3; 2] {
        self.wrapped([way, DVec3::ZERO], time)
    }
}

/// Number of edges \[m\] between a coordinate \[m\] and the box about the origin.
fn boxes(coordinate: f64, edge: f64) -> f64 {
    // On a face itself it is in the box.
    if coordinate.abs() <= 0.5 * edge { 0.0 } else { (coordinate / edge + 0.5).floor() }
}
