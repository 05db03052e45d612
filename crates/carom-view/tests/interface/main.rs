//! The interface as a user meets it: keys, buttons, dropped and changed files, and their effects.
//! The software driver draws; the physics runs in the same thread, so that no timing matters.

mod aim;
mod aligned;
mod bar;
mod billiards;
mod card;
mod contact_forces;
mod contrast;
mod desk;
mod every_scene;
mod files;
mod grab;
mod hints;
mod links;
mod maze;
mod narrow;
mod pictures;
mod pinball;
mod plots;
mod revisions;
mod scenes;
mod sides;
mod springs;
mod surfaces;
mod touch;
mod transport;
mod welcome;
