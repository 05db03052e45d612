//! Pixels of pictures match geometry and light. Any graphics driver will do, also a software one.

use std::f64::consts::PI;

use carom::{DQuat, DVec3, Pose, Shape, Sides};
use carom_render::{
    Ball, Bounds, Camera, Drawing, Framing, GpuError, Light, Offscreen, Pattern, Picture, Quality,
};
use carom_scene::scene::Finish;

const SIZE: [u32; 2] = [400, 300];
const ASPECT: f64 = 4.0 / 3.0;

fn ball(center: DVec3, radius: f64, color: [f64; 3]) -> Ball {
    let (rotation, pattern) = (DQuat::IDENTITY, Pattern::Glowing);
    Ball { center, radius, color, rotation, pattern, finish: Finish::default() }
}

fn drawn(drawing: &Drawing, camera: &Camera, quality: Quality) -> Picture {
    let mut offscreen = Offscreen::new(SIZE, quality).expect("a graphics driver");
    offscreen.draw(drawing, camera).expect("a picture")
}

fn pixel(picture: &Picture, x: u32, y: u32) -> [u8; 3] {
    let first = 4 * (y * picture.width + x) as usize;
    [picture.pixels[first], picture.pixels[first + 1], picture.pixels[first + 2]]
}

/// Returns the sum over all pixels of their part that is red, in a picture that is black elsewhere.
fn red_area(picture: &Picture) -> f64 {
    // sRGB back to light (IEC 61966-2-1).
    let light = |part: u8| (f64::from(part) / 255.0).powf(2.2);
    picture.pixels.chunks_exact(4).map(|it| light(it[0])).sum()
}

fn in_the_dark() -> Drawing {
    let black = [0.0; 3];
    Drawing {
        light: Light { zenith: black, horizon: black, ground: black, ..Light::default() },
        ..Drawing::default()
    }
}

fn camera_in_front(distance: f64) -> Camera {
    Camera::looking_at(DVec3::Z * distance, DVec3::ZERO, 0.8)
}

#[test]
fn a_ball_covers_the_ellipse_that_perspective_makes_of_it() {
    // A cone of half angle s about a direction at the angle t to the axis cuts the picture plane at
    // distance 1 in an ellipse; its half axes are (tan(t + s) - tan(t - s)) / 2 along the direction
    // and sin s / √(cos² t - sin² s) across it.
    for (aside, radius, distance) in
        [(0.0, 1.0, 5.0), (1.5, 1.0, 5.0), (0.0, 0.05, 5.0), (0.0, 1.0, 2.6)]
    {
        let mut drawing = in_the_dark();
        drawing.balls.push(ball(DVec3::new(aside, 0.0, 0.0), radius, [1.0, 0.0, 0.0]));
        let camera = camera_in_front(distance);
        let picture = drawn(&drawing, &camera, Quality::FINE);
        let (t, to_center) = (f64::atan2(aside, distance), aside.hypot(distance));
        let s = (radius / to_center).asin();
        let along = 0.5 * ((t + s).tan() - (t - s).tan());
        let across = s.sin() / (t.cos().powi(2) - s.sin().powi(2)).sqrt();
        let pixels_per_unit = 0.5 * f64::from(SIZE[1]) / (0.5 * camera.vertical_fov).tan();
        let expected = PI * along * across * pixels_per_unit * pixels_per_unit;
        let outline = 2.0 * PI * along.max(across) * pixels_per_unit;
        // Along the outline, coverage is a multiple of a quarter, and gamma is not quite 2.2.
        let error = (red_area(&picture) - expected).abs();
        assert!(
            error < 0.12 * outline,
            "{aside} {radius}: off by {error:.1} of {expected:.1} pixels"
        );
    }
}

