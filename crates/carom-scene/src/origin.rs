//! Finds which sphere, generator or emitter of a scene created a sphere of its world.

use carom::{DVec3, EmitterId, World};

use crate::scene::{Emitter, Scene};

/// What created a sphere: an index into a list of the scene. Emitters that code adds or changes get
/// new indices after those of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Origin {
    Sphere(usize),
    Generator(usize),
    Emitter(usize),
}

/// Origins of the spheres of a scene, by sphere number.
///
/// Origins of emitted spheres are known only after the emitters were followed to their time. Under
/// `discrete` and `bisect` the order of emission may depend on the frames; frames of
/// `simulation.frame_time` are assumed.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "checkpoint", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Origins {
    /// Number of single spheres.
    spheres: usize,
    /// For each generator, the number after its last sphere.
    generator_ends: Vec<u64>,
    emissions: Emissions,
}

impl Origins {
    pub fn new(scene: &Scene) -> Result<Self, carom::Error> {
        let mut end = scene.spheres.len() as u64;
        let ends = scene.generators.iter().map(|generator| {
            end = end.saturating_add(generator.count());
            end
        });
        let generator_ends = ends.collect();
        let emissions = Emissions::new(scene)?;
        Ok(Self { spheres: scene.spheres.len(), generator_ends, emissions })
    }

    /// Number of spheres at the start.
    pub fn initial(&self) -> u64 {
        self.generator_ends.last().copied().unwrap_or(self.spheres as u64)
    }

    /// Follows the emitters until a frame ends at `time` \[s\] or later.
    pub fn follow(&mut self, time: f64) {
        self.emissions.follow(time, usize::MAX);
    }

    /// Adds an emitter after the others at `time` \[s\].
    pub fn add_emitter(&mut self, emitter: &Emitter, time: f64) {
        self.emissions.go_to(time);
        self.emissions.add(emitter).ok();
    }

    /// Replaces the emitter at `place` in the order at `time` \[s\].
    pub fn set_emitter(&mut self, place: usize, emitter: &Emitter, time: f64) {
        self.emissions.go_to(time);
        self.emissions.set(place, emitter).ok();
    }

    /// Removes the emitter at `place` in the order at `time` \[s\].
    pub fn remove_emitter(&mut self, place: usize, time: f64) {
        self.emissions.go_to(time);
        self.emissions.remove(place);
    }

    /// Follows the emitters until the origin of sphere `number` is known, or a frame ends at `time`
    /// \[s\] or later. An impossible number takes no time.
    #[cfg(feature = "recording")]
    pub fn follow_to(&mut self, number: u64, time: f64) {
        let Some(place) = number.checked_sub(self.initial()) else {
            return;
        };
        let is_possible = (place as f64) < self.emissions.most_until(time);
        if let (true, Ok(place)) = (is_possible, usize::try_from(place)) {
            self.emissions.follow(time, place.saturating_add(1));
        }
    }

    /// Returns the origin of sphere `number`; `None` if it is not known.
    pub fn of(&self, number: u64) -> Option<Origin> {
        if number < self.spheres as u64 {
            return Some(Origin::Sphere(number as usize));
        }
        if number < self.initial() {
            let generator = self.generator_ends.partition_point(|end| *end <= number);
            return Some(Origin::Generator(generator));
        }
        let place = usize::try_from(number - self.initial()).ok()?;
        self.emissions.emitters.get(place).map(|emitter| Origin::Emitter(*emitter))
    }
}

/// Runs the emitters of a scene in a world without other spheres.
///
/// The time of an emission depends on no sphere, so the order is that of the scene's own world,
/// under any rule. Emitter i places its spheres at x = i, which identifies them.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "checkpoint", derive(serde::Serialize, serde::Deserialize))]
struct Emissions {
    world: World,
    /// Length of a frame \[s\].
    frame_time: f64,
    /// Number of emitters so far; a changed emitter counts as a new one.
    known: usize,
    /// Emitter of each sphere that was emitted.
    emitters: Vec<usize>,
}

impl Emissions {
    fn new(scene: &Scene) -> Result<Self, carom::Error> {
        let mut settings = scene.settings();
        settings.boundary = carom::Boundary::Open;
        (settings.shear_rate, settings.thermostat) = (0.0, None);
        settings.pair_potential = None;
        settings.spheres_collide = false;
        let (world, frame_time) = (World::new(settings)?, scene.simulation.frame_time);
        let mut emissions = Self { world, frame_time, known: 0, emitters: Vec::new() };
        scene.emitters.iter().try_for_each(|emitter| emissions.add(emitter))?;
        Ok(emissions)
    }

    fn add(&mut self, emitter: &Emitter) -> Result<(), carom::Error> {
        let emitter = self.next(emitter);
        self.world.add_emitter(emitter).map(drop)
    }

    fn set(&mut self, place: usize, emitter: &Emitter) -> Result<(), carom::Error> {
        let emitter = self.next(emitter);
        self.id(place).map_or(Ok(()), |id| self.world.set_emitter(id, emitter))
    }

    fn remove(&mut self, place: usize) {
        if let Some(id) = self.id(place) {
            self.world.remove_emitter(id).ok();
        }
    }

