//! Pinball in a window of `minifb`: left and right raise the flippers, Backspace goes back, Escape ends.
//! `cargo run` in this folder.

mod table;

use std::time::Instant;

use carom::{DVec3, Pose, Shape};
use minifb::{Key, Window, WindowOptions};

use table::{FRAME, SIZE, Sound, Table};

/// Pixels for a metre.
const SCALE: f64 = 800.0;
const WIDTH: usize = (SIZE[0] * SCALE) as usize;
const HEIGHT: usize = (SIZE[1] * SCALE) as usize;
/// Most frames that a picture waits for: after a pause the game goes on where it was.
const MOST_FRAMES: u32 = 10;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut window = Window::new("Pinball", WIDTH, HEIGHT, WindowOptions::default())?;
    window.set_target_fps(60);
    let mut table = Table::new()?;
    let mut pixels = vec![0; WIDTH * HEIGHT];
    let mut before = table.ball().0;
    // Time that has passed and is not yet stepped [s].
    let (mut clock, mut owed) = (Instant::now(), 0.0);
    while window.is_open() && !window.is_key_down(Key::Escape) {
        owed += clock.elapsed().as_secs_f64();
        clock = Instant::now();
        for _ in 0..MOST_FRAMES {
            if owed < FRAME {
                break;
            }
            owed -= FRAME;
            if window.is_key_down(Key::Backspace) {
                table.go_back(2);
            }
            before = table.ball().0;
            for sound in table.step([Key::Left, Key::Right].map(|key| window.is_key_down(key)))? {
                play(&sound);
            }
        }
        owed = owed.min(FRAME);
        let (now, radius) = table.ball();
        // A new ball does not fly in from the drain.
        let part = if now.distance(before) < 0.1 { owed / FRAME } else { 1.0 };
        draw(&table, &mut pixels, before.lerp(now, part), radius);
        window.set_title(&format!("Pinball: {} points", table.score));
        window.update_with_buffer(&pixels, WIDTH, HEIGHT)?;
    }
    Ok(())
}

/// A terminal has one sound; a game plays a sample for each kind.
fn play(sound: &Sound) {
    if !matches!(sound, Sound::Wall) {
        print!("\x07");
    }
}

/// Draws the table with the ball at a place between two frames.
fn draw(table: &Table, pixels: &mut [u32], ball: DVec3, radius: f64) {
    for (number, pixel) in pixels.iter_mut().enumerate() {
        let [x, y] = [number % WIDTH, number / WIDTH].map(|it| (it as f64 + 0.5) / SCALE);
        let place = DVec3::new(x - 0.5 * SIZE[0], SIZE[1] - y, 0.0);
        let mut colliders = table.world.colliders().map(|(_, it)| it);
        let inside = colliders.find(|it| !it.trigger && is_inside(&it.shape, it.pose, place));
        *pixel = match inside {
            _ if place.distance(ball) < radius => 0xF2_F2_F2,
            Some(collider) if collider.kick > 0.0 => 0xE0_5A_47,
            Some(_) => 0x4F_8A_C9,
            None => 0x16_1C_2B,
        };
    }
}

/// Whether a solid of the table covers a place.
fn is_inside(shape: &Shape, pose: Pose, place: DVec3) -> bool {
    let local = pose.rotation.inverse() * (place - pose.position);
    match shape {
        Shape::Sphere { radius } => local.length() < *radius,
        Shape::Box { size } => local.abs().cmplt(0.5 * *size).all(),
        Shape::Capsule { radius, length } => {
            let end = local.y.clamp(-0.5 * length, 0.5 * length);
            local.distance(DVec3::new(0.0, end, 0.0)) < *radius
        }
        _ => false,
    }
}
