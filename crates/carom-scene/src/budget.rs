//! Limits on the size of scenes.

use crate::error::Problem;
use crate::requirement::check;
use crate::scene::{Generator, Scene};

/// Limits on what a scene may contain, checked before anything is created: a generator of a few
/// bytes can stand for more spheres than fit into memory.
///
/// ```
/// use carom_scene::{Budget, SceneText};
///
/// let text = "[[generators]]\nrow = { count = 500, start = [0, 0, 0], step = [3, 0, 0], \
///             sphere = { radius = 1 } }\n";
/// let strict = Budget { spheres: 100, ..Budget::FILE };
/// let refusal = SceneText::new(text, "row.toml")?.within(strict).scene(&[]).unwrap_err();
/// assert!(refusal.to_string().starts_with("row.toml:1: generators[0]: makes 500 spheres"));
/// # Ok::<(), carom_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    /// Most spheres at the start: single ones and those of all generators together.
    pub spheres: u64,
    /// Most colliders: single ones and those of all generators together.
    pub colliders: u64,
    /// Most springs; each spring of a chain counts.
    pub springs: u64,
    /// Most bytes in each file of a scene.
    pub bytes: u64,
    /// Whether meshes may be read from files.
    pub opens_files: bool,
}

impl Default for Budget {
    fn default() -> Self {
        Self::FILE
    }
}

impl Budget {
    /// Limits for scene files: gases of a million spheres are allowed, in about 1 GB of memory.
    pub const FILE: Self = Self {
        spheres: 2_000_000,
        colliders: 1_000_000,
        springs: 4_000_000,
        bytes: 256 << 20,
        opens_files: true,
    };

    /// Limits for links, which anyone can send: a text of the longest length takes at most about
    /// 0.5 GB.
    pub const LINK: Self = Self {
        spheres: 200_000,
        colliders: 100_000,
        springs: 400_000,
        bytes: 8 << 20,
        opens_files: false,
    };

    /// Limits for scenes that were checked already or built in code: a larger number is a typing
    /// error.
    pub const MOST: Self = Self {
        spheres: 10_000_000,
        colliders: 1_000_000,
        springs: 20_000_000,
        bytes: u64::MAX,
        opens_files: true,
    };

    /// Checks the numbers of spheres, colliders and springs of a scene, including those of all
    /// generators, before any is created.
    pub(crate) fn check(&self, scene: &Scene) -> Result<(), Problem> {
        let (spheres, colliders) = (scene.spheres.len() as u64, scene.colliders.len() as u64);
        for (list, count, most) in
            [("spheres", spheres, self.spheres), ("colliders", colliders, self.colliders)]
        {
            check(count <= most, &format!("{list}[{most}]"), || {
                format!("{count} {list} are more than the {most} that are allowed")
            })?;
        }
        let joined = |chain: [u32; 2]| u64::from(chain[1].saturating_sub(chain[0]));
        let springs: u64 = scene.springs.iter().map(|it| it.chain.map_or(1, joined)).sum();
        check(springs <= self.springs, "springs", || {
            format!("{springs} springs are more than the {} that are allowed", self.springs)
        })?;
        self.check_generators(&scene.generators, spheres, colliders)
    }

    /// Checks the generators of a scene that has `spheres` single spheres and `colliders` single
    /// colliders.
    fn check_generators(
        &self,
        generators: &[Generator],
        mut spheres: u64,
        mut colliders: u64,
    ) -> Result<(), Problem> {
        for (i, generator) in generators.iter().enumerate() {
            let (sum, limit, most, made) = match generator.collider() {
                None => (&mut spheres, self.spheres, Self::MOST.spheres, "spheres"),
                Some(_) => (&mut colliders, self.colliders, Self::MOST.colliders, "colliders"),
            };
            let own = generator.places();
            if own > most {
                // `check_count` refuses this generator later, and names the field.
                return Ok(());
            }
            *sum += own;
            let sum = *sum;
            check(sum <= limit, &format!("generators[{i}]"), || {
                format!("makes {sum} {made} with those before it, and a scene has {limit} at most")
            })?;
        }
        Ok(())
    }
}
