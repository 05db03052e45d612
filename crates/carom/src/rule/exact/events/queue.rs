//! The queue of events: which sphere's next event comes first.
//!
//! A calendar queue (Brown 1988; with bounded increment, Paul, J. Comput. Phys. 221, 615, 2007):
//! events lie unsorted in buckets of time, and only the bucket at work is sorted; what comes into it
//! later goes into a small heap. What lies beyond the last bucket waits on one pile. An operation
//! takes constant time, whatever the number of events.
//!
//! Each sphere has one event at a time. When it changes, the old entry stays where it is and is
//! dropped when its turn comes, for its time is no longer the sphere's.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use educe::Educe;

/// Entries that a bucket holds on average: few enough to sort in the fastest cache, many enough
/// that buckets cost nothing.
const ENTRIES_PER_BUCKET: usize = 32;
/// Buckets of a small queue.
const MIN_BUCKETS: usize = 16;
/// Up to this many spheres, the memory of buckets is no matter.
const FEW: usize = 20_000;
/// The queue has this many times the buckets that its spheres need, so that few events lie beyond the last bucket.
const SPARE_BUCKETS: usize = 8;
/// The queue is cleared of void entries when it holds this many times what it can need.
const MAX_VOID_RATIO: usize = 2;

/// An event of a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Entry {
    /// Time on the world's clock \[s\].
    pub time: f64,
    /// The sphere, by its place in the memory of the rule.
    pub slot: u32,
    /// The same sphere, by its place in the order of ids: what is first at equal times does not
    /// depend on the memory.
    pub index: u32,
}

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.time.total_cmp(&other.time).then(self.index.cmp(&other.index))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Events in the order of time.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct EventQueue {
    /// Events of the buckets before `next_bucket`, the first one last.
    current: Vec<Entry>,
    /// Entries of the current bucket that were added since it was sorted.
    late: BinaryHeap<Reverse<Entry>>,
    /// Entries of each bucket, by its number. `bucket_of` derives the bucket of an event from its
    /// time alone.
    buckets: Vec<Vec<Entry>>,
    /// When the first bucket begins \[s\].
    start: f64,
    /// Inverse of the width of a bucket \[1/s\].
    per_second: f64,
    /// The bucket that comes after the current one.
    next_bucket: usize,
    /// Events after the last bucket.
    far: Vec<Entry>,
    len: usize,
    /// Number of spheres, which bounds the number of entries that are not void.
    spheres: usize,
}

impl EventQueue {
    /// An empty queue for this many spheres.
    pub fn new(spheres: usize) -> Self {
        let spare = if spheres <= FEW { SPARE_BUCKETS } else { 1 };
        let buckets = (spare * spheres / ENTRIES_PER_BUCKET).max(MIN_BUCKETS);
        Self {
            buckets: vec![Vec::new(); buckets],
            next_bucket: buckets,
            start: f64::NEG_INFINITY,
            per_second: 1.0,
            spheres,
            ..Self::default()
        }
    }

    /// Adds an event. One that never comes, at infinity, is forgotten.
    pub fn push(&mut self, entry: Entry) {
        if entry.time == f64::INFINITY {
            return;
        }
        self.len += 1;
        let bucket = self.bucket_of(entry.time);
        if bucket < self.next_bucket {
            self.late.push(Reverse(entry));
        } else {
            match self.buckets.get_mut(bucket) {
                Some(bucket) => bucket.push(entry),
                None => self.far.push(entry),
            }
        }
    }

    /// The number of the bucket of a time \[s\], whether there is one or not. However it rounds, a
    /// later time is never in an earlier bucket.
    #[inline]
    fn bucket_of(&self, time: f64) -> usize {
        ((time - self.start) * self.per_second) as usize
    }

    /// Takes out the first event that is not void and not later than `end` \[s\].
    pub fn pop(&mut self, end: f64, is_live: impl Fn(&Entry) -> bool) -> Option<Entry> {
        loop {
            while let Some((first, is_late)) = self.first() {
                if first.time > end {
                    return None;
                }
                if is_late {
                    self.late.pop();
                } else {
                    self.current.pop();
                }
                self.len -= 1;
                if is_live(&first) {
                    return Some(first);
                }
            }
            let is_done = self.len == 0 || self.bucket_of(end) < self.next_bucket;
            if is_done || !self.fill_current(&is_live) {
                return None;
            }
        }
    }

    /// The first entry of the current bucket, and whether it is a late one.
    #[inline]
    fn first(&self) -> Option<(Entry, bool)> {
        match (self.current.last(), self.late.peek()) {
            (Some(&sorted), Some(&Reverse(late))) if late < sorted => Some((late, true)),
            (Some(&sorted), _) => Some((sorted, false)),
            (None, Some(&Reverse(late))) => Some((late, true)),
            (None, None) => None,
        }
    }

