//! A scene being watched: its world, its past, and what is measured on the way.
