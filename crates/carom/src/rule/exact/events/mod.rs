//! Events: what each sphere meets next, and which sphere's next event comes first.

mod prediction;
mod queue;
mod schedule;

pub(super) use prediction::{
    Event, EventTarget, NextEvents, PackedTarget, Prediction, UpcomingEvent,
};
pub(super) use schedule::Schedule;
