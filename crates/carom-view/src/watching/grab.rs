//! The picked ball in the hand: a spring pulls it after the pointer, and it flies on when it is let
//! go. While the scene is paused, it moves with the pointer.

use std::f64::consts::TAU;

use carom::{DVec3, SphereId, Spring, SpringEnd, SpringId};
use carom_session::{Command, Edit, SphereChange, View};

/// Swings of a held ball in a second of its viewer \[1/s\].
const FREQUENCY: f64 = 3.0;

/// Damping of the spring, as a part of the critical one.
const DAMPING: f64 = 0.7;

/// Largest angle by which a held ball swings in a frame of the scene \[rad\]: every rule takes so
/// stiff a spring.
const LARGEST_ANGLE: f64 = 0.5;

/// Number of frames of the interface after which a spring that did not come is given up.
const PATIENCE: u32 = 600;

/// A ball in the hand.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grab {
    ball: SphereId,
    /// Offset from the point under the pointer to where the ball is held, across the view \[m\].
    offset: DVec3,
    /// Where the ball is held \[m\].
    anchor: DVec3,
    /// Direction of view: the pointer moves in the plane across it.
    normal: DVec3,
    hold: Hold,
    /// Number of frames of the interface since the spring was added.
    age: u32,
    /// The picture in which it is held.
    pub side: usize,
}

/// How a ball is held.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Hold {
    /// It moves with the pointer; whether it has moved.
    Moved(bool),
    /// A spring was added after this one, and is not seen yet.
    Awaited(Option<SpringId>),
    /// The ball is held by this spring.
    Spring(SpringId),
}

impl Grab {
    /// Takes the sphere at an index, which is drawn at `center` \[m\], into the hand; `normal` is the
    /// direction of view.
    pub fn new(
        view: &View,
        index: usize,
        center: DVec3,
        normal: DVec3,
        commands: &mut Vec<Command>,
    ) -> Self {
        let hold = if view.playback.playing {
            let spring = holding_spring(view, index, center);
            commands.push(Command::Edit(Edit::AddSpring(spring)));
            Hold::Awaited(newest(view))
        } else {
            Hold::Moved(false)
        };
        let ball = view.spheres.ids[index];
        Self { ball, offset: DVec3::ZERO, anchor: center, normal, hold, age: 0, side: 0 }
    }

    /// Keeps the ball where it is, with the pointer above a point \[m\] in the picture of a side.
    pub fn held_at(self, under: DVec3, side: usize) -> Self {
        Self { offset: self.anchor - under, side, ..self }
    }

    /// Returns where the ball is held by a pointer on a ray \[m\].
    pub fn anchor_on(&self, origin: DVec3, direction: DVec3) -> Option<DVec3> {
        let distance = (self.anchor - origin).dot(self.normal) / direction.dot(self.normal);
        let place = origin + direction * distance + self.offset;
        (distance > 0.0 && place.is_finite()).then_some(place)
    }

    /// Finds the spring that was added, once the view has it.
    pub fn see_spring(&mut self, view: &View) {
        if let Hold::Awaited(before) = self.hold {
            self.age += 1;
            let added = newest(view).filter(|id| before.is_none_or(|before| *id > before));
            self.hold = added.map_or(self.hold, Hold::Spring);
        }
    }

    /// Moves the hand to a place, or lets go. Returns the ball that is still held.
    pub fn go_on(
        mut self,
        moved: Option<DVec3>,
        is_held: bool,
        view: &View,
        commands: &mut Vec<Command>,
    ) -> Option<Self> {
        let place = moved.filter(|place| *place != self.anchor);
        match self.hold {
            Hold::Moved(_) if !is_held => return None,
            Hold::Moved(goes_on) => {
                if let Some(position) = place {
                    let change =
                        SphereChange { position: Some(position), ..SphereChange::default() };
                    let edit = Edit::Sphere(self.ball, Box::new(change));
                    commands.push(command(edit, goes_on));
                    self.hold = Hold::Moved(true);
                }
            }
            Hold::Awaited(_) if self.age > PATIENCE => return None,
            // Without its id, the spring can neither be moved nor removed.
            Hold::Awaited(_) => return Some(self),
            Hold::Spring(id) => {
                let (_, spring) = view.springs.iter().find(|(it, _)| *it == id)?;
                if !is_held {
                    commands.push(command(Edit::RemoveSpring(id), true));
                    return None;
                }
                if let Some(place) = place {
                    let spring = Spring { to: SpringEnd::Point(place), ..*spring };
                    commands.push(command(Edit::Spring(id, spring), true));
                }
            }
        }
        self.anchor = place.unwrap_or(self.anchor);
        Some(self)
    }
}

/// Returns the command for an edit that begins a gesture or goes on with one.
fn command(edit: Edit, goes_on: bool) -> Command {
    if goes_on { Command::EditFurther(edit) } else { Command::Edit(edit) }
}

fn newest(view: &View) -> Option<SpringId> {
    view.springs.iter().map(|(id, _)| *id).max()
}

/// Returns the spring that holds the sphere at an index. It is as stiff as the hand is quick, at any
/// size and speed of playback.
fn holding_spring(view: &View, index: usize, place: DVec3) -> Spring {
    let mass = view.spheres.masses[index];
    let frame_time = view.setup.simulation.frame_time;
    let angular_frequency = (TAU * FREQUENCY / view.playback.speed).min(LARGEST_ANGLE / frame_time);
    Spring::to_point(view.spheres.ids[index], place, 0.0)
        .with_stiffness(mass * angular_frequency * angular_frequency)
        .with_damping(2.0 * DAMPING * mass * angular_frequency)
}