#[test]
fn where_two_balls_interpenetrate_the_nearer_surface_is_seen() {
    let mut drawing = in_the_dark();
    drawing.balls.push(ball(DVec3::new(-0.5, 0.0, 0.0), 1.0, [1.0, 0.0, 0.0]));
    drawing.balls.push(ball(DVec3::new(0.5, 0.0, 0.0), 1.0, [0.0, 1.0, 0.0]));
    let picture = drawn(&drawing, &camera_in_front(6.0), Quality::DRAFT);
    // The balls mirror each other: the seam is the middle column.
    for y in [120, 150, 180] {
        assert_eq!(pixel(&picture, 195, y), [255, 0, 0]);
        assert_eq!(pixel(&picture, 204, y), [0, 255, 0]);
    }
}

#[test]
fn the_back_of_a_rectangle_is_told_from_its_front() {
    let mut drawing = Drawing::default();
    let shape = Shape::Rectangle { size_x: 4.0, size_z: 4.0 };
    drawing.add_collider(shape, Pose::at(DVec3::ZERO), [0.9, 0.9, 0.9], false);
    let from = |height: f64| {
        let camera = Camera::looking_at(DVec3::new(0.3, height, 0.2), DVec3::ZERO, 0.8);
        let [r, g, b] = pixel(&drawn(&drawing, &camera, Quality::DRAFT), 200, 150);
        u32::from(r) + u32::from(g) + u32::from(b)
    };
    let (front, back) = (from(4.0), from(-4.0));
    assert!(front > 2 * back, "front {front}, back {back}");
}

#[test]
fn a_wall_seen_from_within_hides_nothing() {
    let mut drawing = in_the_dark();
    drawing.balls.push(ball(DVec3::ZERO, 1.0, [1.0, 0.0, 0.0]));
    let wall = |normal: DVec3| {
        let rotation = DQuat::from_rotation_arc(DVec3::Y, normal);
        Pose { position: -2.0 * normal, rotation }
    };
    drawing.add_collider(Shape::HalfSpace, wall(DVec3::NEG_Z), [0.9, 0.9, 0.9], false);
    let picture = drawn(&drawing, &camera_in_front(6.0), Quality::DRAFT);
    assert_eq!(pixel(&picture, 200, 150), [255, 0, 0]);
}

/// Returns half-spaces with these inward normals, 2 m from the origin, and a red ball at the
/// origin.
fn room(normals: &[DVec3]) -> Drawing {
    let mut drawing = in_the_dark();
    drawing.balls.push(ball(DVec3::ZERO, 0.5, [1.0, 0.0, 0.0]));
    for normal in normals {
        let rotation = DQuat::from_rotation_arc(DVec3::Y, *normal);
        let pose = Pose { position: -2.0 * *normal, rotation };
        drawing.add_collider(Shape::HalfSpace, pose, [0.9, 0.9, 0.9], false);
    }
    let bounds = Bounds { min: DVec3::splat(-2.0), max: DVec3::splat(2.0) };
    drawing.framing = Some(Framing { whole: bounds, balls: bounds });
    drawing
}

#[test]
fn walls_of_half_spaces_make_a_room_that_ends() {
    let walls = [DVec3::Y, DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z];
    let camera = Camera::looking_at(DVec3::new(0.0, 3.0, 14.0), DVec3::ZERO, 0.6);
    for quality in [Quality::DRAFT, Quality::FINE] {
        let picture = drawn(&room(&walls), &camera, quality);
        let at = |point: DVec3| {
            let place = camera.place(point, ASPECT).expect("before the eye");
            let x = (0.5 + 0.5 * f64::from(place.x)) * f64::from(SIZE[0]);
            let y = (0.5 - 0.5 * f64::from(place.y)) * f64::from(SIZE[1]);
            pixel(&picture, x as u32, y as u32)
        };
        assert_eq!(at(DVec3::ZERO), [255, 0, 0]);
        let is_wall = |point| at(point)[1] > 20;
        assert!(is_wall(DVec3::new(1.0, 1.5, -2.0)), "the wall behind");
        assert!(is_wall(DVec3::new(-1.0, -2.0, 1.0)), "the floor");
        assert!(is_wall(DVec3::new(-2.0, 1.5, -1.0)), "the wall at the left");
        // Beyond the walls nothing of floor and walls is drawn.
        for beyond in [DVec3::new(-3.0, -2.0, -1.0), DVec3::new(3.0, -2.0, 1.0), DVec3::Y * 3.0] {
            assert_eq!(at(beyond), [0; 3], "{beyond}");
        }
    }
}

