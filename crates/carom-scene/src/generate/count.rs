//! Limits on the number of spheres or colliders that a generator creates.

use crate::budget::Budget;
use crate::error::Problem;
use crate::requirement::check;
use crate::scene::Generator;

/// Most spheres of a dense fluid: making it takes about a hundred collisions of each.
const MOST_OF_FLUID: u64 = 100_000;

/// Checks that the generator at `path` creates either spheres or colliders, and not too many.
pub(super) fn check_count(generator: &Generator, path: &str) -> Result<(), Problem> {
    let (most, made) = match (generator.sphere(), generator.collider()) {
        (Some(_), None) => (Budget::MOST.spheres, "spheres"),
        (None, Some(_)) => (Budget::MOST.colliders, "colliders"),
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
        Generator::Row(_)
        | Generator::Ring(_)
        | Generator::Random { .. }
        | Generator::DenseFluid(_) => "count",
        _ => "counts",
    };
    let most = match generator {
        Generator::DenseFluid(_) => MOST_OF_FLUID,
        _ => most,
    };
    let count = generator.places();
    check((1..=most).contains(&count), &format!("{path}.{field}"), || {
        format!("must make 1 to {most} {made}, not {count}")
    })
}
