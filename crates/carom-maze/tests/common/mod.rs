//! Small mazes for tests.
#![allow(dead_code, reason = "no test uses all of them")]

use carom_maze::{Game, GameEvent, Maze, Options, Steering};
use carom_scene::scene::{Collider, Force, Scene, Shape, Sphere};

/// Returns a collider at a position, without rotation.
pub fn collider(name: &str, shape: Shape, position: [f64; 3]) -> Collider {
    Collider { name: name.to_owned(), position, restitution: 0.0, ..Collider::new(shape) }
}

pub fn wall(name: &str, position: [f64; 3], size: [f64; 3]) -> Collider {
    collider(name, Shape::Box { size }, position)
}

pub fn collectible(position: [f64; 3]) -> Collider {
    let shape = Shape::Sphere { radius: 0.25 };
    Collider { trigger: true, ..collider("collectible", shape, position) }
}

/// Returns a square floor of 20 m at a height \[m\] without walls, with the ball in its middle and
/// the end wall at x = -3. Gravity is 9.8 m/s².
pub fn open_floor(height: f64) -> Scene {
    let mut scene = Scene::new("open");
    scene.forces = vec![Force::Gravity { acceleration: [0.0, -9.8, 0.0] }];
    scene.spheres = vec![Sphere::at([0.0, height + 0.5, 0.0], 0.5)];
    let ground = Shape::Rectangle { size_x: 20.0, size_z: 20.0 };
    scene.colliders = vec![
        collider("Ground", ground, [0.0, height, 0.0]),
        wall("end wall", [-3.0, height + 0.5, 0.0], [0.2, 1.0, 6.0]),
    ];
    scene
}

pub fn game(scene: &Scene) -> Game {
    game_with(scene, Options::default())
}

pub fn game_with(scene: &Scene, options: Options) -> Game {
    Game::new(Maze::from_scene(scene).unwrap(), options).unwrap()
}

/// Plays until an event happens, at most for `seconds`; returns the events.
pub fn until_event(game: &mut Game, steering: Steering, seconds: f64) -> Vec<GameEvent> {
    for _ in 0..(seconds / game.frame_time()) as usize {
        let events = game.step(steering).unwrap().to_vec();
        if !events.is_empty() {
            return events;
        }
    }
    Vec::new()
}

/// Plays for this time \[s\].
pub fn play(game: &mut Game, steering: Steering, seconds: f64) {
    for _ in 0..(seconds / game.frame_time()).round() as usize {
        game.step(steering).unwrap();
    }
}