#[test]
fn a_wall_between_the_eye_and_the_balls_is_glass() {
    for shape in [
        Shape::Rectangle { size_x: 4.0, size_z: 4.0 },
        Shape::Box { size: DVec3::new(4.0, 0.1, 4.0) },
    ] {
        let mut drawing = room(&[]);
        let front = DQuat::from_rotation_arc(DVec3::Y, DVec3::Z);
        let pose = Pose { position: DVec3::Z * 2.2, rotation: front };
        drawing.add_collider(shape.clone(), pose, [0.9, 0.9, 0.9], false);
        for quality in [Quality::DRAFT, Quality::FINE] {
            let picture = drawn(&drawing, &camera_in_front(9.0), quality);
            assert_eq!(pixel(&picture, 200, 150), [255, 0, 0], "{shape:?}");
            let edge = (150..400).map(|x| pixel(&picture, x, 150)).find(|it| it[1] > 20);
            assert!(edge.is_some(), "nothing is seen of {shape:?}");
        }
        // Behind the balls it is a wall.
        let back = Pose { position: DVec3::Z * -2.2, rotation: front };
        let mut drawing = room(&[]);
        drawing.add_collider(shape.clone(), back, [0.9, 0.9, 0.9], false);
        let picture = drawn(&drawing, &camera_in_front(9.0), Quality::DRAFT);
        assert_ne!(pixel(&picture, 240, 150), [0; 3], "{shape:?}");
    }
}

#[test]
fn a_scene_without_floor_has_a_grid_on_which_balls_cast_shadows() {
    let mut drawing = Drawing { has_grid: true, ..Drawing::default() };
    let above = Ball { pattern: Pattern::Plain, ..ball(DVec3::ZERO, 0.5, [1.0, 0.0, 0.0]) };
    drawing.balls.push(above);
    let bounds = Bounds { min: DVec3::splat(-2.0), max: DVec3::splat(2.0) };
    drawing.framing = Some(Framing { whole: bounds, balls: bounds });
    let camera = Camera::looking_at(DVec3::new(0.0, 6.0, 9.0), DVec3::Y * -1.5, 0.8);
    let tones = |drawing: &Drawing, y: u32| {
        let picture = drawn(drawing, &camera, Quality::FINE);
        let row: Vec<u8> = (0..SIZE[0]).map(|x| pixel(&picture, x, y)[1]).collect();
        (row.iter().copied().min().expect("pixels"), row.iter().copied().max().expect("pixels"))
    };
    let place = camera.place(DVec3::Y * -2.0, ASPECT).expect("before the eye");
    let row = ((0.5 - 0.5 * f64::from(place.y)) * f64::from(SIZE[1])) as u32;
    let (shaded, lit) = tones(&drawing, row);
    assert!(u32::from(shaded) + 40 < u32::from(lit), "{shaded} {lit}");
    // Without the ball its grid lines remain; one of them lies on that row.
    drawing.balls.clear();
    let (line, between) = tones(&drawing, row + 8);
    assert!(u32::from(line) + 10 < u32::from(between), "{line} {between}");
}

