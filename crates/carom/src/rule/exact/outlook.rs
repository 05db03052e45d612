//! What lies ahead of a sphere.

use super::neighbour::MAX_SPHERES;

/// What a sphere meets next, in 16 bytes, for each sphere keeps two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Event {
    /// On the world's clock \[s\].
    pub time: f64,
    pub target: Target,
    /// Number of the other sphere's flight for which this was predicted.
    pub flights: u32,
}

impl Event {
    const NEVER: Self = Self { time: f64::INFINITY, target: Target::RESTART, flights: 0 };
    /// One that would have to be looked for: it stands before all others.
    const UNKNOWN: Self = Self { time: f64::NEG_INFINITY, ..Self::NEVER };

    /// Whether it never comes.
    pub fn is_never(&self) -> bool {
        self.time == f64::INFINITY
    }
}

/// What a sphere meets next, and what else it would meet next if that did not come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ahead {
    pub first: Event,
    pub second: Event,
}

impl Ahead {
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
pub(super) enum Upon {
    /// Another sphere, by slot.
    Sphere(u32),
    Surface(u32),
    /// The forces of its lasting contacts have to be found anew.
    Cluster,
    /// Nothing: its flight begins anew from where it is.
    Restart,
}

/// The same in four bytes: the slot of a sphere, a surface's number with the highest bit set (there
/// is no memory for so many surfaces that it was set before), or one of the numbers below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Target(u32);

impl Target {
    const SURFACE: u32 = 1 << 31;
    /// No slot: these are smaller.
    pub const CLUSTER: Self = Self(MAX_SPHERES as u32);
    pub const RESTART: Self = Self(MAX_SPHERES as u32 + 1);

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
    pub fn upon(self) -> Upon {
        match self {
            Self(surface) if surface & Self::SURFACE != 0 => {
                Upon::Surface(surface & !Self::SURFACE)
            }
            Self::CLUSTER => Upon::Cluster,
            Self::RESTART => Upon::Restart,
            Self(slot) => Upon::Sphere(slot),
        }
    }
}

/// What happens next to a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Next {
    Event(Event),
    /// It leaves its neighbourhood at this time \[s\].
    Departure(f64),
}

/// What lies ahead of a sphere: events, and a departure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outlook {
    pub ahead: Ahead,
    /// When it leaves its neighbourhood, on the world's clock \[s\].
    pub departure: f64,
}

impl Outlook {
    /// The first event.
    #[inline(always)]
    pub fn event(&self) -> Event {
        self.ahead.first
    }

    /// When the first of it happens, on the world's clock \[s\].
    #[inline(always)]
    pub fn time(&self) -> f64 {
        // Never NaN: to ask for that, as `min` does, takes longer than all the rest.
        if self.departure < self.ahead.first.time { self.departure } else { self.ahead.first.time }
    }

    /// What happens first.
    #[inline(always)]
    pub fn next(&self) -> Next {
        if self.departure < self.ahead.first.time {
            Next::Departure(self.departure)
        } else {
            Next::Event(self.event())
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
            assert_eq!(Target::sphere(slot).upon(), Upon::Sphere(slot));
        }
        for number in [0, 7, last, last + 1, last + 2] {
            assert_eq!(Target::surface(number).upon(), Upon::Surface(number));
        }
        assert_eq!(Target::CLUSTER.upon(), Upon::Cluster);
        assert_eq!(Target::RESTART.upon(), Upon::Restart);
    }
}
