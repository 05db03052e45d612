//! Colours and finishes of single spheres, which a world does not store.

use std::sync::Arc;

use carom::{EmitterId, Rule, Sphere, SphereId, StepReport, World};
use carom_scene::Paint;
use carom_scene::scene::{self, Color, Generator, Scene};

use crate::setup::Setup;

/// Largest relative difference of equal densities: a mass was computed from density and volume and
/// back, with three rounding errors each way.
const SAME_DENSITY: f64 = 1e-12;

/// Tolerance of the frame rules for emissions at the start of a frame \[s\]
/// (`docs/physics/motion.md`, "Emission").
const DUE_TOLERANCE: f64 = 1e-9;

/// Paint of single spheres.
///
/// A sphere gets its paint when it is added: its own, or the colour of its density. Later changes
/// of its mass do not change the paint. The schedules of emitters are followed, because a world
/// does not report which emitter created a sphere.
#[derive(Debug, Clone, Default)]
pub(crate) struct Looks {
    /// Paints, ascending by id. Those of removed spheres are dropped from time to time.
    paints: Arc<Vec<(SphereId, Paint)>>,
    schedules: Vec<Schedule>,
}

/// Progress of an emitter: it emits sphere number k at `start + k period`.
#[derive(Debug, Clone, Copy)]
struct Schedule {
    id: EmitterId,
    /// Time at which the emitter started \[s\].
    start: f64,
    emitted: u64,
}

impl Schedule {
    /// Time of the next emission \[s\], computed with exactly the operations of the physics.
    fn due(&self, setup: &Setup) -> f64 {
        let emitter = setup.emitters.iter().find(|(id, _)| *id == self.id);
        let period = emitter.map_or(f64::INFINITY, |(_, emitter)| emitter.period);
        self.start + self.emitted as f64 * period
    }
}

impl Looks {
    /// Paints at the start of a scene and its world.
    pub fn new(scene: &Scene, world: &World) -> Self {
        let single = scene.spheres.iter().map(|sphere| (sphere, 1));
        let all = single.chain(scene.generators.iter().filter_map(generated));
        let paints = all.flat_map(|(sphere, count)| {
            std::iter::repeat_n(paint_of_template(scene, sphere), count)
        });
        let ids = world.spheres().ids().iter().copied();
        let own = ids.zip(paints).filter(|(_, paint)| *paint != Paint::default());
        let schedules = world.emitters().map(|(id, _)| Schedule { id, start: 0.0, emitted: 0 });
        Self { paints: Arc::new(own.collect()), schedules: schedules.collect() }
    }

    /// Paints of single spheres, ascending by id.
    pub fn paints(&self) -> &[(SphereId, Paint)] {
        &self.paints
    }

    /// Sets the paint of the sphere that was added last.
    pub fn paint(&mut self, id: SphereId, paint: Paint) {
        if paint != Paint::default() {
            Arc::make_mut(&mut self.paints).push((id, paint));
        }
    }

    /// Restarts the schedule of an emitter at `time` \[s\].
    pub fn restart_emitter(&mut self, id: EmitterId, time: f64) {
        for schedule in self.schedules.iter_mut().filter(|schedule| schedule.id == id) {
            (schedule.start, schedule.emitted) = (time, 0);
        }
    }

    /// Records the emissions of a frame that started at `start` \[s\].
    pub fn note(
        &mut self,
        report: &StepReport,
        start: f64,
        scene: &Scene,
        world: (&World, &Setup),
    ) {
        let (world, setup) = world;
        // Spheres that were left out also count as emissions.
        let mut due: Vec<_> = report.emitted.iter().chain(&report.left_out).copied().collect();
        if due.is_empty() {
            return;
        }
        due.sort_unstable();
        let is_exact = matches!(world.settings().rule, Rule::Exact(_));
        let sources = self.sources(due.len(), start, is_exact, setup);
        let template = |id| setup.emitters.iter().find(|it| it.0 == id).map(|it| &it.1.sphere);
        let came = due.into_iter().zip(sources);
        for (sphere, emitter) in came.filter(|(id, _)| report.emitted.binary_search(id).is_ok()) {
            let template = template(emitter);
            let paint = template.map(|it| paint_of_template(scene, it));
            self.paint(sphere, paint.unwrap_or_default());
        }
        self.forget_the_gone(world);
    }

    /// Returns the emitters of `count` spheres that were emitted in a frame, in order: at the start
    /// of the frame by emitter, afterwards by time.
    fn sources(&mut self, count: usize, start: f64, exact: bool, setup: &Setup) -> Vec<EmitterId> {
        let mut sources = Vec::with_capacity(count);
        let mut until = if exact { start } else { start + DUE_TOLERANCE };
        while sources.len() < count && until < f64::INFINITY {
            for schedule in &mut self.schedules {
                while schedule.due(setup) <= until && sources.len() < count {
                    sources.push(schedule.id);
                    schedule.emitted += 1;
                }
            }
            until = self.schedules.iter().map(|it| it.due(setup)).fold(f64::INFINITY, f64::min);
        }
        sources
    }

    /// Drops paints of removed spheres once they outnumber the others, so that the cost per sphere
    /// is constant.
    fn forget_the_gone(&mut self, world: &World) {
        if self.paints.len() > 2 * world.spheres().len() {
            Arc::make_mut(&mut self.paints)
                .retain(|(id, _)| world.spheres().index_of(*id).is_some());
        }
    }
}

/// Sphere of a generator, and their number.
fn generated(generator: &Generator) -> Option<(&scene::Sphere, usize)> {
    Some((generator.sphere()?, usize::try_from(generator.count()).unwrap_or(usize::MAX)))
}

/// Paint of spheres with this description.
fn paint_of_template(scene: &Scene, sphere: &scene::Sphere) -> Paint {
    let color = sphere.color.or_else(|| color_of_template(scene, sphere));
    Paint { color, finish: sphere.finish }
}

/// Colour of the density of spheres with this description.
fn color_of_template(scene: &Scene, sphere: &scene::Sphere) -> Option<Color> {
    let radius = sphere.radius.or(sphere.diameter.map(|diameter| 0.5 * diameter))?;
    let density =
        sphere.density.unwrap_or_else(|| sphere.mass.unwrap_or(1.0) / carom::volume(radius));
    color_of_density(scene, density)
}

/// Colour of the density of a sphere in a scene.
pub(crate) fn color_of(scene: &Scene, sphere: &Sphere) -> Option<Color> {
    color_of_density(scene, sphere.kilograms() / carom::volume(sphere.radius))
}

/// Colour of a density \[kg/m³\] in a scene.
fn color_of_density(scene: &Scene, density: f64) -> Option<Color> {
    let colors = scene.colors.as_ref()?;
    let is_it = |listed: &&scene::DensityColor| {
        (listed.density - density).abs() <= SAME_DENSITY * listed.density
    };
    colors.densities.iter().find(is_it).map(|listed| listed.color)
}
