//! The engine of the Python package `carom`: conversions only, no physics.
//!
//! Users call Python (`python/carom`), which calls [`Engine`] here. Numbers, arrays and text pass
//! between them:
//!
//! - descriptions by users arrive as TOML in the format of scene files, which `carom-scene` reads
//!   and checks (`part`); descriptions return as JSON;
//! - Python owns arrays, which are updated after every frame (`arrays`). A script can read an array
//!   as long as it holds it, without `unsafe` code here; the next call applies values that a script
//!   wrote into it (`written`);
//! - large numbers of spheres pass as arrays in both directions (`points`);
//! - events pass as tables of words (`tables`).
//!
//! A refused call leaves the world unchanged and raises an exception of `carom.errors` (`failure`).
//! Long calls let other threads of Python run.

#![warn(clippy::unwrap_used)]

mod arguments;
mod arrays;
mod batch;
mod command_line;
mod derivatives;
mod describing;
mod editing;
mod engine;
mod failure;
#[cfg(feature = "pictures")]
mod film;
#[cfg(feature = "pictures")]
mod graphics_failure;
mod imports;
mod in_use;
mod inner;
mod maze;
mod motion;
mod neighbours;
mod next_event;
mod next_poses;
mod packing;
#[cfg(feature = "pictures")]
mod painter;
mod pairs;
mod part;
mod particles;
#[cfg(feature = "pictures")]
mod picture_settings;
mod points;
mod predicted_path;
mod properties;
mod quantity;
mod queries;
mod recording;
mod running;
mod scenes;
mod setting;
mod snapshot;
mod springs;
mod stop;
mod stress;
mod tables;
mod threads;
mod written;

pub use batch::BatchEngine;
pub use derivatives::{TangentsEngine, TapeEngine};
pub use engine::Engine;
pub use maze::MazeEpisodes;
pub use neighbours::NeighbourLists;
#[cfg(feature = "pictures")]
pub use painter::Painter;
pub use predicted_path::Path;
pub use snapshot::Snapshot;
pub use stress::StressEngine;

/// The same allocator as in the program `carom`. NumPy uses its own.
#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The compiled part of the package `carom`. Users call the package, not this module.
#[pyo3::pymodule(gil_used = true)]
mod _carom {
    #[pymodule_export]
    use crate::BatchEngine;
    #[pymodule_export]
    use crate::Engine;
    #[pymodule_export]
    use crate::MazeEpisodes;
    #[pymodule_export]
    use crate::NeighbourLists;
    #[cfg(feature = "pictures")]
    #[pymodule_export]
    use crate::Painter;
    #[pymodule_export]
    use crate::Path;
    #[pymodule_export]
    use crate::Snapshot;
    #[pymodule_export]
    use crate::StressEngine;
    #[pymodule_export]
    use crate::TangentsEngine;
    #[pymodule_export]
    use crate::TapeEngine;
    #[pymodule_export]
    use crate::command_line::run_command;
    #[cfg(feature = "pictures")]
    #[pymodule_export]
    use crate::film::film_scene;
    #[pymodule_export]
    use crate::imports::{import_gltf, import_particle_file, import_unity};
    #[pymodule_export]
    use crate::neighbours::label_clusters;
    #[pymodule_export]
    use crate::packing::{pack_spheres, radii_of_sizes};
    #[pymodule_export]
    use crate::pairs::{pair_histogram, pairs_within};
    #[pymodule_export]
    use crate::particles::{read_particle_file, write_particle_file};
    #[pymodule_export]
    use crate::scenes::{canonical_toml, find_scene, list_scenes, read_scene, read_scene_file};

    /// Whether `carom view` is available, which opens a window.
    #[pymodule_export]
    const HAS_WINDOW: bool = cfg!(feature = "view");
}
