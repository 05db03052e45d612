//! Springs of scene files in worlds.

use carom::{SphereId, SpringEnd, World};

use crate::error::Problem;
use crate::requirement::{check, check_vector};
use crate::scene::Spring;
use crate::scene::values::vector;

/// Adds the spring, or the chain of springs, written at `path` to a world with all spheres of its scene.
pub(crate) fn add(world: &mut World, spring: &Spring, path: &str) -> Result<(), Problem> {
    match (spring.spheres, spring.sphere, spring.anchor, spring.chain) {
        (Some([first, second]), None, None, None) => {
            let path_of_spheres = format!("{path}.spheres");
            let [first, second] =
                [sphere(world, first, &path_of_spheres)?, sphere(world, second, &path_of_spheres)?];
            check(first != second, &path_of_spheres, || "must be two spheres".into())?;
            join(world, spring, first, SpringEnd::Sphere(second), path)
        }
        (None, Some(number), Some(anchor), None) => {
            let id = sphere(world, number, &format!("{path}.sphere"))?;
            check_vector(anchor, &format!("{path}.anchor"))?;
            join(world, spring, id, SpringEnd::Point(vector(anchor)), path)
        }
        (None, None, None, Some([first, last])) => {
            let path_of_chain = format!("{path}.chain");
            sphere(world, last, &path_of_chain)?;
            check(first < last, &path_of_chain, || {
                "must be the first sphere of a chain and a later one".into()
            })?;
            let ids: Vec<SphereId> = world.spheres().ids()[first as usize..=last as usize].to_vec();
            ids.windows(2)
                .try_for_each(|pair| join(world, spring, pair[0], SpringEnd::Sphere(pair[1]), path))
        }
        _ => Err(Problem::new(path, "needs `spheres`, `sphere` and `anchor`, or `chain`")),
    }
}

/// The sphere of this number.
fn sphere(world: &World, number: u32, path: &str) -> Result<SphereId, Problem> {
    let ids = world.spheres().ids();
    ids.get(number as usize).copied().ok_or_else(|| {
        let there_are = match ids.len() {
            0 => "the scene has no spheres".to_owned(),
            count => format!("spheres are numbered from 0 to {}", count - 1),
        };
        Problem::new(path, format!("there is no sphere {number}: {there_are}"))
    })
}

fn join(
    world: &mut World,
    spring: &Spring,
    first: SphereId,
    to: SpringEnd,
    path: &str,
) -> Result<(), Problem> {
    let place = |id| world.sphere(id).map(|sphere| sphere.position);
    let length = || {
        let end = match to {
            SpringEnd::Sphere(id) => place(id)?,
            SpringEnd::Point(point) => point,
        };
        Ok(world.settings().boundary.nearest_image(place(first)? - end).length())
    };
    let refused = |error| Problem::of_physics(path, error);
    let rest_length = spring.rest_length.map_or_else(length, Ok).map_err(refused)?;
    let spring = carom::Spring {
        sphere: first,
        to,
        rest_length,
        stiffness: spring.stiffness,
        damping: spring.damping,
        only_pulls: spring.only_pulls,
    };
    world.add_spring(spring).map(drop).map_err(refused)
}
