//! Places of points in a picture, and points at places of a picture.

use carom::DVec3;
use carom_render::Camera;
use egui::{Pos2, Rect, Vec2};

/// A camera and the rectangle of its picture on the screen.
#[derive(Debug, Clone, Copy)]
pub struct Projection {
    pub camera: Camera,
    pub rect: Rect,
}

impl Projection {
    fn aspect(&self) -> f64 {
        f64::from(self.rect.width() / self.rect.height())
    }

    /// Returns the position of a point \[m\] on the screen; `None` behind the camera.
    pub fn place(&self, point: DVec3) -> Option<Pos2> {
        let place = self.camera.place(point, self.aspect())?;
        Some(self.rect.center() + Vec2::new(place.x, -place.y) * 0.5 * self.rect.size())
    }

    /// Returns the radius on the screen of a sphere, in points; `None` if the camera is within it.
    pub fn radius(&self, center: DVec3, radius: f64) -> Option<f32> {
        let distance = (center - self.camera.position).length_squared() - radius * radius;
        let height = (0.5 * self.camera.vertical_fov).tan();
        (distance > 0.0)
            .then(|| (radius / distance.sqrt() / height) as f32 * 0.5 * self.rect.height())
    }

    /// Returns the direction from the camera through a place on the screen.
    pub fn ray(&self, pointer: Pos2) -> DVec3 {
        let place = (pointer - self.rect.center()) / (0.5 * self.rect.size());
        self.camera.ray(glam::Vec2::new(place.x, -place.y), self.aspect())
    }

    /// Returns the point of the level plane at a height \[m\] at a place on the screen; `None` above the horizon.
    pub fn on_level(&self, pointer: Pos2, height: f64) -> Option<DVec3> {
        let direction = self.ray(pointer);
        let distance = (height - self.camera.position.y) / direction.y;
        let point = self.camera.position + direction * distance;
        (distance > 0.0 && point.is_finite()).then_some(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_is_as_large_as_the_ball_in_the_picture() {
        let camera = Camera::looking_at(DVec3::Z * 10.0, DVec3::ZERO, 1.0);
        let rect = Rect::from_min_size(Pos2::ZERO, Vec2::new(400.0, 300.0));
        let projection = Projection { camera, rect };
        let radius = projection.radius(DVec3::ZERO, 1.0).unwrap();
        // The tangent from the eye touches the sphere at an angle whose sine is a tenth.
        let expected = 150.0 * 0.1f64.asin().tan() / 0.5f64.tan();
        assert!((f64::from(radius) - expected).abs() < 1e-3, "{radius} {expected}");
        assert_eq!(projection.place(DVec3::ZERO), Some(rect.center()));
        assert_eq!(projection.radius(DVec3::Z * 9.5, 1.0), None);
    }
}
