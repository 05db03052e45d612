//! Makes random descriptions such as the rules take.

use super::drawn::{Drawn, Material, Obstacle};
use super::vector::Vector;

/// Removes what a rule refuses, and what has no stable motion under it.
pub fn sensible(mut drawn: Drawn) -> Drawn {
    let is_slow = drawn.balls.iter().all(|ball| ball.velocity.iter().all(|it| it.abs() < 10.0));
    let is_heavy = drawn.balls.iter().all(|ball| ball.mass >= 0.0);
    let (is_exact, is_periodic) = (drawn.rule == "exact", drawn.around.kind == "periodic");
    // Under other rules stiff ones are not stable; and many impacts within a force tick heat light balls.
    drawn.springs = drawn.springs.filter(|_| is_exact && is_slow);
    // Held over a tick, drag throws back what is light and fast; at rest such a ball becomes fast.
    if !is_slow || !is_heavy {
        drawn.forces.retain(|it| LINEAR.iter().any(|kind| it.starts_with(kind)));
    }
    if !is_exact {
        drawn.choices.retain(|it| !it.starts_with("thermostat"));
    }
    if drawn.around.kind == "sheared" {
        drawn = if drawn.rule == "contact" { rough_in_shear(drawn) } else { alone_in_shear(drawn) };
    }
    if drawn.choices.iter().any(|it| it.starts_with("pair_potential")) {
        drawn = elastic(unlinked(drawn));
        drawn.material.non_additivity = None;
    }
    if drawn.growth.is_some() {
        drawn = growing(drawn);
    }
    if drawn.fluid.is_some() {
        drawn = filled(drawn);
    }
    if drawn.is_flat {
        drawn = flat(drawn);
    }
    if is_periodic {
        // Such gravity has no end there.
        drawn.forces.retain(|it| !it.starts_with("mutual"));
    }
    // What stands in the middle leaves no room.
    if drawn.emitter.is_some() {
        drawn.obstacles.clear();
    }
    drawn
}

/// Reduces a world to balls without forces, which may be rough in shear under the rule `contact`.
fn rough_in_shear(mut drawn: Drawn) -> Drawn {
    drawn.choices.retain(|it| !it.starts_with("pair_potential"));
    (drawn.springs, drawn.emitter) = (None, None);
    drawn.forces.clear();
    drawn.obstacles.clear();
    drawn.has_floor = false;
    drawn
}

/// Reduces a world to smooth balls without forces, which alone may be sheared under the rule `exact`.
fn alone_in_shear(drawn: Drawn) -> Drawn {
    let mut drawn = unlinked(drawn);
    drawn.choices.retain(|it| !it.starts_with("pair_potential"));
    drawn.forces.clear();
    drawn.obstacles.clear();
    drawn.has_floor = false;
    drawn
}

/// Reduces a world to balls that grow within their enclosure.
fn growing(drawn: Drawn) -> Drawn {
    let mut drawn = elastic(alone_in_shear(drawn));
    drawn.choices.retain(|it| !it.starts_with("thermostat"));
    (drawn.around.velocity, drawn.around.spin) = (None, None);
    drawn.around.parts.clear();
    if drawn.around.kind == "sheared" {
        drawn.around.kind = "periodic";
    }
    drawn
}

/// Reduces a world to a dense fluid in a box at rest, or a periodic one.
fn filled(mut drawn: Drawn) -> Drawn {
    drawn.balls.clear();
    drawn.obstacles.clear();
    (drawn.has_floor, drawn.emitter, drawn.springs, drawn.growth) = (false, None, None, None);
    // It is made without regard to pairs.
    drawn.material.non_additivity = None;
    let around = &mut drawn.around;
    (around.turn, around.velocity, around.spin) = ([0.0; 3], None, None);
    around.parts.clear();
    if drawn.is_flat {
        around.kind = "periodic";
    } else if around.kind != "periodic" && around.kind != "sheared" {
        around.kind = "container";
    }
    drawn
}

/// Makes all impacts elastic.
fn elastic(mut drawn: Drawn) -> Drawn {
    let (law, law_of_balls) = (None, None);
    drawn.material =
        Material { restitution: 1.0, law, law_of_balls, has_pair: false, ..drawn.material };
    drawn
}

/// Reduces a world to smooth balls under gravity at most, as wells need.
fn unlinked(mut drawn: Drawn) -> Drawn {
    drawn.rule = "exact";
    drawn.forces.retain(|it| it.starts_with("gravity"));
    (drawn.springs, drawn.emitter) = (None, None);
    let Material { restitution, law, law_of_balls, non_additivity, .. } = drawn.material;
    let (rolling, spinning) = (None, None);
    drawn.material = Material {
        restitution,
        law,
        has_pair: false,
        law_of_balls,
        non_additivity,
        friction: None,
        rolling,
        spinning,
        tangential: None,
    };
    drawn.balls.iter_mut().for_each(|ball| ball.spin = None);
    drawn
}

/// Moves everything into the plane z = 0, in which balls are discs.
fn flat(mut drawn: Drawn) -> Drawn {
    let in_plane = |[x, y, _]: Vector| [x, y, 0.0];
    let about_z = |[_, _, z]: Vector| [0.0, 0.0, z];
    let leads_out = |it: &str| !IN_PLANE.iter().any(|kind| it.starts_with(kind));
    for force in drawn.forces.iter_mut().filter(|it| leads_out(it)) {
        *force = "gravity = { acceleration = [0.5, -8.0, 0.0] }".to_owned();
    }
    drawn.forces.dedup();
    let around = &mut drawn.around;
    if around.kind == "half-spaces" {
        around.kind = "container";
    }
    around.turn = about_z(around.turn);
    around.velocity = around.velocity.map(in_plane);
    around.spin = around.spin.map(about_z);
    around.parts.clear();
    drawn.obstacles.retain(|it| !OUT_OF_PLANE.iter().any(|kind| it.shape.starts_with(kind)));
    for obstacle in &mut drawn.obstacles {
        let Obstacle { position, turn, velocity, spin, parts, belt, .. } = obstacle;
        (*position, *turn) = (in_plane(*position), about_z(*turn));
        (*velocity, *spin) = (velocity.map(in_plane), spin.map(about_z));
        *belt = belt.map(in_plane);
        parts.clear();
    }
    for ball in &mut drawn.balls {
        (ball.place, ball.velocity) = (in_plane(ball.place), in_plane(ball.velocity));
        ball.spin = ball.spin.map(about_z);
    }
    drawn
}

/// Forces in the plane z = 0 on what moves there.
const IN_PLANE: [&str; 4] =
    ["viscous-drag", "point-attractor", "mutual-gravity", "quadratic-drag = { density = 1.2 }"];

/// Shapes without a plane of symmetry at z = 0.
const OUT_OF_PLANE: [&str; 3] = ["{ mesh", "{ height-field", "{ track"];

/// Forces under which flights have a closed form.
const LINEAR: [&str; 2] = ["gravity", "constant"];
