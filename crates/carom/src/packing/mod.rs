//! Dense packings and dense fluids, made by spheres that grow while they fly and collide.
//!
//! [`start()`] puts small spheres into a periodic box, [`compress()`] has them grow until they are as dense, or press as
//! hard, as one likes, [`equilibrate`] lets a fluid forget how it was made and measures its pressure, and [`rattlers()`]
//! counts the spheres of a packing that nothing holds.
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
mod measure;
mod rattlers;
mod start;

pub use compress::{Compressed, Compression, Until, compress, equilibrate};
pub use measure::{Fluid, packing_fraction};
pub use rattlers::{jammed_rattlers, rattlers};
pub use start::{Enclosure, Start, start};
