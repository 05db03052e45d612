//! A camera that is turned, moved and brought nearer by hand.

use carom::{DQuat, DVec3};
pub use carom_render::Preset;
use carom_render::{Bounds, Camera};
use carom_session::LinkCamera;
use egui::Ui;

/// A camera and what it looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// Where from.
    pub camera: Camera,
    /// From the camera to the point about which it turns \[m\].
    pub distance: f64,
}

/// Nearest to straight up or down that a camera is turned \[rad\]: past it, right would be left.
const NEAREST_TO_POLE: f64 = 0.01;

impl Orbit {
    /// A camera in this place, turning about the point nearest to what there is to see.
    pub fn about(camera: Camera, bounds: &Bounds) -> Self {
        let ahead = (bounds.center() - camera.position).dot(camera.ahead());
        let distance = if ahead > 0.0 { ahead } else { bounds.radius() };
        Self { camera, distance: distance.max(1e-6) }
    }

    /// A preset for what lies in `bounds`, seen in a picture of this width to height.
    pub fn preset(preset: Preset, of_scene: Option<Camera>, bounds: &Bounds, aspect: f64) -> Self {
        // Narrower pictures are widened when they are drawn.
        Self::about(preset.camera(of_scene, bounds, aspect.max(16.0 / 9.0)), bounds)
    }

    /// A camera as a link has it, the horizon level.
    pub fn of_link(place: LinkCamera) -> Self {
        let vertical_fov = place.vertical_fov_degrees.to_radians();
        let camera = Camera::looking_at(place.position, place.target, vertical_fov);
        Self { camera, distance: place.position.distance(place.target) }
    }

    /// This camera for a link, which does not hold how it is tilted sideways.
    pub fn for_link(&self) -> LinkCamera {
        let Camera { position, vertical_fov, .. } = self.camera;
        // Degrees as people write them, not one rounding off.
        let vertical_fov_degrees = (vertical_fov.to_degrees() * 1e6).round() / 1e6;
        LinkCamera { position, target: self.target(), vertical_fov_degrees }
    }

    /// The point about which it turns \[m\].
    pub fn target(&self) -> DVec3 {
        self.camera.position + self.distance * self.camera.ahead()
    }

    /// Turns about the target: to the right and upward as the hand drags what is seen \[rad\].
    pub fn turn(&mut self, right: f64, up: f64) {
        let target = self.target();
        // Angle between the way it looks and straight up.
        let from_up = self.camera.ahead().angle_between(DVec3::Y);
        let most = from_up - NEAREST_TO_POLE;
        let least = from_up - (std::f64::consts::PI - NEAREST_TO_POLE);
        let up = up.clamp(least.min(0.0), most.max(0.0));
        let pitch = DQuat::from_axis_angle(self.camera.rotation * DVec3::X, up);
        let yaw = DQuat::from_rotation_y(-right);
        self.camera.rotation = (yaw * pitch * self.camera.rotation).normalize();
        self.camera.position = target - self.distance * self.camera.ahead();
    }

    /// Moves across the picture, by parts of its height at the target.
    pub fn pan(&mut self, right: f64, up: f64) {
        let height = 2.0 * self.distance * (0.5 * self.camera.vertical_fov).tan();
        let across = DVec3::new(-right, -up, 0.0) * height;
        self.camera.position += self.camera.rotation * across;
    }

    /// Comes nearer to the target, for a factor above 1.
    pub fn zoom(&mut self, factor: f64) {
        let target = self.target();
        let distance = self.distance / factor;
        if distance.is_finite() && distance > 0.0 {
            self.distance = distance;
            // Near things stay in sight when it comes close.
            self.camera.near = self.camera.near.min(1e-2 * distance);
            self.camera.position = target - distance * self.camera.ahead();
        }
    }

    /// Moves along with something that moved by this \[m\].
    pub fn follow(&mut self, by: DVec3) {
        self.camera.position += by;
    }

    /// Comes nearer, by this part of the way, to where all of `bounds` is in a picture of this width
    /// to height, seen from the side it is on; faster where that would be left behind.
    pub fn approach(&mut self, bounds: &Bounds, aspect: f64, part: f64) {
        // Farthest that the target stays behind the middle, in radii.
        const BEHIND: f64 = 0.4;
        let direction = -self.camera.ahead();
        let fitted = Self::about(Camera::fitted(bounds, direction, aspect.max(16.0 / 9.0)), bounds);
        // Its own field of view may be another one than that of fitted cameras.
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

    /// Looks at a point from the side and distance it has \[m\].
    pub fn center_on(&mut self, point: DVec3) {
        self.camera.position = point - self.distance * self.camera.ahead();
    }
}

/// How far the wheel is turned for e times nearer, in points. Browsers tell a notch as 100 to 120
/// pixels, desktops as a line, of which the interface makes 40.
const SCROLL: f64 = if cfg!(target_arch = "wasm32") { 750.0 } else { 300.0 };

/// How many times nearer wheel and fingers bring the camera.
pub fn zoom_asked(ui: &Ui) -> f64 {
    let (scrolled, pinched) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
    f64::from(pinched) * (f64::from(scrolled) / SCROLL).exp()
}
