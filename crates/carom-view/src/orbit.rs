//! A camera that the user turns, moves and zooms.

use carom::{DQuat, DVec3};
pub use carom_render::Preset;
use carom_render::{Bounds, Camera};
use carom_session::LinkCamera;
use egui::Ui;

/// A camera and its distance from the point that it turns about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// The camera.
    pub camera: Camera,
    /// Distance from the camera to the target, the point about which it turns \[m\].
    pub distance: f64,
}

/// Smallest angle between the camera's direction and straight up or down \[rad\]: beyond it, right
/// would become left.
const NEAREST_TO_POLE: f64 = 0.01;

/// Ratio of width to height that scenes are made for.
const WIDE: f64 = 16.0 / 9.0;

/// Largest vertical angle of view to which a narrow picture opens a camera \[°\].
const WIDEST: f64 = 50.0;

/// Space around fitted bounds, relative to them.
const MARGIN: f64 = 1.04;

impl Orbit {
    /// Returns an orbit of this camera whose target is the point of its axis nearest to the middle
    /// of `bounds`.
    pub fn about(camera: Camera, bounds: &Bounds) -> Self {
        let ahead = (bounds.center() - camera.position).dot(camera.ahead());
        let distance = if ahead > 0.0 { ahead } else { bounds.radius() };
        Self { camera, distance: distance.max(1e-6) }
    }

    /// Returns a preset that shows `bounds` in a picture with this ratio of width to height.
    pub fn preset(preset: Preset, of_scene: Option<Camera>, bounds: &Bounds, aspect: f64) -> Self {
        let wide = preset.camera(of_scene, bounds, aspect.max(WIDE));
        if preset == Preset::Scene && of_scene.is_some() {
            return Self::about(wide, bounds);
        }
        Self::fitted(bounds, -wide.ahead(), aspect)
    }

    /// Returns an orbit that shows `bounds` from this direction in a picture with this ratio of
    /// width to height, see [`Self::in_picture`].
    pub fn fitted(bounds: &Bounds, direction: DVec3, aspect: f64) -> Self {
        let wide = Camera::fitted(bounds, direction, aspect.max(WIDE));
        if aspect >= WIDE {
            return Self::about(wide, bounds);
        }
        // A narrower picture has room above and below.
        let sideways = (0.5 * wide.vertical_fov).tan() * WIDE / MARGIN;
        let upward = sideways / aspect;
        let to_camera = wide.rotation.inverse();
        let needed = bounds.corners().map(|corner| {
            let seen = to_camera * (corner - bounds.center());
            (seen.x.abs() / sideways).max(seen.y.abs() / upward) + seen.z
        });
        let distance = needed.into_iter().fold(1e-6, f64::max);
        let position = bounds.center() - distance * wide.ahead();
        Self::about(Camera { position, ..wide }, bounds)
    }

    /// Returns the camera for a picture with this ratio of width to height. Scenes are made for
    /// 16:9; in a narrower picture the camera shows more above and below instead of less at the
    /// sides: by a wider angle of view up to [`WIDEST`], beyond that from farther away, because
    /// balls at the edges of a wide picture look like eggs.
    pub fn in_picture(&self, aspect: f64) -> Camera {
        let widened = (WIDE / aspect).max(1.0);
        let opening = (0.5 * self.camera.vertical_fov).tan();
        let most = opening.max((0.5 * WIDEST.to_radians()).tan());
        let upward = (opening * widened).min(most);
        let back = self.distance * (opening * widened / upward - 1.0);
        Camera {
            vertical_fov: 2.0 * upward.atan(),
            position: self.camera.position - back * self.camera.ahead(),
            ..self.camera
        }
    }

    /// Returns the camera of a link, with a level horizon.
    pub fn of_link(place: LinkCamera) -> Self {
        let vertical_fov = place.vertical_fov_degrees.to_radians();
        let camera = Camera::looking_at(place.position, place.target, vertical_fov);
        Self { camera, distance: place.position.distance(place.target) }
    }

    /// Returns this camera for a link, which leaves out a sideways tilt.
    pub fn for_link(&self) -> LinkCamera {
        let Camera { position, vertical_fov, .. } = self.camera;
        // Rounds degrees as people write them.
        let vertical_fov_degrees = (vertical_fov.to_degrees() * 1e6).round() / 1e6;
        LinkCamera { position, target: self.target(), vertical_fov_degrees }
    }

    /// Returns the target, the point about which the camera turns \[m\].
    pub fn target(&self) -> DVec3 {
        self.camera.position + self.distance * self.camera.ahead()
    }

    /// Turns the camera about the target; `right` and `up` are the drag of the picture \[rad\].
    pub fn turn(&mut self, right: f64, up: f64) {
        let target = self.target();
        // Angle between the camera's direction and straight up.
        let from_up = self.camera.ahead().angle_between(DVec3::Y);
        let most = from_up - NEAREST_TO_POLE;
        let least = from_up - (std::f64::consts::PI - NEAREST_TO_POLE);
        let up = up.clamp(least.min(0.0), most.max(0.0));
        let pitch = DQuat::from_axis_angle(self.camera.rotation * DVec3::X, up);
        let yaw = DQuat::from_rotation_y(-right);
        self.camera.rotation = (yaw * pitch * self.camera.rotation).normalize();
        self.camera.position = target - self.distance * self.camera.ahead();
    }

