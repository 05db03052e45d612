//! Settings of scene files as those of `carom`.

use carom::Settings;

use crate::error::Problem;
use crate::scene::values::vector;
use crate::scene::{
    Bisect, Boundary, CombineRule, Contact, Discrete, Exact, ImpactLaw, Integrator, PairPotential,
    Rule, Scene, Simulation, Thermostat, WindBack, Zones,
};

impl Scene {
    /// Converts the simulation table to the settings of a world.
    pub fn settings(&self) -> Settings {
        settings(&self.simulation)
    }
}

impl From<Boundary> for carom::Boundary {
    fn from(boundary: Boundary) -> Self {
        match boundary {
            Boundary::Open => Self::Open,
            Boundary::Periodic { size, .. } => Self::Periodic { size: vector(size) },
        }
    }
}

impl From<Thermostat> for carom::Thermostat {
    fn from(thermostat: Thermostat) -> Self {
        match thermostat {
            Thermostat::Andersen { frequency, temperature, seed } => {
                Self::Andersen { frequency, temperature, seed }
            }
            Thermostat::Rescale { interval, temperature } => {
                Self::Rescale { interval, temperature }
            }
            Thermostat::WhiteNoise { interval, strength, seed } => {
                Self::WhiteNoise { interval, strength, seed }
            }
        }
    }
}

impl From<PairPotential> for carom::PairPotential {
    fn from(potential: PairPotential) -> Self {
        let PairPotential::SquareWell { depth, range_ratio } = potential;
        Self::SquareWell { depth, range_ratio }
    }
}

/// Shear rate of a boundary \[1/s\].
fn shear_rate(boundary: Boundary) -> f64 {
    match boundary {
        Boundary::Open => 0.0,
        Boundary::Periodic { shear_rate, .. } => shear_rate,
    }
}

fn settings(simulation: &Simulation) -> Settings {
    let rule: carom::Rule = match simulation.rule {
        Rule::Discrete => discrete(&simulation.discrete).into(),
        Rule::Bisect => bisect(&simulation.bisect).into(),
        Rule::Exact => exact(&simulation.exact).into(),
        Rule::Contact => contact(&simulation.contact).into(),
    };
    Settings::default()
        .with_rule(rule)
        .with_dimensions(simulation.dimensions)
        .with_combine_rule(simulation.combine_rule.into())
        .with_friction_combine_rule(simulation.friction_combine_rule.into())
        .with_spheres_collide(simulation.spheres_collide)
        .with_boundary(simulation.boundary.into())
        .with_shear_rate(shear_rate(simulation.boundary))
        .with_thermostat(simulation.thermostat.map(Into::into))
        .with_pair_potential(simulation.pair_potential.map(Into::into))
}

impl From<CombineRule> for carom::CombineRule {
    fn from(rule: CombineRule) -> Self {
        match rule {
            CombineRule::Product => Self::Product,
            CombineRule::Minimum => Self::Minimum,
            CombineRule::Maximum => Self::Maximum,
            CombineRule::Average => Self::Average,
            CombineRule::GeometricMean => Self::GeometricMean,
        }
    }
}

fn discrete(parameters: &Discrete) -> carom::Discrete {
    carom::Discrete::default().with_integrator(integrator(parameters.integrator))
}

fn bisect(parameters: &Bisect) -> carom::Bisect {
    let wind_back = match parameters.wind_back {
        WindBack::Touched => carom::WindBack::Touched,
        WindBack::All => carom::WindBack::All,
    };
    carom::Bisect::default()
        .with_integrator(integrator(parameters.integrator))
        .with_tolerance(parameters.tolerance)
        .with_max_halvings(parameters.max_halvings)
        .with_max_impacts(parameters.max_impacts)
        .with_wind_back(wind_back)
}

fn exact(parameters: &Exact) -> carom::Exact {
    let impact_law = match parameters.impact_law {
        ImpactLaw::Sequential => carom::ImpactLaw::Sequential,
        ImpactLaw::Simultaneous => carom::ImpactLaw::Simultaneous,
        ImpactLaw::Reflection => carom::ImpactLaw::Reflection,
    };
    let zones = match parameters.zones {
        Zones::Automatic => carom::Zones::Automatic,
        Zones::Never => carom::Zones::Never,
    };
    carom::Exact::default()
        .with_impact_law(impact_law)
        .with_contact_duration(parameters.contact_duration)
        .with_max_impacts(parameters.max_impacts)
        .with_zones(zones)
        .with_zone_budget(parameters.zone_budget)
        .with_zone_tick(parameters.zone_tick)
        .with_force_tick(parameters.force_tick)
}

fn contact(parameters: &Contact) -> carom::Contact {
    carom::Contact::default()
        .with_sub_steps(parameters.sub_steps)
        .with_sweeps(parameters.sweeps)
        .with_converged(parameters.converged)
        .with_sleep_speed(parameters.sleep_speed)
}

fn integrator(integrator: Integrator) -> carom::Integrator {
    match integrator {
        Integrator::SemiImplicitEuler => carom::Integrator::SemiImplicitEuler,
        Integrator::ExplicitEuler => carom::Integrator::ExplicitEuler,
        Integrator::VelocityVerlet => carom::Integrator::VelocityVerlet,
        Integrator::RungeKutta4 => carom::Integrator::RungeKutta4,
    }
}

/// Whether a field of the settings is one of a thermostat.
fn is_of_thermostat(field: &str) -> bool {
    matches!(field, "frequency" | "interval" | "temperature" | "strength")
}

/// Converts an error of the settings; the path is that of the table which contains them.
pub(crate) fn settings_problem(simulation: &Simulation, error: carom::Error) -> Problem {
    let path = match &error {
        carom::Error::Invalid { source, .. } if matches!(source.field, "size" | "shear_rate") => {
            "simulation.boundary.periodic"
        }
        carom::Error::Invalid { source, .. }
            if matches!(
                source.field,
                "boundary" | "dimensions" | "thermostat" | "pair_potential"
            ) =>
        {
            "simulation"
        }
        carom::Error::Invalid { source, .. } if is_of_thermostat(source.field) => {
            "simulation.thermostat"
        }
        carom::Error::Invalid { source, .. } if matches!(source.field, "depth" | "range_ratio") => {
            "simulation.pair_potential"
        }
        _ => &format!("simulation.{}", simulation.rule),
    };
    Problem::of_physics(path, error)
}
