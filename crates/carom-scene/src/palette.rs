//! Colours and finishes of spheres and colliders.

use std::collections::BTreeMap;

use carom::volume;

use crate::error::SceneError;
use crate::origin::{Origin, Origins};
use crate::scene::{Collider, Color, Colors, Emitter, Finish, Scene, Sphere};

/// Largest relative difference of a density from a listed one that counts as equal: mass / volume
/// has a few rounding errors (1e-15), listed densities differ by far more.
const SAME_DENSITY: f64 = 1e-9;

/// Colour and finish that a scene states for a sphere or a collider.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "checkpoint", derive(serde::Serialize, serde::Deserialize))]
pub struct Paint {
    /// Own colour of the body, if it has one.
    pub color: Option<Color>,
    /// How its surface reflects light.
    pub finish: Finish,
}

impl From<&Sphere> for Paint {
    fn from(sphere: &Sphere) -> Self {
        Self { color: sphere.color, finish: sphere.finish }
    }
}

impl From<Coat> for Paint {
    fn from(Coat { color, finish }: Coat) -> Self {
        Self { color: Some(color), finish }
    }
}

impl Sphere {
    /// Returns the sphere with another colour and finish.
    pub fn painted(self, Paint { color, finish }: Paint) -> Self {
        Self { color, finish, ..self }
    }
}

impl From<&Collider> for Paint {
    fn from(collider: &Collider) -> Self {
        Self { color: collider.color, finish: collider.finish }
    }
}

/// Colour and finish in which a sphere or a collider is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coat {
    /// sRGB, each part in \[0, 1\].
    pub color: Color,
    /// How the surface reflects light.
    pub finish: Finish,
}

impl From<Color> for Coat {
    /// Creates a coat with the default finish.
    fn from(color: Color) -> Self {
        Self { color, finish: Finish::default() }
    }
}

/// Colours and finishes of the bodies of a scene, and of its world after changes in code.
///
/// ```
/// use carom_scene::{Library, Palette};
///
/// let (scene, _) = Library::new().find("tutorial1", &[])?;
/// let world = scene.world()?;
/// let palette = Palette::new(&scene)?;
/// let spheres = world.spheres();
/// let coat = palette.sphere(spheres.ids()[0].number(), spheres.radii()[0], spheres.masses()[0]);
/// assert!(coat.color.iter().all(|part| (0.0..=1.0).contains(part)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[cfg_attr(feature = "checkpoint", derive(serde::Serialize, serde::Deserialize))]
pub struct Palette {
    origins: Origins,
    /// Numbers of spheres that were added in code, ascending; `origins` does not count them.
    added: Vec<u64>,
    /// Paint that code gave to single spheres; it replaces their own.
    painted: BTreeMap<u64, Paint>,
    /// Paint of each single sphere of the scene.
    spheres: Vec<Paint>,
    generators: Vec<Paint>,
    /// Paint of each emitter, in the order of the emitters of `origins`.
    emitters: Vec<Paint>,
    colliders: Vec<Paint>,
    /// Default colours of the scene.
    #[cfg_attr(feature = "checkpoint", serde(skip))]
    colors: Colors,
}

impl Palette {
    /// A blue, for spheres of scenes without colours.
    pub const SPHERE: Color = [0.20, 0.45, 0.80];

    /// A warm, light grey, for colliders of scenes without colours.
    pub const COLLIDER: Color = [0.86, 0.85, 0.82];

