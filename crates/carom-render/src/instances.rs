//! Instances of what is drawn many times, packed for the device. Positions are relative to the eye,
//! so that 32 bits suffice however far the eye is from the origin.

use carom::{DVec3, Mesh, Shape};
use carom_scene::outline::{is_hollow, is_round};
use carom_scene::scene::Finish;

use crate::container::{self, Seen};
use crate::cutaway;
use crate::drawing::{Arrow, Ball, Drawing, Panel, Pattern, linear};
use crate::framing::Framing;
use crate::round::{self, Facet};

/// A ball: centre and radius, colour with pattern and finish, rotation.
pub(crate) type PackedBall = [f32; 12];
/// A panel: centre with kind and finish, rotation, half lengths and grid, colour and opacity.
pub(crate) type PackedPanel = [f32; 16];
/// A grid: centre, distance of its lines, and how far it reaches.
pub(crate) type PackedGrid = [f32; 8];
/// An arrow: start and width, end and head, colour.
pub(crate) type PackedArrow = [f32; 12];

/// A half-space is drawn out to this many times the larger of the scene's radius and the eye's
/// height.
const HORIZON: f64 = 60.0;

/// Kinds of panels in the shader.
const RECTANGLE: f64 = 0.0;
const BOX: f64 = 1.0;
const GROUND: f64 = 2.0;
const WALL: f64 = 3.0;
const INCLINE: f64 = 4.0;
const FACET: f64 = 5.0;
const TRIANGLE: f64 = 6.0;
const PANE: f64 = 7.0;

/// Value of the opacity for faces of which only the rims are drawn.
const RIM: f64 = -1.0;

/// Least vertical part of a half-space's normal: for ground, which goes on to the horizon, and for
/// an incline, on which balls roll down.
const LEVEL: f64 = 0.999_9;
const INCLINED: f64 = 0.05;

/// All instances of a drawing, and the number of panels of each kind.
#[derive(Debug, Default)]
pub(crate) struct Instances {
    /// First balls of glass, the farthest first; then small balls; then all others.
    pub balls: Vec<PackedBall>,
    /// Number of balls of glass, and number of small balls.
    pub glass_balls: usize,
    pub small_balls: usize,
    /// Rectangles and half-spaces.
    pub faces: Vec<PackedPanel>,
    pub boxes: Vec<PackedPanel>,
    pub arrows: Vec<PackedArrow>,
    /// The grid below a scene without ground.
    pub grid: Option<PackedGrid>,
    /// Number of balls, faces and boxes that cast shadows; they come first.
    pub casting: [usize; 3],
}

