//! A thread that runs a session by its own clock.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use carom::StopRequest;

use crate::command::Command;
use crate::error::SessionError;
use crate::player::Player;
use crate::queue::Queue;
use crate::view::View;

/// Time between checks for commands and new views, unless a frame takes longer.
const SLICE: Duration = Duration::from_millis(8);

/// Time after which a view that was not received is replaced: it is not being drawn.
const UNSEEN: Duration = Duration::from_millis(33);

/// Time between views that show the progress of a seek.
const PROGRESS: Duration = Duration::from_millis(100);

/// Handle of the thread.
#[derive(Debug)]
pub(crate) struct Worker {
    shared: Arc<Shared>,
    thread: JoinHandle<()>,
    /// Time at which the last received view was made.
    view_made: Instant,
}

/// Data shared by both threads.
#[derive(Debug, Default)]
struct Shared {
    /// Set while a command waits that interrupts the current frame.
    stops_frame: Arc<AtomicBool>,
    inbox: Mutex<Inbox>,
    has_mail: Condvar,
    outbox: Mutex<Outbox>,
    /// Time since which the thread works without a pause; `None` while it sleeps.
    at_work: Mutex<Option<Instant>>,
}

#[derive(Debug, Default)]
struct Inbox {
    queue: Queue,
    is_closed: bool,
}

/// Views are passed back and forth, so that their memory is reused.
#[derive(Debug, Default)]
struct Outbox {
    newest: Option<(Box<View>, Instant)>,
    spare: Option<Box<View>>,
}

impl Worker {
    /// Starts the thread.
    pub fn start(mut player: Player, on_news: Box<dyn Fn() + Send>) -> Result<Self, SessionError> {
        let shared = Arc::new(Shared::default());
        let theirs = shared.clone();
        player.set_stop_request(StopRequest::from(shared.stops_frame.clone()));
        let builder = thread::Builder::new().name("carom session".to_owned());
        let thread = builder.spawn(move || work(player, &theirs, &on_news))?;
        Ok(Self { shared, thread, view_made: Instant::now() })
    }

    /// Sends a command.
    pub fn send(&self, command: Command) -> Result<(), SessionError> {
        if self.thread.is_finished() {
            return Err(SessionError::Ended);
        }
        let stops_frame = command.stops_frame();
        let mut inbox = lock(&self.shared.inbox);
        inbox.queue.push(command)?;
        if stops_frame {
            self.shared.stops_frame.store(true, Ordering::Relaxed);
        }
        drop(inbox);
        self.shared.has_mail.notify_one();
        Ok(())
    }

    /// Receives the newest view; returns whether there is one.
    pub fn receive(&mut self, view: &mut Box<View>) -> bool {
        if self.thread.is_finished() {
            view.playback.playing = false;
            view.playback.error = Some(Arc::new(SessionError::Ended));
        }
        let mut outbox = lock(&self.shared.outbox);
        let Some((newest, made)) = outbox.newest.take() else { return false };
        outbox.spare = Some(std::mem::replace(view, newest));
        self.view_made = made;
        true
    }

    /// Time for which the thread has been working without a pause \[s\].
    pub fn seconds_at_work(&self) -> f64 {
        let since = lock(&self.shared.at_work).filter(|_| !self.thread.is_finished());
        since.map_or(0.0, |since| since.elapsed().as_secs_f64())
    }

    /// Seconds since the last received view was made.
    pub fn seconds_since_view(&self) -> f64 {
        self.view_made.elapsed().as_secs_f64()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        lock(&self.shared.inbox).is_closed = true;
        self.shared.stops_frame.store(true, Ordering::Relaxed);
        self.shared.has_mail.notify_one();
    }
}

/// Main loop of the thread, until the handle is dropped.
fn work(mut player: Player, shared: &Shared, on_news: &dyn Fn()) {
    let mut view = Box::<View>::default();
    let mut published = Instant::now();
    let mut last = Instant::now();
    while shared.wait(&mut player, published) {
        let now = Instant::now();
        let wall_seconds = (now - last).as_secs_f64();
        last = now;
        *lock(&shared.at_work) = Some(now);
        player.update(wall_seconds, &mut || now.elapsed() >= SLICE);
        *lock(&shared.at_work) = None;
        if shared.is_view_due(&player, published) {
            player.fill(&mut view);
            view = shared.publish(view);
            published = Instant::now();
            on_news();
        }
    }
}

impl Shared {
    /// Sleeps until there is work or a command, and passes commands to the player. Returns whether
    /// to continue.
    fn wait(&self, player: &mut Player, published: Instant) -> bool {
        let mut inbox = lock(&self.inbox);
        loop {
            if inbox.is_closed {
                return false;
            }
            self.stops_frame.store(false, Ordering::Relaxed);
            let has_mail = !inbox.queue.is_empty();
            player.queue.take_from(&mut inbox.queue);
            let Some(time) = time_to_work(player, published) else {
                inbox = self.has_mail.wait(inbox).unwrap_or_else(PoisonError::into_inner);
                continue;
            };
            if has_mail || time.is_zero() {
                return true;
            }
            let waited = self.has_mail.wait_timeout(inbox, time);
            let timeout;
            (inbox, timeout) = waited.unwrap_or_else(PoisonError::into_inner);
            if timeout.timed_out() {
                return !inbox.is_closed;
            }
        }
    }

    /// Whether a new view should be published.
    fn is_view_due(&self, player: &Player, published: Instant) -> bool {
        let age = published.elapsed();
        if !player.has_news() || (player.is_seeking() && age < PROGRESS) {
            return false;
        }
        age >= UNSEEN || lock(&self.outbox).newest.is_none()
    }

    /// Publishes a view; returns another one to fill.
    fn publish(&self, view: Box<View>) -> Box<View> {
        let mut outbox = lock(&self.outbox);
        let unseen = outbox.newest.replace((view, Instant::now()));
        unseen.map(|(view, _)| view).or_else(|| outbox.spare.take()).unwrap_or_default()
    }
}

/// Longest time to sleep.
const LONGEST_SLEEP: Duration = Duration::from_secs(3600);

/// Time to sleep until there is work; `None` if there is none without a command.
fn time_to_work(player: &Player, published: Instant) -> Option<Duration> {
    let work = player.seconds_to_work().map(|seconds| {
        // A time that overflows a duration is limited as well.
        Duration::try_from_secs_f64(seconds).unwrap_or(LONGEST_SLEEP).min(LONGEST_SLEEP)
    });
    let news = player.has_news().then(|| UNSEEN.saturating_sub(published.elapsed()));
    match (work, news) {
        (Some(work), Some(news)) => Some(work.min(news)),
        (work, news) => work.or(news),
    }
}

/// Locks a mutex even after a panic of the other thread: its content is only moved in and out, so
/// it is always valid.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
