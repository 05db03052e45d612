//! The schedule: the predictions of all spheres, in a queue by time.

use educe::Educe;
use prefetch_index::prefetch_index;

use super::prediction::{NextEvents, Prediction, UpcomingEvent};
use super::queue::{Entry, EventQueue};

/// Spheres of which a median is taken.
const SAMPLE: usize = 1_000;

/// The next event of each sphere, and the order of these events. It follows from the flights: the queue decides how
/// fast the next event is found, never what it is.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Schedule {
    /// Prediction of each sphere, by slot.
    predictions: Vec<Prediction>,
    queue: EventQueue,
}

impl Schedule {
    /// The schedule of these predictions, by slot, of the spheres at these indices of the world's
    /// arrays. What comes after the `horizon`, on the world's clock \[s\], is not queued.
    pub fn new(predictions: Vec<Prediction>, index_of: &[u32], horizon: f64) -> Self {
        let mut queue = EventQueue::new(predictions.len());
        for (slot, (prediction, &index)) in (0..).zip(predictions.iter().zip(index_of)) {
            if prediction.time() <= horizon {
                queue.push(Entry { time: prediction.time(), slot, index });
            }
        }
        Self { predictions, queue }
    }

    /// What a sphere meets next.
    #[inline(always)]
    pub fn next_events(&self, slot: u32) -> NextEvents {
        self.predictions[slot as usize].events
    }

    /// The next events of a sphere, and when it leaves its neighbour region.
    #[inline(always)]
    pub fn prediction(&self, slot: u32) -> Prediction {
        self.predictions[slot as usize]
    }

    /// Puts the next event of a sphere, which is at an `index` of the world's arrays, back into the queue.
    pub fn put_back(&mut self, slot: u32, index: u32) {
        let time = self.predictions[slot as usize].time();
        self.queue.push(Entry { time, slot, index });
    }

    /// When the first event of all comes, on the world's clock \[s\], and the median of the next events of a sample of
    /// the spheres.
    pub fn first_and_median(&self) -> [f64; 2] {
        let times = || self.predictions.iter().map(Prediction::time);
        let first = times().fold(f64::INFINITY, f64::min);
        let mut sample: Vec<f64> = times().step_by(times().len() / SAMPLE + 1).collect();
        if sample.is_empty() {
            return [first; 2];
        }
        let middle = sample.len() / 2;
        [first, *sample.select_nth_unstable_by(middle, f64::total_cmp).1]
    }

    /// When a sphere crosses the boundary of its neighbour region, on the world's clock \[s\].
    #[inline(always)]
    pub fn cell_crossing(&self, slot: u32) -> f64 {
        self.predictions[slot as usize].cell_crossing
    }

    /// What happens first to a sphere.
    #[inline(always)]
    pub fn first(&self, slot: u32) -> UpcomingEvent {
        self.predictions[slot as usize].first()
    }

    /// Enters the prediction of a sphere, which is at an `index` of the world's arrays.
    #[inline]
    pub fn enter(&mut self, slot: u32, index: u32, prediction: Prediction) {
        self.predictions[slot as usize] = prediction;
        self.queue.push(Entry { time: prediction.time(), slot, index });
    }

    /// Takes out what happens next, not later than `end` \[s\], with the slot of the sphere.
    #[inline]
    pub fn pop(&mut self, end: f64) -> Option<(u32, UpcomingEvent)> {
        let Entry { slot, .. } = self.queue.pop(end, |entry| is_live(&self.predictions, entry))?;
        Some((slot, self.first(slot)))
    }

    /// Drops void entries of the queue if there are too many of them.
    pub fn tidy(&mut self) {
        self.queue.tidy(|entry| is_live(&self.predictions, entry));
    }

    /// The slot of a sphere whose event is among the next, but for those that were entered last.
    #[inline]
    pub fn upcoming(&self, place: usize) -> Option<u32> {
        self.queue.upcoming(place)
    }

    /// Fetches the prediction of a sphere into the cache.
    #[inline(always)]
    pub fn prefetch(&self, slot: u32) {
        prefetch_index(&self.predictions, slot as usize);
    }
}

/// Whether an entry of the queue still holds what happens next to its sphere.
fn is_live(predictions: &[Prediction], entry: &Entry) -> bool {
    predictions[entry.slot as usize].time() == entry.time
}
