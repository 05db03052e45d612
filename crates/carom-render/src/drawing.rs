//! What is drawn: spheres, surfaces and arrows, and the light on them.

use carom::{DQuat, DVec3, Pose, Shape};
use carom_scene::Coat;
use carom_scene::scene::{Color, Finish, Sun};

use crate::bounds::Bounds;
use crate::framing::Framing;

/// Opacity of triggers: spheres pass through them, so they look transparent.
const TRIGGER_OPACITY: f64 = 0.45;

/// Opacity of glass surfaces.
const GLASS_OPACITY: f64 = 0.25;

/// Everything in a picture.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// Spheres.
    pub balls: Vec<Ball>,
    /// Rectangles, boxes, containers and half-spaces.
    pub panels: Vec<Panel>,
    /// Arrows and lines.
    pub arrows: Vec<Arrow>,
    /// The light, and the sky behind everything.
    pub light: Light,
    /// Where surfaces without end are cut off, and where balls must be visible. `None`: computed
    /// from the drawing ([`Framing::of_drawing`]).
    pub framing: Option<Framing>,
    /// Whether a grid is drawn below the scene where no floor reaches the horizon.
    pub has_grid: bool,
    /// Whether surfaces in front of many balls are drawn in full, too, instead of as glass.
    pub keeps_whole: bool,
}

/// A pattern painted on a ball.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pattern {
    /// Nothing.
    #[default]
    Plain,
    /// White bands and caps that show the rotation of a ball that stands out.
    Striped,
    /// A band in another tone of the ball's colour that shows rotation, for many balls.
    Banded,
    /// Fine rings: the ball is fixed.
    Fixed,
    /// The ball's own colour whatever the light, for marks.
    Glowing,
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Centre \[m\].
    pub center: DVec3,
    /// Radius \[m\].
    pub radius: f64,
    /// sRGB.
    pub color: Color,
    /// Rotation from the ball's own frame to the world; visible only with a pattern.
    pub rotation: DQuat,
    /// The pattern painted on the ball.
    pub pattern: Pattern,
    /// How the surface reflects light.
    pub finish: Finish,
}

impl Ball {
    /// Returns a sphere at `center` \[m\] with this radius \[m\] and coat: banded if it has an
    /// orientation, else plain.
    pub fn from_sphere(
        center: DVec3,
        radius: f64,
        coat: impl Into<Coat>,
        orientation: Option<DQuat>,
    ) -> Self {
        let pattern = if orientation.is_some() { Pattern::Banded } else { Pattern::Plain };
        let Coat { color, finish } = coat.into();
        Self { center, radius, color, rotation: orientation.unwrap_or_default(), pattern, finish }
    }
}

/// A surface of a collider.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Any but a sphere.
    pub shape: Shape,
    /// Position and rotation.
    pub pose: Pose,
    /// sRGB.
    pub color: Color,
    /// How the surface reflects light.
    pub finish: Finish,
    /// Opacity from 0, invisible, to 1, opaque.
    pub opacity: f64,
}

/// A line or arrow of constant width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrow {
    /// \[m\]
    pub start: DVec3,
    /// \[m\]
    pub end: DVec3,
    /// sRGB.
    pub color: Color,
    /// Width in pixels.
    pub width: f64,
    /// Whether the line ends in an arrow head.
    pub head: bool,
    /// Whether it is drawn in front of balls and surfaces that would hide it.
    pub in_front: bool,
}

/// Light of the sun and the sky, and light reflected by the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Unit vector towards the sun.
    pub to_sun: DVec3,
    /// Light of the sun, linear.
    pub sun: [f32; 3],
    /// Light of the sky straight above, linear.
    pub zenith: [f32; 3],
    /// Light of the sky at the horizon, linear.
    pub horizon: [f32; 3],
    /// Light from below the horizon, linear.
    pub ground: [f32; 3],
}

/// Least mean light from above on surfaces, linear: under a darker sky, white light from all sides
/// adds what is missing, so that the shaded half of a ball stays visible.
const LEAST_AMBIENT: f32 = 0.35;

