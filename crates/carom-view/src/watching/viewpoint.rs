//! The camera of a watched scene.

use std::sync::Arc;

use carom::DVec3;
use carom_render::{Bounds, Camera, Drawing, Framing, Panel, Pattern};
use carom_scene::Scene;
use carom_session::{LinkCamera, View};

use crate::look::{self, DrawOptions, Marks};
use crate::orbit::{Orbit, Preset};

/// The camera of a scene, and what moves it.
#[derive(Debug, Default)]
pub(super) struct Viewpoint {
    /// `None` until there is a picture to fit the scene into.
    orbit: Option<Orbit>,
    /// Ratio of width to height of that picture.
    aspect: f64,
    /// The preset in use until the user moves the camera; it adapts to the shape of the picture.
    preset: Option<Preset>,
    /// Whether the camera keeps the scene in the picture.
    fits: bool,
    /// Position of the followed ball in the last picture \[m\].
    followed: Option<DVec3>,
    /// A scene, and the space swept in its first seconds.
    framed: Option<(Arc<Scene>, Option<Framing>)>,
}

/// Time in which the distance of a fitting camera from its goal falls by a factor e \[s\].
const FITTING_TIME: f64 = 0.25;

/// Size of the space that a scene sweeps at first, relative to which balls that are spread farther
/// have left: in a picture of all, each would be a speck.
const SPREAD: f64 = 6.0;

/// Returns the bounds that the camera keeps in the picture: those of the surfaces and the crowd of
/// balls. Once balls are spread far beyond `first`, which the first seconds sweep, those are the
/// surfaces, where there are any.
fn fitted_bounds(first: Option<Framing>, now: &Drawing) -> Bounds {
    let all = Framing::of_drawing(now).unwrap_or(Framing::UNIT).whole;
    let surfaces = Bounds::around(now.panels.iter().filter_map(Panel::bounds));
    let fixed = now.balls.iter().filter(|ball| ball.pattern == Pattern::Fixed);
    let fixed = Bounds::around(fixed.map(|ball| Bounds::from_sphere(ball.center, ball.radius)));
    let surfaces = Bounds::around([surfaces, fixed].into_iter().flatten());
    let is_spread = first.is_some_and(|it| all.radius() > SPREAD * it.whole.radius());
    surfaces.filter(|_| is_spread).unwrap_or(all)
}

impl Viewpoint {
    /// Returns the scene's own camera.
    pub fn new() -> Self {
        Self { preset: Some(Preset::Scene), ..Self::default() }
    }

    /// Returns the camera of a link.
    pub fn at(place: LinkCamera) -> Self {
        Self { orbit: Some(Orbit::of_link(place)), ..Self::default() }
    }

    /// Returns the camera for a link; `None` for the scene's own.
    pub fn for_link(&self) -> Option<LinkCamera> {
        let is_own = self.preset == Some(Preset::Scene);
        self.orbit.filter(|_| !is_own).map(|orbit| orbit.for_link())
    }

    /// Returns the camera of the last picture.
    pub fn orbit(&self) -> Option<Orbit> {
        self.orbit
    }

    /// Returns whether the camera keeps the scene in the picture.
    pub fn fits(&self) -> bool {
        self.fits
    }

    /// Returns whether the camera follows a ball.
    pub fn follows(&self) -> bool {
        self.followed.is_some()
    }

    /// Moves the camera to a preset.
    pub fn look_from(&mut self, preset: Preset) {
        *self = Self { preset: Some(preset), framed: self.framed.take(), ..Self::default() };
    }

    /// Starts or stops keeping the scene in the picture.
    pub fn toggle_fit(&mut self) {
        self.fits ^= true;
        self.preset = None;
        self.followed = None;
    }

    /// Starts to follow a ball at this position \[m\], or stops following.
    pub fn toggle_follow(&mut self, place: Option<DVec3>) {
        self.followed = if self.follows() { None } else { place };
        self.fits &= !self.follows();
        self.preset = if self.follows() { None } else { self.preset };
    }

    /// Stops following.
    pub fn unfollow(&mut self) {
        self.followed = None;
    }

    /// Takes a camera that the user has moved. Fitting continues if it was only turned.
    pub fn take(&mut self, orbit: Orbit) {
        let Some(before) = self.orbit.replace(orbit) else { return };
        if before != orbit {
            let moved = orbit.target().distance(before.target());
            let turned_only = moved < 1e-6 * before.distance && orbit.distance == before.distance;
            self.fits &= turned_only;
            self.preset = None;
        }
    }

    /// Returns the space swept in the first seconds of a scene.
    pub fn framing(&mut self, scene: &Arc<Scene>) -> Option<Framing> {
        if !self.framed.as_ref().is_some_and(|(framed, _)| Arc::ptr_eq(framed, scene)) {
            self.framed = Some((scene.clone(), Framing::of_scene(scene)));
            if self.preset.is_some() {
                self.orbit = None;
            }
        }
        self.framed.as_ref().and_then(|it| it.1)
    }

    /// Returns the camera for the next picture with this ratio of width to height, `seconds` after
    /// the last one. `followed` is the present position of the followed ball \[m\].
    pub fn next(
        &mut self,
        view: &View,
        blend: f64,
        followed: Option<DVec3>,
        (aspect, seconds): (f64, f64),
    ) -> Orbit {
        let first = self.framing(&view.scene);
        let now = || {
            let mut drawing = Drawing::default();
            look::draw(
                view,
                &DrawOptions { marks: Marks::default(), dark: false, blend, picked: None },
                &mut drawing,
            );
            drawing
        };
        let of_scene = || Camera::of_scene(&view.scene);
        let has_changed = self.preset.is_some() && self.aspect != aspect;
        let mut orbit = self.orbit.filter(|_| !has_changed).unwrap_or_else(|| {
            let bounds = Framing::of_run(first, &now()).whole;
            Orbit::preset(self.preset.unwrap_or(Preset::Scene), of_scene(), &bounds, aspect)
        });
        if self.fits {
            let bounds = fitted_bounds(first, &now());
            orbit.approach(&bounds, aspect, 1.0 - (-seconds / FITTING_TIME).exp());
        }
        if let (Some(before), Some(now)) = (self.followed, followed) {
            orbit.follow(now - before);
            self.followed = Some(now);
        }
        self.aspect = aspect;
        *self.orbit.insert(orbit)
    }
}