impl Instances {
    /// Packs a drawing seen from `eye`. `framing` sets how far half-spaces reach; `sharpness` is
    /// the number of pixels that a length of 1 m covers at a distance of 1 m.
    pub fn pack(&mut self, drawing: &Drawing, eye: DVec3, framing: &Framing, sharpness: f64) {
        let Self { balls, glass_balls, small_balls, faces, boxes, arrows, grid, casting } = self;
        balls.clear();
        faces.clear();
        boxes.clear();
        arrows.clear();
        // Shadow casters come first: neither marks nor translucent surfaces are among them.
        let is_mark = |ball: &&Ball| ball.pattern == Pattern::Glowing;
        let packed = |ball| packed_ball(ball, eye);
        let is_glass = |ball: &&Ball| ball.finish == Finish::Glass && !is_mark(ball);
        balls.extend(drawing.balls.iter().filter(is_glass).map(packed));
        *glass_balls = balls.len();
        balls.sort_by(|a, b| tangent_squared(b).total_cmp(&tangent_squared(a)));
        let is_opaque = |ball: &&Ball| !is_mark(ball) && !is_glass(ball);
        let is_small = |ball: &&Ball| {
            ball.radius * sharpness < small_radius(ball) * (ball.center - eye).length()
        };
        let opaque = || drawing.balls.iter().filter(is_opaque);
        balls.extend(opaque().filter(is_small).map(packed));
        let small = &mut balls[*glass_balls..];
        small.sort_by(|a, b| distance_squared(a).total_cmp(&distance_squared(b)));
        *small_balls = small.len();
        balls.extend(opaque().filter(|ball| !is_small(ball)).map(packed));
        casting[0] = balls.len();
        balls.extend(drawing.balls.iter().filter(is_mark).map(packed));
        let may_hide = |it: &&Panel| it.opacity == 1.0 && !drawing.keeps_whole;
        let is_hiding = |it: &&Panel| may_hide(it) && cutaway::hides(it, eye, &framing.balls);
        let is_solid = |it: &&Panel| it.opacity == 1.0 && !is_hiding(it);
        let solid = drawing.panels.iter().filter(is_solid);
        solid.for_each(|panel| add_panel(panel, eye, faces, boxes));
        casting[1..].copy_from_slice(&[faces.len(), boxes.len()]);
        let clear = drawing.panels.iter().filter(|it| it.opacity < 1.0).cloned();
        let hiding = drawing.panels.iter().filter(is_hiding);
        let rims = hiding.map(|panel| Panel { opacity: RIM, ..panel.clone() });
        clear.chain(rims).for_each(|panel| add_panel(&panel, eye, faces, boxes));
        for panel in &drawing.panels {
            add_walls(panel, eye, faces);
            add_round_walls(panel, eye, faces);
            add_half_space(panel, eye, framing, faces);
        }
        arrows.extend(drawing.arrows.iter().map(|arrow| packed_arrow(arrow, eye)));
        let has_ground = drawing.panels.iter().any(bears_balls);
        *grid = (drawing.has_grid && !has_ground).then(|| packed_grid(eye, framing));
    }
}

/// Returns the radius in pixels below which a ball is small: its shape, its pattern and the
/// softness of its shadows are invisible.
fn small_radius(ball: &Ball) -> f64 {
    match ball.pattern {
        Pattern::Plain => 4.0,
        _ => 1.6,
    }
}

/// Returns the squared length of a tangent from the eye to a ball. Of two balls that do not
/// overlap, the one with the shorter tangent is never behind the other.
fn tangent_squared(ball: &PackedBall) -> f32 {
    distance_squared(ball) - ball[3] * ball[3]
}

/// Returns the squared distance of a ball's centre from the eye.
fn distance_squared(&[x, y, z, ..]: &PackedBall) -> f32 {
    x * x + y * y + z * z
}

/// Returns whether a panel is a floor or an incline without end.
fn bears_balls(panel: &Panel) -> bool {
    panel.shape == Shape::HalfSpace && panel.normal().y > INCLINED
}

fn add_panel(
    panel: &Panel,
    eye: DVec3,
    faces: &mut Vec<PackedPanel>,
    boxes: &mut Vec<PackedPanel>,
) {
    match panel.shape {
        ref shape if is_round(shape) => {
            let facets = round::facets(panel).filter(|_| !is_cut_open(panel));
            faces.extend(facets.map(|facet| packed_facet(&facet, panel, eye)));
        }
        Shape::Box { size } => boxes.push(packed_box(panel, size, eye)),
        Shape::Container { size, .. } if is_volume(panel) => {
            boxes.push(packed_box(panel, size, eye));
        }
        Shape::Rectangle { size_x, size_z } => {
            faces.push(packed_rectangle(RECTANGLE, panel, [size_x, size_z], eye));
        }
        Shape::Mesh(ref mesh) => add_triangles(panel, mesh, eye, faces),
        // Spheres are balls; half-spaces and walls of containers cast no shadows and are added
        // later.
        _ => {}
    }
}

