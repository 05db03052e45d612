//! What surrounds the bodies of a scene: the grid below it, the water in it, or space with orbits.

use carom::{DVec3, Pose, Shape};
use carom_scene::scene::{Color, Finish, Force};

use crate::drawing::{Drawing, Panel, luminance};
use crate::orbits::{self, Body};

/// Colour and opacity of water.
const WATER: Color = [0.35, 0.62, 0.80];
const WATER_OPACITY: f64 = 0.5;

/// Backgrounds into which orbits fade: a dark and a light sky.
const DARK_SKY: f64 = 0.10;
const LIGHT_SKY: f64 = 0.90;

/// Luminance above which a sky is light.
const LIGHT: f32 = 0.2;

/// Adds what surrounds a scene with these forces to a drawing of its surfaces and balls, which has
/// its light: the level surface of each fluid, and either a grid below the scene or, where nothing
/// but attraction acts and there are no surfaces, the orbits of the bodies.
pub fn add_surroundings<'a>(
    forces: impl IntoIterator<Item = &'a Force>,
    bodies: &[Body],
    drawing: &mut Drawing,
) {
    let forces: Vec<&Force> = forces.into_iter().collect();
    let is_in_space = is_space(&forces) && drawing.panels.is_empty();
    drawing.has_grid = !is_in_space;
    if is_in_space {
        let is_light = luminance(drawing.light.horizon) > LIGHT;
        let sky = if is_light { LIGHT_SKY } else { DARK_SKY };
        drawing.arrows.extend(orbits::lines(&forces, bodies, [sky; 3]));
    }
    drawing.panels.extend(forces.into_iter().filter_map(water));
}

/// Returns whether only bodies and points attract: nothing falls down.
fn is_space(forces: &[&Force]) -> bool {
    let attracts = |force: &&Force| {
        matches!(force, Force::PointAttractor { .. } | Force::MutualGravity { .. })
    };
    !forces.is_empty() && forces.iter().all(attracts)
}

/// Returns the surface of the fluid of a force, which has no shore; `None` without a fluid.
fn water(force: &Force) -> Option<Panel> {
    let Force::Buoyancy { surface_height, density, .. } = force else { return None };
    (*density > 0.0).then(|| Panel {
        shape: Shape::HalfSpace,
        pose: Pose::at(DVec3::Y * *surface_height),
        color: WATER,
        finish: Finish::Glass,
        opacity: WATER_OPACITY,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRAVITY: Force = Force::Gravity { acceleration: [0.0, -9.81, 0.0] };
    const ATTRACTION: Force =
        Force::PointAttractor { position: [0.0; 3], gravitational_parameter: 1.0, softening: 0.0 };

    fn surrounded(forces: &[Force]) -> Drawing {
        let mut drawing = Drawing::default();
        let body =
            Body { position: DVec3::X, velocity: DVec3::Z, mass: 1.0, color: [1.0, 0.0, 0.0] };
        add_surroundings(forces, &[body], &mut drawing);
        drawing
    }

    #[test]
    fn only_bodies_that_nothing_but_attraction_moves_have_orbits_and_no_ground() {
        let space = surrounded(&[ATTRACTION]);
        assert!(!space.has_grid && !space.arrows.is_empty());
        for forces in [&[][..], &[GRAVITY], &[GRAVITY, ATTRACTION]] {
            let ground = surrounded(forces);
            assert!(ground.has_grid && ground.arrows.is_empty());
        }
    }

    #[test]
    fn water_lies_at_its_height() {
        let water =
            Force::Buoyancy { density: 1000.0, surface_height: 0.4, gravity: [0.0, -9.81, 0.0] };
        let drawing = surrounded(&[GRAVITY, water]);
        let [surface] = &drawing.panels[..] else { panic!("{:?}", drawing.panels) };
        assert_eq!((surface.pose.position, surface.normal()), (DVec3::Y * 0.4, DVec3::Y));
        assert!(surface.opacity < 1.0);
    }
}
