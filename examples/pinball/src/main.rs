//! Pinball in a window of `minifb`: the arrows raise the flippers, Space held and let go launches the ball, Backspace goes
//! back, Escape ends. `cargo run` in this folder.

mod draw;
mod table;

use std::time::Instant;

use minifb::{Key, Window, WindowOptions};

use draw::{HEIGHT, Picture, WIDTH};
use table::{FRAME, Keys, Role, Sound, Table};

/// Most frames that a picture waits for: after a pause the game goes on where it was.
const MOST_FRAMES: u32 = 12;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut window = Window::new("Pinball", WIDTH, HEIGHT, WindowOptions::default())?;
    window.set_target_fps(60);
    let mut table = Table::new()?;
    let mut picture = Picture::new(&table);
    let mut before = table.ball();
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
                table.go_back(3);
            }
            before = table.ball();
            for sound in table.step(keys(&window))? {
                play(&sound);
                picture.flash(sound.collider);
            }
        }
        owed = owed.min(FRAME);
        let now = table.ball();
        // A new ball does not fly in from the drain.
        let part = if now.distance(before) < 0.1 { owed / FRAME } else { 1.0 };
        picture.draw(&table, before.lerp(now, part));
        window.set_title(&title(&table));
        window.update_with_buffer(&picture.pixels, WIDTH, HEIGHT)?;
    }
    Ok(())
}

fn keys(window: &Window) -> Keys {
    let is_down = |keys: [Key; 2]| keys.into_iter().any(|key| window.is_key_down(key));
    Keys {
        left: is_down([Key::Left, Key::A]),
        right: is_down([Key::Right, Key::D]),
        plunger: is_down([Key::Space, Key::Down]),
    }
}

fn title(table: &Table) -> String {
    let hint = match table.balls() {
        0 => ": game over, hold Space for a new game",
        _ if table.is_ball_waiting() => ": hold Space, and let go",
        _ => "",
    };
    format!("Pinball: {} points{hint}", table.score())
}

/// A terminal has one sound; a game plays a sample for each role, as loud as the impulse is large.
fn play(sound: &Sound) {
    if sound.impulse > 0.1 || Role::of(sound.collider) != Role::Wall {
        print!("\x07");
    }
}
