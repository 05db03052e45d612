//! A maze: a scene in its own frame, with the role of each collider.

use carom::{DQuat, DVec3};
use carom_scene::Library;
use carom_scene::scene::{Collider, Color, Colors, Force, Scene, Shape, Sphere};

use crate::error::MazeError;

/// Colours of parts without a colour in the scene.
const WALL_COLOR: Color = [0.42, 0.55, 0.71];
const END_WALL_COLOR: Color = [0.80, 0.25, 0.22];
const GROUND_COLOR: Color = [0.86, 0.86, 0.84];
const COLLECTIBLE_COLOR: Color = [0.95, 0.76, 0.2];
const BALL_COLOR: Color = [0.66, 0.24, 0.52];

/// Role of a collider in the game.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// A wall that the ball bounces off.
    Wall,
    /// A wall that wins the game when the ball touches it.
    EndWall,
    /// A surface that the ball rolls on.
    Ground,
    /// A surface that faces down and keeps the ball from jumping.
    Ceiling,
    /// A part that the ball takes by touching it. The number is its index among the collectibles.
    Collectible(usize),
}

/// A level maze in its own frame: the scene, and the role of each of its colliders.
#[derive(Debug, Clone)]
pub struct Maze {
    scene: Scene,
    roles: Vec<Role>,
    start: DVec3,
    radius: f64,
    gravity: f64,
}

impl Maze {
    /// Returns the maze of the course.
    ///
    /// # Errors
    /// Only errors of a broken built-in scene.
    pub fn course() -> Result<Self, MazeError> {
        let (scene, _) = Library::new().find("maze", &[])?;
        Self::from_scene(&scene)
    }

    /// Makes a maze from a scene with one sphere, the ball. Solid colliders named "end wall" are
    /// end walls, trigger spheres and boxes are collectibles, rectangles and half-spaces that face
    /// up are ground, those that face down are ceiling, and all others are walls. Colours and
    /// camera are the scene's.
    ///
    /// The ball starts at rest on the ground below its position in the scene. The game ignores the
    /// scene's simulation settings and motion.
    ///
    /// # Errors
    /// [`MazeError`] without a ball, ground under it, gravity, or an end wall; if the ball overlaps
    /// a wall at its start; and for an invalid scene.
    pub fn from_scene(scene: &Scene) -> Result<Self, MazeError> {
        let name = || scene.name.clone();
        let count = scene.spheres.len() + scene.generators.len() + scene.emitters.len();
        let [ball] = scene.spheres.as_slice() else {
            return Err(MazeError::OneBall { scene: name(), count });
        };
        if count > 1 {
            return Err(MazeError::OneBall { scene: name(), count });
        }
        let roles = roles(&scene.colliders);
        if !roles.contains(&Role::EndWall) {
            return Err(MazeError::NoEndWall { scene: name() });
        }
        // Making a world checks all numbers of the scene.
        let mut scene = scene.clone();
        scene.simulation.allow_overlap = true;
        let ball_in_world = scene.world()?.spheres().get(0);
        let (radius, place) = (ball_in_world.radius, ball_in_world.position);
        let gravity = gravity(&scene.forces, ball_in_world.kilograms());
        if gravity <= 0.0 {
            return Err(MazeError::NoGravity { scene: name() });
        }
        let heights = scene.colliders.iter().zip(&roles).filter_map(|(collider, role)| {
            let height = ground_height(collider, place)?;
            (*role == Role::Ground && height <= place.y).then_some(height)
        });
        let ground = heights.fold(f64::NEG_INFINITY, f64::max);
        if ground == f64::NEG_INFINITY {
            return Err(MazeError::NoGround { scene: name() });
        }
        let start = DVec3::new(place.x, ground + radius, place.z);
        scene.spheres[0] =
            Sphere { position: start.to_array(), velocity: [0.0; 3], ..ball.clone() };
        scene.simulation = Default::default();
        color(&mut scene, &roles);
        for collider in &mut scene.colliders {
            (collider.velocity, collider.angular_velocity) = ([0.0; 3], [0.0; 3]);
        }
        scene.world()?;
        Ok(Self { scene, roles, start, radius, gravity })
    }

    /// Returns the title for display.
    pub fn title(&self) -> &str {
        if self.scene.title.is_empty() { &self.scene.name } else { &self.scene.title }
    }

    /// Returns the level scene with the ball at its start, with camera, sun and colours.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the role of each collider of [`Self::scene`], in the same order.
    pub fn roles(&self) -> &[Role] {
        &self.roles
    }

    /// Returns the start of the ball's centre \[m\].
    pub fn start(&self) -> DVec3 {
        self.start
    }

    /// Returns the radius of the ball \[m\].
    pub fn ball_radius(&self) -> f64 {
        self.radius
    }

    /// Returns the downward acceleration of the ball \[m/s²\], > 0.
    pub fn gravity(&self) -> f64 {
        self.gravity
    }

    /// Returns the centres of the collectibles \[m\] in order.
    pub fn collectibles(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.with_role(|role| matches!(role, Role::Collectible(_)))
            .map(|collider| DVec3::from_array(collider.position))
    }

