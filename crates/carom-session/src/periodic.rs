//! Displacements in a periodic box.

use carom::DVec3;

/// Multiple of the edges of a periodic box that is nearest to `way` \[m\]; zero along open axes.
pub(crate) fn whole_edges(way: DVec3, size: DVec3) -> DVec3 {
    let along =
        |way: f64, size: f64| if size.is_finite() { (way / size).round() * size } else { 0.0 };
    DVec3::new(along(way.x, size.x), along(way.y, size.y), along(way.z, size.z))
}
