use super::Separation;
use crate::mesh::{ClosedMesh, Corner, Depth, Edge, Facet};
use crate::norm::Norm;
use glam::DVec3;

/// Separation of what a closed mesh encloses and a sphere with its centre inside: minus the distance from the nearest
/// place of the surface, minus the radius, along the way there. `None` outside, where the faces, edges and corners
/// count.
///
/// - `center`, `radius` \[m\] of the sphere
pub(crate) fn sphere_closed_mesh(
    mesh: &ClosedMesh,
    center: DVec3,
    radius: f64,
) -> Option<Separation> {
    let Depth { depth, normal } = mesh.depth_at(center)?;
    Some(Separation { distance: -depth - radius, normal, point: center + depth * normal })
}

/// Separation of a flat face of a mesh and a sphere: `(x - p) · n - r`, where the foot of the centre is inside
/// the face, by all but rounding. `None` elsewhere, and where the centre is behind it.
///
/// - `center`, `radius` \[m\] of the sphere
pub(crate) fn sphere_facet(facet: &Facet, center: DVec3, radius: f64) -> Option<Separation> {
    let is_met = facet.height_of(center) >= 0.0 && facet.is_under(center);
    is_met.then(|| sphere_facet_plane(facet, center, radius))
}

/// [`sphere_facet`] of a sphere that is known to meet it.
pub(crate) fn sphere_facet_plane(facet: &Facet, center: DVec3, radius: f64) -> Separation {
    let height = facet.height_of(center);
    let normal = facet.frame.normal;
    Separation { distance: height - radius, normal, point: center - height * normal }
}

/// Separation of an edge of a mesh and a sphere, `|x - q| - r` with q the foot of the centre on the edge, where
/// nothing of the mesh is nearer. `None` elsewhere.
pub(crate) fn sphere_edge(edge: &Edge, center: DVec3, radius: f64) -> Option<Separation> {
    edge.is_nearest(center).then(|| sphere_edge_line(edge, center, radius))
}

/// [`sphere_edge`] of a sphere that is known to meet it.
pub(crate) fn sphere_edge_line(edge: &Edge, center: DVec3, radius: f64) -> Separation {
    let [one, other] = edge.outward;
    let middle = one + other;
    let normal_at_zero = if middle == DVec3::ZERO { one } else { middle / middle.norm() };
    Separation::from_point(edge.foot_of(center), center, radius, normal_at_zero)
}

/// Separation of a corner of a mesh and a sphere, `|x - p| - r`, where nothing of the mesh is nearer. `None`
/// elsewhere.
pub(crate) fn sphere_corner(corner: &Corner, center: DVec3, radius: f64) -> Option<Separation> {
    corner.is_nearest(center).then(|| sphere_corner_point(corner, center, radius))
}

/// [`sphere_corner`] of a sphere that is known to meet it.
pub(crate) fn sphere_corner_point(corner: &Corner, center: DVec3, radius: f64) -> Separation {
    Separation::from_point(corner.point, center, radius, DVec3::Y)
}