#[test]
fn one_sees_what_a_container_holds_and_its_far_walls() {
    let mut drawing = in_the_dark();
    drawing.balls.push(ball(DVec3::ZERO, 0.5, [1.0, 0.0, 0.0]));
    let open = Sides { top: true, ..Sides::NONE };
    let shape = Shape::Container { size: DVec3::splat(2.0), open };
    drawing.add_collider(shape, Pose::at(DVec3::ZERO), [0.9, 0.9, 0.9], false);
    for quality in [Quality::DRAFT, Quality::FINE] {
        let picture = drawn(&drawing, &camera_in_front(6.0), quality);
        assert_eq!(pixel(&picture, 200, 150), [255, 0, 0]);
        let bare = drawn(&in_the_dark(), &camera_in_front(6.0), quality);
        // Beside the ball is the wall behind it.
        assert_ne!(pixel(&picture, 235, 150), pixel(&bare, 235, 150));
    }
}

#[test]
fn a_ball_shades_the_floor_away_from_the_sun() {
    let mut drawing = Drawing::default();
    let shape = Shape::Rectangle { size_x: 20.0, size_z: 20.0 };
    drawing.add_collider(shape, Pose::at(DVec3::ZERO), [0.8, 0.8, 0.8], false);
    drawing.light.to_sun = DVec3::new(1.0, 1.0, 0.0).normalize();
    let bare = drawing.clone();
    let above = ball(DVec3::new(0.0, 2.0, 0.0), 0.5, [1.0, 0.0, 0.0]);
    drawing.balls.push(Ball { pattern: Pattern::Plain, ..above });
    let camera = Camera::looking_at(DVec3::Y * 15.0, DVec3::ZERO, 0.8);
    for quality in [Quality::DRAFT, Quality::FINE] {
        let (with, without) = (drawn(&drawing, &camera, quality), drawn(&bare, &camera, quality));
        // A ball 2 m high under a sun at 45° shades the floor 2 m further along -x.
        let at = |point: DVec3| {
            let place = camera.place(point, ASPECT).expect("before the eye");
            let x = (0.5 + 0.5 * f64::from(place.x)) * f64::from(SIZE[0]);
            let y = (0.5 - 0.5 * f64::from(place.y)) * f64::from(SIZE[1]);
            let light = |picture| u32::from(pixel(picture, x as u32, y as u32)[1]);
            (light(&with), light(&without))
        };
        let (shaded, lit) = at(DVec3::new(-2.3, 0.0, 0.1));
        assert!(5 * shaded < 4 * lit, "shaded {shaded}, lit {lit}");
        let (shaded, lit) = at(DVec3::new(2.3, 0.0, 0.1));
        assert!(shaded.abs_diff(lit) <= 3, "towards the sun: {shaded} and {lit}");
    }
    // A mark glows and casts no shadow.
    drawing.balls[0].pattern = Pattern::Glowing;
    drawing.balls[0].radius = 1e-3;
    let marked = drawn(&drawing, &camera, Quality::DRAFT);
    let bare = drawn(&bare, &camera, Quality::DRAFT);
    let differing = marked.pixels.chunks(4).zip(bare.pixels.chunks(4)).filter(|(a, b)| a != b);
    assert!(differing.count() <= 4, "but for the mark itself");
}

/// The map of the sun need not reach as deep as the floor.
#[test]
fn a_single_ball_high_above_a_floor_without_end_shades_it_all_over() {
    let mut drawing = Drawing::default();
    drawing.add_collider(Shape::HalfSpace, Pose::at(DVec3::ZERO), [0.8, 0.8, 0.8], false);
    drawing.light.to_sun = DVec3::new(1.0, 1.0, 0.0).normalize();
    let camera = Camera::looking_at(DVec3::new(-5.0, 9.0, 9.0), DVec3::new(-5.0, 0.0, 0.0), 0.8);
    for quality in [Quality::DRAFT, Quality::FINE] {
        let tone = |drawing: &Drawing, x: f64| {
            let place = camera.place(DVec3::new(x, 0.0, 0.0), ASPECT).expect("before the eye");
            let x = (0.5 + 0.5 * f64::from(place.x)) * f64::from(SIZE[0]);
            let y = (0.5 - 0.5 * f64::from(place.y)) * f64::from(SIZE[1]);
            u32::from(pixel(&drawn(drawing, &camera, quality), x as u32, y as u32)[1])
        };
        let lit = tone(&drawing, -5.0);
        let mut shaded = drawing.clone();
        let above = ball(DVec3::new(0.0, 5.0, 0.0), 0.5, [1.0, 0.0, 0.0]);
        shaded.balls.push(Ball { pattern: Pattern::Plain, ..above });
        // At both sides of the middle of a shadow 1.4 m wide.
        for x in [-5.5, -5.0, -4.5] {
            let seen = tone(&shaded, x);
            assert!(5 * seen < 4 * lit, "{x}: {seen} of {lit}");
        }
    }
}

