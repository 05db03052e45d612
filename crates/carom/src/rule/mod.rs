//! Step rules: how the stages are put together to advance all spheres by one frame.

mod bisect;
mod discrete;
pub(crate) mod exact;
mod islands;

use islands::Islands;

use crate::bodies::Motion;
use crate::detect::contact::Contact;
use crate::detect::contacts::Search;
use crate::interval::Interval;
use crate::report::StepReport;
use crate::system::System;

/// How a frame is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Rule {
    /// The course's rule: move every sphere by the frame, then answer what overlaps at its end.
    ///
    /// Fast, but contacts are found late, and a sphere that crosses a surface within a frame
    /// passes through it.
    Discrete,
    /// The tutorial's rule: where spheres intersect at the end of the frame, wind them back, find
    /// the time of contact by bisection, answer it there and go on with the rest of the frame.
    ///
    /// A contact that begins and ends within a frame is still missed.
    Bisect(Bisect),
    /// Carom's own rule: spheres fly in closed form from one event to the next, and every impact
    /// happens at its own time, however many there are in a frame and however fast they are. A
    /// frame only says when to look.
    Exact(Exact),
}

impl Default for Rule {
    fn default() -> Self {
        Self::Exact(Exact::default())
    }
}

/// Parameters of the rule `exact`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exact {
    /// How long a contact lasts at least \[s\], > 0. Two bodies that would be back in contact sooner,
    /// under the forces that press them together, stay in contact; and an impact of two spheres that
    /// both were hit within that time gives nothing back, unless it is elastic. So no sequence of ever
    /// shorter bounces stops the clock. A contact lasts longer where bounces of that length cannot be
    /// resolved: `docs/physics.md`, "Contact duration".
    pub contact_duration: f64,
    /// Work of one sphere in a frame: its impacts, other events of its flight, and the work of the
    /// groups it is in, in units of an impact. More is refused as an error, so that a step ends within
    /// seconds.
    pub max_impacts: u32,
}

impl Default for Exact {
    fn default() -> Self {
        Self {
            // A bounce of this length under gravity is 1e-20 m high, far below the rounding of a
            // position, and yet it is far above the rounding of a clock that shows hours.
            contact_duration: 1e-10,
            // More than a sphere at a third of the speed of light needs between walls 1 m apart in a
            // sixtieth of a second; some seconds of work.
            max_impacts: 5_000_000,
        }
    }
}

/// Parameters of the rule `bisect`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bisect {
    /// Surfaces at most this far apart, or overlapping by at most this, touch \[m\].
    pub tolerance: f64,
    /// Halvings of the (rest of the) frame in search of a contact; the error in its time is at
    /// most the frame divided by two to this power.
    pub max_halvings: u32,
    /// How often two bodies may meet in a frame. Bodies at rest on each other would meet without
    /// end; at the bound, their group takes the rest of the frame in one piece.
    pub max_impacts: u32,
    /// Which spheres go through the pieces into which a contact cuts the frame.
    pub wind_back: WindBack,
}

impl Default for Bisect {
    fn default() -> Self {
        Self {
            // Far above rounding in a scene of metres, far below anything one could see.
            tolerance: 1e-9,
            max_halvings: 8,
            max_impacts: 32,
            wind_back: WindBack::Touched,
        }
    }
}

/// Which spheres go through the pieces into which a contact cuts the frame.
///
/// The choice is between two errors of the integrator's order; without forces they agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WindBack {
    /// Those that take part in a contact of the same group. The others take the frame in one
    /// piece, undisturbed by impacts elsewhere, and the work is proportional to the contacts.
    #[default]
    Touched,
    /// All, as the tutorial does. The work grows with spheres times contacts.
    All,
}

/// Working memory of the rules, kept from step to step only to spare its allocation.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    near: Vec<u32>,
    search: Search,
    contacts: Vec<Contact>,
    islands: Islands,
    bisect: bisect::Buffers,
}

/// Advances all spheres by one frame.
pub(crate) fn step(
    system: &System,
    motion: &mut Motion,
    frame: Interval,
    scratch: &mut Scratch,
    report: &mut StepReport,
) {
    match system.settings.rule {
        Rule::Discrete => discrete::step(system, motion, frame, scratch, report),
        Rule::Bisect(parameters) => {
            bisect::step(system, parameters, motion, frame, scratch, report);
        }
        // It keeps flights from frame to frame: see `State::advance_exactly`.
        Rule::Exact(_) => {}
    }
}