impl Default for Light {
    /// A clear morning.
    fn default() -> Self {
        Self {
            to_sun: DVec3::new(0.35, 0.8, 0.48).normalize(),
            sun: linear([1.0, 0.957, 0.839]),
            zenith: linear([0.60, 0.75, 0.92]),
            horizon: linear([0.93, 0.955, 0.975]),
            ground: linear([0.80, 0.83, 0.86]),
        }
    }
}

impl Light {
    /// Returns the light of a scene: its sun, and a sky in its background colour.
    pub fn of_scene(scene: &carom_scene::Scene) -> Self {
        let mut light = Self::default();
        if let Some(Sun { rotation, color, intensity }) = &scene.sun {
            // Light travels along the sun's local -z.
            light.to_sun = DQuat::from_array(*rotation).normalize() * DVec3::Z;
            light.sun = linear(*color).map(|part| part * *intensity as f32);
        }
        if let Some(background) = scene.colors.as_ref().and_then(|colors| colors.background) {
            light.horizon = linear(background);
            light.zenith = linear(background.map(|part| part * 0.88));
            light.ground = linear(background.map(|part| part * 0.92));
        }
        light
    }

    /// Returns the same light under a dark sky, for dark surroundings. A sky that is darker already
    /// stays as it is.
    pub fn at_dusk(self) -> Self {
        let darker = |day: [f32; 3], dusk: Color| {
            let dusk = linear(dusk);
            if luminance(day) < luminance(dusk) { day } else { dusk }
        };
        Self {
            zenith: darker(self.zenith, [0.26, 0.29, 0.36]),
            horizon: darker(self.horizon, [0.36, 0.39, 0.45]),
            ground: darker(self.ground, [0.27, 0.28, 0.31]),
            ..self
        }
    }

    /// Returns the white light from all sides that surfaces get besides that of the sky, linear.
    pub(crate) fn fill(&self) -> f32 {
        let sky = 0.5 * (luminance(self.zenith) + luminance(self.horizon));
        (LEAST_AMBIENT - sky).max(0.0)
    }
}

/// Returns the relative luminance of a linear colour (ITU-R BT.709-6, item 3.2).
pub(crate) fn luminance([red, green, blue]: [f32; 3]) -> f32 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// Converts sRGB to linear colour (IEC 61966-2-1).
pub(crate) fn linear(color: Color) -> [f32; 3] {
    color.map(|part| {
        let part = part.clamp(0.0, 1.0);
        let linear =
            if part <= 0.040_45 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) };
        linear as f32
    })
}

impl Panel {
    /// Returns the normal of the front, a unit vector.
    pub(crate) fn normal(&self) -> DVec3 {
        self.pose.rotation.normalize() * DVec3::Y
    }

    /// Returns the distance of a point in front of the panel's plane \[m\]; negative behind it.
    pub(crate) fn height_of(&self, point: DVec3) -> f64 {
        self.normal().dot(point - self.pose.position)
    }

    /// Returns the box around the panel; `None` for a half-space.
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of_shape(self.shape.clone(), self.pose)
    }
}

impl Drawing {
    /// Returns the box around all balls and finite panels; `None` if there are none.
    pub fn bounds(&self) -> Option<Bounds> {
        let balls = self.balls.iter().map(|ball| Bounds::from_sphere(ball.center, ball.radius));
        Bounds::around(balls.chain(self.panels.iter().filter_map(Panel::bounds)))
    }

    /// Removes balls, panels and arrows; light and framing stay.
    pub fn clear(&mut self) {
        self.balls.clear();
        self.panels.clear();
        self.arrows.clear();
    }

    /// Adds a collider as a ball or a panel. Triggers are translucent.
    pub fn add_collider(&mut self, shape: Shape, pose: Pose, coat: impl Into<Coat>, trigger: bool) {
        let Coat { color, finish } = coat.into();
        match shape {
            Shape::Sphere { radius } => self.balls.push(Ball {
                center: pose.position,
                radius,
                color,
                rotation: pose.rotation.normalize(),
                pattern: if trigger { Pattern::Plain } else { Pattern::Fixed },
                finish,
            }),
            _ => {
                let (finish, opacity) = match finish {
                    _ if trigger => (Finish::default(), TRIGGER_OPACITY),
                    Finish::Glass => (finish, GLASS_OPACITY),
                    _ => (finish, 1.0),
                };
                self.panels.push(Panel { shape, pose, color, finish, opacity });
            }
        }
    }
}
