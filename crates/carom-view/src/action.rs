//! The actions of the interface, and their keys.

use egui::{Context, Event, Key, KeyboardShortcut, Modifiers};

/// An action that the user can request.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)] // Each is explained in the table below, which users read as well.
pub enum Action {
    Choose,
    PlayOrPause,
    Step,
    StepBack,
    Restart,
    RestartWithValues,
    Undo,
    Redo,
    Faster,
    Slower,
    Throw,
    SceneCamera,
    FrontCamera,
    TopCamera,
    Fit,
    Follow,
    Screenshot,
    Record,
    Save,
    Link,
    Inspector,
    Plots,
    Impacts,
    Velocities,
    Contacts,
    Forces,
    Compare,
    Nudge,
    Theme,
    Help,
    Close,
}

impl Action {
    fn shortcut(self) -> Option<&'static Shortcut> {
        SHORTCUTS.iter().find(|shortcut| shortcut.action == self)
    }

    /// Returns the text of the action and its keys, for display.
    pub fn hint(self) -> String {
        let said = |it: &Shortcut| format!("{} ({})", it.text, it.keys_text());
        self.shortcut().map(said).unwrap_or_default()
    }

    /// Returns the keys of the action, for display.
    pub fn keys(self) -> String {
        self.shortcut().map(Shortcut::keys_text).unwrap_or_default()
    }

    /// Returns whether the action repeats while its key is held.
    fn repeats(self) -> bool {
        matches!(self, Self::Step | Self::StepBack | Self::Faster | Self::Slower)
    }
}

/// What a key is for; the help lists keys in these groups.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Playing, and going to other times.
    Time,
    /// Cameras.
    View,
    /// Panels and marks.
    Measure,
    /// Pictures, films and links.
    Share,
    /// The window itself.
    Window,
}

impl Group {
    /// All groups, in the order of the help.
    pub const ALL: [Self; 5] = [Self::Time, Self::View, Self::Measure, Self::Share, Self::Window];

    /// Returns the heading of the group.
    pub fn title(self) -> &'static str {
        match self {
            Self::Time => "Time and edits",
            Self::View => "Camera",
            Self::Measure => "What is shown",
            Self::Share => "Share",
            Self::Window => "Window",
        }
    }
}

/// An action with its keys and its text.
#[derive(Debug, Clone, Copy)]
pub struct Shortcut {
    /// The group of the help that lists it.
    pub group: Group,
    /// The action.
    pub action: Action,
    /// The keys; each of them triggers the action.
    pub keys: &'static [KeyboardShortcut],
    /// The text for display.
    pub text: &'static str,
}

impl Shortcut {
    /// Returns the names of the keys, for display.
    pub fn keys_text(&self) -> String {
        let name = |key: &KeyboardShortcut| {
            let control = if key.modifiers.command { "Ctrl + " } else { "" };
            let shift = if key.modifiers.shift { "Shift + " } else { "" };
            format!("{control}{shift}{}", key.logical_key.symbol_or_name())
        };
        let keys: Vec<String> = self.keys.iter().map(name).collect();
        keys.join("  or  ")
    }
}

const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

