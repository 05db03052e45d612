//! Dense packings and dense fluids in a periodic cube: what `carom pack` and `carom.pack` of Python make.

use std::str::FromStr;

use carom::packing::{self, Compressed, Compression, Fluid, Start, Until};
use carom::{Error, World};

use crate::generate::Numbers;

/// Radii, with the shares of spheres that have them: `0.5`, `0.5:2,0.7:1` (two of one for one of the other) or `0.4-0.6`
/// (evenly between).
#[derive(Debug, Clone, PartialEq)]
pub struct Sizes(Vec<Size>);

/// Radii between two \[m\], and how large their share is.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Size {
    radii: [f64; 2],
    share: f64,
}

impl FromStr for Sizes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let size = |part: &str| {
            let (radii, share) = part.split_once(':').unwrap_or((part, "1"));
            let (low, high) = radii.split_once('-').unwrap_or((radii, radii));
            let number =
                |text: &str| positive(text).map_err(|problem| format!("{part}: {problem}"));
            let radii = [number(low)?, number(high)?];
            if radii[0] > radii[1] {
                return Err(format!("{part}: the smaller radius comes first"));
            }
            Ok(Size { radii, share: number(share)? })
        };
        text.split(',').map(size).collect::<Result<_, _>>().map(Self)
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("a positive number is needed".to_owned()),
    }
}

impl Sizes {
    /// Returns the radii of `count` spheres \[m\]: as many of each size as its share says, in the order of sizes.
    pub fn radii(&self, count: usize, seed: u64) -> Vec<f64> {
        let mut numbers = Numbers::new(seed);
        let total: f64 = self.0.iter().map(|size| size.share).sum();
        let (mut radii, mut share) = (Vec::with_capacity(count), 0.0);
        for size in &self.0 {
            share += size.share;
            let until = (count as f64 * share / total).round() as usize;
            let [low, high] = size.radii;
            let drawn = |_| low + (high - low) * numbers.unit();
            radii.extend((radii.len()..until.min(count)).map(drawn));
        }
        radii
    }
}

/// How spheres are packed.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// Radii at the packing fraction \[m\], each > 0.
    pub radii: Vec<f64>,
    /// Decides places and velocities.
    pub seed: u64,
    /// Part of the periodic cube that the radii fill, in (0, 1).
    pub packing_fraction: f64,
    /// Reduced pressure at which the compression ends instead, > 1.
    pub pressure: Option<f64>,
    /// Speed at which the mean diameter grows, in parts of the thermal speed, > 0.
    pub growth: f64,
    /// Collisions of each sphere after that, without growth, in which the pressure is measured.
    pub equilibrate: Option<f64>,
}

/// A packing or a fluid.
#[derive(Debug)]
pub struct Packed {
    /// The spheres in their box.
    pub world: World,
    /// What became of the compression.
    pub compressed: Compressed,
    /// What was measured last.
    pub fluid: Fluid,
    /// How many spheres nothing holds; `None` of a fluid.
    pub rattlers: Option<usize>,
}

impl Recipe {
    /// Returns the world at the start of the compression.
    ///
    /// # Errors
    /// Those of [`packing::start()`].
    pub fn start(&self) -> Result<World, Error> {
        let start = Start::of(self.radii.clone(), self.seed);
        packing::start(&start.with_packing_fraction(self.packing_fraction))
    }

    /// Compresses the spheres of [`Recipe::start`].
    ///
    /// # Errors
    /// Those of [`packing::compress`] and [`packing::equilibrate`].
    pub fn pack(&self, mut world: World) -> Result<Packed, Error> {
        let until = match self.pressure {
            Some(pressure) => Until::Pressure(pressure),
            None => Until::PackingFraction(self.packing_fraction),
        };
        let compression = Compression::until(until).with_growth(self.growth);
        let compressed = packing::compress(&mut world, &compression)?;
        let mut fluid = compressed.fluid;
        if let Some(collisions) = self.equilibrate.filter(|_| compressed.is_reached) {
            fluid = packing::equilibrate(&mut world, collisions, None)?;
        }
        let rattlers = packing::jammed_rattlers(&world, fluid.pressure)?;
        Ok(Packed { world, compressed, fluid, rattlers })
    }
}

impl Packed {
    /// Returns why the packing fails if the spheres jammed before they were as dense as requested.
    pub fn shortfall(&self, recipe: &Recipe) -> Option<String> {
        let Compressed { is_reached, packing_fraction, .. } = self.compressed;
        let wanted = recipe.packing_fraction;
        let said =
            || format!("jammed at a packing fraction of {packing_fraction:.4}, not {wanted}");
        (!is_reached).then(said)
    }
}