    /// Creates the palette of a scene at its start.
    ///
    /// # Errors
    /// [`SceneError`] for settings or emitters that are invalid, as in [`Scene::world`].
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        let origins = origins(scene)?;
        let generated = |sphere: Option<&Sphere>| sphere.map(Paint::from).unwrap_or_default();
        Ok(Self {
            origins,
            added: Vec::new(),
            painted: BTreeMap::new(),
            spheres: scene.spheres.iter().map(Paint::from).collect(),
            generators: scene.generators.iter().map(|it| generated(it.sphere())).collect(),
            emitters: scene.emitters.iter().map(|emitter| (&emitter.sphere).into()).collect(),
            colliders: scene.all_colliders().iter().map(Paint::from).collect(),
            colors: scene.colors.clone().unwrap_or_default(),
        })
    }

    /// Returns the palette with the default colours of `scene`.
    #[cfg(feature = "checkpoint")]
    pub(crate) fn in_colors_of(self, scene: &Scene) -> Self {
        Self { colors: scene.colors.clone().unwrap_or_default(), ..self }
    }

    /// Follows the emitters until `time` \[s\], so that the origin of each emitted sphere is known.
    /// Call it with the world's time before the spheres are drawn.
    ///
    /// The frames of the scene are assumed. If the world is stepped by other frames under
    /// `discrete` or `bisect`, spheres may get the colour of another emitter.
    pub fn follow(&mut self, time: f64) {
        if !self.emitters_agree() {
            self.origins.follow(time);
        }
    }

    /// Records that a sphere was added in code. Its number must be the largest so far.
    pub fn add_sphere(&mut self, number: u64, paint: Paint) {
        self.added.push(number);
        if paint != Paint::default() {
            self.paint(number, paint);
        }
    }

    /// Sets the colour and finish of one sphere.
    pub fn paint(&mut self, number: u64, paint: Paint) {
        self.painted.insert(number, paint);
    }

    /// Replaces the paint of all colliders.
    pub fn set_colliders(&mut self, colliders: &[Collider]) {
        self.colliders = colliders.iter().map(Paint::from).collect();
    }

    /// Records that an emitter was added after the others, at `time` \[s\].
    pub fn add_emitter(&mut self, emitter: &Emitter, time: f64) {
        self.origins.add_emitter(emitter, time);
        self.emitters.push((&emitter.sphere).into());
    }

    /// Records that the emitter at `place` in the order was changed at `time` \[s\]. Spheres that
    /// it emitted before keep their colours.
    pub fn set_emitter(&mut self, place: usize, emitter: &Emitter, time: f64) {
        self.origins.set_emitter(place, emitter, time);
        self.emitters.push((&emitter.sphere).into());
    }

    /// Records that the emitter at `place` in the order was removed at `time` \[s\].
    pub fn remove_emitter(&mut self, place: usize, time: f64) {
        self.origins.remove_emitter(place, time);
    }

    /// Returns colour and finish of a sphere of this number, radius \[m\] and mass \[kg\]. The
    /// colour is its own (or that of its generator or emitter), else that of its density, else the
    /// default of the scene, else [`Self::SPHERE`].
    pub fn sphere(&self, number: u64, radius: f64, mass: f64) -> Coat {
        let Paint { color, finish } = self.own(number);
        let colors = &self.colors;
        let color = color
            .or_else(|| density_color(colors, mass / volume(radius)))
            .or(colors.spheres)
            .unwrap_or(Self::SPHERE);
        Coat { color, finish }
    }

    /// Returns colour and finish of the collider at `index`. The colour is its own, else the
    /// default of the scene, else [`Self::COLLIDER`].
    pub fn collider(&self, index: usize) -> Coat {
        let Paint { color, finish } = self.colliders.get(index).copied().unwrap_or_default();
        Coat { color: color.or(self.colors.colliders).unwrap_or(Self::COLLIDER), finish }
    }

    /// Returns the paint of a sphere: its own, or that of its generator or emitter.
    pub fn own(&self, number: u64) -> Paint {
        if let Some(&painted) = self.painted.get(&number) {
            return painted;
        }
        let added_before = match self.added.binary_search(&number) {
            Ok(_) => return Paint::default(),
            Err(place) => place as u64,
        };
        match self.origins.of(number - added_before) {
            Some(Origin::Sphere(index)) => self.spheres[index],
            Some(Origin::Generator(index)) => self.generators[index],
            Some(Origin::Emitter(index)) => self.emitters[index],
            None if self.emitters_agree() => self.emitters.first().copied().unwrap_or_default(),
            None => Paint::default(),
        }
    }

    /// Whether all emitters have the same paint, so that the origin of an emitted sphere does not
    /// matter.
    fn emitters_agree(&self) -> bool {
        self.emitters.windows(2).all(|pair| pair[0] == pair[1])
    }
}

