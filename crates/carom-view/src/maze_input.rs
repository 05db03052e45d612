//! What a player does in a frame of the maze, in steps that a link can hold.

use carom_maze::{Steering, Tilt};

use crate::input_log::Input;

/// Steps from level to the full tilt.
const STEPS: f64 = 64.0;

/// What a player does in a frame, and the options that hold in it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MazeInput {
    /// Whether the maze turns towards a tilt, else it turns as by keys.
    towards: bool,
    /// About the x and z axes: steps of the full tilt, or 1, 0, -1 by keys.
    about: [i8; 2],
    /// Whether the ball rolls by friction.
    pub rolls: bool,
    /// Whether the maze turns back to level when nothing steers it.
    pub levels_back: bool,
}

impl MazeInput {
    /// Rounds a steering; a full tilt has the angle `most` \[rad\].
    pub fn of(steering: Steering, most: f64, [rolls, levels_back]: [bool; 2]) -> Self {
        let (towards, about) = match steering {
            Steering::Turn { about_x, about_z } => (false, [about_x, about_z]),
            Steering::Towards(Tilt { about_x, about_z }) => {
                (true, [about_x, about_z].map(|angle| STEPS * angle / most))
            }
        };
        // A number too large for the steps becomes the largest.
        Self { towards, about: about.map(|part| part.round() as i8), rolls, levels_back }
    }

    /// Returns the rounded steering; a full tilt has the angle `most` \[rad\].
    pub fn steering(self, most: f64) -> Steering {
        let [about_x, about_z] = self.about.map(f64::from);
        if self.towards {
            let [about_x, about_z] = [about_x, about_z].map(|steps| steps / STEPS * most);
            return Steering::Towards(Tilt { about_x, about_z });
        }
        Steering::Turn { about_x, about_z }
    }
}

impl Input for MazeInput {
    fn write(self) -> String {
        let [x, z] = self.about;
        let kind = if self.towards { "T" } else { "" };
        let rolls = if self.rolls { "R" } else { "" };
        let stays = if self.levels_back { "" } else { "S" };
        format!("{kind}{x},{z}{rolls}{stays}")
    }

    fn read(text: &str) -> Option<Self> {
        let (numbers, levels_back) = ends_with(text, "S");
        let (numbers, rolls) = ends_with(numbers, "R");
        let (towards, numbers) = match numbers.strip_prefix('T') {
            Some(numbers) => (true, numbers),
            None => (false, numbers),
        };
        let (x, z) = numbers.split_once(',')?;
        let about = [x.parse().ok()?, z.parse().ok()?];
        let input = Self { towards, about, rolls, levels_back: !levels_back };
        (input.write() == text).then_some(input)
    }
}

/// Returns a text without its ending, and whether it had it.
fn ends_with<'a>(text: &'a str, ending: &str) -> (&'a str, bool) {
    text.strip_suffix(ending).map_or((text, false), |rest| (rest, true))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_come_back_from_their_text_and_steer_alike() {
        let most = 20.0_f64.to_radians();
        let tilt = Tilt { about_x: 0.37 * most, about_z: -most };
        let steerings = [Steering::NONE, Steering::roll(1.0, -1.0), Steering::Towards(tilt)];
        for steering in steerings {
            for options in [[false, true], [true, true], [true, false]] {
                let input = MazeInput::of(steering, most, options);
                assert_eq!(MazeInput::read(&input.write()), Some(input));
                let again = MazeInput::of(input.steering(most), most, options);
                assert_eq!(again, input, "{steering:?}");
            }
        }
        let rounded = MazeInput::of(Steering::Towards(tilt), most, [false, true]);
        let Steering::Towards(found) = rounded.steering(most) else { panic!("{rounded:?}") };
        assert!((found.about_x - tilt.about_x).abs() < most / STEPS, "{found:?}");
        assert_eq!(found.about_z, tilt.about_z);
    }

    #[test]
    fn other_texts_are_no_inputs() {
        for text in ["", "1", "1,", "x,1", "1,2,3", "T1", "1,200", "01,0", "1,0SR", "1,0 R", "+1,0"]
        {
            assert_eq!(MazeInput::read(text), None, "{text:?}");
        }
    }
}
