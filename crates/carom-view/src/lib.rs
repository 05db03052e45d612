//! The interface of Carom, one for desktop window and browser.

#![warn(clippy::unwrap_used)]

pub mod session;
