//! A thread that moves a session by its own clock.

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

/// Work between two looks at what was sent: commands and new views come at least so often, frames
/// permitting.
const SLICE: Duration = Duration::from_millis(8);

/// A view that was not taken is renewed only so often: a view that is not taken is not drawn.
const UNSEEN: Duration = Duration::from_millis(33);

/// On the way elsewhere, a view so often shows how far it has come.
const PROGRESS: Duration = Duration::from_millis(100);

/// The other end of the thread.
#[derive(Debug)]
pub(crate) struct Worker {
    shared: Arc<Shared>,
    thread: JoinHandle<()>,
    /// When the view was made that was taken last.
    view_made: Instant,
}

/// What both threads see.
#[derive(Debug, Default)]
struct Shared {
    /// Set while something waits that a frame at work must not hold up.
    stops_frame: Arc<AtomicBool>,
    inbox: Mutex<Inbox>,
    has_mail: Condvar,
    outbox: Mutex<Outbox>,
    /// Since when the thread is at work, while it is.
    at_work: Mutex<Option<Instant>>,
}

#[derive(Debug, Default)]
struct Inbox {
    queue: Queue,
    is_closed: bool,
}

/// Views go to and fro, so that their memory is used again.
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

    /// Takes the newest view, if there is a new one.
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

    /// For how long the thread has been at work without looking up \[s\].
    pub fn seconds_at_work(&self) -> f64 {
        let since = lock(&self.shared.at_work).filter(|_| !self.thread.is_finished());
        since.map_or(0.0, |since| since.elapsed().as_secs_f64())
    }

    /// Seconds since the view was made that was taken last.
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

/// What the thread does until the other end is dropped.
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
    /// Sleeps until there is work or mail, and hands over the mail. Returns whether to go on.
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

    /// Whether it is time for a new view.
    fn is_view_due(&self, player: &Player, published: Instant) -> bool {
        let age = published.elapsed();
        if !player.has_news() || (player.is_seeking() && age < PROGRESS) {
            return false;
        }
        age >= UNSEEN || lock(&self.outbox).newest.is_none()
    }

    /// Puts a view where it is found; returns another one to fill.
    fn publish(&self, view: Box<View>) -> Box<View> {
        let mut outbox = lock(&self.outbox);
        let unseen = outbox.newest.replace((view, Instant::now()));
        unseen.map(|(view, _)| view).or_else(|| outbox.spare.take()).unwrap_or_default()
    }
}

/// Longest sleep without a look at the clock.
const LONGEST_SLEEP: Duration = Duration::from_secs(3600);

/// Time to sleep before there is something to do; `None` for ever.
fn time_to_work(player: &Player, published: Instant) -> Option<Duration> {
    let work = player.seconds_to_work().map(|seconds| {
        // A time too long for a duration is too long to sleep, too.
        Duration::try_from_secs_f64(seconds).unwrap_or(LONGEST_SLEEP).min(LONGEST_SLEEP)
    });
    let news = player.has_news().then(|| UNSEEN.saturating_sub(published.elapsed()));
    match (work, news) {
        (Some(work), Some(news)) => Some(work.min(news)),
        (work, news) => work.or(news),
    }
}

/// What the other thread left when it panicked is whole: it is only moved in and out.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
