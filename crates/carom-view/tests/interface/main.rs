//! The interface as a user meets it: keys and buttons pressed, files dropped and changed, and
//! what becomes of it. Drawn by the software driver; physics in place, so that nothing depends on a
//! thread's timing.

mod contact_forces;
mod contrast;
mod desk;
mod every_scene;
mod files;
mod hints;
mod links;
mod maze;
mod narrow;
mod pictures;
mod plots;
mod revisions;
mod scenes;
mod sides;
mod springs;
mod touch;
mod transport;
