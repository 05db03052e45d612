//! Checkpoints: worlds as bytes, from which a simulation continues later or in another process.

use std::io::{self, Write};

use carom::{ForceId, Snapshot};
use thiserror::Error;
use xxhash_rust::xxh3::xxh3_64;

use crate::budget::Budget;
use crate::palette::Palette;
use crate::scene::Scene;

/// First bytes of every checkpoint.
const MAGIC: &[u8; 8] = b"carom\x1a\r\n";
/// Version of Carom and of the layout of states; the number increases with each change of the
/// layout.
const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "/33");

/// A world at one moment, with its scene and its colours.
///
/// ```
/// use carom::World;
/// use carom_scene::{Checkpoint, Library, Palette};
///
/// let (scene, _) = Library::new().find("tutorial1", &[])?;
/// let mut world = scene.world()?;
/// world.step(0.5)?;
/// let palette = Palette::new(&scene)?;
/// let bytes = Checkpoint { snapshot: world.snapshot(), scene, palette }.to_bytes()?;
///
/// let mut other = World::default();
/// other.restore(&Checkpoint::from_bytes(&bytes)?.snapshot);
/// assert_eq!(other.step(0.5)?.impacts, world.step(0.5)?.impacts);
/// assert_eq!(other.state_hash(), world.state_hash());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Checkpoint {
    /// Complete state of the world: the future depends on nothing else.
    pub snapshot: Snapshot,
    /// The scene of the world; where there was none, the scene that describes the world.
    pub scene: Scene,
    /// The colours of the world.
    pub palette: Palette,
}

/// Why a checkpoint cannot be written or read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// A force defined in user code, which cannot be stored.
    #[error("force {0} is a function of the program, which a snapshot cannot hold as bytes")]
    ForeignForce(ForceId),
    /// The bytes do not begin as a checkpoint does.
    #[error("these bytes are no snapshot of Carom")]
    NoCheckpoint,
    /// The bytes were written by another version of Carom, which stores other fields.
    #[error(
        "this snapshot is of Carom {found}, and only the same version reads it: this is {VERSION}"
    )]
    OtherVersion {
        /// Version and layout that wrote the bytes.
        found: String,
    },
    /// There is not enough memory for the bytes, or for the state in them.
    #[error("there is no memory for the snapshot")]
    NoMemory,
    /// Bytes are missing or were changed.
    #[error("this snapshot is damaged: some of its bytes are missing or wrong")]
    Damaged,
}

impl Checkpoint {
    /// Serializes the checkpoint; see [`Self::bytes_of`].
    ///
    /// # Errors
    /// Those of [`Self::bytes_of`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        Self::bytes_of(&self.snapshot, &self.scene, &self.palette)
    }

    /// Serializes the three parts of a checkpoint. The bytes are the same on every platform, and a
    /// world that is restored from them continues as the original, bit for bit.
    ///
    /// Only the same version of Carom reads them, with [`Self::from_bytes`]. A checksum detects
    /// accidental damage, but no deliberate change: read only bytes that you trust.
    ///
    /// # Errors
    /// [`CheckpointError::ForeignForce`] for a force defined in user code, and
    /// [`CheckpointError::NoMemory`].
    pub fn bytes_of(
        snapshot: &Snapshot,
        scene: &Scene,
        palette: &Palette,
    ) -> Result<Vec<u8>, CheckpointError> {
        if let Some(force) = snapshot.foreign_force() {
            return Err(CheckpointError::ForeignForce(force));
        }
        let mut bytes = Growing(MAGIC.to_vec());
        let parts = (VERSION, snapshot, scene.to_toml(), palette);
        postcard::to_io(&parts, &mut bytes).map_err(|_| CheckpointError::NoMemory)?;
        let checksum = xxh3_64(&bytes.0).to_le_bytes();
        bytes.write_all(&checksum).map_err(|_| CheckpointError::NoMemory)?;
        Ok(bytes.0)
    }

    /// Reads the checkpoint from bytes that [`Self::to_bytes`] wrote.
    ///
    /// # Errors
    /// [`CheckpointError`] if the bytes are no checkpoint, are of another version or damaged, or do
    /// not fit into memory.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CheckpointError> {
        let parts = bytes.strip_prefix(MAGIC).ok_or(CheckpointError::NoCheckpoint)?;
        let damaged = |_| CheckpointError::Damaged;
        let (version, _): (&str, _) = postcard::take_from_bytes(parts).map_err(damaged)?;
        if version != VERSION {
            let found = version.escape_debug().to_string();
            return Err(CheckpointError::OtherVersion { found });
        }
        let (written, checksum) = bytes.split_last_chunk().ok_or(CheckpointError::Damaged)?;
        if xxh3_64(written) != u64::from_le_bytes(*checksum) {
            return Err(CheckpointError::Damaged);
        }
        // The state takes about as much memory as its bytes; twice as much is reserved for a test.
        let room = Vec::<u8>::new().try_reserve_exact(2 * bytes.len());
        room.map_err(|_| CheckpointError::NoMemory)?;
        let (_, snapshot, scene, palette): (&str, Snapshot, String, Palette) =
            postcard::from_bytes(parts).map_err(damaged)?;
        let scene = Scene::from_toml_within(&scene, "snapshot", Budget::MOST)
            .map_err(|_| CheckpointError::Damaged)?;
        let palette = palette.in_colors_of(&scene);
        Ok(Self { snapshot, scene, palette })
    }
}

/// Bytes whose growth returns an error when memory runs out.
struct Growing(Vec<u8>);

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.try_reserve(bytes.len()).map_err(|_| io::ErrorKind::OutOfMemory)?;
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
