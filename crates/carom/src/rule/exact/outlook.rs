//! What lies ahead of a sphere.

use super::neighbour::MAX_SPHERES;

/// What a sphere meets next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Event {
    /// On the world's clock \[s\].
    pub time: f64,
    pub target: Target,
    /// Number of the other sphere's flight for which this was predicted.
    pub flights: u32,
}

impl Event {
    pub const NEVER: Self = Self { time: f64::INFINITY, target: Target::Restart, flights: 0 };
    /// One that would have to be looked for: it stands before all others.
    const UNKNOWN: Self = Self { time: f64::NEG_INFINITY, ..Self::NEVER };
}

/// What a sphere meets next, and what else it would meet next if that did not come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ahead {
    pub first: Event,
    pub second: Event,
}

impl Ahead {
    pub const NOTHING: Self = Self { first: Event::NEVER, second: Event::NEVER };

    /// One event, where it is not known what comes if it does not.
    pub fn only(first: Event) -> Self {
        Self { first, second: Event::UNKNOWN }
    }

    /// What is left if the first does not come, as far as it is known.
    pub fn without_first(self) -> Option<Self> {
        (self.second.time > f64::NEG_INFINITY).then(|| Self::only(self.second))
    }

    /// Takes in an event that may come, too.
    #[inline(always)]
    pub fn add(&mut self, event: Event) {
        if event.time < self.first.time {
            (self.first, self.second) = (event, self.first);
        } else if event.time < self.second.time {
            self.second = event;
        }
    }
}

/// What a sphere comes upon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    /// Another sphere, by slot.
    Sphere(u32),
    Surface(u32),
    /// The forces of its lasting contacts have to be found anew.
    Cluster,
    /// Nothing: its flight begins anew from where it is.
    Restart,
}

/// What happens next to a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Next {
    Event(Event),
    /// It leaves its neighbourhood at this time \[s\].
    Departure(f64),
}

/// What lies ahead of a sphere, in little memory, for each sphere has one: events, and a departure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outlook {
    first: PackedEvent,
    second: PackedEvent,
    /// When it leaves its neighbourhood, on the world's clock \[s\].
    pub departure: f64,
}

/// An event in 16 bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PackedEvent {
    /// On the world's clock \[s\].
    time: f64,
    target: PackedTarget,
    flights: u32,
}

impl PackedEvent {
    #[inline(always)]
    fn of(Event { time, target, flights }: Event) -> Self {
        Self { time, target: PackedTarget::of(target), flights }
    }

    #[inline(always)]
    fn unpacked(self) -> Event {
        Event { time: self.time, target: self.target.unpacked(), flights: self.flights }
    }
}

impl Outlook {
    #[inline(always)]
    pub fn new(Ahead { first, second }: Ahead, departure: f64) -> Self {
        Self { first: PackedEvent::of(first), second: PackedEvent::of(second), departure }
    }

    #[inline(always)]
    pub fn ahead(&self) -> Ahead {
        Ahead { first: self.event(), second: self.second.unpacked() }
    }

    /// The first event.
    #[inline(always)]
    pub fn event(&self) -> Event {
        self.first.unpacked()
    }

    /// When the first of it happens, on the world's clock \[s\].
    #[inline(always)]
    pub fn time(&self) -> f64 {
        // Never NaN: to ask for that, as `min` does, takes longer than all the rest.
        if self.departure < self.first.time { self.departure } else { self.first.time }
    }

    /// What happens first.
    #[inline(always)]
    pub fn next(&self) -> Next {
        if self.departure < self.first.time {
            Next::Departure(self.departure)
        } else {
            Next::Event(self.event())
        }
    }
}

/// A target in four bytes: the slot of a sphere, a surface's number with the highest bit set (there
/// is no memory for so many surfaces that it was set before), or one of the numbers below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct PackedTarget(u32);

impl PackedTarget {
    const SURFACE: u32 = 1 << 31;
    /// No slot: these are smaller.
    const CLUSTER: Self = Self(MAX_SPHERES as u32);
    const RESTART: Self = Self(MAX_SPHERES as u32 + 1);

    #[inline(always)]
    fn of(target: Target) -> Self {
        match target {
            Target::Sphere(slot) => Self(slot),
            Target::Surface(surface) => Self(surface | Self::SURFACE),
            Target::Cluster => Self::CLUSTER,
            Target::Restart => Self::RESTART,
        }
    }

    #[inline(always)]
    fn unpacked(self) -> Target {
        match self {
            Self(surface) if surface & Self::SURFACE != 0 => {
                Target::Surface(surface & !Self::SURFACE)
            }
            Self::CLUSTER => Target::Cluster,
            Self::RESTART => Target::Restart,
            Self(slot) => Target::Sphere(slot),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outlook_gives_back_the_event_it_was_made_of() {
        let last = MAX_SPHERES as u32 - 1;
        let spheres = [0, last].map(Target::Sphere);
        let others = [Target::Surface(0), Target::Surface(7), Target::Cluster, Target::Restart];
        for (number, target) in (0u32..).zip(spheres.into_iter().chain(others)) {
            let event = Event { time: f64::from(number), target, flights: number };
            let ahead = Ahead { first: event, second: Event { time: 9.0, ..event } };
            let outlook = Outlook::new(ahead, 2.0);
            assert_eq!((outlook.ahead(), outlook.event()), (ahead, event));
            assert_eq!(outlook.next() == Next::Event(event), event.time <= 2.0);
        }
    }
}
