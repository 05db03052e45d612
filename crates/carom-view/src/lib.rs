//! The interface of Carom, the same for desktop window and browser.
//!
//! [`App`] is the interface; a window ([`window::open`]), a web page or a test hosts it. It shows a
//! scene, whose physics is in [`carom_session`], or a game: a maze, pinball or nine-ball. A key or a button makes an
//! [`Action`]; panels read the session's view and answer with commands.

#![warn(clippy::unwrap_used)]

mod action;
mod address;
mod aiming;
mod app;
mod billiards_screen;
mod chooser;
mod contact_forces;
mod cue_hand;
#[cfg(not(target_arch = "wasm32"))]
mod desktop;
mod exports;
mod fonts;
mod game_view;
#[cfg(feature = "gamepad")]
mod gamepad;
mod help;
mod host;
mod impact_list;
mod input_log;
mod inspector;
mod layout;
mod link_dialog;
mod look;
mod maze_input;
mod maze_screen;
mod menu;
mod naming;
mod notices;
mod orbit;
mod page;
mod pinball_screen;
mod plots;
mod projection;
mod recorder;
mod ring;
mod saved;
mod snapshot;
mod studio;
mod theme;
mod transport;
#[cfg(not(target_arch = "wasm32"))]
mod watched_file;
mod watching;
#[cfg(not(target_arch = "wasm32"))]
pub mod window;
mod written_scene;

pub use action::{Action, Group, SHORTCUTS, Shortcut};
pub use app::{App, Setup, Start};
pub use billiards_screen::BilliardsScreen;
#[cfg(not(target_arch = "wasm32"))]
pub use desktop::{Desktop, default_folder};
pub use host::{FilmMaker, Host, Inbox, ReadFile};
pub use maze_screen::MazeScreen;
pub use notices::Notices;
pub use pinball_screen::PinballScreen;
pub use watching::Watching;
