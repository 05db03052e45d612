//! Finishes reflect light differently, measured in the pixels of pictures.

use std::cell::RefCell;

use carom::{DQuat, DVec3, Pose, Shape, Sides};
use carom_render::{Ball, Camera, Drawing, Offscreen, Pattern, Picture, Quality};
use carom_scene::Coat;
use carom_scene::scene::{Color, Finish};

const SIZE: [u32; 2] = [200, 200];
const ALL: [Finish; 5] =
    [Finish::Matte, Finish::Satin, Finish::Glossy, Finish::Metal, Finish::Glass];
const RED: Color = [0.8, 0.1, 0.1];
const GREEN: Color = [0.1, 0.7, 0.2];

fn ball(center: DVec3, color: Color, finish: Finish) -> Ball {
    Ball::from_sphere(center, 0.5, Coat { color, finish }, None)
}

/// Draws balls in front of the sky in every quality.
fn pictures(balls: &[Ball]) -> [Picture; 2] {
    let drawing = Drawing { balls: balls.to_vec(), ..Drawing::default() };
    [Quality::DRAFT, Quality::FINE].map(|quality| drawn(&drawing, quality))
}

thread_local! {
    /// One renderer of each quality for all pictures of a test, because starting a driver takes
    /// longer than drawing.
    static OFFSCREENS: RefCell<Vec<(Quality, Offscreen)>> = const { RefCell::new(Vec::new()) };
}

fn drawn(drawing: &Drawing, quality: Quality) -> Picture {
    let camera = Camera::looking_at(DVec3::Z * 3.0, DVec3::ZERO, 0.6);
    OFFSCREENS.with_borrow_mut(|all| {
        if all.iter().all(|it| it.0 != quality) {
            all.push((quality, Offscreen::new(SIZE, quality).expect("a graphics driver")));
        }
        let (_, offscreen) = all.iter_mut().find(|it| it.0 == quality).expect("it is there");
        offscreen.draw(drawing, &camera).expect("a picture")
    })
}

