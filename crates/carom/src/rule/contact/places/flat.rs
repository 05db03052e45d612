//! Flat parts of surfaces, and where they are once they have turned.

use glam::DVec3;

use crate::surface::{Form, SurfaceMotion};

/// Whether a surface has this normal in more than one place.
pub(crate) fn is_flat(form: &Form, normal: DVec3) -> bool {
    match form {
        Form::HalfSpace { .. } => true,
        Form::Rectangle(rectangle) => rectangle.normal == normal,
        Form::Facet(_) => true,
        Form::Band(band) => band.flat_normal() == Some(normal),
        _ => false,
    }
}

/// Normal of a turning plane after `h` \[s\], and its velocity \[m/s\]: tangential to it as where the sphere
/// touches then, along it the speed of approach to the sphere's present place.
pub(crate) fn turning_plane(
    motion: &SurfaceMotion,
    (normal, point): (DVec3, DVec3),
    (center, height): (DVec3, f64),
    h: f64,
) -> (DVec3, DVec3) {
    let (normal, point) = (motion.turned(normal, h), motion.carried(point, h));
    let velocity = motion.velocity_after(point, h);
    let along = (height - (center - point).dot(normal)) / h;
    (normal, velocity + (along - velocity.dot(normal)) * normal)
}
