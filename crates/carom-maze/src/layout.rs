//! Makes the scene of a drawn maze, in metres.
//!
//! Sizes are those of the course's maze, which suit its ball.

use carom::{DQuat, DVec3};
use carom_scene::scene::{Collider, Force, Scene, Shape, Sphere, Sun};

use crate::camera;
use crate::cover::{Rectangle, cover};
use crate::drawing::{Drawing, Place};

/// Radius of the ball \[m\].
const BALL_RADIUS: f64 = 0.5;
/// Clear width of a corridor \[m\]: almost half a ball wider than the ball.
const WAY: f64 = 1.45;
/// Thickness of a thin wall \[m\].
const THIN: f64 = 0.25;
/// Height of a wall, and how much of it is below the ground \[m\].
const WALL_HEIGHT: f64 = 1.6;
const WALL_BELOW_GROUND: f64 = 0.13;
const WALL_RESTITUTION: f64 = 0.2;
/// Space between the ball and the ceiling \[m\], too little to jump over walls.
const HEADROOM: f64 = 0.03;
const COLLECTIBLE_RADIUS: f64 = 0.25;
/// Height of collectibles above the ground \[m\]: visible from above, touched from the side.
const COLLECTIBLE_HEIGHT: f64 = 0.6;
/// Downward acceleration \[m/s²\].
const GRAVITY: f64 = 9.8;
/// Name of end walls, which [`Maze::from_scene`](crate::Maze::from_scene) recognises.
const END_WALL: &str = "end wall";

/// Edges \[m\] of columns or rows, centred at 0.
struct Edges(Vec<f64>);

impl Edges {
    fn new(count: usize, thin_walls: bool) -> Self {
        let mut edges = vec![0.0];
        for number in 0..count {
            let size = if thin_walls && number % 2 == 0 { THIN } else { WAY };
            edges.push(edges[number] + size);
        }
        let middle = 0.5 * edges[count];
        edges.iter_mut().for_each(|edge| *edge -= middle);
        Self(edges)
    }

    fn whole(&self) -> f64 {
        2.0 * self.0[self.0.len() - 1]
    }

    /// Returns the coordinate at a number of columns or rows, interpolated between edges \[m\].
    fn at(&self, number: f64) -> f64 {
        let before = (number as usize).min(self.0.len() - 2);
        self.0[before] + (number - before as f64) * (self.0[before + 1] - self.0[before])
    }

    fn middle(&self, number: usize) -> f64 {
        self.at(number as f64 + 0.5)
    }
}

/// Returns the scene of a drawing. The ground is at y = 0, and the first row at the far side, -z.
pub(crate) fn scene(drawing: &Drawing, name: &str) -> Scene {
    let x = Edges::new(drawing.columns, drawing.thin_walls);
    let z = Edges::new(drawing.rows, drawing.thin_walls);
    let mut scene = Scene::new(name);
    scene.title = drawing.title.clone();
    scene.forces = vec![Force::Gravity { acceleration: [0.0, -GRAVITY, 0.0] }];
    let (column, row) = drawing.start;
    let start = [x.middle(column), BALL_RADIUS, z.middle(row)];
    scene.spheres = vec![Sphere::at(start, BALL_RADIUS)];
    scene.colliders = vec![plate("Ceiling", &x, &z), plate("Ground", &x, &z)];
    let ceiling = &mut scene.colliders[0];
    ceiling.position = [0.0, 2.0 * BALL_RADIUS + HEADROOM, 0.0];
    ceiling.rotation = DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0).to_array();
    ceiling.visible = false;
    for (what, name) in [(Place::Wall, "wall"), (Place::End, END_WALL)] {
        let rectangles = cover(&drawing.cells(what));
        scene.colliders.extend(rectangles.iter().map(|it| wall(name, it, &x, &z)));
    }
    for (column, row) in drawing.places(Place::Collectible) {
        scene.colliders.push(collectible([x.middle(column), COLLECTIBLE_HEIGHT, z.middle(row)]));
    }
    let height = WALL_HEIGHT - WALL_BELOW_GROUND;
    scene.camera = Some(camera::fitted(DVec3::new(0.5 * x.whole(), height, 0.5 * z.whole())));
    scene.sun = Some(sun());
    scene
}

/// Returns a level rectangle of the size of the maze.
fn plate(name: &str, x: &Edges, z: &Edges) -> Collider {
    let shape = Shape::Rectangle { size_x: x.whole(), size_z: z.whole() };
    Collider { restitution: 0.0, ..collider(name, shape, [0.0; 3]) }
}

fn wall(name: &str, rectangle: &Rectangle, x: &Edges, z: &Edges) -> Collider {
    let [left, right] = rectangle.columns.map(|number| x.at(number));
    let [far, near] = rectangle.rows.map(|number| z.at(number));
    let shape = Shape::Box { size: [right - left, WALL_HEIGHT, near - far] };
    let height = 0.5 * WALL_HEIGHT - WALL_BELOW_GROUND;
    let position = [0.5 * (left + right), height, 0.5 * (far + near)];
    Collider { restitution: WALL_RESTITUTION, ..collider(name, shape, position) }
}

fn collectible(position: [f64; 3]) -> Collider {
    let shape = Shape::Sphere { radius: COLLECTIBLE_RADIUS };
    Collider { trigger: true, ..collider("collectible", shape, position) }
}

fn collider(name: &str, shape: Shape, position: [f64; 3]) -> Collider {
    Collider { name: name.to_owned(), position, ..Collider::new(shape) }
}

/// Returns the sun of the course.
fn sun() -> Sun {
    Sun {
        rotation: [-0.408217902, 0.234569701, 0.109381601, 0.875426105],
        color: [1.0, 0.95686275, 0.8392157],
        intensity: 1.0,
    }
}