const fn command(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const fn shift(key: KeyboardShortcut) -> KeyboardShortcut {
    KeyboardShortcut::new(key.modifiers.plus(Modifiers::SHIFT), key.logical_key)
}

macro_rules! shortcuts {
    ($($group:ident { $($action:ident: [$($key:expr),*], $text:literal;)* })*) => {
        /// All shortcuts, in the order of the help. Keys are compared with their modifiers first,
        /// so that Shift + Home is not Home.
        pub const SHORTCUTS: &[Shortcut] = &[$($(Shortcut {
            group: Group::$group,
            action: Action::$action,
            keys: &[$($key),*],
            text: $text,
        },)*)*];
    };
}

shortcuts! {
    Time {
        PlayOrPause: [key(Key::P)], "play or pause";
        Step: [key(Key::Period)], "one frame forward";
        StepBack: [key(Key::Comma)], "one frame back";
        Restart: [key(Key::Home)], "back to the start; edits come again at their times";
        RestartWithValues: [shift(key(Key::Home))], "back to the start, with the values set since";
        Undo: [command(Key::Z)], "take back the last edit, and go where it was made";
        Redo: [shift(command(Key::Z)), command(Key::Y)], "make the edit again that was taken back";
        Faster: [key(Key::Plus), key(Key::Equals)], "faster";
        Slower: [key(Key::Minus)], "slower";
        Throw: [key(Key::B)], "throw a new ball to where the camera looks, and pick it";
    }
    View {
        SceneCamera: [key(Key::Num1)], "the scene's camera";
        FrontCamera: [key(Key::Num2)], "camera in front";
        TopCamera: [key(Key::Num3)], "camera above";
        Fit: [key(Key::Num0)], "keep all there is in the picture, or stop doing so";
        Follow: [key(Key::F)], "follow the picked ball, or stop following";
    }
    Measure {
        Plots: [key(Key::G)], "show or hide the plots";
        Impacts: [key(Key::L)], "show or hide the list of impacts";
        Velocities: [key(Key::V)], "show or hide velocities";
        Contacts: [key(Key::K)], "show or hide contacts";
        Forces: [key(Key::C)], "show or hide contact forces";
        Compare: [key(Key::X)], "the same scene under two rules, side by side";
        Nudge: [key(Key::N)], "a copy beside it, the picked ball moved by a billionth of its radius";
    }
    Share {
        Screenshot: [key(Key::Space)], "save a picture with the time on it";
        Record: [key(Key::R)], "start or stop recording a film";
        Save: [command(Key::S)], "save the present state as a scene file";
        Link: [key(Key::U)], "a link to this run, for others";
    }
    Window {
        Choose: [key(Key::Enter)], "choose a scene";
        Inspector: [key(Key::I)], "show or hide the settings";
        Theme: [key(Key::T)], "light or dark";
        Help: [key(Key::F1), key(Key::Questionmark)], "this list";
        Close: [key(Key::Escape)], "close a dialog or a message";
    }
}

/// Name of a game, and its controls with their texts, for the help.
pub type GameControls = (&'static str, &'static [(&'static str, &'static str)]);

/// Controls of a maze.
pub const MAZE: GameControls = (
    "Maze",
    &[
        ("arrow keys, or W A S D", "tilt the maze"),
        ("right drag", "tilt the maze"),
        ("gamepad's stick", "tilt the maze"),
        ("Enter, when it is won", "play again"),
    ],
);

/// Controls of pinball.
pub const PINBALL: GameControls = (
    "Pinball",
    &[
        ("left and right arrow, or A and D", "raise a flipper"),
        ("down arrow, or S", "pull the plunger; let go to shoot"),
        (
            "a finger on the left or right half",
            "raise a flipper; pull the plunger while the ball waits",
        ),
        ("Enter, when it is over", "play again"),
    ],
);

/// Controls of nine-ball.
pub const BILLIARDS: GameControls = (
    "Nine-ball",
    &[
        ("drag from the cue ball", "aim along its path; let go to strike"),
        ("arrow keys", "strike it off its middle: side, top and bottom"),
        ("drag the cue ball in hand", "move it, after Move was chosen"),
        ("Enter, when the rack is won", "play again"),
    ],
);

/// Controls of the picture with the mouse, for the help.
pub const MOUSE: &[(&str, &str)] = &[
    ("drag", "turn the camera"),
    ("right drag, or Shift + drag", "move the camera"),
    ("wheel", "come nearer or go away"),
    ("click on a ball or surface", "pick it; beside all: pick none"),
    ("drag the picked ball", "pull it by a spring; let go to throw it"),
    ("Ctrl + drag of the picked surface", "move it across the view"),
    (
        "drag from a cue ball",
        "aim along its path; let go to strike, on the ball to put the cue away",
    ),
    ("Ctrl + click", "throw a new ball that way"),
    ("double click", "turn about what was clicked"),
    ("drop a file", "open it as a scene or maze"),
    ("one finger", "turn the camera; in a maze: tilt it"),
    ("two fingers", "move the camera, come nearer or go away; in a maze: turn it"),
];

/// Returns the actions whose keys were pressed, and consumes these keys so that no button reacts to
/// them. While a text is typed, only the key of the help counts. With `without_enter`, Enter is
/// left to others.
pub fn pressed(context: &Context, without_enter: bool) -> Vec<Action> {
    let is_typing = context.text_edit_focused();
    let is_of_use = |key: &&KeyboardShortcut| !is_typing || key.logical_key == Key::F1;
    let is_pressed = |shortcut: &&Shortcut| {
        context.input_mut(|input| {
            let is_fresh = |key: &KeyboardShortcut| {
                input.events.iter().any(|event| {
                    matches!(event, Event::Key { key: pressed, pressed: true, repeat: false, .. }
                        if *pressed == key.logical_key)
                })
            };
            // A held key repeats only actions that move in steps.
            let counts = shortcut.action.repeats() || shortcut.keys.iter().any(is_fresh);
            shortcut.keys.iter().filter(is_of_use).any(|key| input.consume_shortcut(key)) && counts
        })
    };
    let mut all: Vec<&Shortcut> =
        SHORTCUTS.iter().filter(|it| !(without_enter && it.action == Action::Choose)).collect();
    // Keys without Shift would match those with it, too.
    all.sort_by_key(|it| !it.keys.iter().any(|key| key.modifiers.shift));
    all.into_iter().filter(is_pressed).map(|it| it.action).collect()
}
