//! What is drawn: spheres, surfaces and arrows, and the light on them.

use carom::{DQuat, DVec3, Pose, Shape};
use carom_scene::Coat;
use carom_scene::scene::{Color, Finish, Sun};

use crate::bounds::Bounds;
use crate::framing::Framing;

/// How much triggers hide of what is behind them: they let spheres through.
const TRIGGER_OPACITY: f64 = 0.45;

/// How much a surface of glass does.
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
    /// What lights them, and what is behind them.
    pub light: Light,
    /// Where surfaces without end are cut off, and where balls have to be seen: by what is drawn
    /// ([`Framing::of_drawing`]), unless given.
    pub framing: Option<Framing>,
    /// Whether there is a grid below it all where no floor goes on to the horizon.
    pub has_grid: bool,
}

/// What is painted on a ball.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pattern {
    /// Nothing.
    #[default]
    Plain,
    /// With white bands and caps that show how it is turned, for a ball that stands out.
    Striped,
    /// With a band in another tone of its colour that shows how it is turned, for many balls.
    Banded,
    /// Fine rings: it never gives way.
    Fixed,
    /// Its own colour, whatever the light: for marks.
    Glowing,
}

/// A sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// \[m\]
    pub center: DVec3,
    /// \[m\]
    pub radius: f64,
    /// sRGB.
    pub color: Color,
    /// From its own frame to the world; only a pattern shows it.
    pub rotation: DQuat,
    /// What is painted on it.
    pub pattern: Pattern,
    /// How its surface takes light.
    pub finish: Finish,
}

impl Ball {
    /// A sphere at this place \[m\] with this radius \[m\] and coat: banded where it has an
    /// orientation, else plain.
    pub fn of_sphere(
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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Panel {
    /// A rectangle, box, container or half-space.
    pub shape: Shape,
    /// Where it is.
    pub pose: Pose,
    /// sRGB.
    pub color: Color,
    /// How its surface takes light.
    pub finish: Finish,
    /// From 0, nothing to be seen, to 1.
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
    /// In pixels.
    pub width: f64,
    /// Whether it ends in a head.
    pub head: bool,
    /// Whether balls and surfaces before it leave it in sight.
    pub in_front: bool,
}

/// Sun, sky, and what the ground sends back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Unit vector to the sun.
    pub to_sun: DVec3,
    /// Of the sun, linear.
    pub sun: [f32; 3],
    /// Of the sky straight above, linear.
    pub zenith: [f32; 3],
    /// Of the sky at the horizon, linear.
    pub horizon: [f32; 3],
    /// Of all that lies below the horizon, linear.
    pub ground: [f32; 3],
}

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
    /// The light of a scene: its sun, and a sky of its background colour.
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

    /// The same light under a dark sky, for dark surroundings.
    pub fn at_dusk(self) -> Self {
        Self {
            zenith: linear([0.26, 0.29, 0.36]),
            horizon: linear([0.36, 0.39, 0.45]),
            ground: linear([0.27, 0.28, 0.31]),
            ..self
        }
    }
}

/// Linear from sRGB (IEC 61966-2-1).
pub(crate) fn linear(color: Color) -> [f32; 3] {
    color.map(|part| {
        let part = part.clamp(0.0, 1.0);
        let linear =
            if part <= 0.040_45 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) };
        linear as f32
    })
}

impl Panel {
    /// The way its front faces, unit vector.
    pub(crate) fn normal(&self) -> DVec3 {
        self.pose.rotation.normalize() * DVec3::Y
    }

    /// How far a point is in front of its plane \[m\].
    pub(crate) fn height_of(&self, point: DVec3) -> f64 {
        self.normal().dot(point - self.pose.position)
    }

    /// The box around it; `None` for a half-space, which has none.
    pub fn bounds(&self) -> Option<Bounds> {
        Bounds::of_shape(self.shape, self.pose)
    }
}

impl Drawing {
    /// The box around everything that ends somewhere; `None` if nothing does.
    pub fn bounds(&self) -> Option<Bounds> {
        let balls = self.balls.iter().map(|ball| Bounds::of_sphere(ball.center, ball.radius));
        Bounds::around(balls.chain(self.panels.iter().filter_map(Panel::bounds)))
    }

    /// Takes out all there is; light and framing stay.
    pub fn clear(&mut self) {
        self.balls.clear();
        self.panels.clear();
        self.arrows.clear();
    }

    /// Adds a collider: a ball or a panel. Triggers do not look as if they were solid.
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
