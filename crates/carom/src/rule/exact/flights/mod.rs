//! Flights: where every sphere flies since its last event, and what equal spheres share.

mod at_time;
mod between;
mod body;
mod clusters;
mod components;
mod contact_work;
mod curve;
mod curve_contacts;
mod curves;
mod edge_crossing;
mod flight_log;
mod free_field;
mod friction_choice;
mod friction_state;
mod growth;
mod held_over;
mod image_beside;
mod joint_field;
mod lanes;
mod logging;
mod moving_surface;
mod radii;
mod rotation;
mod species;
mod state;
mod support_change;
mod tie;
mod time_in_wells;
mod touched;
mod wells;

pub(super) use at_time::{first_lost, write_motion};
pub(super) use body::Body;
pub(super) use clusters::{Cluster, RingSide, Support, Supported};
pub(super) use components::Component;
pub(super) use contact_work::ContactWork;
pub(super) use curve_contacts::{
    ContactSphere, CurveBody, CurveContact, CurveContacts, MOST_CONTACTS, Moving,
};
pub(super) use curves::{JointStep, StepLimits};
pub(crate) use flight_log::{
    Arrival, FlightLog, GroupImpact, JointFlight, StruckMember, StruckTouch,
};
pub(super) use growth::Growth;
pub(super) use lanes::FlightLanes;
pub(super) use moving_surface::MovingSurface;
pub(super) use rotation::{Rotation, write_spin};
pub(super) use species::Species;
pub(super) use state::Flights;
pub(crate) use support_change::{HeldMotion, SupportChange};
pub(super) use wells::Wells;
