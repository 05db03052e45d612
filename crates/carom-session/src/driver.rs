//! Runs a session at the pace of a clock.

use crate::command::Command;
use crate::error::SessionError;
use crate::player::Player;
use crate::view::View;
use crate::watched::Watched;
#[cfg(not(target_arch = "wasm32"))]
use crate::worker::Worker;

/// Runs a session at the pace of a clock, executes [`Command`]s and publishes [`View`]s. An
/// interface owns a driver and calls [`Self::update`] before each picture.
#[derive(Debug)]
pub struct Driver {
    form: Form,
    view: Box<View>,
}

/// Whether the session runs in the caller's thread or in its own.
#[derive(Debug)]
enum Form {
    Inline(Box<Player>),
    #[cfg(not(target_arch = "wasm32"))]
    Threaded(Worker),
}

impl Driver {
    /// Creates a driver that works inside [`Self::update`], for browsers and tests.
    pub fn inline(watched: impl Into<Watched>) -> Self {
        let mut player = Player::new(watched.into());
        let mut view = Box::<View>::default();
        player.fill(&mut view);
        Self { form: Form::Inline(Box::new(player)), view }
    }

    /// Creates a driver with its own thread and clock, so that frames and pictures do not wait for
    /// each other. The thread calls `on_news` for each new view, and ends after the current frame
    /// when the driver is dropped.
    ///
    /// # Errors
    /// [`SessionError::Thread`] if the thread cannot be started.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn threaded(
        watched: impl Into<Watched>,
        on_news: Box<dyn Fn() + Send>,
    ) -> Result<Self, SessionError> {
        let mut player = Player::new(watched.into());
        let mut view = Box::<View>::default();
        player.fill(&mut view);
        Ok(Self { form: Form::Threaded(Worker::start(player, on_news)?), view })
    }

    /// Sends a command, which is executed after those sent before.
    ///
    /// # Errors
    /// [`SessionError::Busy`] if too many commands wait, [`SessionError::Ended`] if the driver has
    /// ended; the command is then discarded.
    pub fn send(&mut self, command: Command) -> Result<(), SessionError> {
        match &mut self.form {
            Form::Inline(player) => player.queue.push(command),
            #[cfg(not(target_arch = "wasm32"))]
            Form::Threaded(worker) => worker.send(command),
        }
    }

    /// Updates the view and returns whether it is new. Without a thread, it executes waiting
    /// commands and takes the frames that are due after `wall_seconds` since the last call: at
    /// least one piece of work, then more until `time_is_up`. With a thread, it receives the newest
    /// view.
    pub fn update(&mut self, wall_seconds: f64, mut time_is_up: impl FnMut() -> bool) -> bool {
        match &mut self.form {
            Form::Inline(player) => {
                player.update(wall_seconds, &mut time_is_up);
                let has_news = player.has_news();
                if has_news {
                    player.fill(&mut self.view);
                } else {
                    let state_hash = self.view.playback.state_hash;
                    self.view.playback = player.playback();
                    self.view.playback.state_hash = state_hash;
                }
                has_news
            }
            #[cfg(not(target_arch = "wasm32"))]
            Form::Threaded(worker) => worker.receive(&mut self.view),
        }
    }

    /// View as of the last [`Self::update`].
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Seconds until [`Self::update`] has work to do, if no command is sent. `None` if it never
    /// has, and always `None` with a thread, which calls `on_news` instead.
    pub fn seconds_to_work(&self) -> Option<f64> {
        match &self.form {
            Form::Inline(player) => player.seconds_to_work(),
            #[cfg(not(target_arch = "wasm32"))]
            Form::Threaded(_) => None,
        }
    }

    /// Time for which the thread has been working without a pause \[s\]; a large value means one
    /// long frame. Returns 0 if there is no thread or it sleeps.
    pub fn seconds_at_work(&self) -> f64 {
        match &self.form {
            Form::Inline(_) => 0.0,
            #[cfg(not(target_arch = "wasm32"))]
            Form::Threaded(worker) => worker.seconds_at_work(),
        }
    }

    /// Position of a picture made now between two frames, in \[0, 1\]: 0 shows the previous
    /// positions of spheres, 1 their positions.
    pub fn blend(&self) -> f64 {
        let playback = &self.view.playback;
        let since = match &self.form {
            Form::Inline(_) => 0.0,
            #[cfg(not(target_arch = "wasm32"))]
            Form::Threaded(worker) => worker.seconds_since_view(),
        };
        (playback.blend + playback.blend_rate * since).min(1.0)
    }
}