#[test]
fn a_fitted_camera_sees_every_corner_and_wastes_little() {
    let bounds = Bounds { min: DVec3::new(-3.0, 0.0, 1.0), max: DVec3::new(5.0, 2.0, 1.5) };
    for from in [DVec3::Z, DVec3::Y, DVec3::new(0.5, 0.5, 1.0), DVec3::new(-1.0, 0.1, 0.0)] {
        let camera = Camera::fitted(&bounds, from, ASPECT);
        let places = bounds.corners().map(|it| camera.place(it, ASPECT).expect("before the eye"));
        let farthest = places.iter().map(|it| it.abs().max_element()).fold(0.0, f32::max);
        assert!((0.9..=1.0).contains(&farthest), "{from}: {farthest}");
    }
}

#[test]
fn a_ray_through_a_place_meets_what_is_shown_there() {
    let camera = Camera::looking_at(DVec3::new(2.0, 3.0, 7.0), DVec3::new(1.0, 0.0, 0.0), 0.9);
    let point = DVec3::new(0.3, -0.4, 1.7);
    let place = camera.place(point, ASPECT).expect("before the eye");
    let to_point = (point - camera.position).normalize();
    // Positions have 24 bits.
    assert!((camera.ray(place, ASPECT) - to_point).length() < 1e-6);
    assert_eq!(camera.place(camera.position - camera.ahead(), ASPECT), None);
}

#[test]
fn a_hundred_thousand_balls_are_drawn_at_once() {
    let mut drawing = in_the_dark();
    for i in 0..100_000 {
        let place = |step: i32, count: i32| f64::from((i / step) % count);
        let center = DVec3::new(place(1, 100), place(100, 100), place(10_000, 10));
        drawing.balls.push(ball(center, 0.4, [1.0, 0.0, 0.0]));
    }
    let bounds = drawing.bounds().expect("there are balls");
    let picture = drawn(&drawing, &Camera::fitted(&bounds, DVec3::Z, ASPECT), Quality::DRAFT);
    assert!(red_area(&picture) > 30_000.0, "{}", red_area(&picture));
}

#[test]
fn a_picture_without_pixels_or_too_large_is_refused() {
    for size in [[0, 10], [10, 0], [1_000_000, 10]] {
        let refused = Offscreen::new(size, Quality::DRAFT).expect_err("no such picture");
        assert!(matches!(refused, GpuError::Size { .. }), "{refused}");
    }
}

/// The picture has 268 million pixels with four samples each; some devices have the memory for
/// them.
#[test]
fn a_picture_for_which_there_is_no_memory_is_refused() {
    let mut offscreen = Offscreen::new([8, 8], Quality::FINE).expect("a graphics driver");
    match offscreen.resize([16_384, 16_384]) {
        Err(GpuError::Memory { width: 16_384, height: 16_384 } | GpuError::Size { .. }) => {}
        Err(other) => panic!("{other}"),
        // The device had enough.
        Ok(()) => return,
    }
    // It draws as before.
    let drawn = offscreen.draw(&in_the_dark(), &camera_in_front(3.0)).expect("a picture");
    assert_eq!((drawn.width, drawn.height), (8, 8));
}

