//! Inputs of a game frame by frame, kept to play the game again.

use carom_session::MAX_MOVES;

/// What a player presses in a frame, and its text, one word.
pub trait Input: Copy + PartialEq {
    /// Writes the input.
    fn write(self) -> String;

    /// Reads an input that [`Self::write`] wrote; `None` for any other text.
    fn read(text: &str) -> Option<Self>;
}

/// The inputs of a game, as runs of frames with equal input.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InputLog<I> {
    runs: Vec<(u32, I)>,
}

impl<I: Input> InputLog<I> {
    /// Adds the input of a frame.
    pub fn push(&mut self, input: I) {
        match self.runs.last_mut() {
            Some((frames, last)) if *last == input && *frames < u32::MAX => *frames += 1,
            _ => self.runs.push((1, input)),
        }
    }

    /// Writes each run as its number of frames and its input, in a line; `None` if the text is too long for a link.
    pub fn to_text(&self) -> Option<String> {
        let mut text = String::new();
        for (frames, input) in &self.runs {
            text += &format!("{frames} {}\n", input.write());
            if text.len() > MAX_MOVES {
                return None;
            }
        }
        Some(text)
    }

    /// Reads a log; `None` for a text that is none.
    pub fn from_text(text: &str) -> Option<Self> {
        let run = |line: &str| {
            let (frames, input) = line.split_once(' ')?;
            Some((frames.parse().ok()?, I::read(input)?))
        };
        Some(Self { runs: text.lines().map(run).collect::<Option<_>>()? })
    }

    /// Returns the inputs, frame by frame.
    pub fn into_frames(self) -> impl Iterator<Item = I> + 'static
    where
        I: 'static,
    {
        let repeated = |(frames, input)| (0..frames).map(move |_: u32| input);
        self.runs.into_iter().flat_map(repeated)
    }
}

#[cfg(test)]
mod tests {
    use carom_pinball::Keys;

    use super::*;

    fn log(frames: &[(u32, Keys)]) -> InputLog<Keys> {
        let mut log = InputLog::default();
        for (count, keys) in frames {
            (0..*count).for_each(|_| log.push(*keys));
        }
        log
    }

    const BOTH: Keys = Keys { left: true, right: true, plunger: false };
    const PLUNGER: Keys = Keys { left: false, right: false, plunger: true };

    #[test]
    fn inputs_come_back_from_their_text_frame_by_frame() {
        let log = log(&[(2, PLUNGER), (3, Keys::NONE), (1, BOTH)]);
        let text = log.to_text().expect("a short text");
        assert_eq!(text, "2 P\n3 -\n1 LR\n");
        let read = InputLog::<Keys>::from_text(&text).expect("its own text");
        let none = Keys::NONE;
        assert_eq!(read, log);
        let frames: Vec<Keys> = read.into_frames().collect();
        assert_eq!(frames, [PLUNGER, PLUNGER, none, none, none, BOTH]);
    }

    #[test]
    fn other_texts_are_no_logs_and_long_ones_are_not_written() {
        for text in ["2", "2 X", "P 2", "-1 P", "4294967296 P", "2 P\n\n", "2  P"] {
            assert_eq!(InputLog::<Keys>::from_text(text), None, "{text:?}");
        }
        // However many frames a text asks for, it is read at once.
        let endless = InputLog::<Keys>::from_text("4294967295 P\n0 L").expect("a log");
        assert_eq!(endless.into_frames().nth(1_000_000), Some(PLUNGER));
        let nervous: Vec<(u32, Keys)> =
            (0..MAX_MOVES).map(|i| (1, if i % 2 == 0 { BOTH } else { PLUNGER })).collect();
        assert_eq!(log(&nervous).to_text(), None);
    }
}
