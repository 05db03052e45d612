//! The earliest predicted events of a sphere.

use crate::rule::exact::neighbours::MAX_SPHERES;

/// An event in 16 bytes; each sphere has two.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Event {
    /// Time on the world's clock \[s\].
    pub time: f64,
    pub target: PackedTarget,
    /// Generation of the other sphere's flight for which this was predicted.
    pub generation: u32,
}

impl Event {
    const NEVER: Self = Self { time: f64::INFINITY, target: PackedTarget::RESTART, generation: 0 };
    /// An event that a search still has to find: it comes before all others.
    const UNKNOWN: Self = Self { time: f64::NEG_INFINITY, ..Self::NEVER };

    /// An event at `time` \[s\] that concerns no other sphere.
    pub fn at(time: f64, target: PackedTarget) -> Self {
        Self { time, target, generation: 0 }
    }

    /// Whether it never comes.
    pub fn is_never(&self) -> bool {
        self.time == f64::INFINITY
    }
}

/// The first event of a sphere, and what comes next if the first does not happen.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct NextEvents {
    pub first: Event,
    pub second: Event,
}

impl NextEvents {
    /// A prediction without events.
    pub const NEVER: Self = Self { first: Event::NEVER, second: Event::NEVER };

    /// One event, with no knowledge of what follows if it is void.
    pub fn only(first: Event) -> Self {
        Self { first, second: Event::UNKNOWN }
    }

    /// The events without the first, as far as they are known.
    pub fn without_first(self) -> Option<Self> {
        (self.second.time > f64::NEG_INFINITY).then(|| Self::only(self.second))
    }

    /// The time \[s\] from which on a possible event changes nothing.
    #[inline(always)]
    pub fn known_until(&self) -> f64 {
        let Self { first, second } = self;
        if second.time > f64::NEG_INFINITY { second.time } else { first.time }
    }

    /// Adds a possible event.
    #[inline(always)]
    pub fn add(&mut self, event: Event) {
        if event.time < self.first.time {
            (self.first, self.second) = (event, self.first);
        } else if event.time < self.second.time {
            self.second = event;
        }
    }
}

/// What an event is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EventTarget {
    /// Another sphere, by slot.
    Sphere(u32),
    Surface(u32),
    /// The forces of its persistent contacts are computed again.
    Cluster,
    /// Nothing happens: the flight restarts from where the sphere is.
    Restart,
    /// The step of its curve ends, and another one begins.
    StepEnd,
}

/// An [`EventTarget`] in four bytes: the slot of a sphere, the number of a surface with the highest bit set (no
/// memory holds enough surfaces to set it otherwise), or one of the constants below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct PackedTarget(u32);

impl PackedTarget {
    const SURFACE: u32 = 1 << 31;
    /// Larger than every slot.
    pub const CLUSTER: Self = Self(MAX_SPHERES as u32);
    pub const RESTART: Self = Self(MAX_SPHERES as u32 + 1);
    pub const STEP_END: Self = Self(MAX_SPHERES as u32 + 2);

    #[inline(always)]
    pub fn sphere(slot: u32) -> Self {
        Self(slot)
    }

    pub fn surface(number: u32) -> Self {
        Self(number | Self::SURFACE)
    }

    /// The slot of a sphere, if it is one.
    #[inline(always)]
    pub fn slot(self) -> Option<u32> {
        (self.0 < MAX_SPHERES as u32).then_some(self.0)
    }

    #[inline(always)]
    pub fn unpacked(self) -> EventTarget {
        match self {
            Self(surface) if surface & Self::SURFACE != 0 => {
                EventTarget::Surface(surface & !Self::SURFACE)
            }
            Self::CLUSTER => EventTarget::Cluster,
            Self::RESTART => EventTarget::Restart,
            Self::STEP_END => EventTarget::StepEnd,
            Self(slot) => EventTarget::Sphere(slot),
        }
    }
}

/// What happens next to a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum UpcomingEvent {
    Event(Event),
    /// It leaves its neighbour region at this time \[s\].
    CellCrossing(f64),
}

/// The next events of a sphere, and when it leaves its neighbour region.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Prediction {
    pub events: NextEvents,
    /// Time of the cell crossing on the world's clock \[s\].
    pub cell_crossing: f64,
}

impl Prediction {
    /// When the first of it happens, on the world's clock \[s\].
    #[inline(always)]
    pub fn time(&self) -> f64 {
        let first = self.events.first.time;
        // Neither is NaN; `min`, which handles NaN, takes longer than all the rest.
        if self.cell_crossing < first { self.cell_crossing } else { first }
    }

    /// What happens first.
    #[inline(always)]
    pub fn first(&self) -> UpcomingEvent {
        if self.cell_crossing < self.events.first.time {
            UpcomingEvent::CellCrossing(self.cell_crossing)
        } else {
            UpcomingEvent::Event(self.events.first)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_gives_back_what_it_was_made_of() {
        let last = MAX_SPHERES as u32 - 1;
        for slot in [0, last] {
            assert_eq!(PackedTarget::sphere(slot).unpacked(), EventTarget::Sphere(slot));
        }
        for number in [0, 7, last, last + 1, last + 2, last + 3] {
            assert_eq!(PackedTarget::surface(number).unpacked(), EventTarget::Surface(number));
        }
        assert_eq!(PackedTarget::CLUSTER.unpacked(), EventTarget::Cluster);
        assert_eq!(PackedTarget::RESTART.unpacked(), EventTarget::Restart);
        assert_eq!(PackedTarget::STEP_END.unpacked(), EventTarget::StepEnd);
    }
}
