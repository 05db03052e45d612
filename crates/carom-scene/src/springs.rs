//! Adds springs of scene files to worlds.

use carom::{Error, SphereId, SpringEnd, World};

use crate::error::Problem;
use crate::requirement::{check, check_non_negative, check_vector};
use crate::scene::Spring;
use crate::scene::values::{Vector, vector};

/// Adds the spring or chain at `path` to a world that has all spheres of its scene.
pub(crate) fn add(world: &mut World, spring: &Spring, path: &str) -> Result<(), Problem> {
    match form(spring, path)? {
        Form::Single(ends) => {
            let (first, to) = ends.find(path, |number, path| numbered(world, number, path))?;
            join(world, spring, first, to, path)
        }
        Form::Chain([first, last]) => {
            let path_of_chain = format!("{path}.chain");
            numbered(world, last, &path_of_chain)?;
            check(first < last, &path_of_chain, || {
                "must be the first sphere of the chain and a later one, as its last".into()
            })?;
            let ids: Vec<SphereId> = world.spheres().ids()[first as usize..=last as usize].to_vec();
            ids.windows(2)
                .try_for_each(|pair| join(world, spring, pair[0], SpringEnd::Sphere(pair[1]), path))
        }
    }
}

/// Returns both ends of the spring at `path`, which names spheres by id. The spheres need not
/// exist.
pub(crate) fn ends_by_id(spring: &Spring, path: &str) -> Result<(SphereId, SpringEnd), Problem> {
    let Form::Single(ends) = form(spring, path)? else {
        let problem = "a running world takes its springs one by one";
        return Err(Problem::new(format!("{path}.chain"), problem));
    };
    let numbers = [
        ("rest_length", spring.rest_length),
        ("stiffness", Some(spring.stiffness)),
        ("damping", Some(spring.damping)),
    ];
    for (name, value) in numbers {
        value.map_or(Ok(()), |value| check_non_negative(value, &format!("{path}.{name}")))?;
    }
    ends.find(path, |number, _| Ok(SphereId::from_number(number.into())))
}

/// Creates the described spring between two ends in a world.
///
/// # Errors
/// [`Error::Unknown`] if the description has no rest length and the world does not have one of the
/// spheres.
pub(crate) fn between(
    spring: &Spring,
    world: &World,
    sphere: SphereId,
    to: SpringEnd,
) -> Result<carom::Spring, Error> {
    let place = |id| world.sphere(id).map(|sphere| sphere.position);
    let length = || {
        let end = match to {
            SpringEnd::Sphere(id) => place(id)?,
            SpringEnd::Point(point) => point,
        };
        Ok(world.settings().boundary.nearest_image(place(sphere)? - end).length())
    };
    let rest_length = spring.rest_length.map_or_else(length, Ok)?;
    let Spring { stiffness, damping, only_pulls, .. } = *spring;
    Ok(carom::Spring { sphere, to, rest_length, stiffness, damping, only_pulls })
}

fn join(
    world: &mut World,
    spring: &Spring,
    first: SphereId,
    to: SpringEnd,
    path: &str,
) -> Result<(), Problem> {
    let made = between(spring, world, first, to).and_then(|spring| world.add_spring(spring));
    made.map(drop).map_err(|error| Problem::of_physics(path, error))
}

/// What a spring or chain connects.
enum Form {
    Single(Ends),
    /// A chain from the first sphere to the last: each is connected to the next.
    Chain([u32; 2]),
}

/// Both ends of a spring; spheres are named by number.
enum Ends {
    Spheres([u32; 2]),
    Anchor(u32, Vector),
}

fn form(spring: &Spring, path: &str) -> Result<Form, Problem> {
    match (spring.spheres, spring.sphere, spring.anchor, spring.chain) {
        (Some(spheres), None, None, None) => Ok(Form::Single(Ends::Spheres(spheres))),
        (None, Some(sphere), Some(anchor), None) => Ok(Form::Single(Ends::Anchor(sphere, anchor))),
        (None, None, None, Some(chain)) => Ok(Form::Chain(chain)),
        _ => Err(Problem::new(path, "needs `spheres`, `sphere` and `anchor`, or `chain`")),
    }
}

impl Ends {
    /// Finds the spheres of the spring at `path`. `sphere` looks up a number that stands at the
    /// given path.
    fn find(
        self,
        path: &str,
        sphere: impl Fn(u32, &str) -> Result<SphereId, Problem>,
    ) -> Result<(SphereId, SpringEnd), Problem> {
        match self {
            Self::Spheres([first, second]) => {
                let path = format!("{path}.spheres");
                let [first, second] = [sphere(first, &path)?, sphere(second, &path)?];
                check(first != second, &path, || "must be two spheres".into())?;
                Ok((first, SpringEnd::Sphere(second)))
            }
            Self::Anchor(number, anchor) => {
                let id = sphere(number, &format!("{path}.sphere"))?;
                check_vector(anchor, &format!("{path}.anchor"))?;
                Ok((id, SpringEnd::Point(vector(anchor))))
            }
        }
    }
}

/// Returns the id of a sphere by its number in the scene.
fn numbered(world: &World, number: u32, path: &str) -> Result<SphereId, Problem> {
    let ids = world.spheres().ids();
    ids.get(number as usize).copied().ok_or_else(|| {
        let there_are = match ids.len() {
            0 => "the scene has no spheres".to_owned(),
            count => format!("spheres are numbered from 0 to {}", count - 1),
        };
        Problem::new(path, format!("there is no sphere {number}: {there_are}"))
    })
}
