//! Dense packings and dense fluids, made by spheres that grow while they fly and collide.
//!
//! [`start()`] puts small spheres into a box, [`compress()`] grows them to a packing fraction or a pressure,
//! [`equilibrate`] runs a fluid to equilibrium and measures its pressure, and [`rattlers()`] counts the spheres of
//! a packing that are not held in place.
//!
//! Source: Lubachevsky and Stillinger, J. Stat. Phys. 60, 561 (1990); `docs/physics/growth.md` has the formulas.
//!
//! ```
//! use carom::packing::{self, Compression, Start, Until};
//!
//! let mut world = packing::start(&Start::of(vec![0.5; 100], 7))?;
//! let compression = Compression::until(Until::PackingFraction(0.5));
//! let compressed = packing::compress(&mut world, &compression)?;
//! assert!(compressed.is_reached && (compressed.packing_fraction - 0.5).abs() < 1e-9);
//! assert!(world.overlaps(1e-9).is_empty());
//! # Ok::<(), carom::Error>(())
//! ```

mod compress;
mod dimensions;
mod measure;
mod rattlers;
mod start;

pub use compress::{Compressed, Compression, Until, compress, equilibrate};
pub use measure::{Fluid, packing_fraction};
pub use rattlers::{jammed_rattlers, rattlers};
pub use start::{Enclosure, Start, start};