    /// The slot of an entry that is among the next, but for those that were added late.
    #[inline]
    pub fn upcoming(&self, place: usize) -> Option<u32> {
        let place = self.current.len().checked_sub(place + 1)?;
        Some(self.current[place].slot)
    }

    /// Makes the next bucket that is not empty the current one.
    fn fill_current(&mut self, is_live: &impl Fn(&Entry) -> bool) -> bool {
        while self.next_bucket < self.buckets.len() {
            let bucket = self.next_bucket;
            self.next_bucket += 1;
            // The memory is freed, since full buckets and empty ones never have one size.
            let entries = std::mem::take(&mut self.buckets[bucket]);
            self.len -= entries.len();
            self.current.extend(entries.into_iter().filter(|entry| is_live(entry)));
            self.len += self.current.len();
            self.current.sort_unstable_by(|a, b| b.cmp(a));
            if !self.current.is_empty() {
                return true;
            }
        }
        self.begin_year(is_live)
    }

    /// Distributes the events that were beyond the last bucket over the buckets of the next year.
    fn begin_year(&mut self, is_live: &impl Fn(&Entry) -> bool) -> bool {
        let before = self.far.len();
        self.far.retain(|entry| is_live(entry));
        self.len -= before - self.far.len();
        if self.far.is_empty() {
            return false;
        }
        let mut far = std::mem::take(&mut self.far);
        // The density of the earlier half of the events sets the width.
        let middle = far.len() / 2;
        let median = far.select_nth_unstable(middle).1.time;
        let first = far[..=middle].iter().fold(median, |first, entry| entry.time.min(first));
        let per_event = (median - first) / (middle + 1) as f64;
        let width = per_event * ENTRIES_PER_BUCKET as f64;
        // Simultaneous events need no width, but the width must not be 0.
        self.per_second = width.max(f64::MIN_POSITIVE).recip();
        self.start = first;
        self.next_bucket = 0;
        // What stays far away stays in place.
        far.retain(|&entry| {
            let bucket = self.bucket_of(entry.time);
            let bucket = self.buckets.get_mut(bucket);
            bucket.map(|bucket| bucket.push(entry)).is_none()
        });
        self.far = far;
        true
    }

    /// Drops void entries if there are too many of them.
    pub fn tidy(&mut self, is_live: impl Fn(&Entry) -> bool) {
        if self.len <= MAX_VOID_RATIO * self.spheres.max(ENTRIES_PER_BUCKET * MIN_BUCKETS) {
            return;
        }
        self.current.retain(|entry| is_live(entry));
        self.late.retain(|entry| is_live(&entry.0));
        self.buckets.iter_mut().for_each(|bucket| bucket.retain(|entry| is_live(entry)));
        self.far.retain(|entry| is_live(entry));
        let waiting: usize = self.buckets.iter().map(Vec::len).sum();
        self.len = self.current.len() + self.late.len() + waiting + self.far.len();
    }
}

#[cfg(test)]
mod tests {
    //! The queue against a sorted list: proves that events come out in order, each once, none
    //! lost, with events added and changed between; not that it is fast.

    use super::*;

    #[test]
    fn gives_every_live_event_once_in_order_of_time_then_index() {
        let mut seed = 7u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 40) as f64 / (1u64 << 24) as f64
        };
        let spheres = 2000u32;
        let mut times: Vec<f64> = (0..spheres).map(|_| (8.0 * random()).floor() / 4.0).collect();
        let mut queue = EventQueue::new(times.len());
        for (slot, &time) in (0u32..).zip(&times) {
            queue.push(Entry { time, slot, index: spheres - slot });
        }
        let mut last = Entry { time: 0.0, slot: 0, index: 0 };
        for end in [0.5, 0.5, 3.0, 20.0] {
            while let Some(entry) = queue.pop(end, |entry| times[entry.slot as usize] == entry.time)
            {
                assert!(entry.time <= end && entry >= last);
                assert_eq!(entry.time, times.iter().copied().fold(f64::INFINITY, f64::min));
                last = entry;
                // It and another sphere get later events; some never any.
                for slot in [entry.slot, (entry.slot * 7 + 3) % spheres] {
                    let time = match random() {
                        part if part < 0.2 => f64::INFINITY,
                        part => entry.time + 3.0 * part * part + 1e-9,
                    };
                    times[slot as usize] = time;
                    queue.push(Entry { time, slot, index: spheres - slot });
                }
                queue.tidy(|entry| times[entry.slot as usize] == entry.time);
            }
            assert!(times.iter().all(|&time| time > end));
        }
    }
}