/// Creates the origins of a scene's spheres.
pub(crate) fn origins(scene: &Scene) -> Result<Origins, SceneError> {
    Origins::new(scene).map_err(|error| {
        // The world of the scene is refused for the same reason, and its error names the field.
        let text = error.to_string();
        let own = scene.world().err();
        own.unwrap_or_else(|| crate::error::Problem::new("", text).in_code(&scene.name).into())
    })
}

fn density_color(colors: &Colors, density: f64) -> Option<Color> {
    let is_same = |listed: f64| (density - listed).abs() <= SAME_DENSITY * listed;
    colors.densities.iter().find(|listed| is_same(listed.density)).map(|listed| listed.color)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Collider, DensityColor, Emitter, Generator, Row, Shape};

    const RED: Color = [1.0, 0.0, 0.0];
    const GREEN: Color = [0.0, 1.0, 0.0];
    const WHITE: Color = [1.0, 1.0, 1.0];

    fn sphere(color: Option<Color>) -> Sphere {
        Sphere { color, ..Sphere::at([0.0; 3], 0.1) }
    }

    fn emitter(period: f64, color: Option<Color>) -> Emitter {
        Emitter {
            name: String::new(),
            position: [0.0; 3],
            rotation: [0.0, 0.0, 0.0, 1.0],
            period,
            max_spheres: None,
            count: None,
            needs_room: None,
            sphere: sphere(color),
        }
    }

    #[test]
    fn a_colour_of_its_own_comes_before_density_before_the_scenes() {
        let mut scene = Scene::new("colours");
        scene.spheres = vec![sphere(Some(RED)), sphere(None)];
        let row = Generator::Row(Box::new(Row {
            count: 2,
            start: [1.0; 3],
            step: [1.0; 3],
            sphere: Some(sphere(Some(GREEN))),
            collider: None,
        }));
        scene.generators = vec![row];
        let densities = vec![DensityColor { density: 700.0, color: WHITE }];
        scene.colors = Some(Colors { densities, spheres: Some([0.5; 3]), ..Colors::default() });
        let palette = Palette::new(&scene).unwrap();
        let radius = 0.37;
        let mass = 700.0 * volume(radius);
        assert_eq!(palette.sphere(0, radius, mass).color, RED);
        assert_eq!(palette.sphere(1, radius, mass).color, WHITE);
        assert_eq!(palette.sphere(1, radius, 1.001 * mass).color, [0.5; 3]);
        assert_eq!([2, 3].map(|number| palette.sphere(number, radius, mass).color), [GREEN; 2]);
        assert_eq!(palette.sphere(4, radius, mass).color, WHITE, "of unknown origin");
        let plain = Palette::new(&Scene::new("plain")).unwrap();
        assert_eq!(plain.sphere(0, radius, mass), Palette::SPHERE.into());
        assert_eq!(plain.collider(0), Palette::COLLIDER.into());
    }

    #[test]
    fn every_listed_density_is_found_again_in_a_world() {
        for name in ["tutorial1", "tutorial2", "tutorial3", "tutorial4"] {
            let (scene, _) = crate::Library::new().find(name, &[]).unwrap();
            let palette = Palette::new(&scene).unwrap();
            let listed = scene.colors.as_ref().unwrap().densities.iter();
            let listed: Vec<Color> = listed.map(|density| density.color).collect();
            let world = scene.world().unwrap();
            let spheres = world.spheres();
            for (i, id) in spheres.ids().iter().enumerate() {
                let coat = palette.sphere(id.number(), spheres.radii()[i], spheres.masses()[i]);
                assert!(listed.contains(&coat.color), "{name}");
            }
        }
    }

    #[test]
    fn spheres_of_emitters_are_told_apart_though_they_are_alike() {
        let mut scene = Scene::new("fountains");
        scene.simulation.frame_time = 0.1;
        scene.simulation.spheres_collide = false;
        scene.spheres = vec![sphere(None)];
        scene.emitters = vec![emitter(0.25, Some(RED)), emitter(0.5, Some(GREEN))];
        let mut palette = Palette::new(&scene).unwrap();
        palette.follow(0.6);
        // Both emit at 0, the first at 0.25, both at 0.5.
        let colors = [1, 2, 3, 4, 5].map(|number| palette.sphere(number, 0.1, 1.0).color);
        assert_eq!(colors, [RED, GREEN, RED, RED, GREEN]);
    }

    #[test]
    fn emitters_of_one_colour_need_not_be_followed() {
        let mut scene = Scene::new("fountain");
        scene.emitters = vec![emitter(0.25, Some(RED))];
        assert_eq!(Palette::new(&scene).unwrap().sphere(1_000_000, 0.1, 1.0).color, RED);
    }

    #[test]
    fn a_sphere_added_in_code_has_its_colour_and_leaves_others_theirs() {
        let mut scene = Scene::new("fountains");
        scene.simulation.frame_time = 0.1;
        scene.simulation.spheres_collide = false;
        scene.spheres = vec![sphere(Some(WHITE))];
        scene.emitters = vec![emitter(0.25, Some(RED)), emitter(0.5, Some(GREEN))];
        let mut palette = Palette::new(&scene).unwrap();
        // Added before the first emission, and after the first two.
        let painted = |color| Paint { color: Some(color), finish: Finish::Glass };
        palette.add_sphere(1, painted(WHITE));
        palette.add_sphere(4, Paint::default());
        palette.follow(0.6);
        let own = [0, 1, 2, 3, 4, 5].map(|number| palette.own(number).color);
        assert_eq!(own, [Some(WHITE), Some(WHITE), Some(RED), Some(GREEN), None, Some(RED)]);
        assert_eq!(
            [0, 1, 4].map(|number| palette.own(number).finish),
            [Finish::Satin, Finish::Glass, Finish::Satin]
        );
        palette.paint(0, Paint::default());
        assert_eq!(palette.sphere(0, 0.1, 1.0), Palette::SPHERE.into());
    }

    #[test]
    fn when_emitters_change_spheres_have_the_colour_of_the_one_that_emitted_them() {
        let mut scene = Scene::new("fountains");
        scene.simulation.spheres_collide = false;
        scene.simulation.allow_overlap = true;
        scene.emitters = vec![emitter(0.25, Some(RED))];
        let mut world = scene.world().unwrap();
        let mut palette = Palette::new(&scene).unwrap();
        // Red emits at 0 and 0.25, green at 0.4, white in the place of red at 0.5 and 0.75, green
        // at 0.8, white alone at 1 and 1.25.
        let mut other = Scene::new("others");
        other.emitters = vec![emitter(0.4, Some(GREEN)), emitter(0.25, Some(WHITE))];
        let made = other.world().unwrap();
        let made: Vec<_> = made.emitters().map(|(_, emitter)| *emitter).collect();
        let red = world.emitters().next().unwrap().0;
        // Frames of another length than the scene's.
        world.step(0.4).unwrap();
        let green = world.add_emitter(made[0]).unwrap();
        palette.add_emitter(&other.emitters[0], world.time());
        world.step(0.07).unwrap();
        world.set_emitter(red, made[1]).unwrap();
        palette.set_emitter(0, &other.emitters[1], world.time());
        world.step(0.4).unwrap();
        world.remove_emitter(green).unwrap();
        palette.remove_emitter(1, world.time());
        world.step(0.4).unwrap();
        palette.follow(world.time());
        let own: Vec<_> =
            world.spheres().ids().iter().map(|id| palette.own(id.number()).color).collect();
        let expected = [RED, RED, GREEN, WHITE, WHITE, GREEN, WHITE, WHITE];
        assert_eq!(own, expected.map(Some));
    }

    #[test]
    fn a_collider_has_its_own_colour_before_the_scenes() {
        let mut scene = Scene::new("colliders");
        let collider = |color| Collider { color, ..Collider::new(Shape::HalfSpace) };
        scene.colliders = vec![collider(Some(RED)), collider(None)];
        scene.colors = Some(Colors { colliders: Some(GREEN), ..Colors::default() });
        let palette = Palette::new(&scene).unwrap();
        assert_eq!([0, 1].map(|index| palette.collider(index).color), [RED, GREEN]);
    }

    #[test]
    fn a_scene_that_makes_no_sense_is_refused_by_the_name_of_its_field() {
        let mut scene = Scene::new("broken");
        scene.emitters = vec![emitter(-1.0, None)];
        let error = Palette::new(&scene).unwrap_err().to_string();
        assert!(error.contains("emitters[0]"), "{error}");
    }
}
