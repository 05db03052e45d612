//! Light and surroundings of pictures: dark skies, shadows within containers, water.

use carom::{DQuat, DVec3, Pose, Shape, Sides};
use carom_render::{
    Ball, Camera, Drawing, Light, Offscreen, Pattern, Picture, Quality, add_surroundings,
};
use carom_scene::scene::{Finish, Force};

const SIZE: [u32; 2] = [400, 300];
const ASPECT: f64 = 4.0 / 3.0;

fn ball(center: DVec3, radius: f64, color: [f64; 3]) -> Ball {
    let (rotation, pattern) = (DQuat::IDENTITY, Pattern::Plain);
    Ball { center, radius, color, rotation, pattern, finish: Finish::default() }
}

fn drawn(drawing: &Drawing, camera: &Camera) -> Picture {
    let mut offscreen = Offscreen::new(SIZE, Quality::FINE).expect("a graphics driver");
    offscreen.draw(drawing, camera).expect("a picture")
}

/// Returns the pixel at a point.
fn pixel(picture: &Picture, camera: &Camera, point: DVec3) -> [u32; 3] {
    let place = camera.place(point, ASPECT).expect("before the eye");
    let x = (0.5 + 0.5 * f64::from(place.x)) * f64::from(SIZE[0]);
    let y = (0.5 - 0.5 * f64::from(place.y)) * f64::from(SIZE[1]);
    let first = 4 * (y as u32 * picture.width + x as u32) as usize;
    [0, 1, 2].map(|part| u32::from(picture.pixels[first + part]))
}

#[test]
fn the_shaded_half_of_a_ball_is_not_black_under_a_dark_sky() {
    let mut drawing = Drawing { light: Light::default().at_dusk(), ..Drawing::default() };
    drawing.light.to_sun = DVec3::X;
    let white = ball(DVec3::ZERO, 1.0, [0.9; 3]);
    drawing.balls.push(white);
    let camera = Camera::looking_at(DVec3::Z * 5.0, DVec3::ZERO, 0.8);
    let picture = drawn(&drawing, &camera);
    let [dark, bright] = [-0.5, 0.5].map(|x| pixel(&picture, &camera, DVec3::new(x, 0.3, 0.8))[1]);
    assert!(dark > 90 && bright > dark + 60, "{dark} {bright}");
}

#[test]
fn a_sky_that_is_darker_than_dusk_stays_as_it_is() {
    let night =
        Light { zenith: [0.0; 3], horizon: [0.001; 3], ground: [0.0; 3], ..Light::default() };
    assert_eq!(night.at_dusk(), night);
    assert!(Light::default().at_dusk().horizon[1] < Light::default().horizon[1]);
}

/// Shadows are compared with the same place without the ball.
#[test]
fn shadows_are_faint_on_upright_walls_of_containers_and_strong_on_their_floors() {
    let open = Sides { top: true, front: true, ..Sides::NONE };
    let shape = Shape::Container { size: DVec3::splat(2.0), open };
    let mut drawing = Drawing::default();
    drawing.add_collider(shape, Pose::at(DVec3::ZERO), [0.8; 3], false);
    let camera = Camera::looking_at(DVec3::new(0.0, 2.0, 5.0), DVec3::ZERO, 0.8);
    let shade = |to_sun: DVec3, below: DVec3| {
        let mut bare = drawing.clone();
        bare.light.to_sun = to_sun;
        let mut with = bare.clone();
        let red = ball(below + 0.7 * to_sun, 0.2, [1.0, 0.0, 0.0]);
        with.balls.push(red);
        let tone = |drawing: &Drawing| pixel(&drawn(drawing, &camera), &camera, below)[1];
        tone(&bare).saturating_sub(tone(&with))
    };
    // The ball hides neither place from the eye.
    let wall = shade(DVec3::new(0.6, 0.3, 0.74).normalize(), DVec3::new(-0.5, 0.5, -1.0));
    let floor = shade(DVec3::new(0.8, 0.6, 0.0), DVec3::new(-0.5, -1.0, 0.4));
    assert!(3 * wall < floor && floor > 40, "{wall} {floor}");
}

#[test]
fn water_shows_what_is_below_it_in_its_own_colour() {
    let camera = Camera::looking_at(DVec3::new(0.0, 6.0, 6.0), DVec3::ZERO, 0.8);
    let mut drawing = Drawing::default();
    let red = ball(DVec3::Y * -1.0, 0.5, [1.0, 0.0, 0.0]);
    drawing.balls.push(Ball { pattern: Pattern::Glowing, ..red });
    let buoyancy =
        Force::Buoyancy { density: 1000.0, surface_height: 0.0, gravity: [0.0, -9.81, 0.0] };
    add_surroundings(&[buoyancy], &[], &mut drawing);
    let picture = drawn(&drawing, &camera);
    let at = |point: DVec3| pixel(&picture, &camera, point);
    let [red, _, blue] = at(red.center);
    assert!(red > 120 && blue > 60, "{red} {blue}");
    let [red, _, blue] = at(DVec3::X * 2.0);
    assert!(blue > red + 20, "{red} {blue}");
}