    fn id(&self, place: usize) -> Option<EmitterId> {
        self.world.emitters().nth(place).map(|(id, _)| id)
    }

    /// Copies an emitter with its period and count, and places its spheres at the next free x.
    fn next(&mut self, emitter: &Emitter) -> carom::Emitter {
        let sphere = carom::Sphere::new(DVec3::new(self.known as f64, 0.0, 0.0), 1.0);
        self.known += 1;
        carom::Emitter::new(sphere, emitter.period).with_count(emitter.count)
    }

    /// Upper bound of the number of spheres emitted until `time` \[s\].
    #[cfg(feature = "recording")]
    fn most_until(&self, time: f64) -> f64 {
        // One more for time 0, one for rounding.
        self.world.emitters().map(|(_, emitter)| time / emitter.period + 2.0).sum()
    }

    /// Advances until a frame ends at `time` \[s\] or later, or `count` spheres are emitted.
    fn follow(&mut self, time: f64, count: usize) {
        let has_emitters = self.world.emitters().len() > 0;
        while has_emitters && self.world.time() < time && self.emitters.len() < count {
            // The scene's own world refuses the same step, so no more spheres are emitted.
            if self.step(self.frame_time).is_err() {
                return;
            }
        }
    }

    /// Advances to `time` \[s\] in whole frames; the last frame may be shorter.
    fn go_to(&mut self, time: f64) {
        if self.world.emitters().len() == 0 {
            // An invalid time is refused; no world reaches it.
            self.world.set_time(time).ok();
        }
        while self.world.time() < time {
            let rest = time - self.world.time();
            if self.step(rest.min(self.frame_time)).is_err() {
                return;
            }
        }
    }

    fn step(&mut self, dt: f64) -> Result<(), carom::Error> {
        for id in self.world.step(dt)?.emitted.clone() {
            let sphere = self.world.remove_sphere(id)?;
            self.emitters.push(sphere.position.x as usize);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Generator, Lattice, Row, Rule, Sphere};

    fn emitter(x: f64, period: f64, mass: f64) -> Emitter {
        let sphere = Sphere { mass: Some(mass), ..Sphere::at([0.0; 3], 0.1) };
        Emitter {
            name: String::new(),
            position: [x, 0.0, 0.0],
            rotation: [0.0, 0.0, 0.0, 1.0],
            period,
            max_spheres: None,
            count: None,
            needs_room: None,
            sphere,
        }
    }

    #[test]
    fn generators_follow_single_spheres() {
        let mut scene = Scene::new("mixed");
        scene.spheres = vec![Sphere::at([0.0; 3], 0.1)];
        let sphere = || Some(Sphere::at([0.0; 3], 0.1));
        let row = |y: f64| {
            Generator::Row(Box::new(Row {
                count: 2,
                start: [0.0, y, 0.0],
                step: [1.0, 0.0, 0.0],
                sphere: sphere(),
                collider: None,
            }))
        };
        let lattice = Generator::Lattice(Box::new(Lattice {
            counts: [2, 1, 3],
            start: [0.0, 5.0, 0.0],
            spacing: [1.0; 3],
            sphere: sphere(),
            collider: None,
        }));
        scene.generators = vec![row(1.0), lattice, row(2.0)];
        let origins = Origins::new(&scene).unwrap();
        assert_eq!(origins.initial(), scene.world().unwrap().spheres().len() as u64);
        let expected = [0, 0, 1, 1, 1, 1, 1, 1, 2, 2].map(Origin::Generator);
        assert_eq!(origins.of(0), Some(Origin::Sphere(0)));
        for (number, origin) in (1..).zip(expected) {
            assert_eq!(origins.of(number), Some(origin), "{number}");
        }
        assert_eq!(origins.of(11), None);
    }

    /// Emitters that partly emit at the same times; the mass of a sphere identifies its emitter in
    /// the scene's own world.
    #[test]
    fn emission_is_followed_under_every_rule() {
        for rule in [Rule::Exact, Rule::Discrete, Rule::Bisect] {
            let mut scene = Scene::new("fountains");
            scene.simulation.rule = rule;
            scene.simulation.frame_time = 0.1;
            scene.simulation.spheres_collide = false;
            scene.simulation.allow_overlap = true;
            scene.emitters =
                vec![emitter(0.0, 0.5, 1.0), emitter(5.0, 0.03, 2.0), emitter(9.0, 0.25, 3.0)];
            scene.emitters[1].max_spheres = Some(3);
            scene.emitters[2].count = Some(2);
            let mut world = scene.world().unwrap();
            let mut origins = Origins::new(&scene).unwrap();
            for _ in 0..20 {
                world.step(0.1).unwrap();
                origins.follow(world.time());
                for (id, mass) in world.spheres().ids().iter().zip(world.spheres().masses()) {
                    let emitter = *mass as usize - 1;
                    assert_eq!(origins.of(id.number()), Some(Origin::Emitter(emitter)), "{rule:?}");
                }
                let last = world.spheres().ids().last().unwrap().number();
                assert_eq!(origins.of(last + 1), None, "followed too far");
            }
        }
    }
}
