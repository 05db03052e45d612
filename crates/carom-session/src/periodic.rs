//! Ways in a space that may repeat itself.

use carom::DVec3;

/// The whole edges \[m\] of a periodic box that are nearest to `way`; zero along open axes.
pub(crate) fn whole_edges(way: DVec3, size: DVec3) -> DVec3 {
    let along =
        |way: f64, size: f64| if size.is_finite() { (way / size).round() * size } else { 0.0 };
    DVec3::new(along(way.x, size.x), along(way.y, size.y), along(way.z, size.z))
}
