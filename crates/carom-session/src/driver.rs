//! Moves a session at the pace of a clock.

use crate::command::Command;
use crate::error::SessionError;
use crate::player::Player;
use crate::view::View;
use crate::watched::Watched;
#[cfg(not(target_arch = "wasm32"))]
use crate::worker::Worker;

/// Moves a session at the pace of a clock, obeys [`Command`]s, and publishes
/// [`View`]s. An interface owns one and calls [`Self::update`] before each picture.
#[derive(Debug)]
pub struct Driver {
    form: Form,
    view: Box<View>,
}

/// Where the work is done.
#[derive(Debug)]
enum Form {
    Inline(Box<Player>),
    #[cfg(not(target_arch = "wasm32"))]
    Threaded(Worker),
}

impl Driver {
    /// A driver that works in [`Self::update`]: for browsers and tests.
    pub fn inline(watched: impl Into<Watched>) -> Self {
        let mut player = Player::new(watched.into());
        let mut view = Box::<View>::default();
        player.fill(&mut view);
        Self { form: Form::Inline(Box::new(player)), view }
    }

    /// A driver that works on a thread of its own, by its own clock: frames do not wait for
    /// pictures, nor pictures for frames. `on_news` is called there whenever there is a new view.
    /// The thread ends when the driver is dropped, after the frame under way.
    ///
    /// # Errors
    /// [`SessionError::Thread`] if no thread can be had.
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

    /// Sends a command. It is obeyed after those sent before.
    ///
    /// # Errors
    /// [`SessionError::Busy`] if too many wait, [`SessionError::Ended`] if the driver has ended;
    /// the command is not taken then.
    pub fn send(&mut self, command: Command) -> Result<(), SessionError> {
        match &mut self.form {
            Form::Inline(player) => player.queue.push(command),
            #[cfg(not(target_arch = "wasm32"))]
            Form::Threaded(worker) => worker.send(command),
        }
    }

    /// Brings the view up to date. In place: obeys what was sent and takes the frames that are due
    /// now that `wall_seconds` have gone by since the last call, at least one piece of work, until
    /// `time_is_up`. With a thread: takes the newest view. Returns whether the view is a new one.
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

    /// What there is to see, as of the last [`Self::update`].
    pub fn view(&self) -> &View {
        &self.view
    }

    /// Seconds until [`Self::update`] has work to do, if no command is sent; `None` for never, as
    /// with a thread, which does it and then says that it has news.
    pub fn seconds_to_work(&self) -> Option<f64> {
        match &self.form {
            Form::Inline(player) => player.seconds_to_work(),
            #[cfg(not(target_arch = "wasm32"))]
            Form::Threaded(_) => None,
        }
    }

    /// For how long the thread has been at work without looking up \[s\]: much of it is one long frame. 0
    /// where there is no thread, or it sleeps.
    pub fn seconds_at_work(&self) -> f64 {
        match &self.form {
            Form::Inline(_) => 0.0,
            #[cfg(not(target_arch = "wasm32"))]
            Form::Threaded(worker) => worker.seconds_at_work(),
        }
    }

    /// How far a picture made now shows spheres on the way from their previous positions to their
    /// positions, in \[0, 1\].
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