    /// Returns centre and radius \[m\] of a sphere inside each collectible: a ball that touches the
    /// sphere touches the collectible.
    pub(crate) fn collectible_spheres(&self) -> impl Iterator<Item = (DVec3, f64)> + '_ {
        let inner = |shape: &Shape| match *shape {
            Shape::Sphere { radius } => radius,
            Shape::Box { size } | Shape::Container { size, .. } => {
                0.5 * DVec3::from_array(size).min_element()
            }
            Shape::Cylinder { radius, height } => radius.min(0.5 * height),
            Shape::Capsule { radius, .. } => radius,
            _ => 0.0,
        };
        self.with_role(|role| matches!(role, Role::Collectible(_)))
            .map(move |it| (DVec3::from_array(it.position), inner(&it.shape)))
    }

    /// Returns centre and radius \[m\] of a sphere around each collectible.
    pub(crate) fn collectible_reaches(&self) -> impl Iterator<Item = (DVec3, f64)> + '_ {
        let outer = |shape: &Shape| match *shape {
            Shape::Sphere { radius } => radius,
            Shape::Box { size } | Shape::Container { size, .. } => {
                0.5 * DVec3::from_array(size).length()
            }
            Shape::Rectangle { size_x, size_z } => 0.5 * (size_x * size_x + size_z * size_z).sqrt(),
            Shape::HalfSpace => 0.0,
            ref round => round_reach(round),
        };
        self.with_role(|role| matches!(role, Role::Collectible(_)))
            .map(move |it| (DVec3::from_array(it.position), outer(&it.shape)))
    }

    /// Returns the colliders with some roles.
    pub(crate) fn with_role(&self, is_it: fn(Role) -> bool) -> impl Iterator<Item = &Collider> {
        let both = self.scene.colliders.iter().zip(&self.roles);
        both.filter(move |(_, role)| is_it(**role)).map(|(collider, _)| collider)
    }
}

fn roles(colliders: &[Collider]) -> Vec<Role> {
    let mut collectibles = 0;
    let role = |collider: &Collider| {
        let up = up(collider).y;
        match collider.shape {
            _ if collider.trigger => {
                collectibles += 1;
                Role::Collectible(collectibles - 1)
            }
            _ if collider.name.trim().eq_ignore_ascii_case("end wall") => Role::EndWall,
            Shape::Rectangle { .. } | Shape::HalfSpace if up > 0.5 => Role::Ground,
            Shape::Rectangle { .. } if up < -0.5 => Role::Ceiling,
            _ => Role::Wall,
        }
    };
    colliders.iter().map(role).collect()
}

/// Returns the direction of a collider's own y axis.
fn up(collider: &Collider) -> DVec3 {
    let rotation = DQuat::from_array(collider.rotation);
    if rotation.length_squared() > 0.0 { rotation.normalize() * DVec3::Y } else { DVec3::Y }
}

/// Returns the downward acceleration \[m/s²\] of a ball of this mass \[kg\].
fn gravity(forces: &[Force], mass: f64) -> f64 {
    let down = forces.iter().map(|force| match force {
        Force::Constant { force } => -force[1] / mass,
        Force::Gravity { acceleration } => -acceleration[1],
        // Other forces depend on position or motion, so they are no weight.
        _ => 0.0,
    });
    down.sum()
}

/// Returns the height \[m\] of a ground above or below a position; `None` if it does not reach
/// there.
pub(crate) fn ground_height(collider: &Collider, place: DVec3) -> Option<f64> {
    let center = DVec3::from_array(collider.position);
    let normal = up(collider);
    let height = center.y - (place - center).reject_from(DVec3::Y).dot(normal) / normal.y;
    let on_it = DVec3::new(place.x, height, place.z) - center;
    let local = DQuat::from_array(collider.rotation).normalize().inverse() * on_it;
    let reaches = match collider.shape {
        Shape::Rectangle { size_x, size_z } => {
            local.x.abs() <= 0.5 * size_x && local.z.abs() <= 0.5 * size_z
        }
        Shape::HalfSpace => true,
        Shape::Disc { radius } => local.with_y(0.0).length() <= radius,
        _ => false,
    };
    reaches.then_some(height)
}

/// Sets default colours of parts without a colour.
fn color(scene: &mut Scene, roles: &[Role]) {
    let walls = scene.colors.as_ref().and_then(|colors| colors.colliders).unwrap_or(WALL_COLOR);
    for (collider, role) in scene.colliders.iter_mut().zip(roles) {
        let own = match role {
            Role::Wall | Role::Ceiling => walls,
            Role::EndWall => END_WALL_COLOR,
            Role::Ground => GROUND_COLOR,
            Role::Collectible(_) => COLLECTIBLE_COLOR,
        };
        collider.color.get_or_insert(own);
    }
    let spheres = scene.colors.as_ref().and_then(|colors: &Colors| colors.spheres);
    scene.spheres[0].color.get_or_insert(spheres.unwrap_or(BALL_COLOR));
}

/// Returns the radius of a sphere about the centre of a shape of revolution that holds the shape \[m\]; 0 for
/// other shapes.
pub(crate) fn round_reach(shape: &Shape) -> f64 {
    match *shape {
        Shape::Cylinder { radius, height: length } | Shape::Pipe { radius, length, .. } => {
            DVec3::new(radius, 0.5 * length, 0.0).length()
        }
        Shape::Cone { bottom_radius, top_radius, height }
        | Shape::Funnel { bottom_radius, top_radius, height } => {
            DVec3::new(bottom_radius.max(top_radius), 0.5 * height, 0.0).length()
        }
        Shape::Capsule { radius, length } => radius + 0.5 * length,
        Shape::Torus { ring_radius, tube_radius } => ring_radius + tube_radius,
        Shape::Disc { radius } | Shape::Bowl { radius, .. } => radius,
        _ => 0.0,
    }
}
