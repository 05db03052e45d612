//! The camera that a picture is taken with.

use carom::{DQuat, DVec3};
use carom_scene::Scene;
use glam::{DMat3, Mat4, Vec2, Vec3, Vec4};

use crate::bounds::Bounds;

/// A camera. It looks along its local -z, its local +y is up in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Position \[m\].
    pub position: DVec3,
    /// Unit quaternion from the camera's frame to the world.
    pub rotation: DQuat,
    /// Vertical field of view \[rad\], in (0, π).
    pub vertical_fov: f64,
    /// Nearest distance drawn \[m\], > 0.
    pub near: f64,
}

impl Camera {
    /// Vertical field of view of a camera that states none \[°\]: narrow enough that a sphere at
    /// the edge of the picture looks round.
    pub const VERTICAL_FOV_DEGREES: f64 = 35.0;

    /// Returns the camera of a scene, if the scene has one.
    pub fn of_scene(scene: &Scene) -> Option<Self> {
        let camera = scene.camera.as_ref()?;
        Some(Self {
            position: DVec3::from_array(camera.position),
            rotation: DQuat::from_array(camera.rotation).normalize(),
            vertical_fov: camera.vertical_fov_degrees.to_radians(),
            near: camera.near,
        })
    }

    /// Returns a camera at `position` that looks at `target` \[m\]. The world's +y points upward in
    /// the picture; -z does if the camera looks straight down or up.
    pub fn looking_at(position: DVec3, target: DVec3, vertical_fov: f64) -> Self {
        let distance = (position - target).length().max(1e-9);
        let back = (position - target).try_normalize().unwrap_or(DVec3::Z);
        let up = if back.y.abs() > 0.999_999 { DVec3::NEG_Z } else { DVec3::Y };
        let right = up.cross(back).normalize();
        let rotation = DQuat::from_mat3(&DMat3::from_cols(right, back.cross(right), back));
        // A thousandth of the distance to the target: no ball that matters is nearer.
        Self { position, rotation, vertical_fov, near: 1e-3 * distance }
    }

    /// Returns a camera that looks along `-from` from far enough away to show all of `bounds`, in a
    /// picture with the given ratio of width to height.
    pub fn fitted(bounds: &Bounds, from: DVec3, aspect: f64) -> Self {
        // The part of the picture left free around `bounds`.
        const MARGIN: f64 = 1.04;
        let vertical_fov = Self::VERTICAL_FOV_DEGREES.to_radians();
        let direction = from.try_normalize().unwrap_or(DVec3::Z);
        let view = Self::looking_at(bounds.center() + direction, bounds.center(), vertical_fov);
        let to_camera = view.rotation.inverse();
        let upward = (0.5 * vertical_fov).tan() / MARGIN;
        let sideways = upward * aspect;
        // Every corner must lie within the four planes at the edges of the picture.
        let mut distance = 1e-6f64;
        for corner in bounds.corners() {
            let seen = to_camera * (corner - bounds.center());
            let needed = (seen.x.abs() / sideways).max(seen.y.abs() / upward) + seen.z;
            distance = distance.max(needed);
        }
        Self::looking_at(bounds.center() + direction * distance, bounds.center(), vertical_fov)
    }

    /// Returns the same camera for a picture with this ratio of width to height. Scenes are made
    /// for 16:9; in a narrower picture the camera shows more above and below instead of less at the
    /// sides.
    pub fn in_picture(self, aspect: f64) -> Self {
        let widened = (16.0 / 9.0 / aspect).max(1.0);
        let upward = (0.5 * self.vertical_fov).tan() * widened;
        Self { vertical_fov: 2.0 * upward.atan(), ..self }
    }

    /// Returns the direction in which the camera looks, a unit vector.
    pub fn ahead(&self) -> DVec3 {
        self.rotation * DVec3::NEG_Z
    }

    /// Returns the matrix from positions relative to the eye to clip space. Depth is 1 at `near`
    /// and 0 at infinity, which spreads the precision of 32 bits evenly.
    pub(crate) fn clip_from_eye(&self, aspect: f32) -> Mat4 {
        let view = Mat4::from_quat(self.rotation.as_quat().inverse());
        let upward = 1.0 / (0.5 * self.vertical_fov as f32).tan();
        let projection = Mat4::from_cols(
            Vec4::X * (upward / aspect),
            Vec4::Y * upward,
            Vec4::NEG_W,
            Vec4::Z * self.near as f32,
        );
        projection * view
    }

    /// Returns the vectors from the middle of the picture to its right and its upper edge, at
    /// distance 1.
    pub(crate) fn edges(&self, aspect: f32) -> [Vec3; 2] {
        let upward = (0.5 * self.vertical_fov).tan();
        let edges = [DVec3::X * upward * f64::from(aspect), DVec3::Y * upward];
        edges.map(|edge| (self.rotation * edge).as_vec3())
    }

    /// Returns the position of a point \[m\] in the picture, from (-1, -1) at the lower left to (1,
    /// 1); `None` for a point behind the eye.
    pub fn place(&self, point: DVec3, aspect: f64) -> Option<Vec2> {
        let seen =
            self.clip_from_eye(aspect as f32) * (point - self.position).as_vec3().extend(1.0);
        (seen.w > 0.0).then(|| Vec2::new(seen.x, seen.y) / seen.w)
    }

    /// Returns the direction from the eye through a position in the picture; (-1, -1) is the lower
    /// left corner.
    pub fn ray(&self, place: Vec2, aspect: f64) -> DVec3 {
        let [right, up] = self.edges(aspect as f32).map(|edge| edge.as_dvec3());
        let direction = self.ahead() + f64::from(place.x) * right + f64::from(place.y) * up;
        direction.normalize()
    }
}
