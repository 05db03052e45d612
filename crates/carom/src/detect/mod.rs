//! Detection: which bodies touch, and how.
//!
//! The broad phase proposes, one file per pair of shapes measures, `classify` decides.

mod bound_pairs;
pub(crate) mod broad_phase;
mod classify;
pub(crate) mod contact;
pub(crate) mod contacts;
pub(crate) mod image_overlaps;
pub(crate) mod instant;
pub(crate) mod moving_surfaces;
pub(crate) mod passage;
mod separation;
mod sphere_band;
mod sphere_box;
mod sphere_half_space;
mod sphere_mesh;
mod sphere_rectangle;
mod sphere_sphere;
pub(crate) mod surface_tree;
pub(crate) mod swept_region;

use glam::DVec3;

pub(crate) use bound_pairs::bound_pairs;
pub use classify::{ContactState, classify};
pub use separation::Separation;
pub(crate) use sphere_band::{
    sphere_band, sphere_band_known_in_front, sphere_round_solid, sphere_side_of_band,
};
pub(crate) use sphere_box::sphere_box;
pub use sphere_half_space::sphere_half_space;
pub(crate) use sphere_mesh::{
    sphere_closed_mesh, sphere_corner, sphere_corner_point, sphere_edge, sphere_edge_line,
    sphere_facet, sphere_facet_plane,
};
pub(crate) use sphere_rectangle::{sphere_rectangle, sphere_rectangle_known_in_front};
pub use sphere_sphere::sphere_sphere;

use crate::surface::Form;

/// Separation of a surface (body 1) and a sphere (body 2) with `center` and `radius` \[m\];
/// `None` where the sphere is on the side that nothing collides with.
pub(crate) fn sphere_surface(form: &Form, center: DVec3, radius: f64) -> Option<Separation> {
    match form {
        Form::Sphere { center: fixed, radius: fixed_radius } => {
            Some(sphere_sphere([*fixed, center], [*fixed_radius, radius]))
        }
        Form::Rectangle(rectangle) => sphere_rectangle(rectangle, center, radius),
        Form::HalfSpace { point, normal } => {
            Some(sphere_half_space((*point, *normal), center, radius))
        }
        Form::Box(solid) => Some(sphere_box(solid, center, radius)),
        Form::Band(band) => sphere_band(band, center, radius),
        Form::Round(solid) => Some(sphere_round_solid(solid, center, radius)),
        Form::Closed(mesh) => sphere_closed_mesh(mesh, center, radius),
        Form::Facet(facet) => sphere_facet(facet, center, radius),
        Form::Edge(edge) => sphere_edge(edge, center, radius),
        Form::Corner(corner) => sphere_corner(corner, center, radius),
    }
}

/// [`sphere_surface`] of a sphere that has been in front: it may have come behind a one-sided surface.
pub(crate) fn known_in_front(form: &Form, center: DVec3, radius: f64) -> Option<Separation> {
    match form {
        Form::Rectangle(it) => Some(sphere_rectangle_known_in_front(it, center, radius)),
        Form::Band(it) => Some(sphere_band_known_in_front(it, center, radius)),
        Form::Facet(it) if it.is_under(center) => Some(sphere_facet_plane(it, center, radius)),
        _ => sphere_surface(form, center, radius),
    }
}
