//! The command `pack`: makes dense packings and dense fluids by growth.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use carom::{Boundary, Error, StopRequest, World};
use carom_scene::Scene;
use carom_scene::import::plain_name;
use carom_scene::pack::{Packed, Recipe, Sizes};
use carom_scene::recording::Trajectory;
use carom_scene::scene::{self, Sphere};
use carom_scene::unfinished::create_folders_of;

use crate::failure::{Failure, unwritable};
use crate::interruption::interruption;
use crate::length::positive;
use crate::replacing::Replacing;

/// Make a dense packing or a dense fluid.
#[derive(Debug, clap::Args)]
pub struct Pack {
    /// How many spheres.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub spheres: u32,
    /// Part of the periodic box that they are to fill.
    #[arg(long, value_name = "P", default_value_t = 0.64, value_parser = positive)]
    pub packing_fraction: f64,
    /// End at this reduced pressure P V / N k T instead: 1e6 and more of a jammed packing.
    #[arg(long, value_name = "Z", value_parser = positive, conflicts_with = "equilibrate")]
    pub pressure: Option<f64>,
    /// Radii in m at the packing fraction, with their shares: `0.5`, `0.5:2,0.7:1` (two of one for one of the other) or
    /// `0.4-0.6` (evenly between).
    #[arg(long, value_name = "RADII", default_value = "0.5")]
    pub sizes: Sizes,
    /// Seed of the random places, sizes and velocities.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Speed at which the mean diameter grows, in parts of the thermal speed. Slower growth packs denser.
    #[arg(long, value_name = "G", default_value_t = 0.01, value_parser = positive)]
    pub growth: f64,
    /// Collisions of each sphere after that, without growth, in which the pressure of the fluid is measured.
    #[arg(long, value_name = "COLLISIONS", value_parser = positive)]
    pub equilibrate: Option<f64>,
    /// The file to write: a scene (.toml), or places, radii, masses and velocities (.xyz, .lammpstrj, .gsd, .npz, .csv).
    #[arg(long, short, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    pub replacing: Replacing,
}

/// Makes a packing, writes it and prints what it is like.
pub fn pack(pack: &Pack) -> Result<(), Failure> {
    pack.replacing.check(pack.out.as_deref())?;
    let interrupted = interruption()?;
    let recipe = Recipe {
        radii: pack.sizes.radii(pack.spheres as usize, pack.seed),
        seed: pack.seed,
        packing_fraction: pack.packing_fraction,
        pressure: pack.pressure,
        growth: pack.growth,
        equilibrate: pack.equilibrate,
    };
    let mut world = recipe.start().map_err(|error| Failure::Usage(error.to_string()))?;
    world.set_stop_request(Some(StopRequest::from(interrupted)));
    let packed = recipe.pack(world).map_err(refused)?;
    let Packed { world, compressed, fluid, rattlers } = &packed;
    let out = &mut io::stdout().lock();
    writeln!(out, "spheres           {}", world.spheres().len())?;
    writeln!(out, "packing fraction  {:.6}", compressed.packing_fraction)?;
    writeln!(out, "reduced pressure  {:.6}", fluid.pressure)?;
    writeln!(
        out,
        "collision rate    {:.6} in the time of a thermal diameter",
        fluid.collision_rate
    )?;
    writeln!(out, "collisions        {}", compressed.collisions)?;
    if let Some(rattlers) = rattlers {
        writeln!(out, "rattlers          {rattlers}")?;
    }
    writeln!(out, "state hash        {}", world.state_hash())?;
    if let Some(shortfall) = packed.shortfall(&recipe) {
        return Err(Failure::Fault(format!("{shortfall}: a smaller --growth packs denser")));
    }
    match &pack.out {
        Some(file) => write(file, world),
        None => Ok(()),
    }
}

/// Writes a scene, or a trajectory of one frame.
fn write(file: &Path, world: &World) -> Result<(), Failure> {
    if file.extension().is_some_and(|it| it.eq_ignore_ascii_case("toml")) {
        let text = scene_of(file, world).to_toml();
        let written = create_folders_of(file).and_then(|()| std::fs::write(file, text));
        return written.map_err(|error| unwritable(file, &error));
    }
    let mut trajectory = Trajectory::create(file)?;
    trajectory.write(world)?;
    Ok(trajectory.finish()?)
}

/// Returns a scene of the spheres of a periodic box.
fn scene_of(file: &Path, world: &World) -> Scene {
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    let mut scene = Scene::new(plain_name(&name));
    if let Boundary::Periodic { size } = world.settings().boundary {
        scene.simulation.boundary = scene::Boundary::Periodic {
            size: size.to_array(),
            shear_rate: 0.0,
            relative_velocities: false,
        };
    }
    let spheres = world.spheres();
    let sphere = |index: usize| {
        let place = spheres.positions()[index].to_array();
        let mut sphere = Sphere::at(place, spheres.radii()[index]);
        sphere.velocity = spheres.velocities()[index].to_array();
        sphere.mass = Some(spheres.masses()[index]);
        sphere
    };
    scene.spheres = (0..spheres.len()).map(sphere).collect();
    scene
}

fn refused(error: Error) -> Failure {
    match error {
        Error::Stopped { .. } => Failure::Interrupted,
        error => Failure::Fault(error.to_string()),
    }
}
