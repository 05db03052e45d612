//! The engine of the Python package `carom`: it converts, and holds no physics.
//!
//! What users call is Python (`python/carom`), which stands on [`Engine`] here. Between the two go
//! numbers, arrays and text:
//!
//! - what users describe comes as TOML, in the words of scene files, and is read and checked by
//!   `carom-scene` (`part`); descriptions go back as JSON;
//! - arrays belong to Python, and are written after every frame (`arrays`): one can be
//!   read for as long as it is held, and no `unsafe` is needed for it; what a script writes into one, the next
//!   call takes over (`written`);
//! - many spheres of a scene go as arrays, too, both ways (`points`);
//! - what happened goes as tables of words (`tables`).
//!
//! A refused call leaves the world as it was and raises an exception of `carom.errors`
//! (`failure`). Calls that take long let other threads of Python run.

#![warn(clippy::unwrap_used)]

mod arguments;
mod arrays;
mod batch;
mod command_line;
mod describing;
mod editing;
mod engine;
mod failure;
#[cfg(feature = "pictures")]
mod film;
#[cfg(feature = "pictures")]
mod graphics_failure;
mod imports;
#[cfg(feature = "pictures")]
mod look;
mod maze;
mod next_event;
#[cfg(feature = "pictures")]
mod painter;
mod pairs;
mod part;
mod points;
mod properties;
mod quantity;
mod recording;
mod running;
mod scenes;
mod setting;
mod snapshot;
mod springs;
mod stop;
mod tables;
mod threads;
mod written;

pub use batch::BatchEngine;
pub use engine::Engine;
pub use maze::MazeEpisodes;
#[cfg(feature = "pictures")]
pub use painter::Painter;
pub use snapshot::Snapshot;

/// As in the program `carom`; arrays that NumPy makes are not from here.
#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// The compiled part of the package `carom`. Its interface is that of the package, not this one.
#[pyo3::pymodule(gil_used = true)]
mod _carom {
    #[pymodule_export]
    use crate::BatchEngine;
    #[pymodule_export]
    use crate::Engine;
    #[pymodule_export]
    use crate::MazeEpisodes;
    #[cfg(feature = "pictures")]
    #[pymodule_export]
    use crate::Painter;
    #[pymodule_export]
    use crate::Snapshot;
    #[pymodule_export]
    use crate::command_line::run_command;
    #[cfg(feature = "pictures")]
    #[pymodule_export]
    use crate::film::film_scene;
    #[pymodule_export]
    use crate::imports::{import_gltf, import_unity};
    #[pymodule_export]
    use crate::pairs::{pair_histogram, pairs_within};
    #[pymodule_export]
    use crate::scenes::{canonical_toml, find_scene, list_scenes, read_scene, read_scene_file};

    /// Whether `carom view` is there, and opens a window.
    #[pymodule_export]
    const HAS_WINDOW: bool = cfg!(feature = "view");
}
