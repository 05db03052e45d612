//! Dense flow of grains in steady shear under the rule `contact`: friction by inertial number.

use std::f64::consts::PI;

use carom::packing::{self, Compression, Start, Until};
use carom::{CombineRule, Contact, DVec3, Error, Rule, Settings, Sphere, StressMeter, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};

/// Grains in a periodic box with the shear rate 1, of the density 1 and the mean diameter 1.
#[derive(Clone, Copy)]
struct Flow {
    /// Discs or spheres.
    dimensions: u32,
    count: usize,
    packing_fraction: f64,
    friction: f64,
    restitution: f64,
    /// Shear of a frame, before measuring, and meanwhile.
    frame: f64,
    before: f64,
    measured: f64,
}

const DISCS: Flow = Flow {
    dimensions: 2,
    count: 400,
    packing_fraction: 0.75,
    friction: 0.4,
    restitution: 0.1,
    frame: 0.004,
    before: 5.0,
    measured: 10.0,
};
const SPHERES: Flow = Flow {
    dimensions: 3,
    count: 500,
    packing_fraction: 0.55,
    friction: 0.5,
    restitution: 0.7,
    frame: 0.004,
    before: 3.0,
    measured: 5.0,
};
/// Half the spread of the diameters of discs, by the mean.
const SPREAD: f64 = 0.2;
/// How fast the grains are made to grow, by their thermal speed.
const GROWTH: f64 = 0.1;

pub fn claims() -> Vec<Claim> {
    let claim = |flow: Flow, source: &'static str, bound: f64, reason: &'static str| {
        let kind = if flow.dimensions == 2 { "discs" } else { "spheres" };
        Claim::new(
            format!(
                "rough {kind} of packing fraction {} in steady shear: stress ratio by that of their inertial number",
                flow.packing_fraction
            ),
            Expected::value(1.0, source),
            Tolerance::relative(bound, reason),
            move |rule| flow.stress_ratio_by_published(rule),
        )
        .about(Rule::Contact(Contact::default()))
    };
    let of_discs = "da Cruz et al. 2005: .25 + 1.1 I";
    let of_spheres = "Chialvo, Sun and Sundaresan 2012";
    let long = |flow: Flow| Flow { count: 1_000, frame: 0.001, measured: 20.0, ..flow };
    vec![
        claim(DISCS, of_discs, 0.06, "statistics 2 %, the line 4 %").slow(),
        claim(SPHERES, of_spheres, 0.04, "statistics 1 %, size 1 %, the fit 2 %").slow(),
        claim(Flow { packing_fraction: 0.79, ..long(DISCS) }, of_discs, 0.1, "the line 8 %").long(),
        claim(Flow { packing_fraction: 0.58, ..long(SPHERES) }, of_spheres, 0.03, "the fit 2 %")
            .long(),
    ]
}

impl Flow {
    /// Shear stress by pressure, divided by what was published for the inertial number.
    fn stress_ratio_by_published(self, rule: Rule) -> Outcome {
        let mut world = self.world(rule)?;
        let run = |world: &mut World, meter: &mut Option<StressMeter>, shear: f64| {
            for _ in 0..(shear / self.frame) as u64 {
                world.step(self.frame)?;
                if let Some(meter) = meter {
                    meter.add_frame(world);
                }
            }
            Ok::<(), Error>(())
        };
        run(&mut world, &mut None, self.before)?;
        let mut meter = Some(StressMeter::new(&world));
        run(&mut world, &mut meter, self.measured)?;
        let stress = meter.unwrap_or_else(|| StressMeter::new(&world)).stress(None)?;
        let shear = -stress.total().y_axis.x;
        let (ratio, published) = if self.dimensions == 2 {
            let pressure = stress.total().y_axis.y;
            let mean_mass: f64 = world.spheres().masses().iter().sum::<f64>() / self.count as f64;
            (shear / pressure, of_discs((mean_mass / pressure).sqrt()))
        } else {
            let pressure = stress.pressure();
            (shear / pressure, of_spheres(1.0 / pressure.sqrt()))
        };
        Ok(Measured::in_world(&world, ratio / published))
    }

    /// The grains at this packing fraction, with the velocities of the mean flow.
    fn world(self, rule: Rule) -> Result<World, Error> {
        let spread = if self.dimensions == 2 { SPREAD } else { 0.0 };
        let place = |number: usize| 2.0 * (number as f64 + 0.5) / self.count as f64 - 1.0;
        let radii = (0..self.count).map(|number| 0.5 * (1.0 + spread * place(number)));
        let start = Start::of(radii.collect(), 1)
            .with_packing_fraction(self.packing_fraction)
            .with_dimensions(self.dimensions);
        let mut packed = packing::start(&start)?;
        let until = Until::PackingFraction(self.packing_fraction);
        packing::compress(&mut packed, &Compression::until(until).with_growth(GROWTH))?;
        let settings: Settings = packed.settings().with_rule(rule).with_shear_rate(1.0);
        let settings = settings.with_combine_rule(CombineRule::Minimum);
        let mut world = World::new(settings)?;
        for index in 0..self.count {
            let Sphere { position, radius, .. } = packed.spheres().get(index);
            let volume = if self.dimensions == 2 {
                PI * radius * radius
            } else {
                4.0 / 3.0 * PI * radius * radius * radius
            };
            let grain = Sphere::new(position, radius)
                .with_mass(volume)
                .with_velocity(DVec3::new(position.y, 0.0, 0.0))
                .with_friction(self.friction)
                .with_restitution(self.restitution);
            world.add_sphere(grain)?;
        }
        Ok(world)
    }
}

/// Stress ratio of discs by γ √(m/P), for a coefficient of friction of 0.4.
fn of_discs(inertial_number: f64) -> f64 {
    0.25 + 1.1 * inertial_number
}

/// Stress ratio of spheres by γ d √(ρ/P), for a coefficient of friction of 0.5.
fn of_spheres(inertial_number: f64) -> f64 {
    0.382 + 0.37 / (1.0 + libm::pow(0.32 / inertial_number, 1.5))
}