#[test]
fn far_from_the_origin_nothing_trembles() {
    // In 32 bits, places at 1e7 m would be a metre apart.
    let far = DVec3::splat(1e7);
    let at = |origin: DVec3| {
        let mut drawing = in_the_dark();
        drawing.balls.push(ball(origin + DVec3::new(0.25, 0.125, 0.0), 0.5, [1.0, 0.0, 0.0]));
        let camera = Camera { position: origin + DVec3::Z * 3.0, ..camera_in_front(3.0) };
        drawn(&drawing, &camera, Quality::DRAFT)
    };
    assert_eq!(at(DVec3::ZERO).pixels, at(far).pixels);
}

/// Draws a ball of this radius \[m\] and rotation in front of the camera.
fn turned_ball(radius: f64, rotation: DQuat, pattern: Pattern) -> Picture {
    let mut drawing = Drawing::default();
    let ball = ball(DVec3::ZERO, radius, [0.2, 0.45, 0.75]);
    drawing.balls.push(Ball { rotation, pattern, ..ball });
    drawn(&drawing, &camera_in_front(4.0), Quality::DRAFT)
}

#[test]
fn a_banded_ball_shows_a_turn_about_any_axis_and_a_plain_one_none() {
    let [banded, plain] =
        [Pattern::Banded, Pattern::Plain].map(|pattern| turned_ball(1.0, DQuat::IDENTITY, pattern));
    for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.6, 0.0, 0.8)] {
        let turn = DQuat::from_axis_angle(axis, 0.5 * PI);
        let turned = turned_ball(1.0, turn, Pattern::Banded);
        let differs = turned.pixels.chunks(4).zip(banded.pixels.chunks(4)).filter(|(a, b)| a != b);
        // A spot covers some 400 pixels of the ball's 25 000.
        let count = differs.count();
        assert!(count > 600, "about {axis}: {count}");
        assert_eq!(turned_ball(1.0, turn, Pattern::Plain), plain);
    }
    // The band covers at most half of its surface.
    let same = banded.pixels.chunks(4).zip(plain.pixels.chunks(4)).filter(|(a, b)| a == b).count();
    let outside = (SIZE[0] * SIZE[1]) as usize - same;
    assert!(outside < 12_500, "{outside}");
}

#[test]
fn a_banded_ball_of_a_pixel_does_not_flicker_as_it_turns() {
    // A radius of 1.2 pixels.
    let turned = |angle| turned_ball(0.0135, DQuat::from_rotation_y(angle), Pattern::Banded);
    let first = turned(0.0);
    assert_eq!(turned(0.7), first);
    assert_eq!(turned(1.5), first);
}

/// Balls of less than four pixels are drawn in a simpler way; the difference must be invisible.
#[test]
fn a_ball_looks_the_same_just_below_the_size_of_small_ones_and_above() {
    let camera = camera_in_front(5.0);
    let pixels_per_radius = 0.5 * f64::from(SIZE[1]) / (0.5 * camera.vertical_fov).tan() / 5.0;
    for quality in [Quality::DRAFT, Quality::FINE] {
        // Light per area of many balls, which averages over their position on the pixels.
        let light = |pixels: f64| {
            let mut drawing = in_the_dark();
            let radius = pixels / pixels_per_radius;
            let place = |i: i32| f64::from(i) * 0.1813;
            let balls = (-8..=8).flat_map(|i| (-6..=6).map(move |j| (place(i), place(j))));
            drawing.balls.extend(balls.map(|(x, y)| Ball {
                pattern: Pattern::Plain,
                // On a sphere about the eye, all have the same distance.
                ..ball(
                    camera.position + 5.0 * (DVec3::new(x, y, 0.0) - camera.position).normalize(),
                    radius,
                    [1.0, 0.0, 0.0],
                )
            }));
            red_area(&drawn(&drawing, &camera, quality)) / (pixels * pixels)
        };
        let [small, round] = [3.97, 4.03].map(light);
        // Round balls cover quarters of pixels along their outlines, rounded up.
        assert!((small / round - 1.0).abs() < 0.06, "{quality:?}: {small} {round}");
    }
}
