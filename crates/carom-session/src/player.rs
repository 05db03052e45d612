//! Executes commands and takes due frames in small pieces of work.

use std::sync::Arc;

use carom::StopRequest;

use crate::aim::Aim;
use crate::command::Command;
use crate::edit::Edit;
use crate::error::SessionError;
use crate::pace::Pace;
use crate::queue::Queue;
use crate::session::Session;
use crate::view::{Playback, View};
use crate::watched::Watched;

/// Edits of one thing within this time are one gesture \[s\].
const GESTURE: f64 = 1.0;

/// Common part of both forms of a driver, without clock and thread.
#[derive(Debug)]
pub(crate) struct Player {
    watched: Watched,
    pace: Pace,
    pub queue: Queue,
    /// The last edit, and the time since then \[s\].
    last_edit: Option<(Edit, f64)>,
    shows_state_hash: bool,
    shows_contacts: bool,
    /// The ball that is aimed.
    aim: Option<Aim>,
    /// Ends the current frame early.
    stop_request: Option<StopRequest>,
    error: Option<Arc<SessionError>>,
    /// Whether anything changed since [`Self::fill`].
    has_news: bool,
}

impl Player {
    pub fn new(watched: Watched) -> Self {
        Self {
            watched,
            pace: Pace::new(),
            queue: Queue::default(),
            last_edit: None,
            shows_state_hash: false,
            shows_contacts: false,
            aim: None,
            stop_request: None,
            error: None,
            has_news: true,
        }
    }