/// Adds the triangles of a mesh.
fn add_triangles(panel: &Panel, mesh: &Mesh, eye: DVec3, faces: &mut Vec<PackedPanel>) {
    let rotation = panel.pose.rotation.normalize();
    let place = |vertex: &DVec3| panel.pose.position + rotation * *vertex - eye;
    let places: Vec<DVec3> = mesh.vertices().iter().map(place).collect();
    let packed = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|vertex| places[vertex as usize]);
        joined(&[
            four(a, TRIANGLE + finish(panel.finish)),
            four(b - a, 0.0),
            four(c - a, 0.0),
            color(panel.color, panel.opacity),
        ])
    };
    faces.extend(mesh.triangles().iter().map(packed));
}

/// Returns whether a shape is drawn as the inner side of a wall, open towards the eye.
fn is_cut_open(panel: &Panel) -> bool {
    is_hollow(&panel.shape) && !is_volume(panel)
}

/// Adds the wall of a hollow shape of revolution: the inner side where it is behind what the wall holds, elsewhere
/// only the rims. It casts no shadow, because the shadow would move with the eye.
fn add_round_walls(panel: &Panel, eye: DVec3, faces: &mut Vec<PackedPanel>) {
    if !is_cut_open(panel) {
        return;
    }
    let pack = |facet: Facet| packed_facet(&facet, panel, eye);
    faces.extend(round::facets(panel).filter(|it| !it.faces(eye)).map(|it| pack(it.turned())));
    faces.extend(round::rims(panel).map(pack));
}

/// Returns whether a container is drawn as a volume without walls, as a trigger is.
fn is_volume(container: &Panel) -> bool {
    container.opacity < 1.0 && container.finish != Finish::Glass
}

/// Adds the walls of a container. They cast no shadows, because the shadows would move with the
/// eye.
fn add_walls(panel: &Panel, eye: DVec3, faces: &mut Vec<PackedPanel>) {
    let Shape::Container { size, open } = panel.shape else { return };
    if is_volume(panel) {
        return;
    }
    for (wall, seen) in container::walls(panel, size, open, eye) {
        let Shape::Rectangle { size_x, size_z } = wall.shape else { continue };
        let opacity = match seen {
            Seen::Rim if wall.opacity == 1.0 => RIM,
            _ => wall.opacity,
        };
        faces.push(packed_rectangle(PANE, &Panel { opacity, ..wall }, [size_x, size_z], eye));
    }
}

/// Adds a half-space, unless the eye is inside it, where it would hide everything.
fn add_half_space(panel: &Panel, eye: DVec3, framing: &Framing, faces: &mut Vec<PackedPanel>) {
    if panel.shape != Shape::HalfSpace || panel.height_of(eye) < 0.0 {
        return;
    }
    let kind = match panel.normal().y {
        up if up > LEVEL => GROUND,
        up if up > INCLINED => INCLINE,
        _ => WALL,
    };
    faces.push(packed_half_space(panel, kind, eye, framing.whole.radius()));
}

fn four(vector: DVec3, last: f64) -> [f32; 4] {
    let [x, y, z] = vector.as_vec3().to_array();
    [x, y, z, last as f32]
}

fn color(color: [f64; 3], last: f64) -> [f32; 4] {
    let [r, g, b] = linear(color);
    [r, g, b, last as f32]
}

fn joined<const N: usize>(parts: &[[f32; 4]]) -> [f32; N] {
    std::array::from_fn(|i| parts[i / 4][i % 4])
}

fn packed_ball(ball: &Ball, eye: DVec3) -> PackedBall {
    let pattern = match ball.pattern {
        Pattern::Plain => 0.0,
        Pattern::Striped => 1.0,
        Pattern::Fixed => 2.0,
        Pattern::Glowing => 3.0,
        Pattern::Banded => 4.0,
    };
    joined(&[
        four(ball.center - eye, ball.radius),
        color(ball.color, pattern + finish(ball.finish)),
        ball.rotation.as_quat().to_array(),
    ])
}

/// Returns the number that a finish adds to a kind or a pattern; the shaders separate them again.
fn finish(finish: Finish) -> f64 {
    const KINDS: f64 = 8.0;
    KINDS
        * match finish {
            Finish::Satin => 0.0,
            Finish::Matte => 1.0,
            Finish::Glossy => 2.0,
            Finish::Metal => 3.0,
            Finish::Glass => 4.0,
            Finish::Wood => 5.0,
            Finish::Cloth => 6.0,
        }
}