    /// Moves the camera across; `right` and `up` are parts of the picture's height at the target.
    pub fn pan(&mut self, right: f64, up: f64) {
        let height = 2.0 * self.distance * (0.5 * self.camera.vertical_fov).tan();
        let across = DVec3::new(-right, -up, 0.0) * height;
        self.camera.position += self.camera.rotation * across;
    }

    /// Moves the camera nearer to the target for a factor above 1, away for one below.
    pub fn zoom(&mut self, factor: f64) {
        let target = self.target();
        let distance = self.distance / factor;
        if distance.is_finite() && distance > 0.0 {
            self.distance = distance;
            // Nearby objects stay visible when the camera comes close.
            self.camera.near = self.camera.near.min(1e-2 * distance);
            self.camera.position = target - distance * self.camera.ahead();
        }
    }

    /// Moves the camera nearer to a point \[m\] for a factor above 1, away for one below. The point
    /// keeps its place in the picture.
    pub fn zoom_on(&mut self, factor: f64, point: DVec3) {
        let distance = self.distance / factor;
        if distance.is_finite() && distance > 0.0 {
            self.distance = distance;
            self.camera.near = self.camera.near.min(1e-2 * distance);
            self.camera.position = point + (self.camera.position - point) / factor;
        }
    }

    /// Moves the camera by this vector \[m\].
    pub fn follow(&mut self, by: DVec3) {
        self.camera.position += by;
    }

    /// Moves the camera by the given part of the way to where all of `bounds` is visible from the
    /// present direction, in a picture with this ratio of width to height. The part is larger if
    /// the target would stay too far behind.
    pub fn approach(&mut self, bounds: &Bounds, aspect: f64, part: f64) {
        // Largest distance between the target and the middle of `bounds`, in radii.
        const BEHIND: f64 = 0.4;
        let direction = -self.camera.ahead();
        let fitted = Self::fitted(bounds, direction, aspect);
        // The camera's field of view may differ from that of fitted cameras.
        let opening = |camera: &Camera| (0.5 * camera.vertical_fov).tan();
        let scale = opening(&fitted.camera) / opening(&self.camera);
        let distance = self.distance + part * (scale * fitted.distance - self.distance);
        let gap = bounds.center().distance(self.target());
        let part = part.max(1.0 - BEHIND * bounds.radius() / gap.max(f64::MIN_POSITIVE));
        let target = self.target().lerp(bounds.center(), part);
        self.distance = distance;
        self.camera.near = self.camera.near.min(1e-2 * distance);
        self.camera.position = target + distance * direction;
    }

    /// Makes this point the target and keeps direction and distance \[m\].
    pub fn center_on(&mut self, point: DVec3) {
        self.camera.position = point - self.distance * self.camera.ahead();
    }
}

/// Distance that the wheel scrolls to come nearer by a factor e, in points. A notch of the wheel is
/// 100 to 120 pixels in browsers, and a line of 40 points on desktops.
const SCROLL: f64 = if cfg!(target_arch = "wasm32") { 750.0 } else { 300.0 };

/// Returns the factor by which wheel and fingers zoom in.
pub fn zoom_asked(ui: &Ui) -> f64 {
    let (scrolled, pinched) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
    f64::from(pinched) * (f64::from(scrolled) / SCROLL).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orbit() -> Orbit {
        let camera = Camera::looking_at(DVec3::Z * 10.0, DVec3::ZERO, 35f64.to_radians());
        Orbit { camera, distance: 10.0 }
    }

    #[test]
    fn a_zoom_on_a_point_keeps_its_place_in_the_picture() {
        let mut orbit = orbit();
        let point = DVec3::new(1.0, 0.5, 2.0);
        let place = |orbit: &Orbit| orbit.camera.place(point, 1.5).unwrap();
        let before = place(&orbit);
        orbit.zoom_on(3.0, point);
        // The projection has 32 bits.
        assert!(place(&orbit).distance(before) < 1e-5);
        let left = (orbit.camera.position - point).length();
        assert!((left * 3.0 - (DVec3::Z * 10.0 - point).length()).abs() < 1e-9);
    }

    #[test]
    fn tall_pictures_show_the_same_width_without_a_wide_angle() {
        for aspect in [16.0 / 9.0, 1.3, 390.0 / 844.0] {
            let camera = orbit().in_picture(aspect);
            // What is at the right edge of a wide picture stays there.
            let edge = DVec3::X * 10.0 * (0.5 * 35f64.to_radians()).tan() * WIDE;
            let place = camera.place(edge, aspect).unwrap();
            assert!((place.x - 1.0).abs() < 1e-5, "{aspect}: {place}");
            assert!(camera.vertical_fov <= WIDEST.to_radians() + 1e-12, "{aspect}");
        }
    }

    #[test]
    fn fitted_bounds_fill_a_tall_picture_and_none_of_them_is_cut_off() {
        let bounds = Bounds { min: DVec3::new(-3.0, 0.0, -2.0), max: DVec3::new(3.0, 1.0, 2.0) };
        for aspect in [2.0, 1.0, 390.0 / 700.0] {
            let orbit = Orbit::fitted(&bounds, DVec3::new(0.0, 1.3, 0.6), aspect);
            let camera = orbit.in_picture(aspect);
            let places = bounds.corners().map(|corner| camera.place(corner, aspect).unwrap());
            let most = places.iter().map(|it| it.abs().max_element()).fold(0.0, f32::max);
            assert!(most > 0.8 && most <= 1.0, "{aspect}: {most}");
        }
    }
}
