//! Springs and threads between balls, or from a ball to a fixed point.

use carom::{DVec3, SphereId, Spring, SpringEnd, SpringId};
use carom_session::{Command, Edit, View};
use egui::{CollapsingHeader, Ui};

use super::value::{Field, number, tick, vector};

/// Largest number of springs in the list.
const LISTED: usize = 24;

/// Stiffness of a new spring per mass of its lighter ball \[N/(m kg)\]; that ball swings about once a
/// second.
const NEW_STIFFNESS: f64 = 40.0;

const REST_LENGTH: Field = Field {
    name: "Rest length",
    unit: "m",
    hint: "Length at which it neither pulls nor pushes",
    min: 0.0,
    max: f64::INFINITY,
    is_whole: false,
};
const STIFFNESS: Field =
    Field { name: "Stiffness", unit: "N/m", hint: "Force per extension", ..REST_LENGTH };
const DAMPING: Field =
    Field { name: "Damping", unit: "kg/s", hint: "Force per speed of extension", ..REST_LENGTH };

pub(super) fn show(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let is_at_picked = |spring: &Spring| spring.spheres().any(|id| view.picked == Some(id));
    let (at_picked, others): (Vec<_>, Vec<_>) =
        view.springs.iter().partition(|(_, spring)| is_at_picked(spring));
    // A picked ball limits the list to its springs.
    let shown = if at_picked.is_empty() { &others } else { &at_picked };
    for (id, spring) in shown.iter().take(LISTED) {
        row(ui, *id, spring, commands);
    }
    let more = view.springs.len() - shown.len().min(LISTED);
    if more > 0 {
        ui.weak(format!("and {more} others: pick a ball for those at it"));
    }
    add(ui, view, commands);
}

/// Shows a spring under a title that unfolds it.
fn row(ui: &mut Ui, id: SpringId, before: &Spring, commands: &mut Vec<Command>) {
    let mut spring = *before;
    let header = CollapsingHeader::new(title(before)).id_salt(("spring", id));
    header.show(ui, |ui| {
        if let SpringEnd::Point(point) = &mut spring.to {
            let mut place = point.to_array();
            if vector(
                ui,
                Field::any("Fixed at", "m").hint("Point that holds the spring"),
                &mut place,
            ) {
                *point = DVec3::from_array(place);
            }
        }
        number(ui, REST_LENGTH, &mut spring.rest_length);
        number(ui, STIFFNESS, &mut spring.stiffness);
        number(ui, DAMPING, &mut spring.damping);
        tick(ui, "Only pulls", "A thread: slack up to its rest length", &mut spring.only_pulls);
        if spring != *before {
            commands.push(Command::Edit(Edit::Spring(id, spring)));
        }
        if ui.small_button("Remove spring").clicked() {
            commands.push(Command::Edit(Edit::RemoveSpring(id)));
        }
    });
}

/// Returns what a spring connects, in words.
fn title(spring: &Spring) -> String {
    match spring.to {
        SpringEnd::Sphere(other) => format!("ball {} to ball {other}", spring.sphere),
        SpringEnd::Point(point) => {
            let [x, y, z] = point.to_array().map(|it| (1e3 * it).round() / 1e3);
            format!("ball {} to ({x}, {y}, {z})", spring.sphere)
        }
    }
}

/// Shows buttons for springs of the picked ball: to the ball picked before, and to its own
/// position.
fn add(ui: &mut Ui, view: &View, commands: &mut Vec<Command>) {
    let before = picked_before(ui, view);
    let Some(ball) = view.picked.and_then(|id| Ball::of(view, id)) else {
        ui.weak("Pick a ball, or two one after the other, to join them.");
        return;
    };
    let mut add = |ui: &mut Ui, text: &str, spring: &dyn Fn() -> Spring| {
        if ui.small_button(text).clicked() {
            commands.push(Command::Edit(Edit::AddSpring(spring())));
        }
    };
    if let Some(other) = before.and_then(|id| Ball::of(view, id)) {
        let text = format!("+ spring to ball {}", other.id);
        add(ui, &text, &|| ball.joined_to(&other, view));
    }
    add(ui, "+ spring to this place", &|| {
        let spring = Spring::to_point(ball.id, ball.position, 0.0);
        spring.with_stiffness(NEW_STIFFNESS * ball.mass)
    });
}

/// Returns the ball that was picked before the present one.
fn picked_before(ui: &Ui, view: &View) -> Option<SphereId> {
    // In another scene the same number is another ball.
    let id = ui.scope_id().with(("picked", &view.scene.name));
    ui.data_mut(|data| {
        let [last, before]: &mut [Option<SphereId>; 2] = data.get_temp_mut_or_default(id);
        if view.picked.is_some() && view.picked != *last {
            (*last, *before) = (view.picked, *last);
        }
        *before
    })
}

/// A ball that can be connected.
struct Ball {
    id: SphereId,
    position: DVec3,
    mass: f64,
}

impl Ball {
    /// Returns the ball, if it is in the scene.
    fn of(view: &View, id: SphereId) -> Option<Self> {
        let index = view.spheres.index_of(id)?;
        let (position, mass) = (view.spheres.positions[index], view.spheres.masses[index]);
        Some(Self { id, position, mass })
    }

    /// Returns a spring to another ball, with the present distance as its rest length.
    fn joined_to(&self, other: &Self, view: &View) -> Spring {
        let boundary = carom::Boundary::from(view.setup.simulation.boundary);
        let length = boundary.nearest_image(other.position - self.position).length();
        let stiffness = NEW_STIFFNESS * self.mass.min(other.mass);
        Spring::between(self.id, other.id, length).with_stiffness(stiffness)
    }
}
