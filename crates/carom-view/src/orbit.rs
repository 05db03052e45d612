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
        // Narrower pictures show more above and below when they are drawn.
        Self::about(preset.camera(of_scene, bounds, aspect.max(16.0 / 9.0)), bounds)
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
        let fitted = Self::about(Camera::fitted(bounds, direction, aspect.max(16.0 / 9.0)), bounds);
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