fn packed_arrow(arrow: &Arrow, eye: DVec3) -> PackedArrow {
    joined(&[
        four(arrow.start - eye, arrow.width),
        four(arrow.end - eye, if arrow.head { 1.0 } else { 0.0 }),
        color(arrow.color, if arrow.in_front { 1.0 } else { 0.0 }),
    ])
}

fn packed_panel(
    panel: &Panel,
    center: DVec3,
    kind: f64,
    (half, grid): (DVec3, f64),
) -> PackedPanel {
    joined(&[
        four(center, kind + finish(panel.finish)),
        panel.pose.rotation.normalize().as_quat().to_array(),
        four(half, grid),
        color(panel.color, panel.opacity),
    ])
}

fn packed_facet(facet: &Facet, panel: &Panel, eye: DVec3) -> PackedPanel {
    let Facet { pose, half, curvatures: [along, around] } = *facet;
    joined(&[
        four(pose.position - eye, FACET + finish(panel.finish)),
        pose.rotation.as_quat().to_array(),
        four(DVec3::new(half[0], around, half[1]), along),
        color(panel.color, panel.opacity),
    ])
}

fn packed_rectangle(
    kind: f64,
    panel: &Panel,
    [size_x, size_z]: [f64; 2],
    eye: DVec3,
) -> PackedPanel {
    let half = 0.5 * DVec3::new(size_x, 0.0, size_z);
    let size = (half, grid_distance(2.0 * half.max_element()));
    packed_panel(panel, panel.pose.position - eye, kind, size)
}

fn packed_box(panel: &Panel, size: DVec3, eye: DVec3) -> PackedPanel {
    let size = (0.5 * size, grid_distance(size.max_element()));
    packed_panel(panel, panel.pose.position - eye, BOX, size)
}

/// Packs a half-space as a large square that follows the eye in steps of its grid: neither its edge
/// nor a jump of its lines is ever visible.
fn packed_half_space(panel: &Panel, kind: f64, eye: DVec3, radius: f64) -> PackedPanel {
    let rotation = panel.pose.rotation.normalize();
    let seen = rotation.inverse() * (eye - panel.pose.position);
    let reach = HORIZON * radius.max(seen.y.abs()).max(1e-6);
    // From the height of the eye, so that balls that fly away do not change it.
    let grid = grid_distance(2.0 * seen.y.abs());
    let below = (DVec3::new(seen.x, 0.0, seen.z) / grid).round() * grid;
    let center = panel.pose.position + rotation * below;
    let half = DVec3::new(reach, 0.0, reach);
    packed_panel(panel, center - eye, kind, (half, grid))
}

/// Packs the grid below a scene, a little below the lowest surface so that the two do not overlap.
fn packed_grid(eye: DVec3, framing: &Framing) -> PackedGrid {
    // In radii of the scene.
    const BELOW: f64 = 0.01;
    const REACH: f64 = 8.0;
    let (radius, center) = (framing.whole.radius(), framing.whole.center());
    let distance = grid_distance(4.0 * radius);
    // Lines go through the origin.
    let round = |along: f64| (along / (5.0 * distance)).round() * 5.0 * distance;
    let y = framing.whole.min.y - BELOW * radius;
    let center = DVec3::new(round(center.x), y, round(center.z));
    joined(&[four(center - eye, 0.0), [distance as f32, (REACH * radius) as f32, 0.0, 0.0]])
}

/// Returns a round distance of grid lines: about ten lines on a `length` \[m\].
fn grid_distance(length: f64) -> f64 {
    let power = 10f64.powf((length.max(1e-9) / 10.0).log10().floor());
    let rest = length / 10.0 / power;
    power
        * if rest < 1.5 {
            1.0
        } else if rest < 3.5 {
            2.0
        } else if rest < 7.5 {
            5.0
        } else {
            10.0
        }
}