    /// Sets a request that ends frames early during playback. Frames of commands are always
    /// completed, because commands are executed in order.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn set_stop_request(&mut self, request: StopRequest) {
        self.stop_request = Some(request);
    }

    /// Executes waiting commands and takes the frames that are due after `wall_seconds`: at least
    /// one piece of work, then more until `time_is_up`.
    pub fn update(&mut self, wall_seconds: f64, time_is_up: &mut dyn FnMut() -> bool) {
        if let Some((_, seconds)) = &mut self.last_edit {
            *seconds += wall_seconds;
        }
        // Time while stopped or seeking is not made up for.
        let was_playing = self.pace.is_playing() && self.watched.seeking().is_none();
        let is_done = self.obey(time_is_up);
        if is_done {
            let wall_seconds = if was_playing { wall_seconds } else { 0.0 };
            self.take_due_frames(wall_seconds, time_is_up);
        }
    }

    /// Executes waiting commands; returns whether none is left.
    fn obey(&mut self, time_is_up: &mut dyn FnMut() -> bool) -> bool {
        loop {
            let is_on_the_way = self.watched.seeking().is_some();
            match self.next_command(is_on_the_way) {
                Some(command) => self.execute(command),
                None if is_on_the_way => {
                    self.has_news = true;
                    let advanced = self.watched.advance_seek(1);
                    self.pace.show_whole_frame();
                    self.stop_on_error(advanced.map(drop));
                }
                None => return true,
            }
            if time_is_up() {
                return self.queue.is_empty() && self.watched.seeking().is_none();
            }
        }
    }

    /// Returns the next command to execute. During a seek, commands that depend on the time wait
    /// until the seek ends.
    fn next_command(&mut self, is_on_the_way: bool) -> Option<Command> {
        if !is_on_the_way {
            return self.queue.pop_if(|_| true);
        }
        let gives_up = |it: &Command| *it == Command::StopSeeking || it.is_of_any_time();
        let at_once = self.queue.take_first(gives_up);
        at_once.or_else(|| self.queue.pop_if(Command::goes_elsewhere))
    }

    fn execute(&mut self, command: Command) {
        self.has_news = true;
        match command {
            Command::Play => self.play(true),
            Command::Pause => self.pace.set_playing(false),
            Command::Speed(speed) => self.pace.set_speed(speed),
            Command::Pick(sphere) => self.watched.pick(sphere),
            Command::ShowStateHash(shows) => self.shows_state_hash = shows,
            Command::ShowContacts(shows) => self.shows_contacts = shows,
            Command::Aim(aim) => self.aim = aim,
            Command::Step => {
                self.play(false);
                let stepped = self.watched.step();
                self.stop_on_error(stepped);
                self.pace.show_whole_frame();
            }
            Command::StepBack => {
                self.play(false);
                self.go_to(self.watched.session().frame().saturating_sub(1));
            }
            Command::Restart => self.go_to(0),
            Command::Seek(time) => match self.watched.session().frame_at(time) {
                Ok(frame) => self.go_to(frame),
                Err(error) => self.error = Some(Arc::new(error)),
            },
            Command::StopSeeking => {
                let stopped = self.watched.stop_seeking();
                self.stop_on_error(stopped);
            }
            Command::Edit(edit) => {
                self.error = self.edit(edit).err().map(Arc::new);
                self.pace.show_whole_frame();
            }
            Command::EditFurther(edit) => {
                self.last_edit = None;
                self.error = self.watched.edit_further(edit).err().map(Arc::new);
                self.pace.show_whole_frame();
            }
            Command::Undo => self.revise(Watched::undo),
            Command::Redo => self.revise(Watched::redo),
            Command::RestartWithValues => self.revise(|watched| {
                watched.restart_with_values();
                true
            }),
            Command::Open(scene) => {
                let opened = Session::new(*scene).map(Watched::from);
                self.open(opened.map_err(SessionError::from));
            }
            Command::Replay(scene, link) => {
                self.open(Watched::replay(*scene, &link));
            }
            Command::Nudge(sphere, displacement) => {
                self.last_edit = None;
                let nudged = self.watched.nudge(sphere, displacement);
                self.error = nudged.err().map(Arc::new);
                self.pace.show_whole_frame();
            }
            Command::Compare(simulations) => {
                self.open(self.watched.compared(simulations.as_deref()));
            }
        }
    }

    fn edit(&mut self, edit: Edit) -> Result<(), SessionError> {
        let before = self.last_edit.take();
        let goes_on =
            before.is_some_and(|(last, seconds)| seconds < GESTURE && last.merged(&edit).is_some());
        let made = edit.clone();
        if goes_on { self.watched.edit_further(edit) } else { self.watched.edit(edit) }?;
        self.last_edit = Some((made, 0.0));
        Ok(())
    }

    /// Undoes or repeats edits.
    fn revise(&mut self, how: impl Fn(&mut Watched) -> bool) {
        self.last_edit = None;
        if how(&mut self.watched) {
            self.error = None;
            self.pace.show_whole_frame();
        }
    }

    fn play(&mut self, playing: bool) {
        self.pace.set_playing(playing);
        self.error = None;
    }

    fn go_to(&mut self, frame: u64) {
        self.error = None;
        self.watched.seek(frame);
        self.pace.show_whole_frame();
    }

    /// Opens a session; keeps the present one if that fails.
    fn open(&mut self, opened: Result<Watched, SessionError>) {
        match opened {
            Ok(watched) => {
                self.watched = watched;
                self.last_edit = None;
                self.error = None;
                self.pace.show_whole_frame();
            }
            Err(error) => self.error = Some(Arc::new(error)),
        }
    }

    /// Stops playing after an error. A frame that was interrupted waits for the command that
    /// interrupted it.
    fn stop_on_error(&mut self, result: Result<(), SessionError>) {
        if let Err(error) = result
            && !error.is_stop()
        {
            self.pace.set_playing(false);
            self.error = Some(Arc::new(error));
        }
    }

    fn take_due_frames(&mut self, wall_seconds: f64, time_is_up: &mut dyn FnMut() -> bool) {
        let due = self.pace.frames_due(wall_seconds, self.watched.session().frame_time());
        self.watched.set_stop_request(self.stop_request.clone());
        for taken in 1..=due {
            self.has_news = true;
            if let Err(error) = self.watched.step() {
                self.stop_on_error(Err(error));
                self.pace.show_whole_frame();
                break;
            }
            if time_is_up() {
                self.pace.give_back(due - taken);
                break;
            }
        }
        self.watched.set_stop_request(None);
    }

    /// Whether anything changed since [`Self::fill`].
    pub fn has_news(&self) -> bool {
        self.has_news
    }

    /// Whether a seek is under way.
    pub fn is_seeking(&self) -> bool {
        self.watched.seeking().is_some()
    }

    /// Seconds until there is work to do without a command; `None` if there never is.
    pub fn seconds_to_work(&self) -> Option<f64> {
        if self.is_seeking() || !self.queue.is_empty() {
            return Some(0.0);
        }
        self.pace.seconds_to_next_frame(self.watched.session().frame_time())
    }

    /// Copies everything that an interface shows.
    pub fn fill(&mut self, view: &mut View) {
        self.has_news = false;
        self.watched.fill(view);
        self.watched.fill_contacts(view, self.shows_contacts);
        let world = self.watched.session().world();
        view.aimed = self.aim.map_or_else(Vec::new, |aim| aim.path(world));
        view.playback = self.playback();
        let hashes = self.shows_state_hash.then(|| self.watched.state_hashes());
        view.playback.state_hash = hashes.map(|(hash, _)| hash);
        if let Some(other) = &mut view.other {
            other.playback = view.playback.clone();
            other.playback.state_hash = hashes.and_then(|(_, hash)| hash);
        }
    }

    /// State of playback.
    pub fn playback(&self) -> Playback {
        Playback {
            playing: self.pace.is_playing(),
            speed: self.pace.speed(),
            realtime_factor: self.pace.realtime_factor(),
            keeps_up: self.pace.keeps_up(),
            blend: self.pace.blend(),
            blend_rate: self.pace.blend_rate(),
            error: self.error.clone(),
            state_hash: None,
        }
    }
}
