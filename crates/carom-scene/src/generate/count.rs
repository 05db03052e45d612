//! How many a generator may make.

use crate::error::Problem;
use crate::requirement::check;
use crate::scene::{Generator, Scene};

/// More spheres than this in one generator are a slip of the keyboard, and would fill the memory
/// (about 1 GB for the world alone).
const MOST_SPHERES: u64 = 10_000_000;

/// More colliders than this in one generator are such a slip, too.
const MOST_COLLIDERS: u64 = 1_000_000;

/// Checks how many spheres and colliders all generators make together, before any is made.
pub(crate) fn check_total(scene: &Scene) -> Result<(), Problem> {
    let [mut spheres, mut colliders] =
        [scene.spheres.len(), scene.colliders.len()].map(|count| count as u64);
    for (i, generator) in scene.generators.iter().enumerate() {
        let (sum, most, made) = match generator.collider() {
            None => (&mut spheres, MOST_SPHERES, "spheres"),
            Some(_) => (&mut colliders, MOST_COLLIDERS, "colliders"),
        };
        let own = generator.places();
        if own > most {
            // Its own field is to blame: see `check_count`.
            return Ok(());
        }
        *sum += own;
        let sum = *sum;
        check(sum <= most, &format!("generators[{i}]"), || {
            format!("makes {sum} {made} with those before it, and a scene has {most} at most")
        })?;
    }
    Ok(())
}

/// Checks that a generator, of the fields at `path`, makes spheres or colliders, and how many.
pub(super) fn check_count(generator: &Generator, path: &str) -> Result<(), Problem> {
    let (most, made) = match (generator.sphere(), generator.collider()) {
        (Some(_), None) => (MOST_SPHERES, "spheres"),
        (None, Some(_)) => (MOST_COLLIDERS, "colliders"),
        (None, None) => return Err(Problem::new(path, "needs `sphere` or `collider`")),
        (Some(_), Some(_)) => {
            let text = "`sphere` says already what there is";
            return Err(Problem::new(format!("{path}.collider"), text));
        }
    };
    if let Generator::StaggeredRows(rows) = generator {
        check(rows.rows > 0, &format!("{path}.rows"), || "must be at least 1, not 0".into())?;
    }
    let field = match generator {
        Generator::Row(_) | Generator::Ring(_) | Generator::Random { .. } => "count",
        _ => "counts",
    };
    let count = generator.places();
    check((1..=most).contains(&count), &format!("{path}.{field}"), || {
        format!("must make 1 to {most} {made}, not {count}")
    })
}
