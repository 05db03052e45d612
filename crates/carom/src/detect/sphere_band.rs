use glam::DVec3;

use super::Separation;
use crate::band::{Band, View};
use crate::round_solid::RoundSolid;

/// Separation of a surface of revolution and a sphere: the distance of its centre from the face or a rim, less its
/// radius. `None` where the centre is behind the surface.
///
/// - `center`, `radius` \[m\] of the sphere
pub(crate) fn sphere_band(band: &Band, center: DVec3, radius: f64) -> Option<Separation> {
    let view = band.seen_from(center);
    (view.front >= 0.0).then(|| separation_of(&view, center, radius))
}

/// Separation of a surface of revolution and a sphere that is known to be in front of it, whatever rounding says.
pub(crate) fn sphere_band_known_in_front(band: &Band, center: DVec3, radius: f64) -> Separation {
    separation_of(&band.seen_from(center), center, radius)
}

/// Separation of one side of a ring of a surface of revolution and a sphere near the axis.
///
/// - `center`, `radius` \[m\] of the sphere
/// - `side`: unit vector from the axis to the side
pub(crate) fn sphere_side_of_band(
    band: &Band,
    center: DVec3,
    radius: f64,
    side: DVec3,
) -> Separation {
    separation_of(&band.side_seen_from(center, side), center, radius)
}

/// Separation of a solid of revolution and a sphere. Inside, the nearest face counts: minus its distance, minus the
/// radius, along its normal.
///
/// - `center`, `radius` \[m\] of the sphere
pub(crate) fn sphere_round_solid(solid: &RoundSolid, center: DVec3, radius: f64) -> Separation {
    let views = || solid.bands().map(|band| band.seen_from(center));
    let outside =
        views().filter(|view| view.front >= 0.0).min_by(|a, b| a.distance.total_cmp(&b.distance));
    let inside = || views().max_by(|a, b| a.front.total_cmp(&b.front));
    match outside {
        Some(view) => separation_of(&view, center, radius),
        None => inside().map_or(
            Separation { distance: f64::INFINITY, normal: DVec3::Y, point: center },
            |view| {
                let (normal, depth) = (view.front_normal, -view.front);
                Separation { distance: -depth - radius, normal, point: center + depth * normal }
            },
        ),
    }
}

fn separation_of(view: &View, center: DVec3, radius: f64) -> Separation {
    let View { distance, normal, .. } = *view;
    Separation { distance: distance - radius, normal, point: center - distance * normal }
}