fn middle(picture: &Picture) -> [u8; 3] {
    let first = 4 * (SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize;
    std::array::from_fn(|i| picture.pixels[first + i])
}

/// Returns the largest blue value near the middle: the highlight of a red ball.
fn highlight(picture: &Picture) -> u32 {
    // The ball is half as wide as the picture.
    let [width, height] = SIZE.map(|edge| edge as usize);
    let within = |i: &usize| {
        let (x, y) = (i % width, i / width);
        (x.abs_diff(width / 2).pow(2) + y.abs_diff(height / 2).pow(2)) < (width / 5).pow(2)
    };
    (0..width * height)
        .filter(within)
        .map(|i| picture.pixels[4 * i + 2].into())
        .max()
        .expect("pixels")
}

#[test]
fn the_more_polished_a_ball_the_brighter_its_highlight() {
    for i in [0, 1] {
        let of = |finish| highlight(&pictures(&[ball(DVec3::ZERO, RED, finish)])[i]);
        let [matte, satin, glossy, ..] = ALL.map(of);
        // The difference is at least an eighth of the range, which is visible.
        assert!(matte + 30 < satin && satin + 30 < glossy, "{matte} {satin} {glossy}");
    }
}

#[test]
fn what_is_behind_shows_through_glass_alone_and_in_its_tint() {
    let behind = ball(DVec3::Z * -1.2, GREEN, Finish::Satin);
    for finish in ALL {
        let before = ball(DVec3::ZERO, RED, finish);
        // The order in the list does not matter.
        let [with, turned, without] =
            [[before, behind].as_slice(), &[behind, before], &[before]].map(pictures);
        for i in [0, 1] {
            let [with, turned, without] = [&with[i], &turned[i], &without[i]].map(middle);
            assert_eq!(with, turned, "{finish:?}");
            assert_eq!(with != without, finish == Finish::Glass, "{finish:?}");
        }
        if finish == Finish::Glass {
            let [red, green, _] = middle(&without[1]);
            assert!(red > green, "the tint: {red} {green}");
        }
    }
}

#[test]
fn a_ball_before_glass_hides_it() {
    let before = ball(DVec3::Z, GREEN, Finish::Matte);
    let behind = ball(DVec3::ZERO, RED, Finish::Glass);
    let [with, alone] = [[before, behind].as_slice(), &[before]].map(pictures);
    assert_eq!(with.map(|it| middle(&it)), alone.map(|it| middle(&it)));
}

#[test]
fn glass_shades_less_than_what_is_solid() {
    for quality in [Quality::DRAFT, Quality::FINE] {
        let light = |finish: Option<Finish>| {
            let mut drawing = Drawing::default();
            let wall = Pose {
                position: DVec3::Z * -2.0,
                rotation: DQuat::from_rotation_arc(DVec3::Y, DVec3::Z),
            };
            let shape = Shape::Rectangle { size_x: 9.0, size_z: 9.0 };
            drawing.add_collider(shape, wall, [0.8; 3], false);
            drawing.light.to_sun = DVec3::new(0.0, 0.5, 1.0).normalize();
            // Its shadow falls on the middle of the wall, which it does not hide.
            let above = DVec3::new(0.0, 1.0, 0.0);
            drawing.balls.extend(finish.map(|finish| ball(above, RED, finish)));
            middle(&drawn(&drawing, quality))[1]
        };
        let [lit, glass, solid] =
            [None, Some(Finish::Glass), Some(Finish::Matte)].map(light).map(u32::from);
        assert!(solid + 15 < glass && glass + 15 < lit, "{solid} {glass} {lit}");
    }
}

#[test]
fn a_container_of_glass_shows_what_it_holds_through_every_wall() {
    let mut drawing = Drawing::default();
    let held = Ball { pattern: Pattern::Glowing, ..ball(DVec3::ZERO, RED, Finish::Satin) };
    drawing.balls.push(held);
    let bare = drawn(&drawing, Quality::FINE);
    let shape = Shape::Container { size: DVec3::splat(1.4), open: Sides::NONE };
    let glass = Coat { color: [0.7, 0.85, 0.9], finish: Finish::Glass };
    drawing.add_collider(shape, Pose::at(DVec3::ZERO), glass, false);
    let [red, green, _] = middle(&drawn(&drawing, Quality::FINE));
    let [bare_red, bare_green, _] = middle(&bare);
    // The near wall is visible, and the ball more so.
    assert!(green > bare_green + 20, "{green} {bare_green}");
    assert!(red > green + 40 && red.abs_diff(bare_red) < 60, "{red} {green} {bare_red}");
}

/// Draws the front of a board, twice as high as wide, of this finish and half width \[m\]; the camera is
/// `away` half widths away.
fn board(finish: Finish, half: f64, away: f64) -> Picture {
    let mut drawing = Drawing::default();
    let size = half * DVec3::new(2.0, 4.0, 0.2);
    drawing.add_collider(
        Shape::Box { size },
        Pose::at(DVec3::ZERO),
        Coat { color: [0.6, 0.4, 0.25], finish },
        false,
    );
    let camera = Camera::looking_at(DVec3::Z * away * half, DVec3::ZERO, 0.6);
    let mut offscreen = Offscreen::new(SIZE, Quality::FINE).expect("a graphics driver");
    offscreen.draw(&drawing, &camera).expect("a picture")
}

/// Returns the largest change of green along the middle row, or column, within the board.
fn spread(picture: &Picture, along_row: bool) -> u8 {
    let [width, height] = SIZE.map(|edge| edge as usize);
    let greens = (width / 4..3 * width / 4).map(|i| {
        let place = if along_row { height / 2 * width + i } else { i * width + width / 2 };
        picture.pixels[4 * place + 1]
    });
    let (least, most) =
        greens.fold((u8::MAX, 0), |(least, most), it| (least.min(it), most.max(it)));
    most - least
}

#[test]
fn wood_has_grain_along_its_longer_side_and_cloth_a_weave() {
    let [matte, wood] = [Finish::Matte, Finish::Wood].map(|it| board(it, 1.0, 3.0));
    // Threads are seen near by.
    let cloth = board(Finish::Cloth, 1.0, 0.6);
    // Without texture only the light of the sky changes along the face.
    assert!(spread(&matte, true) < 6, "{}", spread(&matte, true));
    assert!(spread(&wood, true) > 20, "{}", spread(&wood, true));
    assert!(spread(&wood, true) > spread(&wood, false), "the board is longer upward");
    assert!(spread(&cloth, true) > 6, "{}", spread(&cloth, true));
}

#[test]
fn a_texture_is_as_fine_as_its_face_is_small() {
    for finish in [Finish::Wood, Finish::Cloth] {
        let [one, million] = [1.0, 1e6].map(|half| board(finish, half, 3.0));
        let differs = |(a, b): &(&u8, &u8)| a.abs_diff(**b) > 12;
        let different = one.pixels.iter().zip(&million.pixels).filter(differs).count();
        // Places are rounded to single precision.
        assert!(different < one.pixels.len() / 100, "{finish:?}: {different}");
    }
}
